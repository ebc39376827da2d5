// What a force must keep to between the renderer and the motors.
#pragma once

#include <string>

#include "feeler/device/device_specification.hpp"

namespace feeler {

/// Limits of a `ForceSafety`. They can be tightened at will and loosened only within the bounds given here;
/// none can be turned off.
struct ForceLimits {
  double maximum_force = 0;      ///< at any moment; at most the device's [N]
  double continuous_force = 0;   ///< for ever; at most the maximum [N]
  double maximum_torque = 0;     ///< at any moment; at most the device's, 0 for a force-only device [N·m]
  double continuous_torque = 0;  ///< for ever; at most the maximum [N·m]

  double force_slew = 0;   ///< fastest growth of the force; at most the maximum in a millisecond [N/s]
  double torque_slew = 0;  ///< fastest growth of the torque; at most the maximum in a millisecond [N·m/s]

  double free_force = 0;  ///< a pose counts as free where the renderer wants less; at most a tenth of the maximum [N]
  double free_torque = 0;  ///< the same of the torque [N·m]

  double ramp_time = 0.3;    ///< from nothing to the whole force, once the pose is free; at least 0.05 [s]
  double fade_time = 0.002;  ///< from the force to nothing, when a tick is late; at most 0.002 [s]
  double latest_tick =
      0.003;  ///< longest time between two poses, and for which one may stay the latest; 0.0005 to 25 ticks at the device's slowest rate [s]

  double heating_time = 10;  ///< time constant of the motors' heating; 1 to 100 [s]
  double warm_temperature = 0.8;  ///< share of the motors' highest temperature from which on the force shrinks; 0 to 0.95
};

/// The limits that suit a device: its own figures, growth to the maximum in 10 ms, free below 2 % of the
/// maximum.
/// @param period  of the loop; two ticks in a row may be lost [s]
ForceLimits limits_of(const DeviceSpecification& device, double period = 1e-3);

/// Refuses (`std::invalid_argument`) limits outside their bounds, or above what the device can do, and a device that is said to do more than 10,000 N or
/// N·m: an infinity limits nothing.
void(check)(const ForceLimits& limits, const DeviceSpecification& device);  // a macro of engines
/// The sentence with which `check` refuses; empty where it does not.
std::string reason_against(const ForceLimits& limits, const DeviceSpecification& device);

}  // namespace feeler
