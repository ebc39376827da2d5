// A rigid pose: where a frame is, and how it is turned.
#pragma once

#include <cmath>

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/rotation.hpp"

namespace feeler {

/// Pose of the tool frame in the world: `point_world = translation + rotation * point_tool` [m, unit quaternion].
template <RealScalar ScalarType>
struct Pose {
  using Scalar = ScalarType;

  Vector3<Scalar> translation = Vector3<Scalar>::Zero();
  Quaternion<Scalar> rotation = Quaternion<Scalar>::Identity();

  Vector3<Scalar> operator*(const Vector3<Scalar>& point_tool) const noexcept { return translation + rotation * point_tool; }
  /// Of a frame that is given in this one: `world_from_tip = world_from_tool * tool_from_tip`.
  Pose operator*(const Pose& inner) const noexcept { return {*this * inner.translation, rotation * inner.rotation}; }
  /// Of the outer frame in this one, `tool_from_world`; the quaternion must be unit.
  Pose inverse() const noexcept {
    const Quaternion<Scalar> back = rotation.conjugate();
    return {-(back * translation), back};
  }

  /// The same numbers: of a quaternion and its opposite, one rotation, false.
  bool operator==(const Pose& other) const noexcept { return translation == other.translation && rotation.coeffs() == other.rotation.coeffs(); }
  /// False for a NaN, a number too large to be squared, an infinity among them, or a quaternion too short to be normalised.
  bool is_finite() const noexcept {
    using std::isfinite;
    const Scalar length = rotation.squaredNorm();
    return isfinite(translation.squaredNorm()) && isfinite(length) && length > std::numeric_limits<Scalar>::epsilon();
  }

  Pose normalized() const noexcept { return {translation, rotation.normalized()}; }

  template <class Other>
  Pose<Other> cast() const noexcept {
    return {translation.template cast<Other>(), rotation.template cast<Other>()};
  }
};

}  // namespace feeler
