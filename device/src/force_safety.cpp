// Decides in each tick what the motors may push.
#include "feeler/device/force_safety.hpp"

#include <algorithm>
#include <cmath>

#include "feeler/device/wrench_limit.hpp"

namespace feeler {
namespace {

constexpr double warm_heat = 0.8;  // of the budget, where the limit begins to fall

double dot(const double (&a)[3], const double (&b)[3]) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const double (&v)[3]) noexcept { return std::hypot(v[0], v[1], v[2]); }

bool is_finite(const DevicePose& pose) noexcept {
  double sum = 0;
  for (const double p : pose.position) sum += p;
  for (const double q : pose.orientation) sum += q;
  return std::isfinite(sum);
}

/// What is left of a limit: all of it below `warm`, nothing at 1.
double share_left(double heat, double warm) noexcept { return std::clamp((1 - heat) / (1 - warm), 0.0, 1.0); }

/// Steps h' = (|F|²/F_c² − h)/τ, exactly for a constant force.
void warm_up(double& heat, double force, double continuous, double heating_time, double time) noexcept {
  if (!(continuous > 0)) return;
  const double end = (force / continuous) * (force / continuous);
  heat = end + (heat - end) * std::exp(-time / heating_time);
}

/// Lets the vector grow by `growth` beyond the part of the last one that lies along it.
/// @return true if it was shortened
bool slow_down(double (&wanted)[3], const double (&last)[3], double growth) noexcept {
  const double goal = length(wanted);
  if (!(goal > 0)) return false;
  const double kept = std::clamp(dot(last, wanted) / goal, 0.0, goal);
  const double reached = kept + growth;
  if (goal <= reached) return false;
  for (double& component : wanted) component *= reached / goal;
  return true;
}

DeviceWrench scaled(const DeviceWrench& wrench, double share) noexcept {
  DeviceWrench result = wrench;
  for (double& component : result.force) component *= share;
  for (double& component : result.torque) component *= share;
  return result;
}

}  // namespace

const char* to_string(ForceFault fault) noexcept {
  switch (fault) {
    case ForceFault::none: return "no fault";
    case ForceFault::late_tick: return "a tick was late: the force fades and comes back";
    case ForceFault::stale_pose: return "the device repeats an old pose: the force fades and comes back with a new one";
    case ForceFault::device_warning: return "the device complains: the force is off, and comes back once the pose is free";
    case ForceFault::hot_motors: return "the motors are hot: let them cool; the force is off, and comes back once the pose is free";
    case ForceFault::not_finite: return "a pose or a wrench was not finite: the force is off until it is restarted";
    case ForceFault::emergency_stop: return "the program stopped the force: it is off until it is restarted";
    case ForceFault::device_lost: return "the device is lost: the force is off";
  }
  return "unknown fault";
}

const char* to_string(ForcePhase phase) noexcept {
  switch (phase) {
    case ForcePhase::waiting: return "waiting for a free pose";
    case ForcePhase::ramping: return "ramping";
    case ForcePhase::on: return "on";
    case ForcePhase::fading: return "fading";
    case ForcePhase::stopped: return "stopped";
  }
  return "unknown phase";
}

ForceSafety::ForceSafety(const ForceLimits& limits, const DeviceSpecification& device)
    : limits_(limits), pushes_torque_(device.pushes_torque() && limits.maximum_torque > 0) {
  check(limits, device);
}

DeviceWrench ForceSafety::step(const Tick& tick) noexcept {
  const double since_last = tick.state.time - pose_time_;
  step_time_ = has_pose_ ? std::clamp(since_last, 0.0, limits_.latest_tick) : 0;

  DeviceWrench pushed;
  const ForceFault stopping = stopping_fault(tick);
  if (stopping != ForceFault::none) {
    note(stopping, tick.state.time);
    phase_ = ForcePhase::stopped;
  } else if (phase_ != ForcePhase::stopped) {
    const ForceFault passing = passing_fault(tick);
    if (passing != ForceFault::none) {
      note(passing, tick.state.time);
      interrupt(passing, tick.now);
    }
    pushed = phase_ == ForcePhase::fading ? faded(tick) : allowed(tick, passing);
  }

  // A clock that was set back must not make an old pose young.
  if (!has_pose_ || tick.state.time != pose_time_ || tick.now < renewed_at_) renewed_at_ = tick.now;
  pose_time_ = tick.state.time;
  has_pose_ = true;
  account(pushed);
  return pushed;
}

ForceFault ForceSafety::stopping_fault(const Tick& tick) noexcept {
  if (tick.status == DeviceStatus::fault || tick.status == DeviceStatus::not_open) is_lost_ = true;
  if (is_lost_) return ForceFault::device_lost;
  if (tick.request == ForceRequest::stop) return ForceFault::emergency_stop;
  if (!is_finite(tick.wanted) || !is_finite(tick.state.pose) || !std::isfinite(tick.state.time)) return ForceFault::not_finite;
  if (tick.request == ForceRequest::restart && phase_ == ForcePhase::stopped) phase_ = ForcePhase::waiting;
  return ForceFault::none;
}

ForceFault ForceSafety::passing_fault(const Tick& tick) const noexcept {
  if (tick.status != DeviceStatus::ok) return ForceFault::device_warning;
  if (!(tick.state.motor_temperature < 1)) return ForceFault::hot_motors;
  if (!(tick.age <= limits_.latest_tick)) return ForceFault::late_tick;
  if (!has_pose_) return ForceFault::none;
  if (!(tick.state.time - pose_time_ <= limits_.latest_tick)) return ForceFault::late_tick;
  if (tick.state.time <= pose_time_ && !(tick.now - renewed_at_ <= limits_.latest_tick)) return ForceFault::stale_pose;
  return ForceFault::none;
}

void ForceSafety::note(ForceFault fault, double time) noexcept {
  ++report_.ticks_with[std::size_t(fault)];
  fault_ = fault;
  if (report_.first_fault != ForceFault::none) return;
  report_.first_fault = fault;
  report_.first_fault_time = time;
}

void ForceSafety::interrupt(ForceFault fault, double now) noexcept {
  const bool is_timing = fault == ForceFault::late_tick || fault == ForceFault::stale_pose;
  if (!is_timing) {
    phase_ = ForcePhase::waiting;
  } else if (phase_ == ForcePhase::ramping || phase_ == ForcePhase::on) {
    fading_ = last_;
    fade_start_ = now;
    faded_for_ = 0;
    phase_ = ForcePhase::fading;
  }
}

DeviceWrench ForceSafety::faded(const Tick& tick) noexcept {
  // What is pushed now lasts until the next tick, and by then it must be gone. It goes by the ticks too, so that a clock that stands or is set back
  // holds nothing.
  faded_for_ = std::max(faded_for_, tick.now - fade_start_) + tick.period;
  const double gone = faded_for_ / limits_.fade_time;
  if (gone < 1 - 1e-6) return scaled(fading_, 1 - gone);
  share_ = 0;
  phase_ = ForcePhase::ramping;
  return {};
}

DeviceWrench ForceSafety::allowed(const Tick& tick, ForceFault passing) noexcept {
  DeviceWrench wrench = tick.wanted;
  if (!pushes_torque_) {
    const double lost = length(wrench.torque);
    if (lost > 0) ++report_.ticks_without_torque;
    report_.peak_lost_torque = std::max(report_.peak_lost_torque, lost);
    std::fill(wrench.torque, wrench.torque + 3, 0.0);
  }

  if (phase_ == ForcePhase::waiting) {
    const bool is_free = length(wrench.force) <= limits_.free_force && length(wrench.torque) <= limits_.free_torque;
    if (!is_free || passing != ForceFault::none) return {};
    share_ = 0;
    phase_ = ForcePhase::ramping;
  } else if (phase_ == ForcePhase::ramping) {
    share_ += step_time_ / limits_.ramp_time;
    if (share_ >= 1) phase_ = ForcePhase::on;
  }
  // Shortened before the ramp: a huge wish must not make it steep.
  const auto limit = [&](double maximum, double continuous, double heat) {
    const double left = continuous + (maximum - continuous) * share_left(heat, warm_heat);
    return left * share_left(tick.state.motor_temperature, limits_.warm_temperature);
  };
  const double most_force = limit(limits_.maximum_force, limits_.continuous_force, force_heat_);
  const double most_torque = limit(limits_.maximum_torque, limits_.continuous_torque, torque_heat_);
  if (length(wrench.force) > most_force || length(wrench.torque) > most_torque) ++report_.ticks_shortened;
  wrench = limited(wrench, most_force, most_torque);
  if (phase_ == ForcePhase::ramping) wrench = scaled(wrench, share_);

  const bool force_slowed = slow_down(wrench.force, last_.force, limits_.force_slew * step_time_);
  const bool torque_slowed = slow_down(wrench.torque, last_.torque, limits_.torque_slew * step_time_);
  if (force_slowed || torque_slowed) ++report_.ticks_slowed;
  return wrench;
}

void ForceSafety::account(const DeviceWrench& pushed) noexcept {
  last_ = pushed;
  const double force = length(pushed.force);
  const double torque = length(pushed.torque);
  warm_up(force_heat_, force, limits_.continuous_force, limits_.heating_time, step_time_);
  warm_up(torque_heat_, torque, limits_.continuous_torque, limits_.heating_time, step_time_);
  report_.peak_force = std::max(report_.peak_force, force);
  report_.peak_torque = std::max(report_.peak_torque, torque);
  report_.peak_force_heat = std::max(report_.peak_force_heat, force_heat_);
  report_.peak_torque_heat = std::max(report_.peak_torque_heat, torque_heat_);
}

}  // namespace feeler
