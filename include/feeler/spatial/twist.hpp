// A small rigid motion as a translation and a rotation vector about a point, and how poses follow it.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/pose.hpp"

namespace feeler {

/// Motion of a frame over one step: its origin moves by `linear` [m], its axes turn by `angular` [rad], world axes.
template <RealScalar ScalarType>
struct Twist {
  using Scalar = ScalarType;

  Vector3<Scalar> linear = Vector3<Scalar>::Zero();
  Vector3<Scalar> angular = Vector3<Scalar>::Zero();

  static Twist from_vector(const Vector6<Scalar>& v) noexcept { return {v.template head<3>(), v.template tail<3>()}; }
  Vector6<Scalar> vector() const noexcept {
    Vector6<Scalar> v;
    v << linear, angular;
    return v;
  }
  Twist operator*(Scalar factor) const noexcept { return {linear * factor, angular * factor}; }
  Twist operator-() const noexcept { return {-linear, -angular}; }
};

/// A motion as it moves points: y = R x + linear, about the point that the twist is about.
template <RealScalar ScalarType>
struct Displacement {
  using Scalar = ScalarType;

  Vector3<Scalar> linear;
  Matrix3<Scalar> turn;  ///< R

  /// Of many points at once the turn is found once.
  Displacement(const Twist<Scalar>& motion) noexcept : linear(motion.linear), turn(exp_rotation(motion.angular).toRotationMatrix()) {}
};

/// The pose after the motion: origin p + linear, axes Exp(angular) R.
template <class Scalar>
Pose<Scalar> moved(const Pose<Scalar>& pose, const Twist<Scalar>& motion) noexcept {
  return {pose.translation + motion.linear, (exp_rotation(motion.angular) * pose.rotation).normalized()};
}

/// The motion from one pose to another: e = (p₁ − p₀, Log(R₁ R₀ᵀ)).
template <class Scalar>
Twist<Scalar> motion_between(const Pose<Scalar>& from, const Pose<Scalar>& to) noexcept {
  return {to.translation - from.translation, log_rotation(to.rotation * from.rotation.conjugate())};
}

}  // namespace feeler
