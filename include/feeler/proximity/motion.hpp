// A tool on its way from one pose to another, and how far planes that hold at both ends hold in between.
#pragma once

#include <algorithm>
#include <cmath>

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/swept_tool.hpp"
#include "feeler/tool/symmetry.hpp"

namespace feeler {

/// Largest distance of a point of the tool, or of its core, from a point of the tool frame [m]: turns do not move the ball that sweeps a core.
template <ConvexTool Tool>
typename Tool::Scalar radius_about(const Tool& tool, const Vector3<typename Tool::Scalar>& point) noexcept {
  using std::sqrt;
  typename Tool::Scalar largest(0);
  for (int i = 0; i < tool.vertex_count(); ++i) largest = (std::max)(largest, (tool.vertex(i) - point).squaredNorm());
  return sqrt(largest);
}

/// Least height of a tool, or of its core, above a point along any vector, both in the tool frame [m].
template <ConvexTool Tool>
typename Tool::Scalar lowest_above(const Tool& tool, const Vector3<typename Tool::Scalar>& point,
                                   const Vector3<typename Tool::Scalar>& normal) noexcept {
  return -highest_along(tool, Vector3<typename Tool::Scalar>(-normal)) - normal.dot(point);
}

/// The same, found from a vertex near it, as `highest_along` has it.
template <ConvexTool Tool>
typename Tool::Scalar lowest_above(const Tool& tool, const Vector3<typename Tool::Scalar>& point, const Vector3<typename Tool::Scalar>& normal,
                                   int& vertex) noexcept {
  return -highest_along(tool, Vector3<typename Tool::Scalar>(-normal), vertex) - normal.dot(point);
}

/// Where the tool is at one time of a motion: axes `rotation`, reference point `shift` away from the start [m].
template <class Scalar>
struct MotionFrame {
  Scalar time = Scalar(0);
  Matrix3<Scalar> rotation = Matrix3<Scalar>::Identity();
  Vector3<Scalar> shift = Vector3<Scalar>::Zero();
};

/// A convex tool that moves by a twist about its reference point: at time t in [0, 1] the reference point has moved by t·linear, the
/// axes have turned by Exp(t·angular). World coordinates are relative to the reference point at the start, so that
/// scenes far from the origin lose no digits.
template <ConvexTool ToolType>
class MovingTool {
 public:
  using Tool = ToolType;
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Frame = MotionFrame<Scalar>;

  /// @param reference  the reference point in the tool frame [m]
  /// @param radius     `radius_about(tool, reference)`
  /// @param pose       pose whose translation is the reference point in the world [m]
  MovingTool(const Tool& tool, const Vector& reference, Scalar radius, const Pose<Scalar>& pose, const Twist<Scalar>& motion) noexcept
      : tool_(tool),
        reference_(reference),
        radius_(radius),
        pose_(pose),
        motion_(motion),
        angle_(motion.angular.norm()),
        distance_(motion.linear.norm()),
        turning_(longest_turn()) {}

  const Tool& tool() const noexcept { return tool_; }
  /// At the start; its translation is the reference point.
  const Pose<Scalar>& pose() const noexcept { return pose_; }
  const Vector& origin() const noexcept { return pose_.translation; }
  const Twist<Scalar>& motion() const noexcept { return motion_; }
  Scalar radius() const noexcept { return radius_; }
  /// Bound on the path of every point of the tool, or of its core, over the whole motion [m].
  Scalar length() const noexcept { return distance_ + turning_; }
  /// Bound on how far its turn alone moves a point [m].
  Scalar turning() const noexcept { return turning_; }
  /// Whether it is no motion: the tool stands where it is.
  bool is_still() const noexcept { return !(distance_ > Scalar(0)) && !(angle_ > Scalar(0)); }

  Pose<Scalar> pose_at(Scalar time) const noexcept { return moved(pose_, motion_ * time); }
  Frame frame_at(Scalar time) const noexcept { return {time, pose_at(time).rotation.toRotationMatrix(), time * motion_.linear}; }
  /// At time 0, to the last bit where the pose is: a motion that begins where another ended has its last frame.
  Frame frame_at_start() const noexcept { return {Scalar(0), pose_.rotation.toRotationMatrix(), Vector::Zero()}; }

  /// Corners relative to `origin()` in the tool frame.
  Matrix3<Scalar> in_tool(const Matrix3<Scalar>& corners, const Frame& frame) const noexcept {
    return (frame.rotation.transpose() * (corners.colwise() - frame.shift)).colwise() + reference_;
  }
  Vector to_world(const Vector& point_tool, const Frame& frame) const noexcept { return frame.rotation * (point_tool - reference_) + frame.shift; }

  /// Least height of the tool along a world normal: min n·x over its points x, relative to `origin()` [m].
  Scalar lowest(const Vector& normal, const Frame& frame) const noexcept {
    return lowest_in_tool(frame.rotation.transpose() * normal) + normal.dot(frame.shift) - swept_radius(tool_);
  }
  /// The same, found from a vertex near it.
  Scalar lowest(const Vector& normal, const Frame& frame, int& vertex) const noexcept {
    return lowest_above(tool_, reference_, Vector(frame.rotation.transpose() * normal), vertex) + normal.dot(frame.shift) - swept_radius(tool_);
  }
  /// The same along a world axis, or against it where `sign` is −1.
  Scalar lowest_along_axis(int axis, Scalar sign, const Frame& frame) const noexcept {
    return lowest_in_tool(sign * frame.rotation.row(axis).transpose()) + sign * frame.shift[axis] - swept_radius(tool_);
  }
  /// Least height of the tool, or of its core, above its reference point along any vector in the tool frame [m].
  Scalar lowest_in_tool(const Vector& normal_tool) const noexcept { return lowest_above(tool_, reference_, normal_tool); }

  /// Bound on how far a tool point strays from its chord along a fixed world normal over a part of the motion [m].
  ///
  /// n·Exp(tw)r has second derivative (n×w)·(w×r), of size at most |w×n| θ ρ; a function strays from its chord by an eighth of that. Of a
  /// tool that is symmetric |w×r| is known: its spin about its own axis or centre moves nothing.
  Scalar sagitta(const Vector& normal, Scalar duration) const noexcept {
    return duration * duration * motion_.angular.cross(normal).norm() * turning_ / 8;
  }

  /// `sagitta` along a world axis.
  Scalar sagitta_along_axis(int axis, Scalar duration) const noexcept {
    using std::sqrt;
    const Scalar across = motion_.angular[(axis + 1) % 3], aside = motion_.angular[(axis + 2) % 3];
    return duration * duration * sqrt(across * across + aside * aside) * turning_ / 8;
  }

  /// The same for an object point that strays from its chord as seen along a normal fixed to the tool.
  ///
  /// In the tool's axes the point is Z(t) = Exp(−tw)(y − c − t·dp), with Z″ = w×(w×Z) + 2 w×Exp(−tw)dp, so the bound is
  /// |w×n| (θ max|Z| + 2|dp|) / 8; |Z| is convex in t, so its maximum is at an end.
  /// @param reach  max |y − c| over the object points and both ends of the part [m]
  Scalar sagitta_of_object(const Vector& normal, Scalar duration, Scalar reach) const noexcept {
    return duration * duration * motion_.angular.cross(normal).norm() * (angle_ * reach + 2 * distance_) / 8;
  }

 private:
  /// max |w×r| over the tool's points [m], which does not change on the way; or a bound, θρ.
  Scalar longest_turn() const noexcept {
    if constexpr (symmetry_of<Tool> == Symmetry::none) {
      return angle_ * radius_;
    } else {
      const auto turn_of = [this](int i) { return motion_.angular.cross(pose_.rotation * Vector(tool_.vertex(i) - reference_)).norm(); };
      return symmetry_of<Tool> == Symmetry::about_axis ? (std::max)(turn_of(0), turn_of(1)) : turn_of(0);
    }
  }

  const Tool& tool_;
  Vector reference_;
  Scalar radius_;
  Pose<Scalar> pose_;
  Twist<Scalar> motion_;
  Scalar angle_;
  Scalar distance_;
  Scalar turning_;
};

/// First u in [0, 1] at which a + u (b − a) − 4g u (1 − u) falls below zero; 1 when it never does.
///
/// It is the lower bound of a slack with values a, b at the ends and a sagitta of at most g in between.
template <class Scalar>
Scalar first_root(Scalar a, Scalar b, Scalar g) noexcept {
  using std::sqrt;
  if (!(a >= Scalar(0))) return Scalar(0);
  const Scalar slope = b - a - 4 * g;
  const Scalar discriminant = slope * slope - 16 * g * a;
  if (b >= Scalar(0) && (slope >= Scalar(0) || !(discriminant > Scalar(0)))) return Scalar(1);
  const Scalar root = 2 * a / (-slope + sqrt(discriminant > Scalar(0) ? discriminant : Scalar(0)));
  return root < Scalar(1) ? root : Scalar(1);
}

}  // namespace feeler
