// The turns of a tool that cannot matter, because they leave it as it is: they follow the device, and nobody optimises them.
#pragma once

#include <limits>
#include <type_traits>

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "feeler/tool/symmetry.hpp"

namespace feeler {

/// Poses and motions of a tool, less what its symmetry makes idle. Poses are those of the reference point.
///
/// - `Symmetry::about_point`: no turn matters. The reference point must be the centre, so a motion is a translation and the graphic rotation
///   is that of the device, bit for bit.
/// - `Symmetry::about_axis`: the roll does not matter if the reference point lies on the axis and turns weigh the same about all axes; else
///   it is optimised like any turn. Of all poses with one axis, that nearest to the device is turned from it by the shortest way from
///   its axis, so the rotation between the two tools is about a normal of the axis: no torque about it.
/// - `Symmetry::none`, and any tool of several pieces: every turn matters, and nothing here is more than `moved` and `motion_between`.
template <RigidTool Tool>
class IdleTurns {
 public:
  using Scalar = typename Tool::Scalar;
  static constexpr Symmetry symmetry = symmetry_of<Tool>;
  /// Legs of a tick's path that may be idle turns: one before the motion and one after it, each of two where it is about half a turn.
  static constexpr int legs = symmetry == Symmetry::none ? 0 : 4;

  /// The reference point of a tool with a centre is that.
  IdleTurns([[maybe_unused]] const Tool& tool, [[maybe_unused]] const Vector3<Scalar>& reference, [[maybe_unused]] const Metric<Scalar>& metric) {
    if constexpr (symmetry == Symmetry::about_axis) {
      const Vector3<Scalar> along = tool.vertex(1) - tool.vertex(0);
      const Scalar size = tool.vertex(0).norm() + tool.vertex(1).norm() + reference.norm();
      roll_.axis = along.normalized();
      const Scalar beside = roll_.axis.cross(reference - tool.vertex(0)).norm();
      roll_.is_idle = beside <= 4 * std::numeric_limits<Scalar>::epsilon() * size && metric.is_isotropic();
    }
  }

  /// The pose with its idle turns as they are best at the device; the tool is where it was.
  Pose<Scalar> following(const Pose<Scalar>& pose, const Pose<Scalar>& device) const noexcept {
    if constexpr (symmetry == Symmetry::about_point) return {pose.translation, device.rotation};
    if constexpr (symmetry == Symmetry::about_axis) {
      const Vector3<Scalar> axis = pose.rotation * roll_.axis, axis_device = device.rotation * roll_.axis;
      const Scalar cosine = axis.dot(axis_device);
      if (!roll_.is_idle || !(Scalar(1) + cosine > Scalar(1e-6))) return pose;  // opposite axes: every roll is as good
      Quaternion<Scalar> turn;
      turn.w() = Scalar(1) + cosine;
      turn.vec() = axis_device.cross(axis);
      const Scalar certainty = turn.norm();  // 2 where the axes are one, next to nothing where they are all but opposite
      Quaternion<Scalar> rotation = (turn.normalized() * device.rotation).normalized();
      if (rotation.dot(pose.rotation) < Scalar(0)) rotation.coeffs() = -rotation.coeffs();
      // A held device must not make the last bits dance.
      const Scalar change = (rotation.coeffs() - pose.rotation.coeffs()).template lpNorm<Eigen::Infinity>();
      if (!(change * certainty > 16 * std::numeric_limits<Scalar>::epsilon())) return pose;
      return {pose.translation, rotation};
    }
    return pose;
  }

  Pose<Scalar> moved(const Pose<Scalar>& pose, const Twist<Scalar>& motion) const noexcept {
    if constexpr (symmetry == Symmetry::about_point) {
      return {pose.translation + motion.linear, pose.rotation};
    } else {
      return feeler::moved(pose, motion);
    }
  }

  Twist<Scalar> motion_between(const Pose<Scalar>& from, const Pose<Scalar>& to) const noexcept {
    if constexpr (symmetry == Symmetry::about_point) {
      return {to.translation - from.translation, Vector3<Scalar>::Zero()};
    } else {
      return feeler::motion_between(from, to);
    }
  }

  /// The size of a turn from a pose that a tool point at a distance of one sees [rad].
  Scalar angle_that_matters(const Vector3<Scalar>& turn, const Pose<Scalar>& from) const noexcept {
    if constexpr (symmetry == Symmetry::about_axis) {
      if (roll_.is_idle) return turn.cross(from.rotation * roll_.axis).norm();
    }
    return turn.norm();
  }

 private:
  struct Nothing {};
  struct Roll {
    Vector3<Scalar> axis = Vector3<Scalar>::Zero();  // of the tool, in its frame
    bool is_idle = false;
  };
  [[no_unique_address]] std::conditional_t<symmetry == Symmetry::about_axis, Roll, Nothing> roll_;
};

}  // namespace feeler
