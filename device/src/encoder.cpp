// Rounds a pose to the counts of encoders.
#include "feeler/device/encoder.hpp"

#include <cmath>

#include "feeler/device/conversion.hpp"
#include "feeler/spatial/pose.hpp"

namespace feeler {
namespace {

Vector3<double> rounded(const Vector3<double>& v, double resolution) noexcept {
  if (!(resolution > 0)) return v;
  return {std::round(v.x() / resolution) * resolution, std::round(v.y() / resolution) * resolution, std::round(v.z() / resolution) * resolution};
}

}  // namespace

// Flattened for the reason given in simulated_hand.cpp.
[[gnu::flatten]] DevicePose quantised(const DevicePose& pose, double position_resolution, double rotation_resolution) noexcept {
  auto exact = from_device<Pose<double>>(pose);
  exact.translation = rounded(exact.translation, position_resolution);
  if (rotation_resolution > 0) {
    exact.rotation = exp_rotation(rounded(log_rotation(exact.rotation), rotation_resolution));
  }
  return to_device_pose(exact);
}

}  // namespace feeler
