// Shortens force and torque to what a device can push.
#include "feeler/device/wrench_limit.hpp"

#include <algorithm>
#include <cmath>

namespace feeler {
namespace {

bool is_finite(const double (&v)[3]) noexcept { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

void shorten(double (&v)[3], double maximum) noexcept {
  if (!is_finite(v)) {
    std::fill(v, v + 3, 0.0);
    return;
  }
  // In units of the largest component, because the square of a large double is not one.
  const double unit = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  if (unit == 0) return;
  const double length = std::hypot(v[0] / unit, v[1] / unit, v[2] / unit);
  const double allowed = maximum / unit;
  if (length <= allowed) return;
  for (double& component : v) component *= allowed / length;
}

}  // namespace

DeviceWrench limited(const DeviceWrench& wrench, double maximum_force, double maximum_torque) noexcept {
  DeviceWrench result = wrench;
  shorten(result.force, maximum_force);
  shorten(result.torque, maximum_torque);
  return result;
}

bool is_finite(const DeviceWrench& wrench) noexcept { return is_finite(wrench.force) && is_finite(wrench.torque); }

}  // namespace feeler
