// Where to start: the nearest free pose of a tool that overlaps the object, or is in its solid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/status.hpp"
#include "feeler/object/triangle_normal.hpp"
#include "feeler/object/triangle_query.hpp"
#include "feeler/proximity/separating_axes.hpp"
#include "feeler/proximity/separation.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// A free pose, and what was in the way.
template <RealScalar ScalarType>
struct FreePose {
  using Scalar = ScalarType;

  bool is_found = false;
  Pose<Scalar> pose;  ///< free; the one asked for where that is, or where none was found
  TickStatus status = TickStatus::not_reset;  ///< what `reset` says of the pose asked for
  Scalar depth = Scalar(0);  ///< how deep that is: the longest way of a tool point from there to the free pose [m]
  FixedVector<ActiveContact<Scalar>, Tick<Scalar>::contact_capacity>
      contacts;  ///< where the tool touches at the free pose, and from where it was freed
};

namespace detail {

/// The search of `nearest_free_pose`.
template <class Renderer>
class FreePoseSearch {
 public:
  using MeshScalar = typename Renderer::Scalar;
  using Scalar = typename Renderer::Working;
  using Result = FreePose<MeshScalar>;

  FreePoseSearch(Renderer& renderer, const Pose<MeshScalar>& pose, Scalar farthest) noexcept
      : renderer_(renderer), scene_(renderer.scene()), asked_(pose), start_(scene_.reference_pose(pose)), farthest_(farthest) {}

  Result run(TickStatus status) noexcept {
    best_.pose = asked_.normalized();
    best_.status = status;
    const Scalar everywhere = Scalar(scene_.object().bounds().diagonal().norm()) + 4 * reach();
    farthest_ = farthest_ > Scalar(0) ? (std::min)(farthest_, everywhere) : Scalar(0);  // a NaN is no way either
    for (const bool follows_normals : {true, false}) push_out(follows_normals);
    go_straight();
    renderer_.reset(best_.is_found ? best_.pose : asked_);  // where that is not free it holds no pose
    return best_;
  }

 private:
  /// Largest distance of a point of the tool from the reference point [m].
  Scalar reach() const noexcept {
    Scalar round(0);
    for (int i = 0; i < scene_.piece_count(); ++i) round = (std::max)(round, swept_radius(scene_.piece(i)));
    return scene_.radius() + round;
  }

  /// Calls `visit(piece, triangle)` for the pairs whose boxes meet, until it returns false.
  template <class Visit>
  void visit_near(const Pose<Scalar>& pose, const Visit& visit) const noexcept {
    bool goes_on = true;
    for (int piece = 0; piece < scene_.piece_count() && goes_on; ++piece) {
      const auto moving = scene_.moving(piece, pose, {});
      const auto frame = moving.frame_at_start();
      Eigen::AlignedBox<Scalar, 3> box;
      for (int k = 0; k < 3; ++k) {
        (box.min)()[k] = pose.translation[k] + moving.lowest_along_axis(k, 1, frame) - scene_.margin();
        (box.max)()[k] = pose.translation[k] - moving.lowest_along_axis(k, -1, frame) + scene_.margin();
      }
      visit_triangles_in(scene_.object(), box, [&](int triangle) { return goes_on = visit(piece, triangle); });
    }
  }
  Matrix3<Scalar> in_tool(int triangle, const Pose<Scalar>& pose) const noexcept {
    return scene_.in_tool(scene_.object().corners(triangle).template cast<Scalar>(), pose, pose.rotation.toRotationMatrix());
  }

  /// Whether a triangle overlaps the tool or is next to nothing off: cheaper than `reset` where there is one.
  bool touches(const Pose<Scalar>& pose) const noexcept {
    bool result = false;
    visit_near(pose, [&](int piece, int triangle) {
      const auto closest = gjk(scene_.piece(piece), in_tool(triangle, pose), {}, scene_.clearance().touching);
      result = closest.is_touching || !(closest.distance > Scalar(0));
      return !result;
    });
    return result;
  }

  /// Moves the tool out of one triangle after the other, each time as little as the metric allows, turns
  /// included: what frees a tool that is caught by a little, in a tight fit too. What is to be left of the margin halves with each round,
  /// as a fit may be tighter than that.
  /// @param follows_normals  to the front of each triangle; else to where it is nearest to be free of it
  void push_out(bool follows_normals) noexcept {
    constexpr int most_rounds = 1000, most_pairs = 50000, most_axes = 8'000'000;
    Pose<Scalar> pose = start_;
    int pairs = 0;
    axes_ = 0;
    kept_ = scene_.margin();
    bool is_moved = true;
    for (int round = 0; round < most_rounds && is_moved && pairs < most_pairs; ++round) {
      is_moved = false;
      const Pose<Scalar> begun = pose;
      visit_near(begun, [&](int piece, int triangle) {
        const Twist<Scalar> push = push_of(piece, triangle, pose, follows_normals);
        if (!push.vector().isZero(Scalar(0))) {
          pose = scene_.idle_turns().moved(pose, push);
          is_moved = true;
        }
        return ++pairs < most_pairs && axes_ < most_axes;
      });
      kept_ = (std::max)(kept_ / 2, 2 * scene_.clearance().rounding);
    }
    if (!is_moved) try_from(pose);
  }

  /// The least motion in the metric after which a triangle is `kept_` from a piece; none where half of it is left.
  Twist<Scalar> push_of(int piece, int triangle, const Pose<Scalar>& pose, bool follows_normals) noexcept {
    const auto& tool = scene_.piece(piece);
    const Matrix3<Scalar> corners = in_tool(triangle, pose);
    auto closest = gjk(tool, corners, {}, scene_.clearance().touching);
    if (!closest.is_touching && closest.distance >= kept_ / 2) return {};
    const Vector3<Scalar> normal = triangle_normal<Scalar>(corners.col(0), corners.col(1), corners.col(2));
    if (follows_normals && !normal.isZero(Scalar(0))) {
      closest.normal = normal;
      closest.distance = separation_along(tool, corners, normal);
      closest.tool_point = tool.vertex(tool.support(Vector3<Scalar>(-normal)));
    } else if (closest.is_touching) {
      way_out(tool, corners, closest);
      // Parted along that, their closest points tell where they touch: a face of the tool turns about the corner that is in it.
      const Scalar gap = (std::max)(scene_.margin(), 4 * scene_.clearance().touching);
      const Matrix3<Scalar> parted = corners.colwise() + (closest.distance - gap) * closest.normal;
      closest.tool_point = gjk(tool, parted, {}, scene_.clearance().touching).tool_point;
    }
    if (closest.distance >= kept_ / 2 - scene_.clearance().allowance) return {};
    Vector6<Scalar> row;
    row.template head<3>() = pose.rotation * closest.normal;
    row.template tail<3>() = (pose.rotation * Vector3<Scalar>(closest.tool_point - scene_.reference())).cross(row.template head<3>());
    const Vector6<Scalar> motion = row.cwiseQuotient(scene_.metric().along().diagonal());
    return Twist<Scalar>::from_vector(motion * ((kept_ - closest.distance) / row.dot(motion)));
  }

  /// The separating plane of a tool and a triangle that overlap. Of a tool of many faces some are tried, spread over it: hardly a longer way out, and
  /// all of ten thousand would take minutes.
  template <class Piece>
  void way_out(const Piece& tool, const Matrix3<Scalar>& corners, ClosestPoints<Scalar>& closest) noexcept {
    constexpr int most_axes = 512, cost_of_large = 8;
    const auto& core = core_of(tool);
    const int axes = core.face_axis_count() + 3 * core.edge_direction_count();
    axes_ += (std::min)(axes, most_axes) * (axes > most_axes ? cost_of_large : 1);
    if (axes <= most_axes) {
      closest = separation_of_touching(tool, corners, closest);
      return;
    }
    SeparatingAxis<Scalar> best;
    const Vector3<Scalar> normal = triangle_normal<Scalar>(corners.col(0), corners.col(1), corners.col(2));
    if (!normal.isZero(Scalar(0))) take_better_axis(core, corners, normal, Scalar(0), best);
    const int stride = core.face_axis_count() / most_axes + 1;
    for (int i = 0; i < core.face_axis_count(); i += stride) take_better_axis(core, corners, core.face_axis(i), Scalar(0), best);
    closest.normal = best.normal;
    closest.distance = separation_along(tool, corners, best.normal);
    closest.tool_point = tool.vertex(tool.support(Vector3<Scalar>(-best.normal)));
  }
  template <class Piece>
  static const auto& core_of(const Piece& tool) noexcept {
    if constexpr (SweptTool<Piece>) {
      return tool.core();
    } else {
      return tool;
    }
  }

  /// Looks along 26 directions, farther and farther, and back from where the tool is free.
  void go_straight() noexcept {
    constexpr int grid = 27;
    const Scalar longest = farthest_ - scene_.margin() / 10;  // and no rounding makes it longer than `farthest_`
    std::array<bool, grid> is_done{};
    Scalar way = 10 * scene_.margin();
    for (bool is_last = false; !is_last; way *= Scalar(1.5)) {
      is_last = way >= longest || (best_.is_found && way > 2 * Scalar(best_.depth));
      way = (std::min)(way, longest);
      for (int i = 0; i < grid; ++i) {
        if (i == grid / 2 || is_done[std::size_t(i)]) continue;
        const Vector3<Scalar> direction = Vector3<Scalar>(Scalar(i % 3 - 1), Scalar(i / 3 % 3 - 1), Scalar(i / 9 - 1)).normalized();
        const Pose<Scalar> pose{start_.translation + way * direction, start_.rotation};
        is_done[std::size_t(i)] = !touches(pose) && try_from(pose);
      }
    }
  }

  /// Takes where the renderer gets from a free pose towards the one asked for, or that pose itself where this is too far, if that is
  /// nearer than the best. False where it is not free.
  bool try_from(const Pose<Scalar>& pose) noexcept {
    constexpr int most_work = 10000;
    const Pose<MeshScalar> first = scene_.tool_pose(pose);
    if (renderer_.reset(first) != TickStatus::converged) return false;
    const Tick<MeshScalar> tick = renderer_.update_until_converged(asked_, most_work);
    if (renderer_.reset(tick.graphic_pose) != TickStatus::converged || !take(tick.graphic_pose, tick.contacts)) take(first, {});
    return true;
  }

  /// False where it is too far.
  bool take(const Pose<MeshScalar>& pose, const decltype(Result::contacts)& contacts) noexcept {
    const Pose<Scalar> end = scene_.reference_pose(pose);
    const Scalar energy = scene_.metric().energy(scene_.idle_turns().motion_between(start_, end)), depth = longest_way(end);
    if (depth > farthest_) return false;
    if (best_.is_found && energy >= energy_) return true;
    energy_ = energy;
    best_ = {true, pose, best_.status, MeshScalar(depth), contacts};
    return true;
  }

  Scalar longest_way(const Pose<Scalar>& end) const noexcept {
    using std::sqrt;
    const Pose<Scalar> from = scene_.tool_frame(start_), to = scene_.tool_frame(end);
    Scalar longest(0);
    for (int i = 0; i < scene_.piece_count(); ++i) {
      for (int v = 0; v < scene_.piece(i).vertex_count(); ++v) {
        const Vector3<Scalar> vertex = scene_.piece(i).vertex(v);
        longest = (std::max)(longest, (to * vertex - from * vertex).squaredNorm());
      }
    }
    return sqrt(longest);
  }

  Renderer& renderer_;
  const RenderedScene<typename Renderer::Tool>& scene_;
  Pose<MeshScalar> asked_;
  Pose<Scalar> start_;  // the same, of the reference point
  Scalar farthest_;
  Result best_;
  Scalar energy_ = Scalar(0);  // of the best, from the pose asked for
  Scalar kept_ = Scalar(0);  // what a push out leaves of the margin [m]
  int axes_ = 0;  // tried in a push out
};

}  // namespace detail

/// The nearest pose at which a tool is free, for a start in contact, in a solid, or with a tool that grew:
/// certified as `reset` does, and what the renderer then is reset to. Where none is found, it holds no pose.
///
/// From the pose asked for the tool is pushed out of what it overlaps, and moved straight along 26
/// directions, farther and farther. From each free pose so found `update_until_converged` leads back towards
/// the pose asked for, and of where that ends the nearest in the metric is taken; where that is too far, the free
/// pose itself. It is a local minimum, with the margin kept where there is room for it; that nothing is nearer is not
/// proved. In a fit tighter than the margin the tool stays, but for walls of hundreds of triangles or tools of hundreds
/// of faces: there the search may be cut short and go out. The way there from the pose asked for may cross the
/// object: where walls are thin the other side may be nearer.
/// @param renderer  a `HapticRenderer`
/// @param farthest  no tool point goes farther [m]; without it, as far as the outside; nothing is found where it is no length
/// @cost  noexcept, no allocation; bounded: 10 to 200 ms, and up to two seconds where thousands of triangles
/// are overlapped, five with a round fit or a hull of 10,000 points; for use outside the loop
template <class Renderer, class Scalar = typename Renderer::Scalar>
FreePose<Scalar> nearest_free_pose(Renderer& renderer, const Pose<Scalar>& pose, Scalar farthest = (std::numeric_limits<Scalar>::max)()) noexcept {
  const TickStatus status = renderer.reset(pose);
  if (status == TickStatus::penetrating || status == TickStatus::inside)
    return detail::FreePoseSearch<Renderer>(renderer, pose, typename Renderer::Working(farthest)).run(status);
  FreePose<Scalar> result;
  result.is_found = status == TickStatus::converged;
  result.pose = renderer.tick().graphic_pose;
  result.status = status;
  return result;
}

}  // namespace feeler
