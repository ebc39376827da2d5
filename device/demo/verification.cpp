// The checker over a run, within a budget of time.
#include "verification.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "support/penetration_checker.hpp"

namespace feeler::demo {
namespace {

/// Places that are looked at between two poses of a way; its poses come on top.
constexpr int places_between = 3;

test::CheckedTool checked_tool_of(const scenes::Scene& scene) {
  return std::visit([](const auto& tool) { return test::checked_tool(tool); }, scene.tool);
}

/// Checks one tick after the other and keeps the deepest of each kind.
class RunChecker {
 public:
  RunChecker(const scenes::Scene& scene, const Recording& recording)
      : object_(scene.vertices, scene.triangles), tool_(checked_tool_of(scene)), recording_(recording) {}

  void check(std::size_t tick, Verification& result) const {
    ++result.checked_ticks;
    const double pose_depth = depth(test::checked_pose(recording_.ticks[tick].graphic), result);
    if (pose_depth > result.pose_depth) {
      result.pose_depth = pose_depth;
      result.pose_tick = tick;
    }
    const std::vector<Pose<double>>& way = recording_.way;
    const std::size_t begin = recording_.way_begin(tick), end = recording_.ticks[tick].way_end;
    // Its first pose is the graphic pose of the tick before, and its last one has just been judged.
    double deepest = tick == 0 ? depth(test::checked_pose(way[0]), result) : 0.0;
    for (std::size_t i = begin + 1; i < end; ++i) {
      deepest = std::max(deepest, depth_between(way[i - 1], way[i], result));
      if (i + 1 < end) deepest = std::max(deepest, depth(test::checked_pose(way[i]), result));
    }
    if (deepest > result.way_depth) {
      result.way_depth = deepest;
      result.way_tick = tick;
    }
  }

 private:
  double depth(const test::CheckedPose& pose, Verification& result) const {
    ++result.checked_places;
    return double(test::deepest_penetration(object_, tool_, pose).depth);
  }

  double depth_between(const Pose<double>& from, const Pose<double>& to, Verification& result) const {
    double deepest = 0.0;
    if (from == to) return deepest;
    const auto pose0 = test::checked_pose(from), pose1 = test::checked_pose(to);
    for (int i = 1; i <= places_between; ++i) {
      const auto between = test::pose_on_path(pose0, pose1, test::WideReal(i) / (places_between + 1));
      deepest = std::max(deepest, depth(between, result));
    }
    return deepest;
  }

  test::CheckedObject object_;
  test::CheckedTool tool_;
  const Recording& recording_;
};

}  // namespace

Verification verify(const scenes::Scene& scene, const Recording& recording, double budget_seconds) {
  using Clock = std::chrono::steady_clock;
  Verification result;
  const std::size_t ticks = recording.ticks.size();
  if (ticks == 0) return result;
  const RunChecker checker(scene, recording);

  // The cost of a tick depends on how much of the object is near the tool: try some of the whole run.
  constexpr std::size_t trials = 40;
  Verification trial;
  const auto start = Clock::now();
  for (std::size_t i = 0; i < trials; ++i) checker.check(i * (ticks - 1) / trials, trial);
  const double seconds_a_tick = std::chrono::duration<double>(Clock::now() - start).count() / double(trials);
  const double total = seconds_a_tick * double(ticks);
  result.stride = std::size_t(std::max(1.0, std::ceil(total / budget_seconds)));

  for (std::size_t tick = 0; tick < ticks; tick += result.stride) checker.check(tick, result);
  return result;
}

}  // namespace feeler::demo
