// Everything that passed between a device and its renderer, tick by tick: kept while the loop runs, saved
// afterwards, replayed bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "feeler/device/force_safety.hpp"

namespace feeler {

/// One tick of a session: what came in, and what went to the motors.
struct SessionTick {
  ForceSafety::Tick tick;
  DeviceWrench pushed;
  ForcePhase phase = ForcePhase::waiting;
  ForceFault fault = ForceFault::none;  ///< the latest
};

/// A session as it is saved. Of the device only what the safety needs is kept.
struct SessionRecording {
  DeviceSpecification device;
  ForceLimits limits;
  std::vector<SessionTick> ticks;
  std::int64_t lost = 0;  ///< ticks for which there was no room
};

/// Takes the ticks of a `ServoLoop`. The room is made and touched beforehand, so that a tick only copies.
class SessionRecorder {
 public:
  /// @param capacity  ticks; later ones are counted and lost
  explicit SessionRecorder(std::size_t capacity);

  /// By the loop, before its first tick.
  void describe(const DeviceSpecification& device, const ForceLimits& limits);
  /// By the loop. No allocation.
  void add(const SessionTick& tick) noexcept {
    if (count_ < ticks_.size()) {
      ticks_[count_++] = tick;
    } else {
      ++lost_;
    }
  }

  /// After the loop has ended.
  SessionRecording recording() const;

 private:
  DeviceSpecification device_;
  ForceLimits limits_;
  std::vector<SessionTick> ticks_;
  std::size_t count_ = 0;
  std::int64_t lost_ = 0;
};

/// Writes a recording as a file of 8-byte words, little-endian; the same recording gives the same bytes.
/// @throws std::runtime_error when the file cannot be written
void save(const SessionRecording& recording, const std::filesystem::path& file);

/// @throws std::runtime_error for a file that cannot be read, is no recording, is of another version or was
/// cut off
SessionRecording load_session(const std::filesystem::path& file);

/// How a replay went.
struct Replay {
  std::size_t ticks = 0;
  std::int64_t first_other_wish = -1;  ///< tick in which the renderer wanted another wrench than recorded; −1 if in none
  std::int64_t first_other_push = -1;  ///< tick in which the motors would have got another wrench; −1 if in none

  bool is_exact() const noexcept { return first_other_wish < 0 && first_other_push < 0; }
};

/// Runs a recording through the safety again, and through a renderer if one is given; wrenches are compared
/// bit for bit. The ticks are rendered in which the loop rendered.
Replay replay(const SessionRecording& recording, const std::function<DeviceWrench(const DeviceState&)>& render = nullptr);

}  // namespace feeler
