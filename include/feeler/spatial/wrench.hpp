// Force and torque at a stated point, and the stiffness that makes them from a pose difference.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// Force [N] and torque [N·m] on the hand, in world axes, at the tool reference point of the haptic pose.
template <RealScalar ScalarType>
struct Wrench {
  using Scalar = ScalarType;

  Vector3<Scalar> force = Vector3<Scalar>::Zero();
  Vector3<Scalar> torque = Vector3<Scalar>::Zero();

  /// The same wrench with its torque at another point; both points in world axes [m].
  Wrench moved(const Vector3<Scalar>& from, const Vector3<Scalar>& to) const noexcept { return {force, torque + (from - to).cross(force)}; }

  template <class Other>
  Wrench<Other> cast() const noexcept {
    return {force.template cast<Other>(), torque.template cast<Other>()};
  }
};

/// Diagonal stiffness K of the paper's eq. 4, in world axes.
template <RealScalar ScalarType>
struct Stiffness {
  using Scalar = ScalarType;

  Vector3<Scalar> translational = Vector3<Scalar>::Constant(Scalar(1000));      ///< [N/m]
  Vector3<Scalar> rotational = Vector3<Scalar>::Constant(Scalar(3) / 10);       ///< [N·m/rad]

  static Stiffness uniform(Scalar translational, Scalar rotational) noexcept {
    return {Vector3<Scalar>::Constant(translational), Vector3<Scalar>::Constant(rotational)};
  }

  /// F = K (q_g − q_h): the wrench that pulls the hand to the graphic tool (paper, eq. 4).
  ///
  /// With e = (p_g − p_h, φ) and φ = Log(R_g R_hᵀ) the wrench is the negative gradient of ½ eᵀ K e by the haptic pose: force
  /// K_t (p_g − p_h), torque Jᵣ⁻ᵀ(φ) K_r φ, which is K_r φ when K_r is isotropic.
  Wrench<Scalar> wrench(const Twist<Scalar>& graphic_from_haptic) const noexcept {
    const Vector3<Scalar>& phi = graphic_from_haptic.angular;
    const Vector3<Scalar> torque = rotational.cwiseProduct(phi);
    const bool isotropic = rotational.x() == rotational.y() && rotational.y() == rotational.z();
    return {translational.cwiseProduct(graphic_from_haptic.linear),
            isotropic ? torque : Vector3<Scalar>(inverse_left_jacobian<Scalar>(-phi).transpose() * torque)};
  }
};

}  // namespace feeler
