// The renderer: one call a tick from the haptic pose to the graphic pose and the wrench.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "feeler/core/on_heap.hpp"
#include "feeler/core/result.hpp"
#include "feeler/core/status.hpp"
#include "feeler/object/mesh_interior.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/qp/dual_active_set.hpp"
#include "feeler/render/closest_features.hpp"
#include "feeler/render/constraints/working_set.hpp"
#include "feeler/render/contact_method.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/turned_stiffness.hpp"
#include "feeler/tool/rigid_tool.hpp"

namespace feeler {

/// Renders rigid contact of a tool, convex or of convex pieces, with a triangle mesh to the hand.
///
/// Each tick minimises the distance of the graphic pose to the haptic pose (paper, eq. 1 and 3) among the poses that do not penetrate the
/// object and that a collision-free path joins to the last pose. With the default contact method the path is certified triangle by triangle
/// (`Sweep`), so whatever the device does, a pose that is returned is free of collision and nothing thin is crossed.
///
/// The object must outlive the renderer. One renderer belongs to one thread at a time. It takes some kilobytes where it is; what ticks work on is on
/// the heap from its construction on: 0.6 MB, and 70 kB more for each further piece of the tool.
/// @tparam Tool    a `RigidTool`; its scalar is the renderer's
/// @tparam Solver  a `QpSolver` on the working scalar
/// @tparam Method  a `ContactMethod`: how contact is modelled
template <RigidTool ToolType, QpSolver Solver = DualActiveSet<WorkingScalar<typename ToolType::Scalar>>,
          ContactMethod<ToolType, Solver> Method = ClosestFeatures>
class HapticRenderer {
 public:
  using Tool = ToolType;
  using Scalar = typename Tool::Scalar;
  using Working = WorkingScalar<Scalar>;
  using Follower = typename Method::template Follower<Tool, Solver>;

  /// Refuses settings with which the tool could not follow, or could penetrate; see `Settings`.
  HapticRenderer(const TriangleMesh<Scalar>& object, const Tool& tool, const Settings<Scalar>& settings = {});
  HapticRenderer(const TriangleMesh<Scalar>&&, const Tool&, const Settings<Scalar>& = {}) = delete;
  /// The sentence with which the constructor refuses what it is given; empty where it does not. For `try_make<HapticRenderer<…>>`.
  static std::string reason_against(const TriangleMesh<Scalar>& object, const Tool& tool, const Settings<Scalar>& settings = {}) {
    return reason_against_scene(object, detail::working_tool<Working>(tool), settings);
  }

  const Settings<Scalar>& settings() const noexcept { return scene_.settings(); }
  /// The metric in which the graphic pose is the nearest, along its axes.
  const Metric<Working>& metric() const noexcept { return scene_.metric().along(); }

  /// What does not change: object, tool, metric and settings.
  const RenderedScene<Tool>& scene() const noexcept { return scene_; }

  /// Puts the graphic tool at a pose; `TickStatus::penetrating` if it would overlap the object there, `TickStatus::inside` if it would be in a solid,
  /// and then the renderer holds no pose and no force. `nearest_free_pose` finds one.
  /// @cost  not bounded by the work budget: for use outside the loop
  TickStatus reset(const Pose<Scalar>& pose) noexcept;

  /// One tick. The result stays valid until the next call.
  /// @param haptic_pose  pose of the tool frame that the device commands; its quaternion need not be unit
  /// @cost  noexcept; no allocation, lock, clock or I/O; bounded by `Settings::maximum_iterations` and `work_budget`
  const Tick<Scalar>& update(const Pose<Scalar>& haptic_pose) noexcept { return update_along(haptic_pose, along_poses()); }

  /// One tick with stiffness and metric along other axes than those of the poses, which may be others in each tick: those of a device's base as a
  /// turning object sees it, or those of the hand. All promises of a tick hold; the wrench is `wrench_along` these axes, and `wrench_along_tool` is
  /// that of axes that turn with the hand.
  /// @param world_from_axes  need not be unit; the identity is `update(haptic_pose)`, to the last bit
  const Tick<Scalar>& update(const Pose<Scalar>& haptic_pose, const Quaternion<Scalar>& world_from_axes) noexcept
    requires TurningMetricMethod<Method, ToolType, Solver>
  {
    return update_along(haptic_pose, world_from_axes);
  }

  /// A tick of a slow host: `update` at one pose again and again until it is no more `unconverged`, or until less than a `work_budget` is left.
  /// Between two frames a hand goes farther than one tick follows.
  /// @param most_work  in the unit of `Settings::work_budget`, 0.7 to 1 µs; it ends within one `update` of that, and of 1e9
  /// @return the last tick, with the work and the iterations of all, and the path of the last alone
  /// @cost   noexcept; no allocation, lock, clock or I/O; one `update` at least
  const Tick<Scalar>& update_until_converged(const Pose<Scalar>& haptic_pose, int most_work) noexcept {
    return update_until_converged_along(haptic_pose, along_poses(), most_work);
  }
  /// The same with stiffness and metric along other axes; see `update`.
  const Tick<Scalar>& update_until_converged(const Pose<Scalar>& haptic_pose, const Quaternion<Scalar>& world_from_axes, int most_work) noexcept
    requires TurningMetricMethod<Method, ToolType, Solver>
  {
    return update_until_converged_along(haptic_pose, world_from_axes, most_work);
  }

  /// The result of the last tick.
  const Tick<Scalar>& tick() const noexcept { return tick_; }

  /// The contact method at work, for what it tells beyond the tick.
  const Follower& follower() const noexcept { return state_->follower; }

 private:
  /// Axes of stiffness and metric that are those of the poses.
  static Quaternion<Scalar> along_poses() noexcept { return Quaternion<Scalar>::Identity(); }

  const Tick<Scalar>& update_along(const Pose<Scalar>& haptic_pose, const Quaternion<Scalar>& world_from_axes) noexcept;
  const Tick<Scalar>& update_until_converged_along(const Pose<Scalar>& haptic_pose, const Quaternion<Scalar>& world_from_axes,
                                                   int most_work) noexcept;
  void turn_metric(const Quaternion<Working>& world_from_axes) noexcept;
  bool is_free_at(const Pose<Working>& pose) noexcept;
  bool is_inside_at(const Pose<Working>& pose) const noexcept;
  void report(const Pose<Working>& target) noexcept;

  /// What ticks work on.
  struct State {
    explicit State(const RenderedScene<Tool>& scene) : follower(scene), start(scene) {}

    Follower follower;
    MotionCertificate<Tool> start;  // of where it is reset
  };

  RenderedScene<Tool> scene_;
  std::shared_ptr<const MeshInterior> interior_;  // where it is asked for
  OnHeap<State> state_;
  bool is_reset_ = false;
  Tick<Scalar> tick_;
};

// Defined out of the class, so not inline: `extern template class` keeps them, and all that they use, out of a file.

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
HapticRenderer<ToolType, Solver, Method>::HapticRenderer(const TriangleMesh<Scalar>& object, const Tool& tool, const Settings<Scalar>& settings)
    : scene_(object, tool, settings),
      interior_(settings.closed_means_solid ? std::make_shared<const MeshInterior>(object) : nullptr),
      state_(std::in_place, scene_) {}

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
TickStatus HapticRenderer<ToolType, Solver, Method>::reset(const Pose<Scalar>& pose) noexcept {
  is_reset_ = false;
  tick_ = {};
  scene_.turn_metric(Quaternion<Working>::Identity());
  if (!pose.is_finite()) return tick_.status = TickStatus::not_finite;
  tick_.graphic_pose = pose.normalized();
  const Pose<Working> reference_pose = scene_.reference_pose(pose);
  if (!is_free_at(reference_pose)) return tick_.status = TickStatus::penetrating;
  if (is_inside_at(reference_pose)) return tick_.status = TickStatus::inside;
  state_->follower.reset(scene_, reference_pose);
  tick_.graphic_pose = scene_.tool_pose(reference_pose);  // to the last bit what ticks that do not move give
  is_reset_ = true;
  return tick_.status = TickStatus::converged;
}

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
const Tick<typename ToolType::Scalar>& HapticRenderer<ToolType, Solver, Method>::update_along(const Pose<Scalar>& haptic_pose,
                                                                                              const Quaternion<Scalar>& world_from_axes) noexcept {
  if (!haptic_pose.is_finite() || !Pose<Scalar>{.rotation = world_from_axes}.is_finite()) {
    tick_.path.clear();
    tick_.status = TickStatus::not_finite;
    return tick_;
  }
  if (!is_reset_) {
    tick_ = {};
    tick_.graphic_pose = haptic_pose.normalized();
    return tick_;
  }
  turn_metric(world_from_axes.template cast<Working>().normalized());
  const Pose<Working> target = scene_.reference_pose(haptic_pose);
  tick_.work = 0;
  tick_.path.clear();
  tick_.status = state_->follower.follow(scene_, target, tick_);
  report(target);
  return tick_;
}

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
const Tick<typename ToolType::Scalar>& HapticRenderer<ToolType, Solver, Method>::update_until_converged_along(
    const Pose<Scalar>& haptic_pose, const Quaternion<Scalar>& world_from_axes, int most_work) noexcept {
  const int last_begin = (std::min)((std::max)(most_work, 0), 1'000'000'000) - settings().work_budget;  // and no sum overflows
  int work = update_along(haptic_pose, world_from_axes).work, iterations = tick_.iterations;
  while (tick_.status == TickStatus::unconverged && work <= last_begin) {
    work += (std::max)(update_along(haptic_pose, world_from_axes).work, 1);
    iterations += tick_.iterations;
  }
  tick_.work = work;
  tick_.iterations = iterations;
  return tick_;
}

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
void HapticRenderer<ToolType, Solver, Method>::turn_metric(const Quaternion<Working>& world_from_axes) noexcept {
  if (scene_.metric().world_from_axes().coeffs() == world_from_axes.coeffs()) return;
  scene_.turn_metric(world_from_axes);
  if constexpr (TurningMetricMethod<Method, ToolType, Solver>) state_->follower.metric_turned();
}

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
bool HapticRenderer<ToolType, Solver, Method>::is_free_at(const Pose<Working>& pose) noexcept {
  constexpr int part = 4;  // of the work: one blocker will do, and of a hull of thousands of points each takes long
  int work = 0;
  state_->start.clear();
  const WorkingSet<Working, 1> none;
  auto result = state_->start.certify(scene_, pose, {}, work, part, none);
  for (int limit = work + part; result.is_exhausted && result.blockers.empty(); limit = work + part)
    result = state_->start.go_on(scene_, work, limit, none);
  return result.blockers.empty();
}

/// Of a free pose. A piece that crosses no triangle is in a solid with all of it, or with none.
template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
bool HapticRenderer<ToolType, Solver, Method>::is_inside_at(const Pose<Working>& pose) const noexcept {
  if (interior_ == nullptr || interior_->is_empty()) return false;
  const Pose<Working> frame = scene_.tool_frame(pose);
  // A thin tool that lies on the surface is within rounding of either side.
  const auto rounding = static_cast<double>(2 * scene_.clearance().negligible() + scene_.clearance().rounding);
  for (int i = 0; i < scene_.piece_count(); ++i) {
    const Vector3<Working> point = frame * middle_of(scene_.piece(i));
    if (interior_->encloses(scene_.object(), Vector3<double>(point.template cast<double>()), rounding)) return true;
  }
  return false;
}

template <RigidTool ToolType, QpSolver Solver, ContactMethod<ToolType, Solver> Method>
void HapticRenderer<ToolType, Solver, Method>::report(const Pose<Working>& target) noexcept {
  tick_.graphic_pose = scene_.tool_pose(state_->follower.pose());
  const Stiffness<Working> stiffness{settings().stiffness.translational.template cast<Working>(),
                                     settings().stiffness.rotational.template cast<Working>()};
  const Twist<Working> off = scene_.idle_turns().motion_between(target, state_->follower.pose());
  const auto& metric = scene_.metric();
  const Wrench<Working> wrench = metric.is_turned() ? wrench_along(metric.world_from_axes(), stiffness, off) : stiffness.wrench(off);
  tick_.wrench = wrench.template cast<Scalar>();
  tick_.contacts.clear();
  state_->follower.report(scene_, tick_);
}

template <RigidTool Tool>
HapticRenderer(const TriangleMesh<typename Tool::Scalar>&, const Tool&) -> HapticRenderer<Tool>;
template <RigidTool Tool>
HapticRenderer(const TriangleMesh<typename Tool::Scalar>&, const Tool&, const Settings<typename Tool::Scalar>&) -> HapticRenderer<Tool>;

}  // namespace feeler
