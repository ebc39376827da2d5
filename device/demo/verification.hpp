// What the independent checker says about a run: it shares no code with the library.
#pragma once

#include <cstddef>

#include "recording.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// The deepest penetration found, and how much was looked at.
struct Verification {
  /// A pose counts as free up to this depth [m]: ten times the allowance of a certified step, a tenth of a
  /// nanometre.
  static constexpr double tolerance = 1e-10;

  double pose_depth = 0.0;    ///< deepest at a graphic pose [m]
  std::size_t pose_tick = 0;  ///< where that was
  double path_depth = 0.0;    ///< deepest on the straight way from one graphic pose to the next [m]
  std::size_t path_tick = 0;  ///< the tick at the end of that way
  std::size_t crossings = 0;  ///< ways too deep to be a corner cut short
  std::size_t checked_poses = 0;
  std::size_t checked_ways = 0;  ///< each at `samples` places between its ends
  int samples = 3;
  std::size_t stride = 1;  ///< every how manieth tick was checked

  /// The tool goes around a corner in several certified steps a tick; the straight way cuts it short. It may
  /// be as deep as this share of the motion of the tool in that tick; deeper, the tool went through.
  static constexpr double corner_share = 0.25;

  bool penetrated() const { return pose_depth > tolerance || crossings > 0; }
};

/// Whether the checker finds the tool free at a pose, to the tolerance.
bool is_free(const scenes::Scene& scene, const Pose<double>& pose);

/// Checks every triangle at the graphic poses and between them; where that would take longer than the budget,
/// at evenly spread ticks.
/// @param budget_seconds  about, on this thread
Verification verify(const scenes::Scene& scene, const std::vector<TickRecord>& ticks, double budget_seconds);

}  // namespace feeler::demo
