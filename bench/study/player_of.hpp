// The player of one type of renderer.
#pragma once

#include <memory>
#include <utility>

#include "feeler/render/haptic_renderer.hpp"
#include "feeler/tool/compound_tool.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "study/player.hpp"
#include "times.hpp"

namespace feeler::study {

template <class Renderer>
class PlayerOf final : public Player {
 public:
  using Tool = typename Renderer::Tool;
  using Scalar = typename Tool::Scalar;

  PlayerOf(const StudyScene& scene, const Tool& tool, const Cell& cell)
      : object_(scene.vertices.cast<Scalar>(), scene.triangles), renderer_(object_, tool, settings_of(scene, cell)) {}

  TickStatus reset(const Pose<double>& pose) override { return renderer_.reset(pose.cast<Scalar>()); }
  Reading update(const Pose<double>& hand) override {
    const Pose<Scalar> given = hand.cast<Scalar>();
    const long counted = operations();
    const double begin = bench::thread_time();
    const auto& tick = renderer_.update(given);
    const double end = bench::thread_time();
    const long operations_of_tick = operations() - counted;
    const auto wide = [](const Vector3<Scalar>& v) { return Vector3<Wide>(v.unaryExpr([](const Scalar& x) { return static_cast<Wide>(x); })); };
    const auto& rotation = tick.graphic_pose.rotation;
    return {{wide(tick.graphic_pose.translation), Quaternion<Wide>(static_cast<Wide>(rotation.w()), static_cast<Wide>(rotation.x()),
                                                                   static_cast<Wide>(rotation.y()), static_cast<Wide>(rotation.z()))},
            wide(tick.wrench.force),
            wide(tick.wrench.torque),
            tick.status,
            tick.work,
            tick.path.empty(),
            end - begin,
            operations_of_tick};
  }

 private:
  /// That the scalar has counted so far.
  static long operations() {
    if constexpr (requires { Scalar::operations(); }) return Scalar::operations();
    return 0;
  }
  static Settings<Scalar> settings_of(const StudyScene& scene, const Cell& cell) {
    const auto stiffness = scene.stiffness();
    Settings<Scalar> settings;
    settings.stiffness = {stiffness.translational.cast<Scalar>(), stiffness.rotational.cast<Scalar>()};
    settings.closed_means_solid = scene.closed_means_solid;
    settings.margin = Scalar(cell.margin);
    settings.work_budget = cell.budget;
    settings.maximum_iterations = cell.iterations;
    return settings;
  }

  TriangleMesh<Scalar> object_;
  Renderer renderer_;
};

/// Makes a player where the tool is one polytope.
template <class Scalar, class Solver = DualActiveSet<WorkingScalar<Scalar>>, class Method = ClosestFeatures>
std::unique_ptr<Player> make_convex_player(const StudyScene& scene, const Cell& cell) {
  using Tool = ConvexPolytope<Scalar>;
  if (scene.pieces.size() != 1) throw std::invalid_argument("a tool of several pieces is rendered by default only");
  return std::make_unique<PlayerOf<HapticRenderer<Tool, Solver, Method>>>(scene, Tool::hull_of(scene.pieces.front().template cast<Scalar>()), cell);
}

}  // namespace feeler::study
