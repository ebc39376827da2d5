// The checker over a run, within a budget of time.
#include "verification.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "support/penetration_checker.hpp"

namespace feeler::demo {
namespace {

test::CheckedTool checked_tool_of(const scenes::Scene& scene) {
  return std::visit([](const auto& tool) { return test::checked_tool(tool); }, scene.tool);
}

/// Checks one tick after the other and keeps the deepest of each kind.
class RunChecker {
 public:
  RunChecker(const scenes::Scene& scene, const std::vector<TickRecord>& ticks)
      : object_(scene.vertices, scene.triangles), tool_(checked_tool_of(scene)), ticks_(ticks) {}

  void check(std::size_t tick, Verification& result) const {
    const auto here = test::checked_pose(ticks_[tick].graphic);
    const double pose_depth = double(test::deepest_penetration(object_, tool_, here).depth);
    ++result.checked_poses;
    if (pose_depth > result.pose_depth) {
      result.pose_depth = pose_depth;
      result.pose_tick = tick;
    }
    if (tick == 0) return;
    const auto before = test::checked_pose(ticks_[tick - 1].graphic);
    ++result.checked_ways;
    double deepest = 0.0;
    for (int i = 1; i <= result.samples; ++i) {
      const auto between = test::pose_on_path(before, here, test::WideReal(i) / (result.samples + 1));
      deepest = std::max(deepest, double(test::deepest_penetration(object_, tool_, between).depth));
    }
    if (deepest > result.path_depth) {
      result.path_depth = deepest;
      result.path_tick = tick;
    }
    if (deepest > Verification::tolerance + Verification::corner_share * motion(before, here))
      ++result.crossings;
  }

 private:
  /// Longest way of a vertex of the tool [m].
  double motion(const test::CheckedPose& before, const test::CheckedPose& here) const {
    double longest = 0.0;
    for (const test::WideVector& v : tool_.vertices) {
      const test::WideVector moved =
          here.translation + here.rotation * v - before.translation - before.rotation * v;
      longest = std::max(longest, double(moved.norm()));
    }
    return longest;
  }

  test::CheckedObject object_;
  test::CheckedTool tool_;
  const std::vector<TickRecord>& ticks_;
};

}  // namespace

bool is_free(const scenes::Scene& scene, const Pose<double>& pose) {
  const test::CheckedObject object(scene.vertices, scene.triangles);
  const auto found = test::deepest_penetration(object, checked_tool_of(scene), test::checked_pose(pose));
  return double(found.depth) <= Verification::tolerance;
}

Verification verify(const scenes::Scene& scene, const std::vector<TickRecord>& ticks, double budget_seconds) {
  using Clock = std::chrono::steady_clock;
  Verification result;
  if (ticks.empty()) return result;
  const RunChecker checker(scene, ticks);

  // The cost of a tick depends on how much of the object is near the tool: try some of the whole run.
  constexpr std::size_t trials = 40;
  Verification trial;
  const auto start = Clock::now();
  for (std::size_t i = 0; i < trials; ++i) checker.check(i * (ticks.size() - 1) / trials, trial);
  const double seconds_a_tick = std::chrono::duration<double>(Clock::now() - start).count() / double(trials);
  const double total = seconds_a_tick * double(ticks.size());
  result.stride = std::size_t(std::max(1.0, std::ceil(total / budget_seconds)));

  for (std::size_t tick = 0; tick < ticks.size(); tick += result.stride) checker.check(tick, result);
  return result;
}

}  // namespace feeler::demo
