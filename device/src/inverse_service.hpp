// The connection to the Inverse Service of Haply, and the thread that exchanges messages with it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "inverse_service_message.hpp"

namespace feeler {

/// A WebSocket to the service. It answers each message with one state, so forces go out and states come in by turns.
class InverseService {
 public:
  /// Whom the exchange asks and tells, on its thread.
  class Client {
   public:
    /// @param force  to push next: x right, y forward, z up [N]; finite
    virtual void give_force(double (&force)[3]) noexcept = 0;
    virtual void take(const ServiceMessage& message) noexcept = 0;
    /// The connection is gone. The last call.
    virtual void end() noexcept = 0;

   protected:
    ~Client() = default;
  };

  InverseService();
  ~InverseService();  ///< as `stop`
  InverseService(const InverseService&) = delete;
  InverseService& operator=(const InverseService&) = delete;

  /// Connects and takes the list of devices that the service begins with; waits 2 s for each at most.
  /// @return what went wrong, as a sentence; empty where nothing did
  std::string connect(const std::string& host, std::uint16_t port, ServiceMessage& inventory);

  /// Starts the thread.
  /// @param client  outlives the exchange
  /// @param arm     whose force is set
  /// @param pause   from one message to the next [s]; a service that is slower is waited for, unless a force has to be taken away
  void start(Client& client, const std::string& arm, double pause);

  /// Ends the thread, sends a force of zero, and closes the connection; waits 0.3 s at most for a service that does not answer.
  void stop() noexcept;

 private:
  class Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace feeler
