// Shortens force and torque to what a device can push.
#include "feeler/device/wrench_limit.hpp"

#include <algorithm>
#include <cmath>

namespace feeler {
namespace {

bool is_finite(const double (&v)[3]) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

void shorten(double (&v)[3], double maximum) noexcept {
  if (!is_finite(v)) {
    std::fill(v, v + 3, 0.0);
    return;
  }
  // Scaled by the largest component first: the square of 1e200 is not a number to divide by.
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (largest == 0) return;
  const double length = std::hypot(v[0] / largest, v[1] / largest, v[2] / largest) * largest;
  if (length <= maximum) return;
  for (double& component : v) component *= maximum / length;
}

}  // namespace

DeviceWrench limited(const DeviceWrench& wrench, double maximum_force, double maximum_torque) noexcept {
  DeviceWrench result = wrench;
  shorten(result.force, maximum_force);
  shorten(result.torque, maximum_torque);
  return result;
}

bool is_finite(const DeviceWrench& wrench) noexcept {
  return is_finite(wrench.force) && is_finite(wrench.torque);
}

}  // namespace feeler
