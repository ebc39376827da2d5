// What stands between the renderer and the motors: it may shorten, delay or stop a wrench, and never
// lengthens or turns one.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "feeler/device/device.hpp"
#include "feeler/device/force_limits.hpp"

namespace feeler {

/// What the motors are allowed to do.
enum class ForcePhase : std::uint8_t {
  waiting,  ///< nothing, until the pose is free
  ramping,  ///< a growing share of the wrench
  on,       ///< the wrench
  fading,   ///< a shrinking share of the last wrench
  stopped,  ///< nothing, until `restart`; for good when the device is lost
};

/// Why the force was taken away.
enum class ForceFault : std::uint8_t {
  none,
  late_tick,       ///< fades, then ramps
  stale_pose,      ///< fades, then ramps
  device_warning,  ///< nothing at once, until the pose is free
  hot_motors,      ///< nothing at once, until the pose is free
  not_finite,      ///< stops
  emergency_stop,  ///< stops
  device_lost,     ///< stops for good
};
constexpr int force_faults = 8;

/// What the program asks of the force.
enum class ForceRequest : std::uint8_t {
  none,
  stop,     ///< emergency stop: nothing from this tick on
  restart,  ///< ends a stop, unless the device is lost: as at the start, it waits for a free pose
};

/// One sentence for a log or a message box.
const char* to_string(ForceFault fault) noexcept;
const char* to_string(ForcePhase phase) noexcept;

/// What the safety of a session did.
struct ForceReport {
  std::array<std::int64_t, force_faults> ticks_with = {};  ///< by `ForceFault`
  ForceFault first_fault = ForceFault::none;
  double first_fault_time = 0;       ///< on the device's clock [s]
  std::int64_t ticks_shortened = 0;  ///< to the maximum, or to what the motors' heat left of it
  std::int64_t ticks_slowed = 0;     ///< by the slew limit
  double peak_force = 0;             ///< pushed [N]
  double peak_torque = 0;            ///< pushed [N·m]
  double peak_force_heat = 0;        ///< 1 is what the continuous force heats the motors to, in the end
  double peak_torque_heat = 0;
  std::int64_t ticks_without_torque = 0;                        ///< in which the renderer wanted a torque that the device has no motors for
  double peak_lost_torque = 0;  ///< the largest of those torques [N·m]
};

/// Turns the wrench that the renderer wants into one that the motors may push. In this order:
///
/// 1. A device that is lost, a pose or a wrench that is not finite, an emergency stop: nothing, at once, and
/// it stays so.
/// 2. A complaint of the device, or a motor at its highest temperature: nothing, at once. A late tick or a
/// stale pose: the last wrench fades to
///    nothing within `fade_time`, and comes back by the ramp.
/// 3. At the start, after a restart and after a complaint: nothing, until the renderer wants (nearly)
/// nothing. Then the ramp.
/// 4. The torque that the device has no motors for is dropped, and reported.
/// 5. Saturation with the direction kept: at most the maximum; less as the motors warm up, and never more in
/// the long run than the
///    continuous force heats them to: h' = (|F|²/F_c² − h)/τ, and the limit falls from the maximum at h = 0.8
///    to F_c at h = 1.
/// 6. Slew: force and torque grow at most so fast; they shrink at once, so that free space is free. The
/// direction is always the wanted one.
///
/// It knows no clock and shares nothing: the same ticks give the same wrenches, bit for bit.
class ForceSafety {
 public:
  /// What one tick knows.
  struct Tick {
    double now = 0;                          ///< on the clock of the loop [s]
    double period = 1e-3;                    ///< until the next tick, as planned [s]
    double age = 0;                          ///< of the pose when its wrench was ready [s]
    DeviceStatus status = DeviceStatus::ok;  ///< of the write before and of this read, the worse of both
    ForceRequest request = ForceRequest::none;
    DeviceState state;    ///< as read
    DeviceWrench wanted;  ///< by the renderer
  };

  /// Refuses (`std::invalid_argument`) what `check` refuses.
  ForceSafety(const ForceLimits& limits, const DeviceSpecification& device);
  static std::string reason_against(const ForceLimits& limits, const DeviceSpecification& device) { return feeler::reason_against(limits, device); }

  /// What to write. No allocation.
  DeviceWrench step(const Tick& tick) noexcept;

  ForcePhase phase() const noexcept { return phase_; }
  ForceFault fault() const noexcept { return fault_; }  ///< the latest
  const ForceReport& report() const noexcept { return report_; }

 private:
  ForceFault stopping_fault(const Tick& tick) noexcept;
  ForceFault passing_fault(const Tick& tick) const noexcept;
  void note(ForceFault fault, double time) noexcept;
  void interrupt(ForceFault fault, double now) noexcept;
  DeviceWrench faded(const Tick& tick) noexcept;
  DeviceWrench allowed(const Tick& tick, ForceFault passing) noexcept;
  void account(const DeviceWrench& pushed) noexcept;

  ForceLimits limits_;
  bool pushes_torque_;
  ForcePhase phase_ = ForcePhase::waiting;
  ForceFault fault_ = ForceFault::none;
  bool is_lost_ = false;

  bool has_pose_ = false;  // one was seen before this tick
  double pose_time_ = 0;   // its time, on the device's clock
  double renewed_at_ = 0;  // when it came, on the clock of the loop
  double step_time_ = 0;   // since the pose before [s]; bounded

  double share_ = 0;       // of the ramp
  double fade_start_ = 0;  // on the clock of the loop
  double faded_for_ = 0;   // with the tick to come [s]
  DeviceWrench fading_;    // what it fades from
  DeviceWrench last_;      // pushed in the last tick
  double force_heat_ = 0;
  double torque_heat_ = 0;
  ForceReport report_;
};

}  // namespace feeler
