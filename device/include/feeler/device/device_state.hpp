// What crosses the border to a device, as plain numbers: pose, buttons and time in; force and torque out.
#pragma once

#include <cstdint>

#include "feeler/core/no_fast_math.hpp"

namespace feeler {

/// Pose of the handle in the device's base frame. Plain numbers, because the size of an Eigen type changes with compiler flags.
struct DevicePose {
  double position[3] = {0, 0, 0};        ///< [m]
  double orientation[4] = {1, 0, 0, 0};  ///< unit quaternion w, x, y, z: base from handle
};

/// What a device reports in one tick.
struct DeviceState {
  DevicePose pose;
  std::uint32_t buttons = 0;  ///< bit n is button n, set while pressed
  double time = 0;            ///< when the pose was taken, since `open` [s]
  double motor_temperature = 0;  ///< of the hottest motor: 0 cold, 1 where the device cuts out; 0 from a device that does not say
};

/// What a device pushes with: force and torque on the hand, base axes, at the origin of the handle.
struct DeviceWrench {
  double force[3] = {0, 0, 0};   ///< [N]
  double torque[3] = {0, 0, 0};  ///< [N·m]
};

}  // namespace feeler
