// The certificate of a whole motion: every triangle of the object passed for certain, or the ones that block.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include <Eigen/Core>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/passage.hpp"
#include "feeler/proximity/plane_cache.hpp"

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
};

/// Result of a sweep: the motion is free of collision on [0, time]. That is less than the whole where something blocks, or the work ran low.
template <class Scalar>
struct SweepResult {
  static constexpr int blocker_capacity = 24;

  Scalar time = Scalar(1);
  FixedVector<Blocker<Scalar>, blocker_capacity> blockers;
  bool is_exhausted = false;  ///< the work limit was reached: nothing is certified, time is 0; the blockers found so far are real

  bool is_whole() const noexcept { return blockers.empty() && time >= Scalar(1); }
};

/// How far a motion that is blocked at a time should be looked at further: past its first blocker, to know the ones just behind it.
template <ConvexTool Tool>
typename Tool::Scalar worth_certifying(typename Tool::Scalar blocked, const Clearance<typename Tool::Scalar>& clearance,
                                       const MovingTool<Tool>& moving) noexcept {
  using Scalar = typename Tool::Scalar;
  return std::max(blocked, std::min(Scalar(1), clearance.probe / moving.length()));
}

/// Certifies motions of a tool against a triangle mesh with one traversal of its bounding volume hierarchy.
///
/// A box or a triangle passes if one cached plane holds over the whole motion (`PlaneCache`); a triangle that no plane passes is measured
/// (`pass`), which gives a new plane or a blocker. After an early blocker the motion is shortened for the rest, though not to the
/// blocker itself: the ones just behind it are better known at once. Where the work runs low it is shortened too, and the planes known pass
/// most of what is left.
template <ConvexTool Tool>
class Sweep {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;

  /// Boxes and triangles tested that count as much work as one distance query.
  static constexpr int tests_per_work = 24;

  Sweep(PlaneCache<Scalar>& planes, const Clearance<Scalar>& clearance) noexcept
      : planes_(planes), from_known_(clearance), clearance_(clearance.from_unknown()) {}

  /// @param known   triangles to examine first, exactly; the traversal skips them
  /// @param work    grows by the work done
  /// @param limit   value of `work` at which the sweep gives up
  /// @param until   time up to which the motion is of interest: only [0, until] is certified
  template <class MeshScalar>
  SweepResult<Scalar> certify(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving,
                              std::span<const KnownTriangle<Scalar>> known, int& work, int limit,
                              Scalar until = Scalar(1)) noexcept {
    SweepResult<Scalar> result;
    result.time = until;
    begin(mesh, moving, until);
    for (const KnownTriangle<Scalar>& pair : known) {
      if (passes(pair.state.corners)) continue;
      examine(pair.triangle, pair.state, from_known_, moving, result, work);
      if (work > limit) return give_up(result);
    }
    const auto look_at = [&](int triangle, const Matrix3<Scalar>& corners) {
      if (!is_among(triangle, known)) examine(triangle, {corners, Vector::Zero(), planes_.features().recall_or_guess(triangle), false}, clearance_, moving, result, work);
      return true;
    };
    const auto goes_on = [&](int& low) {  // with a shorter motion
      if (work > limit) return false;
      low = limit - (limit - low) / 2;
      result.time = std::min(result.time, end_.time / 4);
      set_end(moving, end_.time / 4);
      return true;
    };
    return traverse(mesh, moving, work, limit - (limit - work) / 8, look_at, goes_on) ? result : give_up(result);
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
      return passes(corners);
    };
    return traverse(mesh, moving, work, limit, is_parted, [](int&) { return false; });
  }

 private:
  using Frame = MotionFrame<Scalar>;
  static constexpr int lanes = 4;
  using Lanes = Eigen::Array<float, lanes, 1>;
  /// Planes for boxes, to be tested together.
  struct BoxPlanes {
    std::array<Lanes, 3> normal{Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    std::array<Lanes, 3> size = normal;  // the normals' magnitudes
    Lanes limit = Lanes::Constant(-std::numeric_limits<float>::infinity());  // of no plane: nothing passes
  };

  template <class MeshScalar>
  void begin(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, Scalar until) noexcept {
    start_ = moving.frame_at(Scalar(0));
    to_boxes_ = moving.origin() - mesh.bvh().origin().template cast<Scalar>();
    extent_ = Scalar(mesh.bounds().diagonal().norm());
    planes_.age();
    planes_.begin(moving, start_);
    set_end(moving, until);
  }

  /// Calls `visit(triangle, its corners relative to the motion's origin)` for every triangle that no cached plane passes, and `goes_on(limit)`
  /// when the work done exceeds the limit, which it may raise, until one call is false; true when it came to the end.
  template <class MeshScalar, class Visit, class GoesOn>
  bool traverse(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, int& work, int limit, const Visit& visit,
                const GoesOn& goes_on) noexcept {
    const auto& bvh = mesh.bvh();
    const auto nodes = bvh.nodes();
    const auto order = bvh.triangle_order();
    std::array<int, 128> stack;
    int depth = 0;
    int tests = 0;
    if (!passes(nodes[0])) stack[std::size_t(depth++)] = 0;
    while (depth > 0) {
      const auto& node = nodes[std::size_t(stack[std::size_t(--depth)])];
      if (++tests >= tests_per_work) {
        tests = 0;
        ++work;
      }
      if (work > limit && !goes_on(limit)) return false;
      if (node.count == 0) {
        const int later = is_ahead(nodes[std::size_t(node.first + 1)], nodes[std::size_t(node.first)], moving) ? 1 : 0;
        for (const int child : {node.first + later, node.first + 1 - later}) {
          if (!passes(nodes[std::size_t(child)])) stack[std::size_t(depth++)] = child;
        }
        continue;
      }
      for (int i = node.first; i < node.first + node.count; ++i) {
        const int triangle = order[std::size_t(i)];
        const Matrix3<Scalar> corners =
            mesh.corners(triangle).template cast<Scalar>().colwise() - moving.origin();
        if (!passes(corners) && !visit(triangle, corners)) return false;
      }
    }
    return true;
  }

  /// Whether the tool comes to a box after another one: an early blocker saves work on all that lies behind it.
  template <class Node>
  static bool is_ahead(const Node& box, const Node& other, const MovingTool<Tool>& moving) noexcept {
    Scalar ahead(0);
    for (int k = 0; k < 3; ++k) {
      const auto axis = std::size_t(k);
      ahead += moving.motion().linear[k] * Scalar((box.lower[axis] - other.lower[axis]) + (box.upper[axis] - other.upper[axis]));
    }
    return ahead > Scalar(0);
  }

  static SweepResult<Scalar> give_up(SweepResult<Scalar>& result) noexcept {
    result.time = Scalar(0);
    result.is_exhausted = true;
    return result;
  }

  static bool is_among(int triangle, std::span<const KnownTriangle<Scalar>> known) noexcept {
    return std::any_of(known.begin(), known.end(), [triangle](const auto& k) { return k.triangle == triangle; });
  }

  void examine(int triangle, const PassedTriangle<Scalar>& state, const Clearance<Scalar>& clearance, const MovingTool<Tool>& moving,
               SweepResult<Scalar>& result, int& work) noexcept {
    const Passage<Scalar> passage = pass(moving, state, start_, end_, clearance, work);
    if (!passage.is_blocked) {
      if (passage.normal.squaredNorm() > Scalar(0) && !state.is_exact) {
        add_plane(passage.normal, moving);
        planes_.features().remember(triangle, passage.features);
      }
      return;
    }
    if (result.blockers.full()) {
      auto latest = std::max_element(result.blockers.begin(), result.blockers.end(),
                                     [](const auto& a, const auto& b) { return a.time < b.time; });
      if (passage.time < latest->time) *latest = {triangle, passage.time, 0};
    } else {
      result.blockers.push_back({triangle, passage.time, 0});
    }
    if (passage.time < result.time) result.time = passage.time;
    const Scalar enough = worth_certifying(result.time, clearance_, moving);
    if (2 * enough <= end_.time) set_end(moving, enough);
  }

  /// From here on only [0, time] is certified.
  void set_end(const MovingTool<Tool>& moving, Scalar time) noexcept {
    end_ = moving.frame_at(time);
    planes_.end(moving, end_, clearance_.kept);
    for (std::size_t k = 0; k < 3; ++k) {
      const Scalar below = planes_.sides()[2 * k].least - clearance_.kept + to_boxes_[int(k)];
      const Scalar above = planes_.sides()[2 * k + 1].least - clearance_.kept - to_boxes_[int(k)];
      lower_[k] = round_down(below, below);
      upper_[k] = -round_down(above, above);
    }
    for (int i = 0; i < planes_.size(); ++i) set_box_plane(i);
  }

  void add_plane(const Vector& normal, const MovingTool<Tool>& moving) noexcept {
    set_box_plane(planes_.add(normal, moving, start_, end_, clearance_.kept));
  }

  /// Boxes are float and relative to the hierarchy's origin; a plane for them gives away what rounding could gain.
  void set_box_plane(int i) noexcept {
    const Vector& normal = planes_.normal(i);
    BoxPlanes& planes = box_planes_[std::size_t(i / lanes)];
    for (int k = 0; k < 3; ++k) {
      planes.normal[std::size_t(k)][i % lanes] = float(normal[k]);
      planes.size[std::size_t(k)][i % lanes] = std::abs(float(normal[k]));
    }
    planes.limit[i % lanes] = round_down(planes_.limit(i) + normal.dot(to_boxes_), extent_);
  }

  static float round_down(Scalar value, Scalar extent) noexcept {
    const float rounded = float(value);
    return rounded - 8 * std::numeric_limits<float>::epsilon() * (std::abs(rounded) + std::abs(float(extent)));
  }

  template <class Node>
    requires requires(const Node& node) { node.lower[0]; }
  bool passes(const Node& node) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      if (node.upper[k] <= lower_[k] || node.lower[k] >= upper_[k]) return true;
    }
    std::array<float, 3> centre, half;
    for (std::size_t k = 0; k < 3; ++k) {
      centre[k] = (node.upper[k] + node.lower[k]) / 2;
      half[k] = (node.upper[k] - node.lower[k]) / 2;
    }
    for (int first = 0; first < planes_.size(); first += lanes) {
      const BoxPlanes& planes = box_planes_[std::size_t(first / lanes)];
      const Lanes room = planes.limit - (planes.normal[0] * centre[0] + planes.normal[1] * centre[1] + planes.normal[2] * centre[2] +
                                         planes.size[0] * half[0] + planes.size[1] * half[1] + planes.size[2] * half[2]);
      if (!(room.maxCoeff() >= 0.0f)) continue;
      int i = 0;
      while (!(room[i] >= 0.0f)) ++i;
      planes_.count_hit(first + i);
      return true;
    }
    return false;
  }

  bool passes(const Matrix3<Scalar>& corners) noexcept {
    for (int i = 0; i < planes_.size(); ++i) {
      const Scalar height = detail::highest(corners, planes_.normal(i));
      if (height <= planes_.limit(i) || planes_.parts_closely(i, height, clearance_)) {
        planes_.count_hit(i);
        return true;
      }
    }
    return false;
  }

  PlaneCache<Scalar>& planes_;
  Clearance<Scalar> from_known_;
  Clearance<Scalar> clearance_;  // from all others
  Vector to_boxes_;       // to the origin of the motion from that of the boxes [m]
  Scalar extent_ = Scalar(0);  // of the mesh [m]
  Frame start_;
  Frame end_;
  std::array<float, 3> lower_{}, upper_{};
  std::array<BoxPlanes, std::size_t(PlaneCache<Scalar>::capacity / lanes)> box_planes_;
};

}  // namespace feeler
