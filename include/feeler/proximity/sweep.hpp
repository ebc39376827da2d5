// The certificate of a whole motion: every triangle of the object passed for certain, or the ones that block.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Core>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
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
#include "feeler/proximity/wall_planes.hpp"

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

/// How far a motion that is blocked should be looked at further: past its first blocker, to know the ones just behind it, and those that are as early but
/// for how exactly times are known; where there is no room for more blockers, to the last of them.
template <ConvexTool Tool>
typename Tool::Scalar worth_certifying(const SweepResult<typename Tool::Scalar>& result, const Clearance<typename Tool::Scalar>& clearance,
                                       const MovingTool<Tool>& moving) noexcept {
  using Scalar = typename Tool::Scalar;
  if (result.blockers.full()) return result.latest()->time;
  return (std::min)(Scalar(1), (std::max)(result.time + Scalar(1) / 32, clearance.probe / moving.length()));
}

/// Certifies motions of a tool against a triangle mesh with one traversal of its bounding volume hierarchy.
///
/// A box or a triangle passes if one cached plane holds over the whole motion (`PlaneCache`); a triangle that no plane passes is measured
/// (`pass`), which gives a new plane or a blocker. After a blocker the motion is shortened for the rest, though not to the
/// blocker itself: the ones just behind it are better known at once. Where the work runs out it stops, and goes on later where it was (`go_on`).
/// @tparam Order  in which boxes and triangles are visited: `NearestFirst` or `InBatches`
template <ConvexTool Tool, class Order = NearestFirst>
class Sweep {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;

  /// @param walls  remembered planes of the object's walls, if any
  /// @param piece    of the tool
  Sweep(PlaneCache<Scalar>& planes, const Clearance<Scalar>& clearance, WallPlanes<Scalar>* walls = nullptr, int piece = 0) noexcept
      : planes_(&planes), walls_(walls), clearance_(clearance), piece_(piece) {}

  /// Its owner has been copied: the caches are those of the copy from here on.
  void work_with(PlaneCache<Scalar>& planes, WallPlanes<Scalar>* walls) noexcept {
    planes_ = &planes;
    walls_ = walls;
  }

  /// @param known   triangles to examine first, exactly; the traversal skips them
  /// @param work    grows by the work done
  /// @param limit   value of `work` at which the sweep stops; some queries more at most
  /// @param until   time up to which the motion is of interest: only [0, until] is certified
  /// @param first_blocked  time at which something else blocks the motion: what does not before that is not looked for exactly
  template <class MeshScalar>
  SweepResult<Scalar> certify(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, std::span<const KnownTriangle<Scalar>> known,
                              int& work, int limit, Scalar until = Scalar(1),
                              Scalar first_blocked = std::numeric_limits<Scalar>::infinity()) noexcept {
    first_blocked_ = first_blocked;
    known_ = known;
    begin(mesh, moving, until);
    result_ = {};
    result_.time = until;
    next_known_ = 0;
    return run(mesh, moving, work, limit, false);
  }
  /// After `certify`, or this, was exhausted: the rest of it.
  /// @param mesh, moving, known  as there
  template <class MeshScalar>
  SweepResult<Scalar> go_on(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, std::span<const KnownTriangle<Scalar>> known,
                            int& work, int limit) noexcept {
    known_ = known;
    return run(mesh, moving, work, limit, true);
  }

  /// The triangles nearer than `Clearance::kept` to a tool that stands still, but for those known and those hidden behind the plane of one that is:
  /// what is no nearer than that one, as seen along its normal, holds the tool no better.
  /// @param known  each with a plane that parts it
  template <class MeshScalar>
  NoticedTriangles notice(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& standing, std::span<const KnownTriangle<Scalar>> known,
                          int& work, int limit) noexcept {
    known_ = known;
    may_be_near_ = false;
    begin(mesh, standing, Scalar(1));
    noticed_ = {};
    return go_on_noticing(mesh, standing, known, work, limit);
  }
  /// After `notice`, or this, was exhausted: the rest of it, with what came before.
  /// @param mesh, standing, known  as there
  template <class MeshScalar>
  NoticedTriangles go_on_noticing(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& standing,
                                  std::span<const KnownTriangle<Scalar>> known, int& work, int limit) noexcept {
    known_ = known;
    const auto look_at = [&](int triangle, const Matrix3<Scalar>& corners) {
      if (is_behind_known(corners, standing, work)) return true;
      ++work;
      const auto closest =
          gjk(standing.tool(), standing.in_tool(corners, start_), planes_->features().recall_or_guess(triangle), clearance_.touching);
      planes_->features().remember(triangle, closest.features);
      if (!closest.is_touching && closest.distance > clearance_.kept) {
        add_plane(start_.rotation * closest.normal, standing);
        return true;
      }
      // Of a wall one triangle tells as much as all that it is cut into.
      if (walls_ != nullptr) walls_->know(mesh, triangle, standing, start_);
      return noticed_.push_back({triangle, 0, closest.features});
    };
    const auto is_wall_parted = [&](int wall, bool) { return walls_->parts_wall(mesh, wall, standing, start_, end_, clearance_); };
    const bool is_done = traverse(mesh, standing, work, known_by_number(), is_wall_parted, look_at, [&] { return work < limit; });
    noticed_.is_exhausted = !is_done && !noticed_.full();
    count_hits();
    return noticed_;
  }

  /// Whether single planes part the tool over the whole motion from every triangle. They are looked for at its start alone: false may mean
  /// that there are some.
  /// @param work, limit  as in `certify`
  template <class MeshScalar>
  bool parts(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit) noexcept {
    known_ = {};
    begin(mesh, moving, Scalar(1));
    const auto is_parted = [&](int, const Matrix3<Scalar>& corners) {
      ++work;
      const auto closest = gjk(moving.tool(), moving.in_tool(corners, start_), {}, clearance_.touching);
      if (closest.is_touching) return false;
      add_plane(start_.rotation * closest.normal, moving);
      return passes(corners, moving);
    };
    const auto none_is_known = [](int) { return false; };
    const auto none_is_parted = [](int, bool) { return false; };
    const bool is_done = traverse(mesh, moving, work, none_is_known, none_is_parted, is_parted, [&] { return work < limit; });
    count_hits();
    return is_done;
  }

 private:
  using Frame = MotionFrame<Scalar>;

  /// A plane that parts a known triangle.
  struct KnownPlane {
    Vector normal;
    Scalar height;  // of that triangle, relative to the motion's origin [m]
  };

  /// @param is_again  the first triangle to be examined was so before, with less work: what comes of it now is made use of
  template <class MeshScalar>
  SweepResult<Scalar> run(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit, bool is_again) noexcept {
    for (; next_known_ < known_.size(); ++next_known_) {
      const KnownTriangle<Scalar>& pair = known_[next_known_];
      if (is_parted(mesh, pair.triangle, moving, work) || passes(pair.state.corners, moving)) continue;
      if (!examine(pair.triangle, pair.state, moving, work, limit, std::exchange(is_again, false))) return exhausted();
      if (result_.is_over()) return result_;
    }
    const auto is_known = known_by_number();
    const auto measure = [&](int triangle, const Matrix3<Scalar>& corners) {
      const PassedTriangle<Scalar> state{corners, Vector::Zero(), planes_->features().recall_or_guess(triangle), false};
      return examine(triangle, state, moving, work, limit, std::exchange(is_again, false));
    };
    // A tool meets the inside of a wall with the vertex that is lowest: what is below that tells when.
    const auto is_wall_parted = [&](int wall, bool is_inside) {
      Scalar parted = walls_->parts_wall_until(mesh, wall, moving, start_, end_, clearance_);
      if (parted >= end_.time) return true;
      if (parted < Scalar(0)) return false;
      if (work < limit && walls_->is_asked_first(mesh, wall, moving, start_)) {
        for (const Scalar& time : {parted, end_.time}) {
          const int triangle = walls_->triangle_below(mesh, wall, moving, start_, time);
          if (triangle < 0 || is_known(triangle)) continue;
          const int blockers = result_.blockers.size();
          if (!measure(triangle, mesh.corners(triangle).template cast<Scalar>().colwise() - moving.origin())) break;
          if (result_.blockers.size() == blockers) continue;
          walls_->meet(wall);
          parted = walls_->parts_wall_until(mesh, wall, moving, start_, end_, clearance_);
          if (parted >= end_.time) return true;
          break;
        }
      }
      if (!is_inside || !walls_->has_met(wall)) return false;
      result_.time = (std::min)(result_.time, parted);
      return true;
    };
    const auto look_at = [&](int triangle, const Matrix3<Scalar>& corners) {
      const int wall = walls_ != nullptr ? mesh.walls().of_triangle(triangle) : Walls<MeshScalar>::none;
      const auto& vertices = mesh.triangle(triangle);
      const auto is_inside = [&mesh](int vertex) { return mesh.walls().is_inside(vertex); };
      return (wall >= 0 && is_wall_parted(wall, std::all_of(vertices.begin(), vertices.end(), is_inside))) || measure(triangle, corners);
    };
    const auto may_go_on = [&] { return work < limit && !result_.is_over(); };
    const bool is_done = traverse(mesh, moving, work, is_known, is_wall_parted, look_at, may_go_on);
    count_hits();
    return is_done || result_.is_over() ? result_ : exhausted();
  }

  template <class MeshScalar>
  void begin(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, Scalar until) noexcept {
    start_ = moving.frame_at_start();
    place_.emplace(Order(moving.motion().linear.template cast<float>()));
    coarse_.begin(moving.origin() - mesh.bvh().origin().template cast<Scalar>(), Scalar(mesh.bounds().diagonal().norm()));
    planes_->age();
    planes_->with_tool().age();
    planes_->begin(moving, start_);
    evaluations_ += planes_->leaves().begin(moving, clearance_.kept) / 4;
    noted_leaf_ = -1;
    if (!may_be_near_) find_known_planes(moving);
    if (walls_ != nullptr) {
      walls_->begin(mesh, piece_, moving, start_, may_be_near_);
      for (const KnownTriangle<Scalar>& pair : known_) walls_->know(mesh, pair.triangle, moving, start_);
    }
    set_end(moving, until);
  }

  /// Calls `visit(triangle, its corners relative to the motion's origin)` for every triangle not `is_known` that no cached plane passes, and
  /// `may_go_on()` between, until one call is false; true when it came to the end. It goes on where it was.
  template <class MeshScalar, class IsKnown, class IsWallParted, class Visit, class MayGoOn>
  FEELER_FLATTEN bool traverse(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, const IsKnown& is_known,
                               const IsWallParted& is_wall_parted, const Visit& visit, const MayGoOn& may_go_on) noexcept {
    const auto look_at = [&](std::int32_t leaf, std::size_t lane) {
      if (leaf == noted_leaf_ ? has_passed(lane) : planes_->leaves().is_parted(leaf, lane)) return true;
      const int triangle = mesh.bvh().leaves()[std::size_t(leaf)].triangle[lane];
      if (is_known(triangle)) return true;
      if (!planes_->leaves().is_kept()) {
        if (is_parted(mesh, triangle, moving, work)) return true;
      } else if (leaf != noted_leaf_) {
        note_planes(mesh, leaf, lane, moving, work);
        if (has_passed(lane)) return true;
      }
      const Matrix3<Scalar> corners = corners_of(mesh, triangle, moving);
      return passes(corners, moving) || visit(triangle, corners);
    };
    const auto plane_count = [this] { return known_planes_.size() + planes_->size(); };
    const auto sift = [&](int node, auto& passed) {
      if (walls_ != nullptr && mesh.walls().count() > 0) {
        const auto& walls = mesh.walls().under(node);
        for (std::size_t i = 0; i < passed.size(); ++i) {
          if (passed[i] == 0 && walls[i] >= 0 && is_wall_parted(walls[i], mesh.walls().is_inside(node, i))) passed[i] = -1;
        }
        count_evaluations(work);
      }
      for (std::size_t i = 0; i < passed.size() && !planes_->leaves().empty(); ++i) {
        const std::int32_t child = mesh.bvh().nodes()[std::size_t(node)].child[i];
        if (passed[i] != 0 || child == 0) continue;
        const auto under = mesh.bvh().leaves_under(child);
        if (planes_->leaves().are_parted(under[0], under[1])) passed[i] = -1;
      }
    };
    return visit_unpassed(mesh.bvh(), coarse_, plane_count, *place_, work, sift, look_at, may_go_on);
  }

  /// Planes that part the tool from the triangles of a leaf, all of them: the leaf that has one for each need not be visited again.
  /// @param unparted  a lane that the front was asked for
  template <class MeshScalar>
  void note_planes(const TriangleMesh<MeshScalar>& mesh, std::int32_t leaf, std::size_t unparted, const MovingTool<Tool>& moving,
                   int& work) noexcept {
    auto& front = planes_->leaves();
    const auto& triangles = mesh.bvh().leaves()[std::size_t(leaf)].triangle;
    unsigned there = 0;
    for (std::size_t i = 0; i < BvhLeaf::width; ++i) there |= unsigned(triangles[i] >= 0) << i;
    noted_leaf_ = leaf;
    passed_lanes_ = 0;
    const auto note = [&](std::size_t lane, const Vector& normal, const Scalar& room) {
      if (room > clearance_.kept) front.note(leaf, there, lane, normal, room);
      passed_lanes_ |= 1U << lane;
    };
    for (std::size_t i = 0; i < BvhLeaf::width; ++i) {
      if (triangles[i] < 0) continue;
      if (i != unparted && front.is_parted(leaf, i)) {
        passed_lanes_ |= 1U << i;
        continue;
      }
      if (is_parted(mesh, triangles[i], moving, work)) {
        note(i, walls_->parting_normal(), walls_->parting_room());
        continue;
      }
      const Matrix3<Scalar> corners = corners_of(mesh, triangles[i], moving);
      if (!passes(corners, moving)) continue;
      if (last_ < planes_->size()) note(i, planes_->normal(last_), planes_->height(last_) - highest_corner(corners, planes_->normal(last_)));
      else passed_lanes_ |= 1U << i;
    }
  }
  /// Whether a triangle of the leaf whose planes were noted last was passed.
  bool has_passed(std::size_t lane) const noexcept { return (passed_lanes_ >> lane & 1U) != 0; }
  template <class MeshScalar>
  static Matrix3<Scalar> corners_of(const TriangleMesh<MeshScalar>& mesh, int triangle, const MovingTool<Tool>& moving) noexcept {
    return mesh.corners(triangle).template cast<Scalar>().colwise() - moving.origin();
  }

  /// Whether a remembered plane parts the tool from a triangle.
  template <class MeshScalar>
  bool is_parted(const TriangleMesh<MeshScalar>& mesh, int triangle, const MovingTool<Tool>& moving, int& work) noexcept {
    if (walls_ == nullptr) return false;
    const bool is_parted = walls_->parts_triangle(mesh, triangle, moving, start_, end_, clearance_);
    count_evaluations(work);
    return is_parted;
  }
  void count_evaluations(int& work) noexcept {
    constexpr int evaluations_per_work = 16;
    evaluations_ += walls_->take_evaluations();
    work += evaluations_ / evaluations_per_work;
    evaluations_ %= evaluations_per_work;
  }

  /// The result so far.
  SweepResult<Scalar> exhausted() const noexcept {
    SweepResult<Scalar> result = result_;
    result.time = Scalar(0);
    result.is_exhausted = true;
    return result;
  }

  /// Tells whether a triangle is known.
  auto known_by_number() const noexcept {
    const auto mark_of = [](int triangle) { return std::uint64_t(1) << (unsigned(triangle) % 64U); };
    std::uint64_t marks = 0;  // a bit for every 64th triangle: most are told from the known by it
    for (const KnownTriangle<Scalar>& pair : known_) marks |= mark_of(pair.triangle);
    return [this, marks, mark_of](int triangle) {
      return (marks & mark_of(triangle)) != 0 &&
             std::any_of(known_.begin(), known_.end(), [triangle](const auto& pair) { return pair.triangle == triangle; });
    };
  }

  /// Measures a triangle; false where the work ran out before it was known how far the motion is free, and nothing came of it.
  /// @param must_do  then too what is known is made use of
  FEELER_FLATTEN bool examine(int triangle, const PassedTriangle<Scalar>& state, const MovingTool<Tool>& moving, int& work, int limit,
                              bool must_do) noexcept {
    if (work >= limit) return false;
    if (!state.is_exact && is_behind_known(state.corners, moving, work)) return true;
    const Passage<Scalar> passage = pass(moving, state, start_, end_, clearance_, work, first_blocked_, limit);
    if (!passage.is_blocked) {
      if (passage.normal.squaredNorm() > Scalar(0) && !state.is_exact) {
        add_plane(passage.normal, moving);
        if (passage.turns) planes_->with_tool().add(end_.rotation.transpose() * passage.normal, moving, start_, end_, clearance_.kept);
        planes_->features().remember(triangle, passage.features);
      }
      return true;
    }
    // Beside a wall that the tool slides along there may be a way that leads nowhere near it in any other direction.
    if (state.is_exact && is_behind_known(state.corners, moving, work)) return true;
    if (passage.is_cut && !must_do) return false;
    result_.add({triangle, passage.time, 0, passage.features});
    first_blocked_ = (std::min)(first_blocked_, passage.time);
    result_.time = (std::min)(result_.time, passage.time);
    if (result_.blockers.full() && result_.latest()->time * moving.length() < clearance_.resolution) result_.time = Scalar(0);
    const Scalar end = worth_certifying(result_, clearance_, moving);
    if (end < end_.time) set_end(moving, end);
    return true;
  }

  /// Whether a triangle lies in or behind the plane that parts a known one from the tool: then it is no nearer than that one, as seen along the
  /// normal. Of a wall that is cut into many triangles a few so tell all.
  FEELER_FLATTEN bool is_behind_known(const Matrix3<Scalar>& corners, const MovingTool<Tool>& moving, int& work) noexcept {
    constexpr int triangles_per_work = 4;
    hidden_ = (hidden_ + 1) % triangles_per_work;
    if (hidden_ == 0) ++work;
    for (const KnownTriangle<Scalar>& wall : known_) {
      PlaneOnMotion<Scalar> plane{wall.state.normal};
      const Scalar height = highest_corner(corners, plane.normal);
      if (!(height <= highest_corner(wall.state.corners, plane.normal) + flat()) || plane.normal.isZero(Scalar(0))) continue;
      plane.begin(moving, start_);
      plane.end(moving, end_);
      if (plane.parts_closely(height, clearance_)) return true;
    }
    return false;
  }

  /// From here on only [0, time] is certified.
  FEELER_FLATTEN void set_end(const MovingTool<Tool>& moving, Scalar time) noexcept {
    end_ = moving.frame_at(time);
    planes_->end(moving, end_, clearance_.kept);
    planes_->with_tool().set_motion(moving, start_, end_, clearance_.kept);
    if (walls_ != nullptr) walls_->end(end_);
    const Scalar kept = clearance_.kept;
    for (int k = 0; k < 3; ++k) coarse_.set_sides(k, planes_->box().lower(k) - kept, planes_->box().upper(k) + kept);
    for (int i = 0; i < known_planes_.size(); ++i) coarse_.set_plane(i, known_planes_[i].normal, known_planes_[i].height);
    for (int i = 0; i < planes_->size(); ++i) coarse_.set_plane(known_planes_.size() + i, planes_->normal(i), planes_->limit(i));
  }

  FEELER_FLATTEN void add_plane(const Vector& normal, const MovingTool<Tool>& moving) noexcept {
    count_hits();
    const int i = planes_->add(normal, moving, start_, end_, clearance_.kept);
    coarse_.set_plane(known_planes_.size() + i, normal, planes_->limit(i));
  }

  /// The planes that part the tool from known triangles near it: what lies behind one is hidden, box by box.
  void find_known_planes(const MovingTool<Tool>& standing) noexcept {
    known_planes_.clear();
    for (const KnownTriangle<Scalar>& known : known_) {
      if (known_planes_.full()) break;
      const Vector& normal = known.state.normal;
      const auto is_alike = [&](const KnownPlane& other) { return other.normal.dot(normal) > Scalar(1) - Scalar(1e-12); };
      if (normal.isZero(Scalar(0)) || std::any_of(known_planes_.begin(), known_planes_.end(), is_alike)) continue;
      const Scalar height = highest_corner(known.state.corners, normal) + flat(), slack = standing.lowest(normal, start_) - height;
      if (slack > -2 * clearance_.allowance && slack < 2 * clearance_.kept) known_planes_.push_back({normal, height});
    }
  }
  /// By how much a triangle may rise from a plane and lie in it still [m].
  Scalar flat() const noexcept { return clearance_.kept / 1000; }

  void count_hits() noexcept {
    coarse_.take_hits(known_planes_.size() + planes_->size(), [this](int i, int hits) {
      if (i >= known_planes_.size()) planes_->count_hits(i - known_planes_.size(), hits);
    });
  }

  FEELER_FLATTEN bool passes(const Matrix3<Scalar>& corners, const MovingTool<Tool>& moving) noexcept {
    if (last_ < planes_->size() && passes(corners, last_)) return true;
    const int turning = planes_->with_tool().parting(corners);
    if (turning >= 0) {
      if (planes_->with_tool().lend(turning)) add_plane(planes_->with_tool().normal_at_end(turning), moving);
      return true;
    }
    for (int i = 0; i < planes_->size(); ++i) {
      if (i == last_ || !passes(corners, i)) continue;
      last_ = i;
      return true;
    }
    return false;
  }

  bool passes(const Matrix3<Scalar>& corners, int i) noexcept {
    const Scalar height = highest_corner(corners, planes_->normal(i));
    if (!(height <= planes_->limit(i) || (may_be_near_ && planes_->parts_closely(i, height, clearance_)))) return false;
    planes_->count_hits(i, 1);
    return true;
  }

  PlaneCache<Scalar>* planes_;
  WallPlanes<Scalar>* walls_;
  Clearance<Scalar> clearance_;
  int piece_;
  int evaluations_ = 0;  // of heights above remembered planes, since the work last grew for it
  std::span<const KnownTriangle<Scalar>> known_;
  bool may_be_near_ = true;  // a motion may end nearer than `Clearance::kept`, where it started so
  Scalar first_blocked_ = std::numeric_limits<Scalar>::infinity();  // time of the first blocker so far
  SweepResult<Scalar> result_;  // so far
  NoticedTriangles noticed_;  // likewise
  std::size_t next_known_ = 0;  // first of the known triangles that is not examined
  std::optional<TraversalPlace<Order>> place_;
  Frame start_;
  Frame end_;
  int hidden_ = 0;  // triangles looked at whether a known wall hides them, since the work last grew for it
  std::int32_t noted_leaf_ = -1;  // the last whose planes were noted, and its triangles that were passed then
  unsigned passed_lanes_ = 0;
  int last_ = 0;  // of the planes to pass a triangle: its neighbours come next
  FixedVector<KnownPlane, 4> known_planes_;
  CoarsePlanes<Scalar, PlaneCache<Scalar>::capacity + 4> coarse_;
};

}  // namespace feeler
