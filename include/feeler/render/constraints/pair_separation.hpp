// How far the pairs of the working set are apart at one pose, by a plane or by a distance query.
#pragma once

#include <algorithm>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/work_meter.hpp"
#include "feeler/render/constraints/closest_points_of_pair.hpp"
#include "feeler/render/constraints/covering_planes.hpp"
#include "feeler/render/constraints/working_set.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// Separations at one pose at a time. Where a motion starts, at a certified pose, what is found is kept as the pair's plane.
///
/// A plane tells in a few dozen products what a query does in a microsecond: a pair that its old plane still parts is not measured, nor one that lies
/// below the plane of another.
/// @tparam Scene  `RenderedScene`
/// @cost  `work` grows by one for each distance query, and for every few planes
template <class Scene>
class PairSeparation {
 public:
  using Scalar = typename Scene::Scalar;
  using Piece = typename Scene::Piece;
  using Pair = WorkingPair<Scalar>;

  void clear() noexcept { planes_.clear(); }
  /// @param is_at_start  whether a motion starts there
  void put_at(const Pose<Scalar>& pose, bool is_at_start) noexcept {
    pose_ = pose;
    axes_ = pose.rotation.toRotationMatrix();
    is_at_start_ = is_at_start;
    covers_.clear();
  }

  const Pose<Scalar>& pose() const noexcept { return pose_; }
  /// Of the tool.
  const Matrix3<Scalar>& axes() const noexcept { return axes_; }
  bool is_at_start() const noexcept { return is_at_start_; }
  /// Of a pair's triangle in the tool frame, one corner in each column [m].
  Matrix3<Scalar> corners_in_tool(const Scene& scene, const Pair& pair) const noexcept { return scene.in_tool(pair.corners_world, pose_, axes_); }

  /// Closest points of a pair, as `closest_points_of`, and what is remembered of them.
  /// @param corners  `corners_in_tool(scene, pair)`
  ClosestPoints<Scalar> query(const Scene& scene, Pair& pair, const Matrix3<Scalar>& corners, int& work) const noexcept {
    return query(scene, pair, corners, axes_, is_at_start_, work);
  }
  /// The same at the start of a motion that is under way.
  static ClosestPoints<Scalar> query_at_start(const Scene& scene, Pair& pair, const Pose<Scalar>& start, int& work) noexcept {
    const Matrix3<Scalar> axes = start.rotation.toRotationMatrix();
    return query(scene, pair, scene.in_tool(pair.corners_world, start, axes), axes, true, work);
  }

  /// Separation of a pair along a world normal [m].
  Scalar slack_along(const Scene& scene, const Pair& pair, const Vector3<Scalar>& normal, int& work) noexcept {
    return slack_along(scene, pair, normal, pose_, axes_, work);
  }
  /// The same at another pose, with its axes.
  FEELER_FLATTEN Scalar slack_along(const Scene& scene, const Pair& pair, const Vector3<Scalar>& normal, const Pose<Scalar>& pose,
                                    const Matrix3<Scalar>& axes, int& work) noexcept {
    planes_.add(1, work);
    const Piece& piece = scene.piece(pair.piece);
    const Scalar lowest = lowest_above(piece, scene.reference(), Vector3<Scalar>(axes.transpose() * normal)) - swept_radius(piece);
    return lowest - highest_corner<Scalar>(pair.corners_world.colwise() - pose.translation, normal);
  }

  /// Whether the planes of pairs, but for those beyond `reach` [m], leave a distance at another pose, or as much of it as they left at the start [m].
  template <class Pairs>
  bool keeps(const Scene& scene, const Pairs& pairs, Scalar distance, const Pose<Scalar>& at, Scalar reach, int& work) noexcept {
    const Matrix3<Scalar> axes = at.rotation.toRotationMatrix();
    return std::all_of(pairs.begin(), pairs.end(), [&](const Pair& pair) {
      return pair.is_beyond(reach) || slack_along(scene, pair, pair.normal, at, axes, work) >= (std::min)(distance, pair.slack);
    });
  }

  /// Makes a plane the pair's if it parts the pair where the motion starts by more than a distance.
  bool try_plane_at_start(const Scene& scene, Pair& pair, const Vector3<Scalar>& normal, Scalar least, int& work) noexcept {
    const Scalar slack = slack_along(scene, pair, normal, work);
    if (!(slack > least)) return false;
    pair.set_plane(normal, slack);
    return true;
  }

  /// The same with the normal that a row of the pair has there, where a step is to leave all of what is left of the margin, or nearly: the plane of the
  /// last query is as it was before the tool turned, and would give a hair of it away.
  void try_plane_of_row(const Scene& scene, Pair& pair, const Vector3<Scalar>& normal, int& work) noexcept {
    const auto& clearance = scene.clearance();
    if (pair.slack > clearance.negligible() && pair.slack < 2 * clearance.kept) try_plane_at_start(scene, pair, normal, pair.slack, work);
  }

  /// Whether the plane of a pair parts it from the tool by more than the contact distance, and at the start is its plane again; or it is beyond
  /// `reach` [m].
  bool try_own_plane(const Scene& scene, Pair& pair, Scalar reach, int& work) noexcept {
    if (pair.is_beyond(reach)) return true;
    if (!pair.has_plane()) return false;
    if (is_at_start_) return try_plane_at_start(scene, pair, pair.normal, scene.contact_distance(), work);
    return slack_along(scene, pair, pair.normal, work) > scene.contact_distance();
  }

  /// Makes the plane of a pair measured here this one's too if it parts it: the other's rows hold the tool for both.
  bool try_cover(const Scene& scene, Pair& pair) noexcept {
    const auto cover = covers_.above(from_tool(pair), scene.margin() / 1000, scene.contact_distance());
    if (!cover) return false;
    pair.last_normal = cover->normal;
    if (is_at_start_) pair.set_plane(cover->normal, cover->distance);
    return true;
  }
  /// Lets the plane of a pair cover others.
  /// @param distance  of the pair, as just queried [m]
  void add_cover(const Pair& pair, Scalar distance) noexcept { covers_.add(pair.last_normal, from_tool(pair), distance); }

 private:
  /// The corners of a pair, seen from the tool's reference point in world axes.
  Matrix3<Scalar> from_tool(const Pair& pair) const noexcept { return pair.corners_world.colwise() - pose_.translation; }

  static ClosestPoints<Scalar> query(const Scene& scene, Pair& pair, const Matrix3<Scalar>& corners, const Matrix3<Scalar>& axes, bool is_at_start,
                                     int& work) noexcept {
    const auto closest = closest_points_of(pair, scene, corners, axes, is_at_start);
    ++work;
    pair.last_normal = axes * closest.normal;
    if (is_at_start) pair.set_plane(pair.last_normal, closest.distance);
    return closest;
  }

  Pose<Scalar> pose_;
  Matrix3<Scalar> axes_;  // there
  bool is_at_start_ = false;
  CoveringPlanes<Scalar> covers_;  // of the pairs measured there
  WorkMeter<16> planes_;  // looked along
};

}  // namespace feeler
