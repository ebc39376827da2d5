// The law of no history: one hand pose has one pose of the tool, whichever way led there, however the surface is cut, and in a mirror.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/laws/fold_proof.hpp"
#include "fuzz/laws/law_run.hpp"

namespace feeler::laws {

inline Pose<double> mirrored(const Pose<double>& pose) {
  const auto& q = pose.rotation;
  return {{-pose.translation.x(), pose.translation.y(), pose.translation.z()}, {q.w(), q.x(), -q.y(), -q.z()}};
}
inline Box<double> mirrored(const Box<double>& box) { return box; }
inline Sphere<double> mirrored(const Sphere<double>& ball) { return ball; }
inline ConvexPolytope<double> mirrored(const ConvexPolytope<double>& tool) {
  Points<double> points(tool.vertex_count(), 3);
  for (int i = 0; i < tool.vertex_count(); ++i) points.row(i) << -tool.vertex(i).x(), tool.vertex(i).y(), tool.vertex(i).z();
  return ConvexPolytope<double>::hull_of(points);
}
inline CompoundTool<ConvexPolytope<double>> mirrored(const CompoundTool<ConvexPolytope<double>>& tool) {
  std::vector<ConvexPolytope<double>> pieces;
  for (int i = 0; i < tool.piece_count(); ++i) pieces.push_back(mirrored(tool.piece(i)));
  return CompoundTool<ConvexPolytope<double>>(std::move(pieces));
}

/// Leads the tool over some places to the last one and holds it there; false if it is not at rest, converged, after 80 ticks beyond its way.
template <class Tool>
bool lead(LawRun<Tool>& run, const std::vector<Pose<double>>& places, double step) {
  for (const Pose<double>& goal : places) {
    const Pose<double> from = run.hand_in_scene();
    const int steps = 1 + int(run.distance(from, goal) / step);
    for (int i = 1; i < steps; ++i) {
      const double share = double(i) / steps;
      run.update({from.translation + share * (goal.translation - from.translation), from.rotation.slerp(share, goal.rotation)});
    }
    run.update(goal);
  }
  for (int i = 80 + run.ticks_of_way(); i > 0; --i) run.hold();
  return run.tick().converged();
}

/// Leads the tool to one hand pose straight, and by a roundabout way; then straight in the same scene with the triangles in another order, cut
/// finer, and mirrored. None of these scenes has a fold: the rooms are convex; in fits, turns are so small that the energy's curvature exceeds
/// what the bend of the contacts takes from it by hundreds.
///
/// At rest all poses agree to 0.1 µm of the farthest point of the tool. Where the play is less than two margins the margin cannot be kept on
/// both sides, and no rule says how it is shared: then to the play, and counted apart. Where no proof is found that one of two poses is no minimum
/// it is told. The figure is the largest difference [m].
template <class Tool>
LawFinding check_no_history(std::mt19937& bits, const LawScene<Tool>& scene) {
  LawFinding finding;
  const bool is_tight = scene.play < 2 * scene.settings.margin;
  const double allowed = is_tight ? std::max(1e-7, scene.play * scene.lever) : 1e-7;
  const Pose<double> goal = scene.random_hand(bits);
  std::vector<Pose<double>> roundabout;
  for (int i = 1 + below(bits, 3); i > 0; --i) roundabout.push_back(scene.random_hand(bits));
  roundabout.push_back(goal);
  const double step = below(bits, 2) == 0 ? 2e-4 : 2e-5;
  LawRun straight(scene);
  if (!straight.is_started()) return finding.is_refused = true, finding;
  const auto compare = [&](const LawScene<Tool>& other, const std::vector<Pose<double>>& places, const char* how, bool is_mirrored) {
    LawRun run(other);
    if (!run.is_started()) return finding.complain("refused", 0, "a start that was taken is refused (%s)", how);
    const bool is_at_rest = lead(run, places, step);
    finding.ticks += run.ticks();
    if (!is_at_rest) return finding.complain("never at rest", run.ticks(), "not converged with the hand held (%s)", how);
    const Pose<double> pose = is_mirrored ? mirrored(run.graphic_in_scene()) : run.graphic_in_scene();
    const double apart = straight.distance(straight.graphic_in_scene(), pose);
    finding.worst = std::max(finding.worst, apart);
    if (apart <= allowed) return;
    const bool is_proved = !is_tight && has_no_fold(scene, straight, straight.graphic_in_scene(), pose);
    finding.complain((std::string(how) + (is_tight    ? ", tight"
                                          : is_proved ? ""
                                                      : ", maybe a fold"))
                         .c_str(),
                     run.ticks(), "%.3g m apart; %s", apart,
                     is_tight    ? "less than two margins of play"
                     : is_proved ? "the way from the worse to the better goes down and keeps its distance: no fold"
                                 : "no proof that it is no fold");
  };
  const bool is_at_rest = lead(straight, {goal}, step);
  finding.ticks += straight.ticks();
  if (!is_at_rest) return finding.complain("never at rest", straight.ticks(), "not converged with the hand held (straight)"), finding;
  compare(scene, roundabout, "another way", false);
  LawScene<Tool> other = scene;
  other.surface = shuffled(scene.surface, bits);
  compare(other, {goal}, "shuffled", false);
  other.surface = cut_finer(scene.surface);
  compare(other, {goal}, "cut finer", false);
  other.surface = mirrored(scene.surface);
  other.tool = mirrored(scene.tool);
  other.start = mirrored(scene.start);
  compare(other, {mirrored(goal)}, "mirrored", true);
  return finding;
}

}  // namespace feeler::laws
