// The law of free axes: along what the shape leaves free the tool goes with the hand, and feels nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "fuzz/laws/law_run.hpp"

namespace feeler::laws {

/// Follows a hand through a scene, and holds it at the end.
///
/// Every contact of these scenes pushes across the free axes and has no moment about them, so at a minimum the gradient of the energy along
/// them, which is the stiffness times the offset, is zero. Asked of converged ticks, to 1e-9 of the hand's way and 1e-9 m; a turn is counted as
/// what it moves the farthest point of the tool by. A box that the hand keeps flat on a plate does not tilt, to as much.
/// A held hand has 40 ticks beyond the tool's way until one tick is converged; else the tool is jammed, and nothing was asked of it.
/// Offsets under 0.1 µm are told apart, as those of ticks that stop early. The figure is the worst offset along a free axis [m].
template <class Tool>
LawFinding check_free_axes(std::mt19937& bits, const LawScene<Tool>& scene) {
  LawFinding finding;
  LawRun run(scene);
  if (!run.is_started()) return finding.is_refused = true, finding;
  const double stiffness = scene.settings.stiffness.translational.x(), torsion = scene.settings.stiffness.rotational.x(), radius = run.radius();
  const auto check = [&](const Tick<double>& tick) {
    if (!tick.converged()) return;
    const Twist<double> offset = run.offset(tick.graphic_pose);
    const double allowed = 1e-9 * (1 + run.way() + radius * run.turned());
    for (const FreeAxis& axis : scene.free_axes) {
      const Vector direction = (axis.is_of_tool ? tick.graphic_pose.rotation : scene.placed.rotation) * axis.direction;
      const double off = axis.is_turn ? radius * std::abs(offset.angular.dot(direction)) : std::abs(offset.linear.dot(direction));
      const double pull = std::abs((axis.is_turn ? tick.wrench.torque : tick.wrench.force).dot(direction));
      finding.worst = std::max(finding.worst, off);
      if (!(off <= allowed))
        finding.complain(off < 1e-7     ? "a little off"
                         : axis.is_turn ? "turned"
                                        : "driven",
                         run.ticks(), "off the hand by %.3g m along or about a free axis, %.3g %s", off, pull, axis.is_turn ? "N m" : "N");
      if (!(pull <= (axis.is_turn ? torsion / radius : stiffness) * allowed))
        finding.complain("pulled", run.ticks(), "%.3g %s along or about a free axis", pull, axis.is_turn ? "N m" : "N");
    }
    if (scene.family == "plate" && scene.is_turned_as_hand && !(radius * offset.angular.norm() <= allowed))
      finding.complain("tilted", run.ticks(), "%.3g rad off a flat plate", offset.angular.norm());
  };
  LawHand hand(bits, scene);
  for (int i = 100 + below(bits, 200); i > 0; --i) check(run.update(hand.next()));
  bool is_at_rest = false;
  for (int i = 40 + run.ticks_of_way(); i > 0; --i) {
    check(run.hold());
    is_at_rest = is_at_rest || run.tick().converged();
  }
  if (!is_at_rest)
    finding.complain("never at rest", run.ticks(), "no tick converged while the hand was held, the tool %.3g m and %.3g rad off it",
                     run.offset(run.tick().graphic_pose).linear.norm(), run.offset(run.tick().graphic_pose).angular.norm());
  finding.ticks = run.ticks();
  return finding;
}

}  // namespace feeler::laws
