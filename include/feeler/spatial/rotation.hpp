// Rotations as unit quaternions and their rotation vectors: exponential, logarithm and derivative.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"

namespace feeler {

template <class Scalar>
using Quaternion = Eigen::Quaternion<Scalar>;

/// The matrix [v]× with [v]× u = v × u.
template <class Scalar>
Matrix3<Scalar> cross_matrix(const Vector3<Scalar>& v) noexcept {
  Matrix3<Scalar> m;
  m << Scalar(0), -v.z(), v.y(), v.z(), Scalar(0), -v.x(), -v.y(), v.x(), Scalar(0);
  return m;
}

/// Rotation by a rotation vector [rad, world axes]; unit to rounding.
template <class Scalar>
Quaternion<Scalar> exp_rotation(const Vector3<Scalar>& rotation_vector) noexcept {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const Scalar angle_squared = rotation_vector.squaredNorm();
  // Sine and cosine of the half angle by their series, where the first term left out, angle¹⁰/(2¹⁰·10!), is under rounding.
  const Scalar fourth = angle_squared * angle_squared;
  if (fourth * fourth * angle_squared < Scalar(3715891200) * std::numeric_limits<Scalar>::epsilon()) {
    const Scalar& x = angle_squared;
    const Scalar sine = Scalar(1) / 2 - x * (Scalar(1) / 48 - x * (Scalar(1) / 3840 - x * (Scalar(1) / 645120 - x * (Scalar(1) / 185794560))));
    const Scalar cosine = Scalar(1) - x * (Scalar(1) / 8 - x * (Scalar(1) / 384 - x * (Scalar(1) / 46080 - x * (Scalar(1) / 10321920))));
    return Quaternion<Scalar>(cosine, sine * rotation_vector.x(), sine * rotation_vector.y(), sine * rotation_vector.z());
  }
  const Scalar angle = sqrt(angle_squared);
  const Vector3<Scalar> v = (sin(angle / 2) / angle) * rotation_vector;
  return Quaternion<Scalar>(cos(angle / 2), v.x(), v.y(), v.z());
}

/// Rotation vector [rad] of a unit quaternion, of length at most π; the inverse of `exp_rotation` within (-π, π).
template <class Scalar>
Vector3<Scalar> log_rotation(const Quaternion<Scalar>& rotation) noexcept {
  using std::atan2;
  using std::sqrt;
  const Scalar sign = rotation.w() < Scalar(0) ? Scalar(-1) : Scalar(1);
  const Scalar sine_squared = rotation.vec().squaredNorm();
  // The arc sine by its series, where the first term left out, 231/13312 sine¹², is under rounding.
  const Scalar fourth = sine_squared * sine_squared;
  if (fourth * fourth * fourth < 57 * std::numeric_limits<Scalar>::epsilon()) {
    const Scalar& x = sine_squared;
    const Scalar ratio = 1 + x * (Scalar(1) / 6 + x * (Scalar(3) / 40 + x * (Scalar(5) / 112 + x * (Scalar(35) / 1152 + x * (Scalar(63) / 2816)))));
    return (sign * 2 * ratio) * rotation.vec();
  }
  const Scalar sine = sqrt(sine_squared), cosine = sign * rotation.w();
  return (sign * 2 * atan2(sine, cosine) / sine) * rotation.vec();
}

/// (1 − (θ/2) cot(θ/2)) / θ² by θ²: how a turn by θ bends the derivatives of the logarithm.
template <class Scalar>
Scalar logarithm_bend(const Scalar& angle_squared) noexcept {
  using std::sqrt;
  using std::tan;
  const Scalar& x = angle_squared;
  // The series, where the first term left out, 691/1307674368000 x⁵, is under rounding.
  if (x * x * x * x * x < Scalar(157700000) * std::numeric_limits<Scalar>::epsilon()) {
    return Scalar(1) / 12 + x * (Scalar(1) / 720 + x * (Scalar(1) / 30240 + x * (Scalar(1) / 1209600 + x * (Scalar(1) / 47900160))));
  }
  const Scalar half = sqrt(x) / 2;
  return (Scalar(1) - half / tan(half)) / x;
}

/// Derivative of `Log(Exp(w) Exp(φ))` by w at w = 0: the inverse of the left Jacobian of SO(3) at φ.
template <class Scalar>
Matrix3<Scalar> inverse_left_jacobian(const Vector3<Scalar>& phi) noexcept {
  const Matrix3<Scalar> cross = cross_matrix(phi);
  return Matrix3<Scalar>::Identity() - cross / 2 + logarithm_bend<Scalar>(phi.squaredNorm()) * cross * cross;
}

}  // namespace feeler
