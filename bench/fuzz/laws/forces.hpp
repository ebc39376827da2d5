// The law of forces: contacts sum to the wrench, and no closed motion gives the hand energy.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fuzz/laws/law_run.hpp"

namespace feeler::laws {

/// The forces of the contacts push the tool out along their normals, and so does the wrench, K (q_g − q_h): they are equal, to 1 % and 1 µN; and so
/// are their moments about the graphic tool's centre, to 1 % of the sum of the moments' sizes. (The wrench is stated at the hand's, to which its
/// force points from the tool's: the arm between them has no moment.)
template <class Tool>
void check_sums(const LawRun<Tool>& run, LawFinding& finding) {
  const Tick<double>& tick = run.tick();
  if (!tick.converged()) return;
  Vector force = Vector::Zero(), torque = Vector::Zero();
  double moments = 0;
  for (const auto& contact : tick.contacts) {
    const Vector share = contact.force * contact.normal_world, arm = contact.point_world - tick.graphic_pose.translation;
    force += share;
    torque += arm.cross(share);
    moments += arm.norm() * contact.force;
  }
  const double off = (force - tick.wrench.force).norm();
  finding.worst = std::max(finding.worst, off / std::max(tick.wrench.force.norm(), 1e-4));
  if (!(off <= 0.01 * tick.wrench.force.norm() + 1e-6))
    finding.complain("force", run.ticks(), "the contacts sum to %.6g N, the wrench is %.6g N, %.3g N apart", force.norm(), tick.wrench.force.norm(),
                     off);
  const double twist = (torque - tick.wrench.torque).norm();
  if (has_turns<Tool> && !(twist <= 0.01 * moments + 1e-6 * run.radius()))
    finding.complain("torque", run.ticks(), "the contacts sum to %.6g N m, the wrench is %.6g N m, %.3g N m apart", torque.norm(),
                     tick.wrench.torque.norm(), twist);
}

/// Follows a hand and looks at the sums; then leads it twice round an ellipse, pressed into the room, and counts the work of the second lap.
///
/// With the projection P the force K (P(h) − h) has a potential, so its work on the hand over a closed way is zero. Of a way in steps it is taken
/// by the trapezoidal rule, from the tool's force and, with the same steps, from that of the projection: the difference is what the hand gains,
/// at most a margin times the largest force. Only where there is a closed form. The figure is the worst error of the sum over the force.
template <class Tool>
LawFinding check_forces(std::mt19937& bits, const LawScene<Tool>& scene) {
  LawFinding finding;
  LawRun run(scene);
  if (!run.is_started()) return finding.is_refused = true, finding;
  if (scene.walls.empty() || !scene.is_turned_as_hand || below(bits, 4) > 0) {
    LawHand hand(bits, scene);
    for (int i = 100 + below(bits, 200); i > 0; --i) run.update(hand.next()), check_sums(run, finding);
    return finding.ticks = run.ticks(), finding;
  }
  const Pose<double> centre = scene.random_hand(bits);
  const Vector a = magnitude(bits, -5, -3) * random_direction(bits), b = magnitude(bits, -5, -3) * random_direction(bits);
  const int steps = std::max(40, int(2 * std::numbers::pi * std::max(a.norm(), b.norm()) / (below(bits, 2) == 0 ? 2e-6 : 2e-5)));
  const auto on_ellipse = [&](int i) {
    const double angle = 2 * std::numbers::pi * (i % steps) / steps;
    return Pose<double>{centre.translation + std::cos(angle) * a + std::sin(angle) * b, centre.rotation};
  };
  const Pose<double> first = on_ellipse(0);
  for (int i = 1, n = 1 + int(run.distance(scene.start, first) / 2e-4); i <= n; ++i) {
    const double share = double(i) / n;
    run.update({scene.start.translation + share * (first.translation - scene.start.translation), scene.start.rotation.slerp(share, first.rotation)});
  }
  const double stiffness = scene.settings.stiffness.translational.x();
  const std::vector<HalfSpace> room = closed_in(scene.walls, scene.tool, centre.rotation, scene.settings.margin);
  double work = 0, largest = 0;
  Vector last_hand = first.translation, last_error = Vector::Zero();
  for (int i = 1; i <= 2 * steps; ++i) {
    const Pose<double> hand = on_ellipse(i);
    run.update(hand);
    check_sums(run, finding);
    if (i < steps) continue;
    const WideVector point = hand.translation.template cast<Wide>();
    const Vector expected = stiffness * (Projection(room, point).point() - point).template cast<double>();
    const Vector error = scene.placed.rotation.conjugate() * run.tick().wrench.force - expected;
    if (i > steps) work += (error + last_error).dot(hand.translation - last_hand) / 2;
    last_hand = hand.translation, last_error = error;
    largest = std::max(largest, run.tick().wrench.force.norm());
  }
  if (!(work <= scene.settings.margin * largest))
    finding.complain("energy", run.ticks(), "the hand gains %.3g J a lap, a margin's way at the largest force is %.3g J", work,
                     scene.settings.margin * largest);
  finding.ticks = run.ticks();
  return finding;
}

}  // namespace feeler::laws
