// The bounds of a device from its specification.
#include "feeler/device/stiffness_limits.hpp"

#include <limits>

namespace feeler {

double quantised_stiffness(double friction, double resolution) noexcept {
  return resolution > 0 ? 2 * friction / resolution : std::numeric_limits<double>::infinity();
}

StiffnessLimits stiffness_limits_of(const DeviceSpecification& device, double period) noexcept {
  return {passive_stiffness(device.damping, period), quantised_stiffness(device.friction, device.position_resolution),
          device.pushes_torque() ? passive_stiffness(device.rotational_damping, period) : 0};
}

}  // namespace feeler
