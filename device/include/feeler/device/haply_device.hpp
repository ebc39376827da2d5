// Devices of Haply through its Inverse Service: an Inverse3 that pushes, and a VerseGrip that turns.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "feeler/device/driven_device.hpp"

namespace feeler {

/// How to find an Inverse3 and its grip.
struct HaplySettings {
  std::string host = "localhost";    ///< where the Inverse Service runs
  std::uint16_t port = 10001;        ///< of its simulation channel
  std::string serial_number = {};    ///< `device_id` of one of several arms, "049D" for example; goes before the index
  std::optional<int> index = {};     ///< of one of several, from 0 as the service lists them; neither takes the first
  std::string grip = {};             ///< `device_id` of one of several grips; empty takes the only one
  bool needs_grip = true;            ///< a device without a grip is refused; else it senses and pushes positions only
  double period = 1e-3;              ///< of the servo loop [s]; the service is asked twice in each
};

/// An Inverse3 with a VerseGrip behind the Inverse Service, a program of Haply's on this computer that answers JSON over a WebSocket.
///
/// The exchange with the service has a thread of its own; `read` and `write` hand pose and wrench over without waiting. It is a watchdog too: after
/// five periods (5 ms at least) without a new wrench it sends a force of zero, and the service lets an arm go that nobody sends forces for.
///
/// The service's frame is x right, y forward, z up, in metres and newtons; it ends here. The time of a pose is when it came. While none comes for 20 ms,
/// or the grip sleeps, or the arm has no power or is not calibrated, every `read` is a warning that says so and nothing is pushed. A service that is
/// silent for a second or gone, an arm that is unplugged, and a pose that is none end the session.
///
/// Needs a build with Boost.Beast and nlohmann's JSON; without them `open` says so.
class HaplyDevice final : public DrivenDevice {
 public:
  /// Refuses (`std::invalid_argument`) a period that is not from 0.00001 to 1 s.
  explicit HaplyDevice(HaplySettings settings = {});
  /// The sentence with which the constructor refuses; empty where it does not. For `try_make`.
  static std::string reason_against(const HaplySettings& settings = {});
};

}  // namespace feeler
