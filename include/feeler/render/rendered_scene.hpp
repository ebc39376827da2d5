// What a contact method is given: object, tool, metric and settings, all in the scalar that decides collisions.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "feeler/core/index.hpp"
#include "feeler/core/requirement.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/separation.hpp"
#include "feeler/render/idle_turns.hpp"
#include "feeler/render/scene_rounding.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/render/usable_settings.hpp"
#include "feeler/spatial/turned_metric.hpp"
#include "feeler/tool/piece_tree.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "feeler/tool/tool_incidence.hpp"

namespace feeler {

namespace detail {
/// The tool in the scalar that decides collisions.
template <class Working, RigidTool Tool>
auto working_tool(const Tool& tool) {
  if constexpr (std::is_same_v<typename Tool::Scalar, Working>) {
    return tool;
  } else {
    return tool.template cast<Working>();
  }
}
}  // namespace detail

/// The constant part of a rendering, but for the axes of the metric. Poses that a contact method works on are those of the reference point: their
/// translation is where it is in the world, not where the origin of the tool frame is.
template <RigidTool ToolType>
class RenderedScene {
 public:
  using MeshScalar = typename ToolType::Scalar;
  using Scalar = WorkingScalar<MeshScalar>;
  using Tool = std::remove_cvref_t<decltype(detail::working_tool<Scalar>(std::declval<const ToolType&>()))>;
  using Piece = PieceOf<Tool>;

  /// Refuses settings that are of no use, and scenes that rounding spoils; see `reason_against_scene`.
  RenderedScene(const TriangleMesh<MeshScalar>& object, const ToolType& tool, const Settings<MeshScalar>& settings)
      : object_(&object),
        tool_(detail::working_tool<Scalar>(tool)),
        settings_(usable(object, tool_, settings)),
        reference_(settings.reference_point.template cast<Scalar>()),
        metric_(metric_of(settings)),
        idle_turns_(tool_, reference_, metric_.along()),
        piece_tree_(tool_) {
    for (int i = 0; i < piece_count(); ++i) {
      incidences_.push_back(incidence_of(piece(i)));
      radii_.push_back(radius_about(piece(i), reference_));
      radius_ = (std::max)(radius_, radii_[as_index(i)]);
    }
    const SceneRounding<MeshScalar, Scalar> rounding(object, tool_, reference_);
    const Scalar of_poses = std::is_same_v<MeshScalar, Scalar> ? Scalar(0) : rounding.of_poses();
    margin_ = (std::max)(Scalar(settings.margin), 10 * of_poses);
    clearance_ = Clearance<Scalar>(margin_, trust_radius());
    clearance_.rounding = of_poses;
    clearance_.allowance = (std::max)(clearance_.allowance, rounding.allowance());
    clearance_.touching = (std::max)(clearance_.touching, touching_distance(radius_));
    const Scalar wanted = clearance_.allowance / Clearance<Scalar>().allowance;
    while (2 * unit_ > 3 * wanted) unit_ /= 2;
    while (4 * unit_ < 3 * wanted) unit_ *= 2;
  }
  RenderedScene(const TriangleMesh<MeshScalar>&&, const ToolType&, const Settings<MeshScalar>&) = delete;  // it refers to the object

  const TriangleMesh<MeshScalar>& object() const noexcept { return *object_; }
  const Tool& tool() const noexcept { return tool_; }
  int piece_count() const noexcept { return feeler::piece_count(tool_); }
  const Piece& piece(int i) const noexcept { return piece_of(tool_, i); }
  /// Of a piece.
  int largest_vertex_count() const noexcept {
    int largest = 0;
    for (int i = 0; i < piece_count(); ++i) largest = (std::max)(largest, piece(i).vertex_count());
    return largest;
  }
  /// The pieces of a compound tool in their groups; see `PieceTree`.
  std::span<const PieceGroup<Scalar>> piece_groups() const noexcept
    requires CompoundShape<Tool>
  {
    return piece_tree_.nodes();
  }
  const FeatureIncidence& incidence(int i) const noexcept { return incidences_[as_index(i)]; }
  const Settings<MeshScalar>& settings() const noexcept { return settings_; }
  /// In the tool frame [m].
  const Vector3<Scalar>& reference() const noexcept { return reference_; }
  /// Largest distance of a point of the tool, or of its core, from the reference point [m].
  Scalar radius() const noexcept { return radius_; }
  const TurnedMetric<Scalar>& metric() const noexcept { return metric_; }
  /// From here on the metric weighs along other axes; all else stays as it is.
  /// @param world_from_axes  unit
  void turn_metric(const Quaternion<Scalar>& world_from_axes) noexcept { metric_.turn(world_from_axes); }
  const Clearance<Scalar>& clearance() const noexcept { return clearance_; }
  /// The clearance to certify a motion with. Where it ends is rounded to the size of the numbers it starts from, so a tool that comes from
  /// kilometres away keeps as much distance.
  template <ConvexTool Moved>
  Clearance<Scalar> clearance_for(const MovingTool<Moved>& moving) const noexcept {
    const Scalar rounding = 8 * std::numeric_limits<Scalar>::epsilon() * (moving.origin().norm() + moving.length());
    Clearance<Scalar> clearance = clearance_;
    clearance.kept = (std::max)(clearance.kept, rounding);
    return clearance;
  }
  /// The unit of length that optimisations are solved in [m]: the power of two in which `Clearance::allowance` is as many units as it is metres with the
  /// default trust radius, or nearly. So the tolerances of a solver, which are numbers, and its norms, which add lengths to angles, mean the same in a scene of
  /// any size.
  Scalar unit_of_solver() const noexcept { return unit_; }
  /// `Settings::margin`, or more where the poses that are returned have not the digits for it [m].
  Scalar margin() const noexcept { return margin_; }
  /// What is nearer may be what holds the tool; what rests at the margin is far enough [m].
  Scalar noticed() const noexcept { return margin_ - margin_ / 1000; }
  /// What is nearer touches: any motion may meet it [m].
  Scalar contact_distance() const noexcept { return 4 * margin_; }
  /// `Settings::step_tolerance`; and what is short whatever the step before it was, what is rest where a motion starts, and what is no motion [m].
  Scalar step_tolerance() const noexcept { return Scalar(settings_.step_tolerance); }
  Scalar very_short() const noexcept { return step_tolerance() / 50; }
  Scalar at_rest() const noexcept { return very_short() / 100; }
  Scalar no_motion() const noexcept { return step_tolerance() / 500000; }
  Scalar trust_radius() const noexcept { return Scalar(settings_.trust_radius); }
  /// Features up to this height above a triangle give rows, those with a gap up to a quarter of it: of a step, and twice the margin at least, or none
  /// would keep it [m].
  Scalar patch_height() const noexcept { return (std::max)(trust_radius() / 8, 8 * margin_); }

  /// Pose of the reference point, from the pose of the tool frame.
  Pose<Scalar> reference_pose(const Pose<MeshScalar>& tool_pose) const noexcept {
    const Pose<Scalar> pose = tool_pose.template cast<Scalar>().normalized();
    return {pose * reference_, pose.rotation};
  }
  /// Pose of the tool frame, from the pose of the reference point.
  Pose<Scalar> tool_frame(const Pose<Scalar>& pose) const noexcept { return {pose.translation - pose.rotation * reference_, pose.rotation}; }
  Pose<MeshScalar> tool_pose(const Pose<Scalar>& pose) const noexcept { return tool_frame(pose).template cast<MeshScalar>(); }
  /// A piece of the tool on a motion of the whole.
  MovingTool<Piece> moving(int i, const Pose<Scalar>& from, const Twist<Scalar>& motion) const noexcept {
    return {piece(i), reference_, radii_[as_index(i)], from, motion};
  }
  /// The box of a group of pieces on a motion of the whole.
  MovingTool<Box<Scalar>> moving(const PieceGroup<Scalar>& group, const Pose<Scalar>& from, const Twist<Scalar>& motion) const noexcept {
    const Vector3<Scalar> reference = reference_ - group.centre;
    return {group.box, reference, reference.norm() + group.box.half_extents().norm(), from, motion};
  }
  /// The turns that do not matter, and what is left of motions without them.
  const IdleTurns<Tool>& idle_turns() const noexcept { return idle_turns_; }
  /// Bound on the path of every point of the tool, or of its core [m].
  Scalar length_of(const Twist<Scalar>& motion) const noexcept { return motion.linear.norm() + radius_ * motion.angular.norm(); }
  /// The same for a motion from a pose: turns that do not matter have no length.
  Scalar length_of(const Twist<Scalar>& motion, const Pose<Scalar>& from) const noexcept {
    return motion.linear.norm() + radius_ * idle_turns_.angle_that_matters(motion.angular, from);
  }
  /// Whether a motion of a length [m] that ended at a pose has led to the target, but for rounding.
  bool has_led_to(const Pose<Scalar>& target, const Pose<Scalar>& pose, Scalar length) const noexcept {
    const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
    const Scalar off = (pose.translation - target.translation).template lpNorm<1>();
    if (!(off <= rounding * (target.translation.template lpNorm<1>() + length + radius_))) return false;
    const Scalar side = pose.rotation.dot(target.rotation) < Scalar(0) ? Scalar(-1) : Scalar(1);
    return (pose.rotation.coeffs() - side * target.rotation.coeffs()).template lpNorm<1>() <= rounding;
  }
  /// The corners of a triangle in the tool frame of a pose with the axes given [m].
  Matrix3<Scalar> in_tool(const Matrix3<Scalar>& corners_world, const Pose<Scalar>& pose, const Matrix3<Scalar>& axes) const noexcept {
    return (axes.transpose() * (corners_world.colwise() - pose.translation)).colwise() + reference_;
  }

 private:
  static const Settings<MeshScalar>& usable(const TriangleMesh<MeshScalar>& object, const Tool& tool, const Settings<MeshScalar>& settings) {
    refuse_for(reason_against_scene(object, tool, settings));
    return settings;
  }
  /// A sphere's turns may weigh nothing; where nobody turns it any other weight does as well.
  static Metric<Scalar> metric_of(const Settings<MeshScalar>& settings) noexcept {
    Metric<Scalar> metric = settings.metric_in_use().template cast<Scalar>();
    if constexpr (symmetry_of<Tool> == Symmetry::about_point) metric.rotational.setOnes();
    return metric;
  }
  struct NoGroups {
    explicit NoGroups(const Tool&) noexcept {}
  };

  const TriangleMesh<MeshScalar>* object_;
  Tool tool_;
  Settings<MeshScalar> settings_;
  std::vector<FeatureIncidence> incidences_;  // of the pieces
  Vector3<Scalar> reference_;
  std::vector<Scalar> radii_;
  Scalar radius_ = Scalar(0);
  TurnedMetric<Scalar> metric_;
  [[no_unique_address]] IdleTurns<Tool> idle_turns_;
  [[no_unique_address]] std::conditional_t<CompoundShape<Tool>, PieceTree<Tool>, NoGroups> piece_tree_;
  Clearance<Scalar> clearance_;
  Scalar unit_ = Scalar(1);
  Scalar margin_;
};

}  // namespace feeler
