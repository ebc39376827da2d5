// The smallest rotation between two directions.
#pragma once

#include <cmath>

#include <Eigen/Geometry>

namespace feeler::scenes {

/// The smallest rotation that takes the direction of `from` to that of `to`; where they are opposite, one of the half turns.
///
/// It is Eigen's FromTwoVectors without the singular value decomposition for opposite directions, which takes every file that calls it
/// ten seconds to compile.
inline Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond rotation;
  if (cosine < -1.0 + 1e-12) {
    rotation.w() = 0.0;
    rotation.vec() = a.unitOrthogonal();
  } else {
    const double twice_w = std::sqrt((1.0 + cosine) * 2.0);
    rotation.vec() = a.cross(b) * (1.0 / twice_w);
    rotation.w() = twice_w * 0.5;
  }
  return rotation;
}

}  // namespace feeler::scenes
