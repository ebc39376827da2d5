// The weighted squared distance between two poses that the renderer minimises, with its derivatives.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/rotation.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/spatial/wrench.hpp"

namespace feeler {

/// Diagonal metric M of the paper's eq. 3: ½ eᵀ M e weighs metres against radians; only ratios matter to a renderer, which takes it `normalized`.
template <RealScalar ScalarType>
struct Metric {
  using Scalar = ScalarType;

  Vector3<Scalar> translational = Vector3<Scalar>::Ones();                   ///< [1]
  Vector3<Scalar> rotational = Vector3<Scalar>::Constant(Scalar(3) / 10000);  ///< squared lengths [m²/rad²]

  /// M ∝ K, scaled so that a metre of translation weighs one. With it the wrench is the exact sum of the contact forces.
  static Metric proportional_to(const Stiffness<Scalar>& stiffness) noexcept {
    return Metric{stiffness.translational, stiffness.rotational}.normalized();
  }
  static Metric with_length(Scalar length) noexcept { return {Vector3<Scalar>::Ones(), Vector3<Scalar>::Constant(length * length)}; }

  /// With the same ratios, and one as the largest translational weight.
  Metric normalized() const noexcept {
    const Scalar unit = translational.maxCoeff();
    return {translational / unit, rotational / unit};
  }

  /// Of M.
  Vector6<Scalar> diagonal() const noexcept {
    Vector6<Scalar> weights;
    weights << translational, rotational;
    return weights;
  }

  /// aᵀ M b [m²].
  Scalar product(const Twist<Scalar>& a, const Twist<Scalar>& b) const noexcept {
    return a.linear.dot(translational.cwiseProduct(b.linear)) + a.angular.dot(rotational.cwiseProduct(b.angular));
  }
  /// ½ eᵀ M e [m²].
  Scalar energy(const Twist<Scalar>& e) const noexcept { return product(e, e) / 2; }

  /// Gradient of the energy of Exp-moved poses by the step (dp, w) at zero, e = graphic from haptic.
  Vector6<Scalar> gradient(const Twist<Scalar>& e) const noexcept {
    Vector6<Scalar> g;
    const Vector3<Scalar> torque = rotational.cwiseProduct(e.angular);
    g.template head<3>() = translational.cwiseProduct(e.linear);
    // J⁻ᵀ φ = φ, so an isotropic weight needs no Jacobian.
    g.template tail<3>() = is_isotropic() ? torque : Vector3<Scalar>(inverse_left_jacobian<Scalar>(e.angular).transpose() * torque);
    return g;
  }

  /// Second derivative of the energy by the step: exact for isotropic rotational weights, Gauss–Newton otherwise.
  ///
  /// For ½|Log(Exp(w) Exp(φ))|² it is aaᵀ + (θ/2) cot(θ/2) (I − aaᵀ), θ = |φ|, a = φ/θ; it vanishes across a at θ = π.
  Matrix6<Scalar> hessian(const Twist<Scalar>& e) const noexcept {
    Matrix6<Scalar> h = Matrix6<Scalar>::Zero();
    h.template topLeftCorner<3, 3>() = translational.asDiagonal();
    h.template bottomRightCorner<3, 3>() = hessian_of_turns(e);
    return h;
  }
  /// Its lower right block; in the others there is nothing but the translational weights.
  Matrix3<Scalar> hessian_of_turns(const Twist<Scalar>& e) const noexcept {
    if (!is_isotropic()) {
      const Matrix3<Scalar> j = inverse_left_jacobian<Scalar>(e.angular);
      return j.transpose() * rotational.asDiagonal() * j;
    }
    const Scalar angle_squared = e.angular.squaredNorm(), bend = logarithm_bend<Scalar>(angle_squared);
    Matrix3<Scalar> h = bend * e.angular * e.angular.transpose();
    h.diagonal().array() += Scalar(1) - bend * angle_squared;
    return h * rotational.x();
  }

  /// Hessian of the quadratic that has this gradient and its minimum at −e, where the motion home ends: M, or Gauss–Newton's.
  Matrix6<Scalar> homing_hessian(const Twist<Scalar>& e) const noexcept { return is_isotropic() ? hessian({}) : hessian(e); }

  bool is_isotropic() const noexcept { return rotational.x() == rotational.y() && rotational.y() == rotational.z(); }

  template <class Other>
  Metric<Other> cast() const noexcept {
    return {translational.template cast<Other>(), rotational.template cast<Other>()};
  }
};

}  // namespace feeler
