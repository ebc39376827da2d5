// What the independent checker says about a run: it shares no code with the library.
#pragma once

#include <cstddef>

#include "recording.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// The deepest penetration found, and how much was looked at.
struct Verification {
  /// A place counts as free up to this depth [m]: what the certificate allows for rounding, once.
  static constexpr double tolerance = 1e-11;

  double pose_depth = 0.0;    ///< deepest at a graphic pose [m]
  std::size_t pose_tick = 0;  ///< where that was
  double way_depth = 0.0;     ///< deepest on the certified way to a graphic pose [m]
  std::size_t way_tick = 0;   ///< the tick at the end of that way
  std::size_t checked_ticks = 0;
  std::size_t checked_places = 0;  ///< poses and places on the ways
  std::size_t stride = 1;          ///< every how manieth tick was checked

  bool penetrated() const { return pose_depth > tolerance || way_depth > tolerance; }
};

/// Checks every triangle at the graphic poses and on the certified ways to them; where that would take longer
/// than the budget, at evenly spread ticks.
/// @param budget_seconds  about, on this thread
Verification verify(const scenes::Scene& scene, const Recording& recording, double budget_seconds);

}  // namespace feeler::demo
