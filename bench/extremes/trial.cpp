#include "extremes/trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <vector>

#include "study/checked_pieces.hpp"
#include "study/truth.hpp"
#include "times.hpp"

namespace feeler::extremes {
namespace {

using study::Wide;

bool is_finite(const study::Reading& reading) {
  return reading.pose.translation.allFinite() && reading.pose.rotation.coeffs().allFinite() && std::abs(reading.pose.rotation.norm() - 1) < 1e-5L &&
         reading.force.allFinite() && reading.torque.allFinite();
}

std::string text(const char* format, double a, double b) {
  char line[120];
  std::snprintf(line, sizeof line, format, a, b);
  return line;
}

/// What the last pose is off the nearest one that there is about it [m]; −1 where none is proved.
double distance_from_nearest(const StudyScene& scene, const study::Truth& truth, const Pose<double>& hand, const Pose<Wide>& pose, double margin) {
  if (scene.triangles.rows() > 100000) return -1;
  const auto nearest = truth.nearest(hand, pose.cast<double>(), margin, margin);
  if (!nearest) return -1;
  const Pose<Wide> there = study::wide(nearest->pose);
  return double((there.translation - pose.translation).norm() +
                Wide(truth.gaps().radius()) * there.rotation.angularDistance(pose.rotation.normalized()));
}

}  // namespace

Finding try_case(const Case& one, const std::string& rendering) {
  constexpr int most_ticks_held = 400;
  Finding finding;
  const StudyScene scene = one.make();
  std::unique_ptr<study::Player> player;
  try {
    player = study::rendering(rendering).make(scene, {.scene = one.name, .rendering = rendering, .margin = one.margin});
    if (const auto status = player->reset(scene.start); status != TickStatus::converged)
      finding.refusal = "reset: the tool overlaps the object where it starts";
  } catch (const std::exception& refusal) {
    finding.refusal = refusal.what();
  }
  if (!finding.refusal.empty()) {
    if (one.outcome == Outcome::rendered || one.outcome == Outcome::free) finding.fault = "refused: " + finding.refusal;
    return finding;
  }
  if (one.outcome == Outcome::refused) {
    finding.fault = "accepted";
    return finding;
  }
  const test::CheckedObject object(scene.vertices, scene.triangles);
  const auto pieces = study::checked_pieces(scene);
  const bool is_large = scene.triangles.rows() > 100000;
  std::vector<double> times;
  int converged = 0;
  study::Reading reading;
  const auto check = [&](int k) {
    times.push_back(reading.microseconds);
    converged += reading.status == TickStatus::converged;
    if (!is_finite(reading) && finding.fault.empty()) finding.fault = text("tick %g: an output is not finite", k, 0);
    if (is_large && k % 20 != 0) return;
    finding.deepest = std::max(finding.deepest, double(test::deepest_penetration(object, pieces, test::checked_pose(reading.pose)).depth));
  };
  for (int k = 1; k <= one.ticks; ++k) {
    reading = player->update(scene.motion(k * 1e-3));
    check(k);
  }
  // The last pose that is a pose.
  Pose<double> hand = scene.motion(one.ticks * 1e-3);
  for (int back = 1; !hand.is_finite(); ++back) hand = scene.motion((one.ticks - back) * 1e-3);
  for (int i = 0; i < most_ticks_held && !(reading.status == TickStatus::converged && reading.is_at_rest); ++i) {
    reading = player->update(hand);
    check(one.ticks + 1 + i);
  }
  finding.is_at_rest = reading.status == TickStatus::converged && reading.is_at_rest;
  finding.converged = double(converged) / double(times.size());
  finding.microseconds = bench::quantile(times, 0.5);
  const study::Truth truth(scene);
  finding.distance = one.off ? one.off(hand, reading.pose) : distance_from_nearest(scene, truth, hand, reading.pose, one.margin);
  if (!finding.fault.empty()) return finding;
  if (!(finding.deepest <= one.overlap_allowed)) finding.fault = text("%.2g m deep; %g m is allowed", finding.deepest, one.overlap_allowed);
  if (one.outcome == Outcome::free || (one.outcome == Outcome::either && !one.remark.empty())) return finding;
  if (!finding.is_at_rest && finding.fault.empty()) finding.fault = "never at rest";
  // In float a pose is rounded on the way out, and the margin follows that.
  const double reach = scene.vertices.cwiseAbs().maxCoeff() + truth.gaps().radius();
  const double allowed = one.distance_allowed + (rendering == "float" ? 40 * double(std::numeric_limits<float>::epsilon()) * reach : 0);
  if (finding.distance < 0 && finding.fault.empty()) finding.fault = "no nearest pose is proved";
  if (!(finding.distance <= allowed) && finding.fault.empty())
    finding.fault = text("%.2g m off the nearest pose; %g m is allowed", finding.distance, allowed);
  return finding;
}

}  // namespace feeler::extremes
