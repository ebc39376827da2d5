// Keeps the account of the energy, and pays its debts with a damper.
#include "feeler/device/passivity_control.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "feeler/core/requirement.hpp"
#include "feeler/device/conversion.hpp"
#include "feeler/device/wrench_limit.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {
namespace {

using Axes = std::array<double, 6>;  // linear, then angular

Axes axes_of(const DeviceWrench& wrench) noexcept {
  return {wrench.force[0], wrench.force[1], wrench.force[2], wrench.torque[0], wrench.torque[1], wrench.torque[2]};
}
DeviceWrench wrench_of(const Axes& axes) noexcept { return {{axes[0], axes[1], axes[2]}, {axes[3], axes[4], axes[5]}}; }

bool is_nothing(const Axes& wrench) noexcept {
  return std::all_of(wrench.begin(), wrench.end(), [](double component) { return component == 0; });
}

/// p(n) − p(n−1) [m] and Log(R(n) R(n−1)ᵀ) [rad]. Flattened for the reason given in simulated_hand.cpp.
[[gnu::flatten]] Axes motion_of(const DevicePose& from, const DevicePose& to) noexcept {
  const auto twist = motion_between(from_device<Pose<double>>(from).normalized(), from_device<Pose<double>>(to).normalized());
  return {twist.linear[0], twist.linear[1], twist.linear[2], twist.angular[0], twist.angular[1], twist.angular[2]};
}

bool is_pose(const DeviceState& state) noexcept {
  double sum = state.time;
  for (const double p : state.pose.position) sum += p;
  double length = 0;
  for (const double q : state.pose.orientation) length += q * q;
  return std::isfinite(sum) && std::isfinite(length) && length > 0;
}

}  // namespace

PassivitySettings passivity_of(const DeviceSpecification& device, double period) {
  PassivitySettings settings;
  settings.damping = device.apparent_mass / (4 * period);
  if (device.position_resolution > 0 && device.friction > 0) {
    settings.damping = std::min(settings.damping, device.friction * period / device.position_resolution);
  }
  settings.allowance = device.continuous_force * device.position_resolution;
  if (device.pushes_torque()) settings.rotational_damping = device.apparent_inertia / (4 * period);
  return settings;
}

std::string PassivityControl::reason_against(const PassivitySettings& settings) {
  const auto is_amount = [](double value) { return std::isfinite(value) && value >= 0; };
  if (!is_amount(settings.damping) || !is_amount(settings.rotational_damping) || !is_amount(settings.allowance))
    return "passivity control: dampings and allowance must be finite and not negative; take them from passivity_of";
  if (settings.delay != 0 && settings.delay != 1) return "passivity control: a wrench is pushed 0 or 1 ticks after its write";
  return {};
}

PassivityControl::PassivityControl(const PassivitySettings& settings) : settings_(settings) {
  refuse_for(reason_against(settings));
  for (std::size_t axis = 0; axis < 6; ++axis) damping_[axis] = axis < 3 ? settings.damping : settings.rotational_damping;
}

DeviceWrench PassivityControl::damped(const DeviceState& state, const DeviceWrench& wanted) noexcept {
  if (!is_pose(state) || !is_finite(wanted)) return wanted;
  const double time = state.time - last_time_;
  const Axes motion = has_pose_ ? motion_of(last_pose_, state.pose) : Axes{};
  last_pose_ = state.pose;
  last_time_ = state.time;
  has_pose_ = true;

  Axes result = axes_of(wanted);
  if (is_nothing(result)) {
    energy_ = {};
    report_.energy = 0;
    return wanted;
  }
  const Axes pushing = axes_of(pushing_);
  double total = 0;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    energy_[axis] -= pushing[axis] * motion[axis];
    total += energy_[axis];
  }
  report_.energy = total;
  const bool is_total = settings_.sum == EnergySum::total;
  report_.lowest_energy = std::min(report_.lowest_energy, is_total ? total : *std::min_element(energy_.begin(), energy_.end()));
  if (!(time > 0)) return wanted;

  Axes velocity{};
  Axes whole{};  // power that the whole damping would take, by axis [W]
  double whole_total = 0;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    velocity[axis] = motion[axis] / time;
    whole[axis] = damping_[axis] * velocity[axis] * velocity[axis];
    whole_total += whole[axis];
  }
  double taken = 0;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const double debt = -(is_total ? total : energy_[axis]) - settings_.allowance;
    if (!(debt > 0) || !(whole[axis] > 0)) continue;
    const double share = std::min(1.0, debt / (time * (is_total ? whole_total : whole[axis])));
    result[axis] -= share * damping_[axis] * velocity[axis];
    taken += share * whole[axis] * time;
  }
  if (taken > 0) ++report_.ticks_damped;
  report_.dissipated += taken;
  return wrench_of(result);
}

void PassivityControl::pushed(const DeviceWrench& wrench) noexcept {
  pushing_ = settings_.delay == 0 ? wrench : written_;
  written_ = wrench;
}

}  // namespace feeler
