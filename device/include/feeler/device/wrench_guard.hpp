// One call for loops that are not ours: an engine's own loop, or that of another haptic library.
#pragma once

#include <string>

#include "feeler/device/device_state.hpp"
#include "feeler/device/force_safety.hpp"

namespace feeler {

/// Limits, ramps and watches the wrench of a loop that somebody else runs, at 25 to 10,000 Hz: a `ForceSafety` that keeps its own books.
///
/// It is plain arithmetic. It shortens, delays or stops a wrench, and never turns one; a frame that comes late fades the force, a NaN stops it. It is
/// called in each frame, so it cannot silence a loop that calls it no more: that is for the device, or for a `ForceWatchdog`.
class WrenchGuard {
 public:
  /// Refuses (`std::invalid_argument`) a rate below 25 or above 10,000 Hz, and limits that `check` refuses.
  /// @param device  whose motors push
  /// @param rate    of the loop, about [Hz]
  WrenchGuard(const DeviceSpecification& device, double rate);
  /// The same with limits of your own; they are those of the device otherwise.
  WrenchGuard(const DeviceSpecification& device, double rate, const ForceLimits& limits);
  /// The sentence with which a constructor refuses; empty where it does not. For `try_make<WrenchGuard>`, in programs without exceptions.
  static std::string reason_against(const DeviceSpecification& device, double rate);
  static std::string reason_against(const DeviceSpecification& device, double rate, const ForceLimits& limits);

  /// What to push now. Once in each frame, also while nothing is touched. No allocation.
  /// @param state   as the device gave it. `time` is when the pose was taken, on the device's own clock [s]; a pose with the time of the last one is old.
  ///                Where the device tells no time, give `now`: then only a loop that is late is noticed, not a device that repeats itself
  /// @param wanted  by the renderer: force and torque on the hand, at the origin of the handle, axes of the device
  /// @param now     of this call, on any clock that goes forward [s]
  /// @param status  what the device says of itself; anything but `ok` is silence
  DeviceWrench allowed(const DeviceState& state, const DeviceWrench& wanted, double now, DeviceStatus status = DeviceStatus::ok) noexcept;

  /// Nothing from now on, until `restart`.
  void stop() noexcept { request_ = ForceRequest::stop; }
  /// After a stop or a NaN: the force comes back by the ramp, once the pose is free.
  void restart() noexcept {
    if (request_ != ForceRequest::stop) request_ = ForceRequest::restart;
  }

  ForcePhase phase() const noexcept { return safety_.phase(); }
  ForceFault fault() const noexcept { return safety_.fault(); }  ///< the latest
  const ForceReport& report() const noexcept { return safety_.report(); }

 private:
  ForceSafety safety_;
  ForceSafety::Tick tick_;
  ForceRequest request_ = ForceRequest::none;
  bool has_ticked_ = false;
};

}  // namespace feeler
