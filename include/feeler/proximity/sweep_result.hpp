// What a sweep finds: the part of a motion that is free, the triangles that block the rest, and those near where it ends.
#pragma once

#include <algorithm>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/motion.hpp"

namespace feeler {

/// A triangle that blocks a motion, and the time up to which it certainly does not.
template <class Scalar>
struct Blocker {
  int triangle = -1;
  Scalar time = Scalar(0);
  int piece = 0;  ///< of the tool
  WitnessFeatures features = {};  ///< on which the last query ended
};

/// A triangle near a tool that was not known.
struct Noticed {
  int triangle = -1;
  int piece = 0;  ///< of the tool
  WitnessFeatures features = {};  ///< on which its query ended
};

/// What was not known near a tool: some of it where it is much.
struct NoticedTriangles : FixedVector<Noticed, 24> {
  bool is_exhausted = false;  ///< the work limit was reached before all was looked at
};

/// Result of a sweep: the motion is free of collision on [0, time]. That is less than the whole where something blocks, or the work ran low.
template <class Scalar>
struct SweepResult {
  static constexpr int blocker_capacity = 24;

  Scalar time = Scalar(1);
  FixedVector<Blocker<Scalar>, blocker_capacity> blockers;
  bool is_exhausted = false;  ///< the work limit was reached: nothing is certified yet, time is 0; the blockers found so far are real

  bool is_whole() const noexcept { return blockers.empty() && time >= Scalar(1); }
  /// Whether as many as there is room for block the motion where it starts: whatever else does, it comes to nothing.
  bool is_over() const noexcept { return blockers.full() && !(time > Scalar(0)); }
  /// Adds a blocker; where there are too many the earliest are kept.
  void add(const Blocker<Scalar>& blocker) noexcept {
    if (blockers.push_back(blocker)) return;
    auto* const last = latest_of(blockers);
    if (blocker.time < last->time) *last = blocker;
  }
  const Blocker<Scalar>* latest() const noexcept { return latest_of(blockers); }

 private:
  template <class Blockers>
  static auto latest_of(Blockers& blockers) noexcept {
    return std::max_element(blockers.begin(), blockers.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  }
};

/// The time up to which a blocked motion is still examined: a little past its first blocker, to learn those just behind it, and because times are
/// known to a resolution only. If the list of blockers is full, it is the time of the last of them.
template <ConvexTool Tool>
typename Tool::Scalar worth_certifying(const SweepResult<typename Tool::Scalar>& result, const Clearance<typename Tool::Scalar>& clearance,
                                       const MovingTool<Tool>& moving) noexcept {
  using Scalar = typename Tool::Scalar;
  if (result.blockers.full()) return result.latest()->time;
  return (std::min)(Scalar(1), (std::max)(result.time + Scalar(1) / 32, clearance.probe / moving.length()));
}

}  // namespace feeler
