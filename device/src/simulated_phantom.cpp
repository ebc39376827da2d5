// The simulated Phantom: delay, saturation and encoders around a simulated hand.
#include "feeler/device/simulated_phantom.hpp"

#include <utility>

#include "feeler/device/encoder.hpp"
#include "feeler/device/wrench_limit.hpp"

namespace feeler {
namespace {

Handle handle_of(const SimulatedPhantomSettings& settings) noexcept {
  const DeviceSpecification& device = settings.specification;
  return {.mass = device.apparent_mass,
          .inertia = device.apparent_inertia,
          .damping = device.damping,
          .rotational_damping = device.rotational_damping,
          .friction = settings.has_friction ? device.friction : 0,
          .rotational_friction = settings.rotational_friction};
}

}  // namespace

SimulatedPhantom::SimulatedPhantom(DevicePath path, const SimulatedPhantomSettings& settings)
    : settings_(settings), at_start_(std::move(path), handle_of(settings), settings.grip, settings.period, settings.substeps), hand_(at_start_) {}

OpenResult SimulatedPhantom::open() {
  if (is_open_) return {};
  hand_ = at_start_;
  written_ = {};
  pushing_ = {};
  is_started_ = false;
  is_open_ = true;
  return {};
}

DeviceStatus SimulatedPhantom::read(DeviceState& state) noexcept {
  if (!is_open_) return DeviceStatus::not_open;
  if (is_started_) {
    hand_.advance(pushing_);
    pushing_ = written_;
  }
  is_started_ = true;
  const DeviceSpecification& device = settings_.specification;
  state = {quantised(hand_.pose(), device.position_resolution, device.rotation_resolution), buttons_, hand_.time()};
  return DeviceStatus::ok;
}

DeviceStatus SimulatedPhantom::write(const DeviceWrench& wrench) noexcept {
  if (!is_open_) return DeviceStatus::not_open;
  if (!is_finite(wrench)) {
    written_ = {};
    return DeviceStatus::not_finite;
  }
  written_ = limited(wrench, settings_.specification.maximum_force, settings_.specification.maximum_torque);
  return DeviceStatus::ok;
}

}  // namespace feeler
