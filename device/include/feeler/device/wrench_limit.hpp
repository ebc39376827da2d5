// Limits of a wrench: what a device can push, with the direction kept.
#pragma once

#include "feeler/device/device_state.hpp"

namespace feeler {

/// The wrench with force and torque each shortened to their maximum, direction kept: cutting axis by axis would push sideways.
/// @param maximum_force [N], at least 0
/// @param maximum_torque [N·m], at least 0
/// @return a zero force or torque where the one given is not finite
DeviceWrench limited(const DeviceWrench& wrench, double maximum_force, double maximum_torque) noexcept;

/// False for a NaN or an infinity in any component.
bool is_finite(const DeviceWrench& wrench) noexcept;

}  // namespace feeler
