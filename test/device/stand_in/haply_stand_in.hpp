// An Inverse Service in this process, with an arm and a grip that have faults on demand: a real WebSocket server on a port of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace feeler_test {

/// Speaks as the service does: a list of devices first, then one state for each message. A force acts until the next message; one that nobody sends
/// messages for any more ends after 20 ms.
class HaplyStandIn {
 public:
  /// What its hand does, and which faults it has.
  struct World {
    // In the maker's frame: x right, y forward, z up.
    double position[3] = {0, 0, 0};        // [m]
    double orientation[4] = {1, 0, 0, 0};  // w, x, y, z
    bool buttons[3] = {false, false, false};

    std::vector<std::string> arms = {"049D"};
    std::vector<std::string> grips = {"61548"};
    std::string type = "inverse3";
    bool is_wired = false;  // the grip

    // Faults.
    bool is_calibrated = true;
    bool tells_calibration = true;
    bool has_power = true;
    bool is_ready = true;
    bool is_grip_awake = true;
    bool is_grip_told = true;    // in states; the list of devices has it all the same
    bool is_unplugged = false;   // the arm
    bool is_silent = false;      // takes messages and does not answer
    bool declines = false;       // is no WebSocket
    int late = 0;                // [ms]: the time that an answer takes
    std::string says_instead = {};  // of what it would say
    bool closes = false;         // the connection, with the next message
  };

  HaplyStandIn();
  ~HaplyStandIn();
  HaplyStandIn(const HaplyStandIn&) = delete;
  HaplyStandIn& operator=(const HaplyStandIn&) = delete;

  std::uint16_t port() const;
  void set(const World& world);
  /// Ends it as a crash does.
  void die();

  /// What the motors of the arm "049D" were told; quiet 20 ms after the last message too.
  bool is_silent() const;
  double pushed() const;  // now [N]
  double peak() const;    // so far [N]
  /// The last force that was not zero: x right, y forward, z up [N].
  void last_push(double (&force)[3]) const;
  int messages() const;
  int wrong_messages() const;  // that are none of the protocol, or for an arm that there is not
  /// Which arm was told to push last.
  std::string pushed_arm() const;

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace feeler_test
