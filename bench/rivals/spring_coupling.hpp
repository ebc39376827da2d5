// The spring and damper by which an engine's body follows the device.
#pragma once

#include <algorithm>
#include <cmath>

#include "feeler/spatial/twist.hpp"
#include "feeler/spatial/wrench.hpp"

namespace feeler::rivals {

/// A rigid body on a spring and a damper, both isotropic.
struct SpringCoupling {
  double stiffness = 1000.0;    ///< [N/m]
  double rotational_stiffness;  ///< [N·m/rad]
  double mass = 0.04;           ///< [kg]
  double inertia;               ///< about any axis [kg·m²]
  bool feeds_velocity_forward = true;  ///< the damper acts on the velocity relative to the device's; else on the body's own

  /// An isotropic K and a body of 40 g and the inertia that gives both motions the same time constant: 6 ms at
  /// 1000 N/m.
  static SpringCoupling of_stiffness(const Stiffness<double>& k) {
    const double stiffness = k.translational.x(), rotational_stiffness = k.rotational.x();
    constexpr double mass = 0.04;
    return {.stiffness = stiffness, .rotational_stiffness = rotational_stiffness, .mass = mass, .inertia = mass * rotational_stiffness / stiffness};
  }

  /// Critical damping [N·s/m], [N·m·s/rad].
  double damping() const { return 2.0 * std::sqrt(stiffness * mass); }
  double rotational_damping() const { return 2.0 * std::sqrt(rotational_stiffness * inertia); }

  /// Of the spring on the hand: K (q_g − q_h).
  Wrench<double> spring_on_hand(const Pose<double>& body, const Pose<double>& haptic) const {
    return Stiffness<double>::uniform(stiffness, rotational_stiffness).wrench(motion_between(haptic, body));
  }
  /// Of the damper on the hand, for velocities [m/s, rad/s].
  Wrench<double> damper_on_hand(const Twist<double>& body, const Twist<double>& haptic) const {
    const Twist<double> device = feeds_velocity_forward ? haptic : Twist<double>{};
    return {damping() * (body.linear - device.linear), rotational_damping() * (body.angular - device.angular)};
  }
};

/// The device between two ticks: a straight line at constant velocities.
class DeviceMotion {
 public:
  /// Velocities fed forward are cut off here: four times what a fast hand does, so that a jump of the device
  /// is no blow.
  static constexpr double greatest_speed = 2.0;       ///< [m/s]
  static constexpr double greatest_turn_rate = 20.0;  ///< [rad/s]

  void reset(const Pose<double>& pose) { last_ = now_ = pose, motion_ = velocity_ = {}; }

  /// @param seconds  of a tick
  void advance(const Pose<double>& pose, double seconds) {
    last_ = now_;
    now_ = pose;
    motion_ = motion_between(last_, now_);
    velocity_.linear = cut_off(motion_.linear / seconds, greatest_speed);
    velocity_.angular = cut_off(motion_.angular / seconds, greatest_turn_rate);
  }

  /// Where the device is at a share of the tick in [0, 1].
  Pose<double> pose(double share) const { return share >= 1.0 ? now_ : moved(last_, motion_ * share); }
  const Twist<double>& velocity() const { return velocity_; }

 private:
  static Vector3<double> cut_off(const Vector3<double>& v, double most) { return v * std::min(1.0, most / std::max(v.norm(), most)); }

  Pose<double> last_, now_;
  Twist<double> motion_, velocity_;
};

}  // namespace feeler::rivals
