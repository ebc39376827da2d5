// The law of convex rooms: the pose is the hand's projection, no two poses are further apart than the hands, and the force goes with them.
#pragma once

#include <algorithm>
#include <random>
#include <stdexcept>

#include "fuzz/laws/law_run.hpp"
#include "support/penetration_checker.hpp"

namespace feeler::laws {

/// The law itself is wrong where what it expects is not free of every triangle, judged by the checker.
template <class Tool>
void require_free(const LawScene<Tool>& scene, const Pose<double>& expected) {
  if (test::deepest_penetration(test::CheckedObject(points_of(scene.surface), rows_of(scene.surface)), test::checked_pieces(scene.tool),
                                test::checked_pose(expected))
          .depth > 0)
    throw std::logic_error("convex-room: the expected pose penetrates; the scene is not what its walls say");
}

/// Follows a hand that turns as the tool may, in a room of flat walls.
///
/// The centre may be in the room closed in by the tool and the margin: an intersection of half spaces, of which `Projection` finds the
/// nearest point to the hand. Asked of converged ticks: to 2 margins. Between two of them, one after the other, the tool goes no further than
/// the hand and the force changes by no more than the stiffness times the hand's step, each up to a margin, as a projection P and 1 − P are
/// non-expansive. The figure is the largest distance from the projection [m].
template <class Tool>
LawFinding check_convex_room(std::mt19937& bits, const LawScene<Tool>& scene) {
  LawFinding finding;
  LawRun run(scene);
  if (!run.is_started()) return finding.is_refused = true, finding;
  const double margin = scene.settings.margin, stiffness = scene.settings.stiffness.translational.x();
  bool was_converged = false;
  Pose<double> last_hand, last_pose;
  Vector last_force = Vector::Zero();
  const auto check = [&](const Tick<double>& tick) {
    const Pose<double> hand = run.hand_in_scene(), pose = run.graphic_in_scene();
    if (tick.converged()) {
      const Projection nearest(closed_in(scene.walls, scene.tool, hand.rotation, margin), hand.translation.template cast<Wide>());
      const double off =
          double((pose.translation.template cast<Wide>() - nearest.point()).norm()) + run.radius() * run.offset(tick.graphic_pose).angular.norm();
      finding.worst = std::max(finding.worst, off);
      if (!(off <= 2 * margin) && finding.kind.empty()) require_free(scene, {Vector(nearest.point().template cast<double>()), hand.rotation});
      if (!(off <= 2 * margin))
        finding.complain("off", run.ticks(), "%.3g m off the projection, which is %.3g m off the hand; margin %.3g m, of which %.3g m is kept", off,
                         double((hand.translation.template cast<Wide>() - nearest.point()).norm()), margin,
                         clearance_in(scene.walls, scene.tool, pose));
      const double step = (hand.translation - last_hand.translation).norm(), gone = (pose.translation - last_pose.translation).norm(),
                   change = (tick.wrench.force - last_force).norm();
      if (was_converged && !(gone <= step + margin))
        finding.complain("hops", run.ticks(), "the tool went %.3g m, the hand %.3g m, margin %.3g m", gone, step, margin);
      if (was_converged && !(change <= stiffness * (step + margin)))
        finding.complain("force steps", run.ticks(), "by %.3g N for %.3g m of the hand", change, step);
    }
    was_converged = tick.converged();
    last_hand = hand, last_pose = pose, last_force = tick.wrench.force;
  };
  LawHand hand(bits, scene);
  for (int i = 150 + below(bits, 250); i > 0; --i) check(run.update(hand.next()));
  for (int i = 20 + run.ticks_of_way(); i > 0; --i) check(run.hold());
  if (!run.tick().converged()) finding.complain("never at rest", run.ticks(), "not converged with the hand held");
  finding.ticks = run.ticks();
  return finding;
}

}  // namespace feeler::laws
