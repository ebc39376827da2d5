// The certificate of a whole motion: every triangle of the object passed for certain, or the ones that block.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <Eigen/Core>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/coarse_planes.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/passage.hpp"
#include "feeler/proximity/plane_cache.hpp"
#include "feeler/proximity/traversal_order.hpp"
#include "feeler/proximity/unpassed_triangles.hpp"

namespace feeler {

/// A triangle that the sweep examines first, with what is known of it from before.
template <class Scalar>
struct KnownTriangle {
  int triangle = -1;
  PassedTriangle<Scalar> state;
};

/// A triangle that blocks a motion, and the time up to which it certainly does not.
template <class Scalar>
struct Blocker {
  int triangle = -1;
  Scalar time = Scalar(0);
  int piece = 0;  ///< of the tool
  WitnessFeatures features = {};  ///< on which the last query ended
};

/// A triangle that a sweep was not told of and that is near where the motion ends.
struct Noticed {
  int triangle = -1;
  int piece = 0;  ///< of the tool
  WitnessFeatures features = {};  ///< on which the last query ended
};

/// Result of a sweep: the motion is free of collision on [0, time]. That is less than the whole where something blocks, or the work ran low.
template <class Scalar>
struct SweepResult {
  static constexpr int blocker_capacity = 24;

  Scalar time = Scalar(1);
  FixedVector<Blocker<Scalar>, blocker_capacity> blockers;
  FixedVector<Noticed, blocker_capacity> noticed;  ///< nearer than `Clearance::noticed` at the end of a motion that nothing blocks; some of them where they are many
  bool is_exhausted = false;  ///< the work limit was reached: nothing is certified, time is 0; the blockers found so far are real

  bool is_whole() const noexcept { return blockers.empty() && time >= Scalar(1); }
  /// Adds a blocker; where there are too many the earliest are kept.
  void add(const Blocker<Scalar>& blocker) noexcept {
    if (blockers.push_back(blocker)) return;
    auto latest = std::max_element(blockers.begin(), blockers.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    if (blocker.time < latest->time) *latest = blocker;
  }
};

/// How far a motion that is blocked at a time should be looked at further: past its first blocker, to know the ones just behind it, and those that are
/// as early but for how exactly times are known.
template <ConvexTool Tool>
typename Tool::Scalar worth_certifying(typename Tool::Scalar blocked, const Clearance<typename Tool::Scalar>& clearance,
                                       const MovingTool<Tool>& moving) noexcept {
  using Scalar = typename Tool::Scalar;
  return (std::min)(Scalar(1), (std::max)(blocked + Scalar(1) / 32, clearance.probe / moving.length()));
}

/// Certifies motions of a tool against a triangle mesh with one traversal of its bounding volume hierarchy.
///
/// A box or a triangle passes if one cached plane holds over the whole motion (`PlaneCache`); a triangle that no plane passes is measured
/// (`pass`), which gives a new plane or a blocker. After a blocker the motion is shortened for the rest, though not to the
/// blocker itself: the ones just behind it are better known at once. Where the work runs low it is shortened too, and the planes known pass
/// most of what is left.
/// @tparam Order  in which boxes and triangles are visited: `NearestFirst` or `InBatches`
template <ConvexTool Tool, class Order = NearestFirst>
class Sweep {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;

  Sweep(PlaneCache<Scalar>& planes, const Clearance<Scalar>& clearance) noexcept
      : planes_(planes), clearance_(clearance) {}

  /// @param known   triangles to examine first, exactly; the traversal skips them
  /// @param work    grows by the work done
  /// @param limit   value of `work` at which the sweep gives up
  /// @param until   time up to which the motion is of interest: only [0, until] is certified
  /// @param first_blocked  time at which something else blocks the motion: what does not before that is not looked for exactly
  template <class MeshScalar>
  SweepResult<Scalar> certify(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving,
                              std::span<const KnownTriangle<Scalar>> known, int& work, int limit, Scalar until = Scalar(1),
                              Scalar first_blocked = std::numeric_limits<Scalar>::infinity()) noexcept {
    SweepResult<Scalar> result;
    result.time = until;
    known_ = known;
    first_blocked_ = first_blocked;
    begin(mesh, moving, until);
    for (const KnownTriangle<Scalar>& pair : known) {
      if (passes(pair.state.corners, moving, true)) continue;
      examine(pair.triangle, pair.state, moving, result, work);
      if (work > limit) return give_up(result);
    }
    std::uint64_t marks = 0;  // a bit for every 64th triangle: most are told from the known by it
    const auto mark_of = [](int triangle) { return std::uint64_t(1) << (unsigned(triangle) % 64U); };
    for (const KnownTriangle<Scalar>& pair : known) marks |= mark_of(pair.triangle);
    const auto is_known = [&](int triangle) { return (marks & mark_of(triangle)) != 0 && is_among(triangle, known); };
    const auto look_at = [&](int triangle, const Matrix3<Scalar>& corners) {
      examine(triangle, {corners, Vector::Zero(), planes_.features().recall_or_guess(triangle), false}, moving, result, work);
      return true;
    };
    int low = limit - (limit - work) / 8;
    const auto may_go_on = [&] {
      if (work <= low) return true;
      if (work > limit) return false;
      low = limit - (limit - low) / 2;
      result.time = (std::min)(result.time, end_.time / 4);  // with a shorter motion
      set_end(moving, end_.time / 4);
      return true;
    };
    const bool is_done = traverse(mesh, moving, work, is_known, look_at, may_go_on);
    count_hits();
    return is_done ? result : give_up(result);
  }

  /// Whether single planes part the tool over the whole motion from every triangle. They are looked for at its start alone: false may mean
  /// that there are some.
  /// @param work, limit  as in `certify`
  template <class MeshScalar>
  bool parts(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit) noexcept {
    begin(mesh, moving, Scalar(1));
    const auto is_parted = [&](int, const Matrix3<Scalar>& corners) {
      ++work;
      const auto closest = gjk(moving.tool(), moving.in_tool(corners, start_), {}, clearance_.touching);
      if (closest.is_touching) return false;
      add_plane(start_.rotation * closest.normal, moving);
      return passes(corners, moving, false);
    };
    const bool is_done = traverse(mesh, moving, work, [](int) { return false; }, is_parted, [&] { return work <= limit; });
    count_hits();
    return is_done;
  }

 private:
  using Frame = MotionFrame<Scalar>;

  template <class MeshScalar>
  void begin(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, Scalar until) noexcept {
    start_ = moving.frame_at_start();
    coarse_.begin(moving.origin() - mesh.bvh().origin().template cast<Scalar>(), Scalar(mesh.bounds().diagonal().norm()));
    planes_.age();
    planes_.with_tool().age();
    planes_.begin(moving, start_);
    set_end(moving, until);
  }

  /// Calls `visit(triangle, its corners relative to the motion's origin)` for every triangle not `is_known` that no cached plane passes, and
  /// `may_go_on()` between, until one call is false; true when it came to the end.
  template <class MeshScalar, class IsKnown, class Visit, class MayGoOn>
  [[gnu::flatten, gnu::noinline]]
  bool traverse(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, const IsKnown& is_known, const Visit& visit,
                const MayGoOn& may_go_on) noexcept {
    const auto look_at = [&](int triangle) {
      if (is_known(triangle)) return true;
      const Matrix3<Scalar> corners = mesh.corners(triangle).template cast<Scalar>().colwise() - moving.origin();
      return passes(corners, moving, false) || visit(triangle, corners);
    };
    const auto plane_count = [this] { return planes_.size(); };
    return visit_unpassed(mesh.bvh(), coarse_, plane_count, Order(moving.motion().linear.template cast<float>()), work, look_at, may_go_on);
  }

  static SweepResult<Scalar> give_up(SweepResult<Scalar>& result) noexcept {
    result.time = Scalar(0);
    result.is_exhausted = true;
    return result;
  }

  static bool is_among(int triangle, std::span<const KnownTriangle<Scalar>> known) noexcept {
    return std::any_of(known.begin(), known.end(), [triangle](const auto& k) { return k.triangle == triangle; });
  }

  [[gnu::flatten, gnu::noinline]]
  void examine(int triangle, const PassedTriangle<Scalar>& state, const MovingTool<Tool>& moving, SweepResult<Scalar>& result,
               int& work) noexcept {
    if (!state.is_exact && is_behind_known(state.corners, moving, work)) return;
    const Passage<Scalar> passage = pass(moving, state, start_, end_, clearance_, work, first_blocked_);
    if (!passage.is_blocked) {
      if (!state.is_exact && passage.slack < clearance_.noticed) result.noticed.push_back({triangle, 0, passage.features});
      if (passage.normal.squaredNorm() > Scalar(0) && !state.is_exact) {
        add_plane(passage.normal, moving);
        if (passage.turns) planes_.with_tool().add(end_.rotation.transpose() * passage.normal, moving, start_, end_, clearance_.kept, clearance_.noticed);
        planes_.features().remember(triangle, passage.features);
      }
      return;
    }
    // Beside a wall that the tool slides along there may be a way that leads nowhere near it in any other direction.
    if (state.is_exact && is_behind_known(state.corners, moving, work)) return;
    result.add({triangle, passage.time, 0, passage.features});
    first_blocked_ = (std::min)(first_blocked_, passage.time);
    result.time = (std::min)(result.time, passage.time);
    const Scalar end = worth_certifying(result.time, clearance_, moving);
    if (end < end_.time) set_end(moving, end);
  }

  /// Whether a triangle lies in or behind the plane that parts a known one from the tool: then it is no nearer than that one, as seen along the
  /// normal. Of a wall that is cut into many triangles a few so tell all.
  [[gnu::flatten, gnu::noinline]]
  bool is_behind_known(const Matrix3<Scalar>& corners, const MovingTool<Tool>& moving, int& work) noexcept {
    constexpr int triangles_per_work = 4;
    hidden_ = (hidden_ + 1) % triangles_per_work;
    if (hidden_ == 0) ++work;
    const Scalar flat = clearance_.noticed / 1000;
    for (const KnownTriangle<Scalar>& wall : known_) {
      PlaneOnMotion<Scalar> plane{wall.state.normal};
      const Scalar height = highest_corner(corners, plane.normal);
      if (!(height <= highest_corner(wall.state.corners, plane.normal) + flat) || plane.normal.isZero(Scalar(0))) continue;
      plane.begin(moving, start_);
      plane.end(moving, end_);
      if (plane.parts_closely(height, clearance_)) return true;
    }
    return false;
  }

  /// From here on only [0, time] is certified.
  [[gnu::flatten, gnu::noinline]]
  void set_end(const MovingTool<Tool>& moving, Scalar time) noexcept {
    end_ = moving.frame_at(time);
    planes_.end(moving, end_, clearance_.kept, clearance_.noticed);
    planes_.with_tool().set_motion(moving, start_, end_, clearance_.kept, clearance_.noticed);
    const Scalar around = (std::max)(clearance_.kept, clearance_.noticed);
    for (int k = 0; k < 3; ++k) coarse_.set_sides(k, planes_.box().lower(k) - around, planes_.box().upper(k) + around);
    for (int i = 0; i < planes_.size(); ++i) coarse_.set_plane(i, planes_.normal(i), planes_.limit(i));
  }

  [[gnu::flatten, gnu::noinline]]
  void add_plane(const Vector& normal, const MovingTool<Tool>& moving) noexcept {
    count_hits();
    const int i = planes_.add(normal, moving, start_, end_, clearance_.kept, clearance_.noticed);
    coarse_.set_plane(i, normal, planes_.limit(i));
  }

  void count_hits() noexcept {
    coarse_.take_hits(planes_.size(), [this](int i, int hits) { planes_.count_hits(i, hits); });
  }

  [[gnu::flatten, gnu::noinline]]
  bool passes(const Matrix3<Scalar>& corners, const MovingTool<Tool>& moving, bool is_known) noexcept {
    if (last_ < planes_.size() && passes(corners, last_, is_known)) return true;
    const int turning = planes_.with_tool().parting(corners);
    if (turning >= 0) {
      if (planes_.with_tool().lend(turning)) add_plane(planes_.with_tool().normal_at_end(turning), moving);
      return true;
    }
    for (int i = 0; i < planes_.size(); ++i) {
      if (i == last_ || !passes(corners, i, is_known)) continue;
      last_ = i;
      return true;
    }
    return false;
  }

  /// Whether one plane passes a triangle; one that is known may be nearer than what is noticed.
  bool passes(const Matrix3<Scalar>& corners, int i, bool is_known) noexcept {
    const Scalar height = highest_corner(corners, planes_.normal(i));
    if (!(height <= planes_.limit(i) || ((is_known || !(clearance_.noticed > Scalar(0))) && planes_.parts_closely(i, height, clearance_)))) return false;
    planes_.count_hits(i, 1);
    return true;
  }

  PlaneCache<Scalar>& planes_;
  Clearance<Scalar> clearance_;
  std::span<const KnownTriangle<Scalar>> known_;
  Scalar first_blocked_ = std::numeric_limits<Scalar>::infinity();  // time of the first blocker so far
  Frame start_;
  Frame end_;
  int hidden_ = 0;  // triangles looked at whether a known wall hides them, since the work last grew for it
  int last_ = 0;  // of the planes to pass a triangle: its neighbours come next
  CoarsePlanes<Scalar, PlaneCache<Scalar>::capacity> coarse_;
};

}  // namespace feeler
