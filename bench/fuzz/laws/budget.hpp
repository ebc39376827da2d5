// The law of the budget: a tick keeps it, and however little it is, the tool arrives where it can.
#pragma once

#include <algorithm>
#include <random>

#include "fuzz/laws/law_run.hpp"
#include "support/rendering.hpp"

namespace feeler::laws {

/// Stops a hand at a random tick and holds it, with a budget of 20 to 1000.
///
/// Every tick keeps it (`keeps_budget`). The tool converges within 20 ticks of what the way to the hand takes at a trust radius a tick, each counted
/// once, and as many times more as the budget is in a thousand: what a motion in a fit all around a tool takes to look at. The figure is the most work
/// over the budget.
template <class Tool>
LawFinding check_budget(std::mt19937& bits, LawScene<Tool> scene) {
  LawFinding finding;
  const int budget = scene.settings.work_budget = int(20 * magnitude(bits, 0, 1.7));
  LawRun run(scene);
  if (!run.is_started()) return finding.is_refused = true, finding;
  const auto check = [&](const Tick<double>& tick) {
    finding.worst = std::max(finding.worst, double(tick.work) / budget);
    if (!test::keeps_budget(tick.work, budget)) finding.complain("budget", run.ticks(), "%d units of work, of %d", tick.work, budget);
  };
  LawHand hand(bits, scene);
  for (int i = 20 + below(bits, 280); i > 0; --i) check(run.update(hand.next()));
  const int most = (20 + run.ticks_of_way()) * (1 + 1000 / budget);
  int held = 0;
  do {
    check(run.hold());
    ++held;
  } while (!run.tick().converged() && held <= most);
  if (!run.tick().converged())
    finding.complain("starves", run.ticks(), "not converged %d ticks after the hand stopped, with a budget of %d; %.3g m off it", held, budget,
                     run.offset(run.tick().graphic_pose).linear.norm());
  finding.ticks = run.ticks();
  return finding;
}

}  // namespace feeler::laws
