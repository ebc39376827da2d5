// The six numbers that a step is written in: a rotation vector, or the Euler angles of the paper.
#pragma once

#include <cmath>
#include <numbers>

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// How the orientation of a step is written.
enum class Increments {
  rotation_vector,  ///< world axes, about the pose that the step starts from
  euler_angles,     ///< differences of the angles γ, β, α about x, y, z with R = Rz(α) Ry(β) Rx(γ) (paper, eq. 2)
};

/// Coordinates of poses near a base pose, all zero there: translation [m], then three angles [rad].
template <RealScalar Scalar, Increments increments>
class StepCoordinates {
 public:
  explicit StepCoordinates(const Pose<Scalar>& base) noexcept : base_(base) {
    if constexpr (increments == Increments::euler_angles) angles_ = angles_of(base.rotation);
  }

  Vector6<Scalar> of(const Pose<Scalar>& pose) const noexcept {
    if constexpr (increments == Increments::rotation_vector) {
      return motion_between(base_, pose).vector();
    } else {
      Vector6<Scalar> result;
      result << pose.translation - base_.translation, nearest_to_base(angles_of(pose.rotation)) - angles_;
      return result;
    }
  }

  Pose<Scalar> pose_at(const Vector6<Scalar>& step) const noexcept {
    if constexpr (increments == Increments::rotation_vector) {
      return moved(base_, Twist<Scalar>::from_vector(step));
    } else {
      const Vector3<Scalar> angles = angles_ + step.template tail<3>();
      return {base_.translation + step.template head<3>(), (about(2, angles[2]) * about(1, angles[1]) * about(0, angles[0])).normalized()};
    }
  }

  /// Row of the separation by the coordinates, from its row by the step (dp, w).
  Vector6<Scalar> row(const Vector6<Scalar>& gradient) const noexcept {
    if constexpr (increments == Increments::rotation_vector) {
      return gradient;
    } else {
      Vector6<Scalar> result = gradient;
      result.template tail<3>() = axes().transpose() * gradient.template tail<3>();
      return result;
    }
  }

  /// Second derivative and gradient of the energy (paper, eq. 3) at the base by the coordinates.
  Matrix6<Scalar> hessian(const Metric<Scalar>& metric, const Pose<Scalar>& target) const noexcept {
    if constexpr (increments == Increments::rotation_vector) {
      return metric.homing_hessian(motion_between(target, base_));
    } else {
      return metric.hessian({});
    }
  }
  Vector6<Scalar> gradient(const Metric<Scalar>& metric, const Pose<Scalar>& target) const noexcept {
    if constexpr (increments == Increments::rotation_vector) {
      return metric.gradient(motion_between(target, base_));
    } else {
      return -metric.diagonal().cwiseProduct(of(target));
    }
  }

 private:
  static Quaternion<Scalar> about(int axis, Scalar angle) noexcept {
    using std::cos;
    using std::sin;
    Quaternion<Scalar> q = Quaternion<Scalar>::Identity();
    q.w() = cos(angle / 2);
    q.vec()[axis] = sin(angle / 2);
    return q;
  }

  static Vector3<Scalar> angles_of(const Quaternion<Scalar>& rotation) noexcept {
    using std::atan2;
    using std::sqrt;
    const Matrix3<Scalar> r = rotation.toRotationMatrix();
    const Scalar cosine = sqrt(r(2, 1) * r(2, 1) + r(2, 2) * r(2, 2));
    return {atan2(r(2, 1), r(2, 2)), atan2(-r(2, 0), cosine), atan2(r(1, 0), r(0, 0))};
  }

  /// Two sets of angles, and turns of 2π, give the same rotation.
  Vector3<Scalar> nearest_to_base(const Vector3<Scalar>& angles) const noexcept {
    constexpr Scalar pi = std::numbers::pi_v<Scalar>;
    const auto unwrapped = [this](const Vector3<Scalar>& a) {
      using std::round;
      Vector3<Scalar> result = a;
      for (int k = 0; k < 3; ++k) result[k] -= 2 * pi * round((a[k] - angles_[k]) / (2 * pi));
      return result;
    };
    const Vector3<Scalar> first = unwrapped(angles);
    const Vector3<Scalar> second = unwrapped({angles[0] + pi, pi - angles[1], angles[2] + pi});
    return (first - angles_).squaredNorm() <= (second - angles_).squaredNorm() ? first : second;
  }

  /// Angular velocity by the rates of γ, β and α, a column each; singular at β = ±π/2.
  Matrix3<Scalar> axes() const noexcept {
    const Quaternion<Scalar> z = about(2, angles_[2]);
    const Quaternion<Scalar> zy = z * about(1, angles_[1]);
    Matrix3<Scalar> result;
    result << zy * Vector3<Scalar>::UnitX(), z * Vector3<Scalar>::UnitY(), Vector3<Scalar>::UnitZ();
    return result;
  }

  Pose<Scalar> base_;
  Vector3<Scalar> angles_ = Vector3<Scalar>::Zero();
};

}  // namespace feeler
