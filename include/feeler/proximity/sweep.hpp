// The certificate of a whole motion: every triangle of the object passed for certain, or the ones that block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/culled_traversal.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/known_triangles.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/passage.hpp"
#include "feeler/proximity/plane_cache.hpp"
#include "feeler/proximity/sweep_result.hpp"
#include "feeler/proximity/traversal_order.hpp"
#include "feeler/proximity/wall_planes.hpp"

namespace feeler {

/// Certifies motions of a tool against a triangle mesh with one traversal of its bounding volume hierarchy.
///
/// A box or a triangle passes if one cached plane holds over the whole motion (`CulledTraversal`); a triangle that no plane passes is measured
/// (`pass`), which gives a new plane or a blocker. After a blocker the motion is shortened for the rest, though not to the
/// blocker itself: the ones just behind it are better known at once. Where the work runs out it stops, and goes on later where it was (`go_on`).
/// @tparam Order  in which boxes and triangles are visited: `NearestFirst` or `InBatches`
template <ConvexTool Tool, class Order = NearestFirst>
class Sweep {
 public:
  using Scalar = typename Tool::Scalar;
  using List = typename KnownTriangles<Scalar>::List;

  /// @param walls  remembered planes of the object's walls, if any
  /// @param piece    of the tool
  Sweep(PlaneCache<Scalar>& planes, const Clearance<Scalar>& clearance, WallPlanes<Scalar>* walls = nullptr, int piece = 0) noexcept
      : traversal_(planes, clearance, walls, piece) {}

  /// Its owner has been copied: the caches are those of the copy from here on.
  void work_with(PlaneCache<Scalar>& planes, WallPlanes<Scalar>* walls) noexcept { traversal_.work_with(planes, walls); }

  /// @param known   triangles to examine first, exactly; the traversal skips them
  /// @param work    grows by the work done
  /// @param limit   value of `work` at which the sweep stops; some queries more at most
  /// @param until   time up to which the motion is of interest: only [0, until] is certified
  /// @param first_blocked  time at which something else blocks the motion: what does not before that is not looked for exactly
  template <class MeshScalar>
  SweepResult<Scalar> certify(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, List known, int& work, int limit,
                              Scalar until = Scalar(1), Scalar first_blocked = std::numeric_limits<Scalar>::infinity()) noexcept {
    first_blocked_ = first_blocked;
    known_.set(known);
    traversal_.begin(mesh, moving, known_, until, false);
    result_ = {};
    result_.time = until;
    next_known_ = 0;
    return run(mesh, moving, work, limit, false);
  }
  /// After `certify`, or this, was exhausted: the rest of it.
  /// @param mesh, moving, known  as there
  template <class MeshScalar>
  SweepResult<Scalar> go_on(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, List known, int& work, int limit) noexcept {
    known_.set(known);
    return run(mesh, moving, work, limit, true);
  }

  /// The triangles nearer than `Clearance::kept` to a tool that stands still, but for those known and those hidden behind the plane of one that is:
  /// what is no nearer than that one, as seen along its normal, holds the tool no better.
  /// @param known  each with a plane that parts it
  template <class MeshScalar>
  NoticedTriangles notice(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& standing, List known, int& work, int limit) noexcept {
    known_.set(known);
    traversal_.begin(mesh, standing, known_, Scalar(1), true);
    noticed_ = {};
    return go_on_noticing(mesh, standing, known, work, limit);
  }
  /// After `notice`, or this, was exhausted: the rest of it, with what came before.
  /// @param mesh, standing, known  as there
  template <class MeshScalar>
  NoticedTriangles go_on_noticing(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& standing, List known, int& work, int limit) noexcept {
    known_.set(known);
    const Clearance<Scalar>& clearance = traversal_.clearance();
    WallPlanes<Scalar>* const walls = traversal_.walls();
    const auto look_at = [&](int triangle, const Matrix3<Scalar>& corners) {
      if (is_hidden(corners, standing, work)) return true;
      ++work;
      const auto closest =
          gjk(standing.tool(), standing.in_tool(corners, traversal_.start()), traversal_.features().recall_or_guess(triangle), clearance.touching);
      traversal_.features().remember(triangle, closest.features);
      if (!closest.is_touching && closest.distance > clearance.kept) {
        traversal_.add_plane(traversal_.start().rotation * closest.normal, standing);
        return true;
      }
      // Of a wall one triangle tells as much as all that it is cut into.
      if (walls != nullptr) walls->know(mesh, triangle, standing, traversal_.start());
      return noticed_.push_back({triangle, 0, closest.features});
    };
    const auto is_wall_parted = [&](int wall, bool) {
      return walls->parts_wall(mesh, wall, standing, traversal_.start(), traversal_.end(), clearance);
    };
    const bool is_done = traversal_.visit_unparted(mesh, standing, work, known_.by_number(), is_wall_parted, look_at, [&] { return work < limit; });
    noticed_.is_exhausted = !is_done && !noticed_.full();
    return noticed_;
  }

  /// Whether single planes part the tool over the whole motion from every triangle. They are looked for at its start alone: false may mean
  /// that there are some.
  /// @param work, limit  as in `certify`
  template <class MeshScalar>
  bool parts(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit) noexcept {
    known_.set({});
    traversal_.begin(mesh, moving, known_, Scalar(1), false);
    const auto is_parted = [&](int, const Matrix3<Scalar>& corners) {
      ++work;
      const auto closest = gjk(moving.tool(), moving.in_tool(corners, traversal_.start()), {}, traversal_.clearance().touching);
      if (closest.is_touching) return false;
      traversal_.add_plane(traversal_.start().rotation * closest.normal, moving);
      return traversal_.is_parted(corners, moving);
    };
    const auto none_is_known = [](int) { return false; };
    const auto none_is_parted = [](int, bool) { return false; };
    return traversal_.visit_unparted(mesh, moving, work, none_is_known, none_is_parted, is_parted, [&] { return work < limit; });
  }

 private:
  /// @param is_resumed  as `examine` has it, of the first triangle to be examined
  template <class MeshScalar>
  SweepResult<Scalar> run(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit, bool is_resumed) noexcept {
    if (!examine_known(mesh, moving, work, limit, is_resumed)) return exhausted();
    if (result_.is_over()) return result_;
    const auto is_known = known_.by_number();
    const auto measure = [&](int triangle, const Matrix3<Scalar>& corners) {
      const PassedTriangle<Scalar> state{.corners = corners, .features = traversal_.features().recall_or_guess(triangle)};
      return examine(triangle, state, moving, work, limit, std::exchange(is_resumed, false));
    };
    WallPlanes<Scalar>* const walls = traversal_.walls();
    const auto parted_until = [&](int wall) {
      return walls->parts_wall_until(mesh, wall, moving, traversal_.start(), traversal_.end(), traversal_.clearance());
    };
    const auto is_wall_parted = [&](int wall, bool is_inside) {
      Scalar parted = parted_until(wall);
      if (parted >= traversal_.end().time) return true;
      if (parted < Scalar(0)) return false;
      if (work < limit && walls->note_question(mesh, wall, moving, traversal_.start()) &&
          is_met_below(mesh, wall, parted, moving, is_known, measure)) {
        walls->meet(wall);
        parted = parted_until(wall);
        if (parted >= traversal_.end().time) return true;
      }
      if (!is_inside || !walls->has_met(wall)) return false;
      result_.time = (std::min)(result_.time, parted);
      return true;
    };
    const auto look_at = [&](int triangle, const Matrix3<Scalar>& corners) {
      const int wall = walls != nullptr ? mesh.walls().of_triangle(triangle) : Walls<MeshScalar>::none;
      const auto& vertices = mesh.triangle(triangle);
      const auto is_inside = [&mesh](int vertex) { return mesh.walls().is_inside(vertex); };
      return (wall >= 0 && is_wall_parted(wall, std::all_of(vertices.begin(), vertices.end(), is_inside))) || measure(triangle, corners);
    };
    const auto may_go_on = [&] { return work < limit && !result_.is_over(); };
    const bool is_done = traversal_.visit_unparted(mesh, moving, work, is_known, is_wall_parted, look_at, may_go_on);
    return is_done || result_.is_over() ? result_ : exhausted();
  }

  /// Measures the known triangles, until they block the motion where it starts; false where the work ran out.
  template <class MeshScalar>
  bool examine_known(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit, bool& is_resumed) noexcept {
    for (; next_known_ < known_.list().size() && !result_.is_over(); ++next_known_) {
      const KnownTriangle<Scalar>& pair = known_.list()[next_known_];
      if (traversal_.is_parted_by_wall(mesh, pair.triangle, moving, work) || traversal_.is_parted(pair.state.corners, moving)) continue;
      if (!examine(pair.triangle, pair.state, moving, work, limit, std::exchange(is_resumed, false))) return false;
    }
    return true;
  }

  /// Whether a triangle of a wall blocks that is below the tool's lowest vertex, where planes cease to part the two or at the end: a tool meets the
  /// inside of a wall with that vertex, and what is below it tells when.
  /// @param parted  time up to which planes part the two
  template <class MeshScalar, class IsKnown, class Measure>
  bool is_met_below(const TriangleMesh<MeshScalar>& mesh, int wall, Scalar parted, const MovingTool<Tool>& moving, const IsKnown& is_known,
                    const Measure& measure) noexcept {
    for (const Scalar& time : {parted, traversal_.end().time}) {
      const int triangle = traversal_.walls()->triangle_below(mesh, wall, moving, traversal_.start(), time);
      if (triangle < 0 || is_known(triangle)) continue;
      const int blockers = result_.blockers.size();
      if (!measure(triangle, traversal_.corners_of(mesh, triangle, moving))) return false;
      if (result_.blockers.size() != blockers) return true;
    }
    return false;
  }

  /// Measures a triangle; false where the work ran out before it was known how far the motion is free, and nothing came of it.
  /// @param is_resumed  it was examined before, with less work: what comes of it now is made use of
  FEELER_FLATTEN bool examine(int triangle, const PassedTriangle<Scalar>& state, const MovingTool<Tool>& moving, int& work, int limit,
                              bool is_resumed) noexcept {
    if (work >= limit) return false;
    if (!state.is_exact && is_hidden(state.corners, moving, work)) return true;
    const Clearance<Scalar>& clearance = traversal_.clearance();
    const Passage<Scalar> passage = pass(moving, state, traversal_.start(), traversal_.end(), clearance, work, first_blocked_, limit);
    if (!passage.is_blocked) {
      if (passage.normal.squaredNorm() > Scalar(0) && !state.is_exact) {
        traversal_.add_plane(passage.normal, moving);
        if (passage.turns) traversal_.add_turning_plane(passage.normal, moving);
        traversal_.features().remember(triangle, passage.features);
      }
      return true;
    }
    // Beside a wall that the tool slides along there may be a way that leads nowhere near it in any other direction.
    if (state.is_exact && is_hidden(state.corners, moving, work)) return true;
    if (passage.is_cut && !is_resumed) return false;
    result_.add({triangle, passage.time, 0, passage.features});
    first_blocked_ = (std::min)(first_blocked_, passage.time);
    result_.time = (std::min)(result_.time, passage.time);
    if (result_.blockers.full() && result_.latest()->time * moving.length() < clearance.resolution) result_.time = Scalar(0);
    const Scalar end = worth_certifying(result_, clearance, moving);
    if (end < traversal_.end().time) traversal_.set_end(moving, end);
    return true;
  }

  /// Whether a triangle lies in or behind the plane of a known one.
  bool is_hidden(const Matrix3<Scalar>& corners, const MovingTool<Tool>& moving, int& work) noexcept {
    return known_.hide(corners, moving, traversal_.start(), traversal_.end(), traversal_.clearance(), work);
  }

  /// The result so far.
  SweepResult<Scalar> exhausted() const noexcept {
    SweepResult<Scalar> result = result_;
    result.time = Scalar(0);
    result.is_exhausted = true;
    return result;
  }

  CulledTraversal<Tool, Order> traversal_;
  KnownTriangles<Scalar> known_;
  Scalar first_blocked_ = std::numeric_limits<Scalar>::infinity();  // time of the first blocker so far
  SweepResult<Scalar> result_;  // so far
  NoticedTriangles noticed_;  // likewise
  std::size_t next_known_ = 0;  // first of the known triangles that is not examined
};

}  // namespace feeler
