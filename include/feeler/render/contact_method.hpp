// What a way of modelling contact must offer to be the third template argument of `HapticRenderer`.
#pragma once

#include <concepts>

#include "feeler/core/status.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/tick.hpp"

namespace feeler {

/// A contact method names a class template `Follower<Tool, Solver>` whose objects, made for a scene, lead the graphic pose after the haptic pose.
///
/// `reset(scene, pose)` starts from a pose that is free of collision. `follow(scene, target, tick)` moves on towards the target, records the
/// way in `tick.path` and the effort in `tick.iterations`, `rows` and `work`, and returns the status of the tick; `pose()` is where it
/// arrived. `report(scene, tick)` lists what holds the tool there. All poses are those of the reference point. One whose metric may turn
/// between ticks has `metric_turned()` too.
template <class Method, class Tool, class Solver>
concept ContactMethod =
    RigidTool<Tool> && QpSolver<Solver> && std::constructible_from<typename Method::template Follower<Tool, Solver>, const RenderedScene<Tool>&> &&
    requires(typename Method::template Follower<Tool, Solver>& follower, const RenderedScene<Tool>& scene,
             const Pose<typename RenderedScene<Tool>::Scalar>& pose, Tick<typename Tool::Scalar>& tick) {
      { follower.reset(scene, pose) } noexcept;
      { follower.follow(scene, pose, tick) } noexcept -> std::same_as<TickStatus>;
      { follower.pose() } noexcept -> std::convertible_to<Pose<typename RenderedScene<Tool>::Scalar>>;
      { follower.report(scene, tick) } noexcept;
    };

/// A contact method whose metric may turn between ticks.
template <class Method, class Tool, class Solver>
concept TurningMetricMethod = ContactMethod<Method, Tool, Solver> && requires(typename Method::template Follower<Tool, Solver>& follower) {
  { follower.metric_turned() } noexcept;
};

}  // namespace feeler
