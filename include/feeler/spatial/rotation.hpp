// Rotations as unit quaternions and their rotation vectors: exponential, logarithm and derivative.
#pragma once

#include <cmath>

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
  // Below, the sine is replaced by its series: the next term, angle^4/1920, is under rounding.
  if (angle_squared * angle_squared < Scalar(1920) * std::numeric_limits<Scalar>::epsilon()) {
    const Vector3<Scalar> v = (Scalar(1) / 2 - angle_squared / 48) * rotation_vector;
    const Scalar w = Scalar(1) - angle_squared / 8 + angle_squared * angle_squared / 384;
    return Quaternion<Scalar>(w, v.x(), v.y(), v.z()).normalized();
  }
  const Scalar angle = sqrt(angle_squared);
  const Vector3<Scalar> v = (sin(angle / 2) / angle) * rotation_vector;
  return Quaternion<Scalar>(cos(angle / 2), v.x(), v.y(), v.z());
}

/// Rotation vector [rad] of a unit quaternion, of length at most π; the inverse of `exp_rotation` within (-π, π).
template <class Scalar>
Vector3<Scalar> log_rotation(const Quaternion<Scalar>& rotation) noexcept {
  using std::atan2;
  const Scalar sine = rotation.vec().norm();
  const Scalar sign = rotation.w() < Scalar(0) ? Scalar(-1) : Scalar(1);
  const Scalar cosine = sign * rotation.w();
  if (sine < std::numeric_limits<Scalar>::min() * 4) return Vector3<Scalar>::Zero();
  return (sign * 2 * atan2(sine, cosine) / sine) * rotation.vec();
}

/// Derivative of `Log(Exp(w) Exp(φ))` by w at w = 0: the inverse of the left Jacobian of SO(3) at φ.
template <class Scalar>
Matrix3<Scalar> inverse_left_jacobian(const Vector3<Scalar>& phi) noexcept {
  using std::sqrt;
  using std::tan;
  const Scalar angle_squared = phi.squaredNorm();
  const Matrix3<Scalar> cross = cross_matrix(phi);
  Scalar second = Scalar(1) / 12 + angle_squared / 720;
  if (angle_squared > Scalar(1e-4)) {
    const Scalar half = sqrt(angle_squared) / 2;
    second = (Scalar(1) - half / tan(half)) / angle_squared;
  }
  return Matrix3<Scalar>::Identity() - cross / 2 + second * cross * cross;
}

}  // namespace feeler
