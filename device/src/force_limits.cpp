// Takes the limits of a device from its figures, and refuses those that would be none.
#include "feeler/device/force_limits.hpp"

#include <algorithm>

#include "feeler/core/requirement.hpp"

namespace feeler {
namespace {

// False for a NaN.
bool is_within(double value, double low, double high) noexcept { return value >= low && value <= high; }

constexpr double most_of_any_device = 10'000;  // [N, N·m]

/// 25 ticks at the slowest rate that the device accepts: 0.05 s for most [s].
double latest_tick_of_all(const DeviceSpecification& device) noexcept {
  return std::max(0.003, 25 / (device.minimum_rate > 0 ? device.minimum_rate : 500));
}

}  // namespace

ForceLimits limits_of(const DeviceSpecification& device, double period) {
  ForceLimits limits;
  limits.maximum_force = device.maximum_force;
  limits.continuous_force = device.continuous_force;
  limits.maximum_torque = device.maximum_torque;
  limits.continuous_torque = device.continuous_torque;
  limits.force_slew = device.maximum_force / 0.01;
  limits.torque_slew = device.maximum_torque / 0.01;
  limits.free_force = 0.02 * device.maximum_force;
  limits.free_torque = 0.02 * device.maximum_torque;
  limits.latest_tick = std::clamp(3 * period, 0.003, latest_tick_of_all(device));
  return limits;
}

std::string reason_against(const ForceLimits& limits, const DeviceSpecification& device) {
  struct Rule {
    bool is_kept;
    const char* sentence;
  };
  for (const auto& [is_kept, sentence] : {
           Rule{!(device.maximum_force > most_of_any_device) && !(device.maximum_torque > most_of_any_device),
                "the maximum force or torque of the device is more than 10000, which is no limit to a hand; give its newtons and newton metres"},
           Rule{limits.maximum_force > 0 && limits.maximum_force <= device.maximum_force,
                "the maximum force must be positive and at most the device's"},
           Rule{limits.continuous_force > 0 && limits.continuous_force <= limits.maximum_force,
                "the continuous force must be positive and at most the maximum; a quarter of it is careful"},
           Rule{is_within(limits.maximum_torque, 0, device.maximum_torque), "the maximum torque must be at least 0 and at most the device's"},
           Rule{is_within(limits.continuous_torque, 0, limits.maximum_torque) && (limits.continuous_torque > 0) == (limits.maximum_torque > 0),
                "the continuous torque must be positive where torque is pushed, and at most the maximum"},
           Rule{limits.force_slew > 0 && limits.force_slew <= 1000 * limits.maximum_force,
                "the force must take at least a millisecond to grow to its maximum"},
           Rule{limits.maximum_torque == 0 || (limits.torque_slew > 0 && limits.torque_slew <= 1000 * limits.maximum_torque),
                "the torque must take at least a millisecond to grow to its maximum"},
           Rule{is_within(limits.free_force, 0, 0.1 * limits.maximum_force) && is_within(limits.free_torque, 0, 0.1 * limits.maximum_torque),
                "a pose is free below a tenth of the maximum at most"},
           Rule{is_within(limits.ramp_time, 0.05, 60), "the ramp must take 0.05 to 60 s"},
           Rule{is_within(limits.fade_time, 0, 0.002), "the fade must take 0 to 0.002 s"},
           Rule{is_within(limits.latest_tick, 0.0005, latest_tick_of_all(device)),
                "the latest tick must be 0.0005 s to 25 ticks at the slowest rate of the device"},
           Rule{is_within(limits.heating_time, 1, 100), "the motors heat in 1 to 100 s"},
           Rule{is_within(limits.warm_temperature, 0, 0.95), "motors are warm from a share of 0 to 0.95 on"},
       }) {
    if (!is_kept) return std::string("force limits: ") + sentence;
  }
  return {};
}

void check(const ForceLimits& limits, const DeviceSpecification& device) { refuse_for(reason_against(limits, device)); }

}  // namespace feeler
