// Integrates a handle between a hand and a wrench.
#include "feeler/device/simulated_hand.hpp"

#include <cmath>
#include <utility>

#include "feeler/core/requirement.hpp"
#include "feeler/device/conversion.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {
namespace {

double grip_damping(double stiffness, double inertia, double ratio) noexcept { return 2 * ratio * std::sqrt(stiffness * inertia); }

/// Semi-implicit Euler of m a = −k x − c v is stable just when k h²/m < 4 − 2 c h/m (Jury's criterion).
bool is_stable(double inertia, double stiffness, double damping, double step) noexcept {
  return stiffness * step * step / inertia < 4 - 2 * damping * step / inertia;
}

void require(bool holds, const char* sentence) {
  if (!holds) refuse(sentence);
}

Vector3<double> vector(const double (&v)[3]) noexcept { return {v[0], v[1], v[2]}; }

void store(const Vector3<double>& from, double (&to)[3]) noexcept {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// Takes so much off the length of a velocity.
void rub(Vector3<double>& velocity, double loss) noexcept {
  if (!(loss > 0)) return;
  const double speed = velocity.norm();
  velocity = speed > loss ? Vector3<double>(velocity * (1 - loss / speed)) : Vector3<double>::Zero();
}

}  // namespace

SimulatedHand::SimulatedHand(DevicePath path, const Handle& handle, const Grip& grip, double period, int substeps)
    : path_(std::move(path)),
      handle_(handle),
      grip_(grip),
      tremor_(grip.tremor, grip.rotational_tremor, grip.seed),
      period_(period),
      substeps_(substeps) {
  require(bool(path_), "simulated hand: the path is empty; give a callable from seconds to a pose");
  require(handle.mass > 0 && handle.inertia > 0, "simulated hand: the handle needs a positive mass and inertia");
  require(handle.damping >= 0 && handle.rotational_damping >= 0, "simulated hand: a negative damping of the handle drives it");
  require(handle.friction >= 0 && handle.rotational_friction >= 0, "simulated hand: a negative friction of the handle drives it");
  require(grip.stiffness >= 0 && grip.rotational_stiffness >= 0 && grip.damping_ratio >= 0,
          "simulated hand: stiffness and damping of the grip must not be negative");
  require(period > 0 && std::isfinite(period) && substeps > 0, "simulated hand: the period and its substeps must be positive");
  const double step = period / substeps;
  const double linear = grip_damping(grip.stiffness, handle.mass, grip.damping_ratio) + handle.damping;
  const double angular = grip_damping(grip.rotational_stiffness, handle.inertia, grip.damping_ratio) + handle.rotational_damping;
  require(is_stable(handle.mass, grip.stiffness, linear, step) && is_stable(handle.inertia, grip.rotational_stiffness, angular, step),
          "simulated hand: the grip is too stiff or too damped to integrate at this step; take more substeps a tick");
  target_ = target(0);
  pose_ = target_;
}

double SimulatedHand::time() const noexcept { return double(ticks_) * period_; }

// Flattened, here and in the encoder: a function of Eigen types left out of line would be merged by the linker with the user's own,
// compiled with other vector widths.
[[gnu::flatten]] DevicePose SimulatedHand::target(double time) const noexcept {
  const auto steady = from_device<Pose<double>>(path_(time));
  if (!steady.is_finite()) return target_;
  const auto shake = tremor_.at(time);
  return to_device_pose(moved(steady.normalized(), {{shake[0], shake[1], shake[2]}, {shake[3], shake[4], shake[5]}}));
}

[[gnu::flatten]] void SimulatedHand::advance(const DeviceWrench& wrench) noexcept {
  const double step = period_ / substeps_;
  const double damper = grip_damping(grip_.stiffness, handle_.mass, grip_.damping_ratio);
  const double angular_damper = grip_damping(grip_.rotational_stiffness, handle_.inertia, grip_.damping_ratio);
  const Vector3<double> pushed_force = vector(wrench.force);
  const Vector3<double> pushed_torque = vector(wrench.torque);

  auto base_from_handle = from_device<Pose<double>>(pose_);
  auto base_from_target = from_device<Pose<double>>(target_);
  Vector3<double> velocity = vector(velocity_.linear);
  Vector3<double> spin = vector(velocity_.angular);

  for (int i = 1; i <= substeps_; ++i) {
    const auto pull = motion_between(base_from_handle, base_from_target);
    const auto next_target = from_device<Pose<double>>(target(time() + i * step));
    const auto target_velocity = motion_between(base_from_target, next_target) * (1 / step);
    base_from_target = next_target;

    const Vector3<double> force =
        grip_.stiffness * pull.linear + damper * (target_velocity.linear - velocity) - handle_.damping * velocity + pushed_force;
    const Vector3<double> torque = grip_.rotational_stiffness * pull.angular + angular_damper * (target_velocity.angular - spin) -
                                   handle_.rotational_damping * spin + pushed_torque;
    velocity += force * (step / handle_.mass);
    spin += torque * (step / handle_.inertia);
    rub(velocity, handle_.friction * (step / handle_.mass));
    rub(spin, handle_.rotational_friction * (step / handle_.inertia));
    base_from_handle = moved(base_from_handle, {velocity * step, spin * step});
  }

  ++ticks_;
  pose_ = to_device_pose(base_from_handle);
  target_ = to_device_pose(base_from_target);
  store(velocity, velocity_.linear);
  store(spin, velocity_.angular);
}

}  // namespace feeler
