// The law of status: a pose that is called converged stays where it is, and none that is near and free is better.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "fuzz/laws/law_run.hpp"

namespace feeler::laws {

/// Looks among 2000 poses within a millimetre for one that keeps the margin and is nearer to the hand by more than the margin is worth.
template <class Tool>
void search_better(std::mt19937& bits, const LawScene<Tool>& scene, const LawRun<Tool>& run, LawFinding& finding) {
  const Twist<double> home = -run.offset(run.tick().graphic_pose);
  const double energy = run.energy(), worth = run.worth_of_margin(), length = std::sqrt(run.renderer().metric().rotational.x());
  for (int i = 0; i < 2000; ++i) {
    const double scale = magnitude(bits, -7, -3);
    Twist<double> step{scale * random_vector(bits), scale / length * random_vector(bits)};
    if (i % 2 == 0 && home.linear.norm() > 0) step.linear += scale * home.linear.normalized();
    if (!has_turns<Tool> || i % 3 == 0) step.angular.setZero();
    const Pose<double> near = moved(run.tick().graphic_pose, step);
    const double gain = energy - run.energy(near);
    if (gain <= worth || clearance_in(scene.walls, scene.tool, relative_to(scene.placed, near)) < 0.999 * scene.settings.margin) continue;
    finding.worst = std::max(finding.worst, gain / std::sqrt(2 * energy));
    return finding.complain("not the nearest", run.ticks(), "a free pose %.3g m and %.3g rad off has %.3g m2 less, the margin is worth %.3g",
                            step.linear.norm(), step.angular.norm(), gain, worth);
  }
}

/// At some random ticks that are converged a copy of the renderer holds the hand: in 60 ticks no point of the tool goes 0.1 µm. In rooms with
/// flat walls, where clearance has a closed form, better poses are searched. The figure is the longest way of a converged pose, or what a better
/// one is nearer by [m].
template <class Tool>
LawFinding check_status(std::mt19937& bits, const LawScene<Tool>& scene) {
  LawFinding finding;
  LawRun run(scene);
  if (!run.is_started()) return finding.is_refused = true, finding;
  LawHand hand(bits, scene);
  long held_ticks = 0;
  for (int i = 100 + below(bits, 200); i > 0; --i) {
    run.update(hand.next());
    if (below(bits, 25) > 0 || !run.tick().converged()) continue;
    HapticRenderer<Tool> held = run.renderer();
    double moved = 0;
    for (int k = 0; k < 60; ++k, ++held_ticks) moved = std::max(moved, run.distance(run.tick().graphic_pose, held.update(run.hand()).graphic_pose));
    finding.worst = std::max(finding.worst, moved);
    if (!(moved <= 1e-7)) finding.complain("not at rest", run.ticks(), "converged, and went %.3g m while the hand was held", moved);
    if (!scene.walls.empty()) search_better(bits, scene, run, finding);
  }
  finding.ticks = run.ticks() + held_ticks;
  return finding;
}

}  // namespace feeler::laws
