// What encoders make of a pose: each coordinate rounded to a whole number of counts.
#pragma once

#include "feeler/device/device_state.hpp"

namespace feeler {

/// The pose on the grid of the encoders.
///
/// Positions are multiples of their resolution; the rotation vector from the base to the handle is one of its own, so the quaternion
/// stays a unit one. True gimbal encoders have a grid of joint angles instead: the count is the same, the pattern is not.
/// @param position_resolution  one count [m]; 0 passes positions through
/// @param rotation_resolution  one count [rad]; 0 passes orientations through
DevicePose quantised(const DevicePose& pose, double position_resolution, double rotation_resolution) noexcept;

}  // namespace feeler
