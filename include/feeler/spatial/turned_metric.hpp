// A metric along axes that may turn from tick to tick: with an object, or with the tool.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// The metric A M Aᵀ, with M diagonal along axes A that stand for a tick; where they are those of the poses it is `Metric` to the last bit.
template <RealScalar ScalarType>
class TurnedMetric {
 public:
  using Scalar = ScalarType;

  TurnedMetric(const Metric<Scalar>& along) noexcept : along_(along) {}

  /// @param world_from_axes  unit
  void turn(const Quaternion<Scalar>& world_from_axes) noexcept {
    is_turned_ = !world_from_axes.vec().isZero(Scalar(0));
    world_from_axes_ = world_from_axes;
    axes_ = world_from_axes.toRotationMatrix();
  }

  /// M, along the axes.
  const Metric<Scalar>& along() const noexcept { return along_; }
  bool is_turned() const noexcept { return is_turned_; }
  const Quaternion<Scalar>& world_from_axes() const noexcept { return world_from_axes_; }

  /// aᵀ A M Aᵀ b [m²].
  Scalar product(const Twist<Scalar>& a, const Twist<Scalar>& b) const noexcept {
    return is_turned_ ? along_.product(in_axes(a), in_axes(b)) : along_.product(a, b);
  }
  /// ½ eᵀ A M Aᵀ e [m²].
  Scalar energy(const Twist<Scalar>& e) const noexcept { return is_turned_ ? along_.energy(in_axes(e)) : along_.energy(e); }
  /// `Metric::gradient`, world axes.
  Vector6<Scalar> gradient(const Twist<Scalar>& e) const noexcept { return is_turned_ ? in_world(along_.gradient(in_axes(e))) : along_.gradient(e); }
  /// `Metric::homing_hessian`, world axes.
  Matrix6<Scalar> homing_hessian(const Twist<Scalar>& e) const noexcept {
    return is_turned_ ? in_world(along_.homing_hessian(in_axes(e))) : along_.homing_hessian(e);
  }
  /// `Metric::hessian_of_turns`, world axes.
  Matrix3<Scalar> hessian_of_turns(const Twist<Scalar>& e) const noexcept {
    return is_turned_ ? Matrix3<Scalar>(axes_ * along_.hessian_of_turns(in_axes(e)) * axes_.transpose()) : along_.hessian_of_turns(e);
  }
  /// A M Aᵀ.
  Matrix6<Scalar> matrix() const noexcept { return in_world(Matrix6<Scalar>(along_.diagonal().asDiagonal())); }

  /// From world axes to those of the metric, and back; nothing where they are the same.
  Twist<Scalar> in_axes(const Twist<Scalar>& e) const noexcept {
    return is_turned_ ? Twist<Scalar>{axes_.transpose() * e.linear, axes_.transpose() * e.angular} : e;
  }
  Vector6<Scalar> in_axes(const Vector6<Scalar>& v) const noexcept { return is_turned_ ? both().transpose() * v : v; }
  Matrix6<Scalar> in_axes(const Matrix6<Scalar>& m) const noexcept { return is_turned_ ? Matrix6<Scalar>(both().transpose() * m * both()) : m; }
  Vector6<Scalar> in_world(const Vector6<Scalar>& v) const noexcept { return is_turned_ ? both() * v : v; }
  Matrix6<Scalar> in_world(const Matrix6<Scalar>& m) const noexcept { return is_turned_ ? Matrix6<Scalar>(both() * m * both().transpose()) : m; }

 private:
  /// A for translations and for turns.
  Matrix6<Scalar> both() const noexcept {
    Matrix6<Scalar> both = Matrix6<Scalar>::Zero();
    both.template topLeftCorner<3, 3>() = axes_;
    both.template bottomRightCorner<3, 3>() = axes_;
    return both;
  }

  Metric<Scalar> along_;
  Quaternion<Scalar> world_from_axes_ = Quaternion<Scalar>::Identity();
  Matrix3<Scalar> axes_ = Matrix3<Scalar>::Identity();
  bool is_turned_ = false;
};

}  // namespace feeler
