// From the plain numbers of a device to the poses and wrenches of the renderer, and back; compiled on the user's side only.
#pragma once

#include <cstddef>

#include "feeler/device/device_state.hpp"

namespace feeler {

/// `PoseType` is a `Pose<Scalar>`: `from_device<Pose<double>>(state.pose)` [m, unit quaternion], base frame as world.
template <class PoseType>
PoseType from_device(const DevicePose& pose) noexcept {
  using Scalar = typename PoseType::Scalar;
  PoseType converted;
  for (int i = 0; i < 3; ++i) converted.translation[i] = Scalar(pose.position[i]);
  const double* q = pose.orientation;
  converted.rotation = decltype(converted.rotation)(Scalar(q[0]), Scalar(q[1]), Scalar(q[2]), Scalar(q[3]));
  return converted;
}

/// `PoseType` is a `Pose<Scalar>`; the quaternion is copied as it is, so pass a unit one.
template <class PoseType>
DevicePose to_device_pose(const PoseType& pose) noexcept {
  DevicePose converted;
  for (int i = 0; i < 3; ++i) converted.position[i] = double(pose.translation[i]);
  converted.orientation[0] = double(pose.rotation.w());
  converted.orientation[1] = double(pose.rotation.x());
  converted.orientation[2] = double(pose.rotation.y());
  converted.orientation[3] = double(pose.rotation.z());
  return converted;
}

/// `WrenchType` is a `Wrench<Scalar>` at the origin of the handle, base axes [N, N·m].
template <class WrenchType>
DeviceWrench to_device_wrench(const WrenchType& wrench) noexcept {
  DeviceWrench converted;
  for (int i = 0; i < 3; ++i) {
    converted.force[i] = double(wrench.force[i]);
    converted.torque[i] = double(wrench.torque[i]);
  }
  return converted;
}

/// A 6×6 matrix, row by row, for the `derivative` of a `WrenchModel`.
template <class Matrix, class Numbers>
void store_derivative(const Matrix& matrix, Numbers& numbers) noexcept {
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) numbers[std::size_t(6 * row + column)] = double(matrix(row, column));
  }
}

}  // namespace feeler
