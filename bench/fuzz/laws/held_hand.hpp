// The law of the held hand: the energy never rises by more than the margin is worth, the tool comes to rest, and then not a bit changes.
#pragma once

#include <algorithm>
#include <random>

#include "fuzz/laws/law_run.hpp"
#include "support/rendering.hpp"

namespace feeler::laws {

/// Stops a hand at a random tick and holds it.
///
/// All rises of the energy together are at most margin · √(2E) + margin², E at the first tick of the hold: what a margin of way costs against
/// the pull. Converged within 20 ticks of what the way to the hand takes at a trust radius a tick; from the fifth tick after that on the bits of
/// the pose are the same. The figure is the rises over what the margin is worth.
template <class Tool>
LawFinding check_held_hand(std::mt19937& bits, const LawScene<Tool>& scene) {
  LawFinding finding;
  LawRun run(scene);
  if (!run.is_started()) return finding.is_refused = true, finding;
  LawHand hand(bits, scene);
  for (int i = 20 + below(bits, 280); i > 0; --i) run.update(hand.next());
  const int way = run.ticks_of_way(), held = 60 + way;
  const double worth = run.worth_of_margin();
  double rises = 0, last = run.energy();
  int converged_at = -1, moved_at = 0;
  Pose<double> settled;
  double stirred = 0;
  for (int i = 1; i <= held; ++i) {
    const Pose<double> before = run.tick().graphic_pose;
    run.hold();
    const double now = run.energy();
    rises += std::max(0.0, now - last);
    last = now;
    if (!test::is_same(before, run.tick().graphic_pose)) moved_at = i;
    if (converged_at < 0 && run.tick().converged()) converged_at = i;
    if (converged_at > 0 && i == converged_at + 5) settled = run.tick().graphic_pose;
    if (converged_at > 0 && i > converged_at + 5) stirred = std::max(stirred, run.distance(settled, run.tick().graphic_pose));
    if (!(rises <= worth))
      finding.complain("rises", run.ticks(), "the energy of a held hand rose by %.3g m2 in %d ticks, the margin is worth %.3g", rises, i, worth);
    finding.worst = std::max(finding.worst, rises / worth);
  }
  if (converged_at < 0 || converged_at > 20 + way)
    finding.complain("late", run.ticks(), "not converged %d ticks after the hand stopped (%d are its way); %.3g m off it",
                     converged_at < 0 ? held : converged_at, way, run.offset(run.tick().graphic_pose).linear.norm());
  else if (moved_at > converged_at + 5)
    finding.complain(stirred < 1e-9 ? "not to the bit" : "stirs", run.ticks(), "converged in tick %d of the hold, and moved in tick %d, by %.3g m",
                     converged_at, moved_at, stirred);
  finding.ticks = run.ticks();
  return finding;
}

}  // namespace feeler::laws
