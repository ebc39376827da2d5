// Looks for walls that a tool of several pieces is near without having met them.
#pragma once

#include <algorithm>

#include "feeler/core/scalar.hpp"
#include "feeler/proximity/surroundings.hpp"
#include "feeler/render/linearisation.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/tick.hpp"

namespace feeler {

/// Takes triangles into the working set before they block a motion.
///
/// A certificate keeps less than the margin from a triangle that is not known, and has no more to say of it where that is kept. In a fit all around
/// a tool a wall may stay so for long: the tool rests nearer to it than to those that are known, turned; or one that is held at one end of a wall
/// turns as it slides, until the other end blocks it. After each tick one piece looks around, the next one after the next tick.
class Lookout {
 public:
  /// @param pose           certified
  /// @param linearisation  it takes in what is found, and has it in the next tick
  /// @param tick           its work grows by little more than `most_work` at most
  /// @cost  noexcept, no allocation
  template <RigidTool ToolType, QpSolver Solver>
  void look(const RenderedScene<ToolType>& scene, const Pose<typename RenderedScene<ToolType>::Scalar>& pose,
            const MotionCertificate<ToolType>& certificate, Linearisation<ToolType, Solver>& linearisation,
            Tick<typename RenderedScene<ToolType>::MeshScalar>& tick) noexcept {
    using Scalar = typename RenderedScene<ToolType>::Scalar;
    if (scene.piece_count() == 1) return;  // it brings the neighbours of what touches at once
    const auto& pairs = linearisation.pairs();
    const auto& problem = linearisation.problem();
    // Without clearance all walls touch, and the certificate tells which of them hold.
    const Scalar none = scene.clearance().none();
    if (std::any_of(pairs.begin(), pairs.end(), [none](const auto& pair) { return pair.slack < none; })) return;

    piece_ = (piece_ + 1) % scene.piece_count();
    const auto moving = scene.moving(piece_, pose, {});
    Surroundings surroundings(scene.object(), moving, scene.clearance(), linearisation.touching(scene));
    const bool has_room = 2 * problem.row_count() < problem.row_capacity;
    for (const auto& pair : pairs) {
      const bool is_wall = pair.piece == piece_ && (pair.state == PairState::has_rows || pair.state == PairState::repeats);
      if (is_wall) surroundings.add_known(pair.corners_world.colwise() - pose.translation, pair.last_normal, has_room && !pair.is_spare());
    }
    const auto& planes = certificate.planes(piece_);
    for (int i = 0; i < planes.size(); ++i) surroundings.add_normal(planes.normal(i));
    surroundings.visit(tick.work, tick.work + most_work, [&](int triangle) { linearisation.discover(scene, pose, piece_, triangle, tick); });
  }

 private:
  static constexpr int most_work = 16;

  int piece_ = 0;  // the last one that looked
};

}  // namespace feeler
