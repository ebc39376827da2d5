// The triangles that no plane at hand parts from a moving tool, found in one traversal of the bounding volume hierarchy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/coarse_planes.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/known_triangles.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/plane_cache.hpp"
#include "feeler/proximity/traversal_order.hpp"
#include "feeler/proximity/unpassed_triangles.hpp"
#include "feeler/proximity/wall_planes.hpp"
#include "feeler/proximity/work_meter.hpp"

namespace feeler {

/// Visits the triangles of a mesh past which a tool moves, but for those that one plane parts from it over all of the motion that is of interest,
/// [0, `end().time`].
///
/// Boxes and triangles are culled by the planes of `PlaneCache`, those that hide what lies behind known triangles, and those of the object's walls;
/// what a visit finds may add a plane, or shorten the motion for the rest. It stops where a visit says so, and goes on there when it is called again.
/// @tparam Order  in which boxes and triangles are visited: `NearestFirst` or `InBatches`
template <ConvexTool Tool, class Order>
class CulledTraversal {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Frame = MotionFrame<Scalar>;
  using Moving = MovingTool<Tool>;

  /// @param walls  remembered planes of the object's walls, if any
  /// @param piece  of the tool
  CulledTraversal(PlaneCache<Scalar>& planes, const Clearance<Scalar>& clearance, WallPlanes<Scalar>* walls, int piece) noexcept
      : planes_(&planes), walls_(walls), clearance_(clearance), piece_(piece) {}

  /// Its owner has been copied: the caches are those of the copy from here on.
  void work_with(PlaneCache<Scalar>& planes, WallPlanes<Scalar>* walls) noexcept {
    planes_ = &planes;
    walls_ = walls;
  }

  const Clearance<Scalar>& clearance() const noexcept { return clearance_; }
  FeatureCache& features() noexcept { return planes_->features(); }
  /// Null where there are none.
  WallPlanes<Scalar>* walls() const noexcept { return walls_; }
  const Frame& start() const noexcept { return start_; }
  /// The end of what is of interest.
  const Frame& end() const noexcept { return end_; }

  /// @param until      time up to which the motion is of interest
  /// @param keeps_off  ask for `Clearance::kept` at the end even where the motion starts nearer: then what known triangles hide is culled as well
  template <class MeshScalar>
  void begin(const TriangleMesh<MeshScalar>& mesh, const Moving& moving, const KnownTriangles<Scalar>& known, Scalar until, bool keeps_off) noexcept {
    start_ = moving.frame_at_start();
    keeps_off_ = keeps_off;
    place_.emplace(Order(moving.motion().linear.template cast<float>()));
    coarse_.begin(moving.origin() - mesh.bvh().origin().template cast<Scalar>(), Scalar(mesh.bounds().diagonal().norm()));
    planes_->age();
    planes_->with_tool().age();
    planes_->begin(moving, start_);
    heights_.note(planes_->leaves().begin(moving, clearance_.kept) / 4);
    noted_leaf_ = -1;
    hiding_planes_.clear();
    if (keeps_off_) hiding_planes_ = known.hiding_planes(moving, start_, clearance_);
    if (walls_ != nullptr) {
      walls_->begin(mesh, piece_, moving, start_, !keeps_off_);
      for (const KnownTriangle<Scalar>& pair : known.list())
        if (!pair.state.normal.isZero(Scalar(0))) walls_->know(mesh, pair.triangle, moving, start_);
    }
    set_end(moving, until);
  }

  /// From here on only [0, time] is of interest.
  FEELER_FLATTEN void set_end(const Moving& moving, Scalar time) noexcept {
    end_ = moving.frame_at(time);
    planes_->end(moving, end_, clearance_.kept);
    planes_->with_tool().set_motion(moving, start_, end_, clearance_.kept);
    if (walls_ != nullptr) walls_->end(end_);
    const Scalar kept = clearance_.kept;
    for (int k = 0; k < 3; ++k) coarse_.set_sides(k, planes_->box().lower(k) - kept, planes_->box().upper(k) + kept);
    for (int i = 0; i < hiding_planes_.size(); ++i) coarse_.set_plane(i, hiding_planes_[i].normal, hiding_planes_[i].height);
    for (int i = 0; i < planes_->size(); ++i) coarse_.set_plane(hiding_planes_.size() + i, planes_->normal(i), planes_->limit(i));
  }

  /// Adds a plane with a world normal.
  FEELER_FLATTEN void add_plane(const Vector& normal, const Moving& moving) noexcept {
    count_hits();
    const int i = planes_->add(normal, moving, start_, end_, clearance_.kept);
    coarse_.set_plane(hiding_planes_.size() + i, normal, planes_->limit(i));
  }
  /// Adds a plane that turns with the tool, with its world normal at the end.
  void add_turning_plane(const Vector& normal_at_end, const Moving& moving) noexcept {
    planes_->with_tool().add(end_.rotation.transpose() * normal_at_end, moving, start_, end_, clearance_.kept);
  }

  /// Calls `visit(triangle, its corners relative to the motion's origin)` for every triangle not `is_known` that no plane parts, and
  /// `may_go_on()` between, until one call is false; true when it came to the end. It goes on where it was.
  /// @param is_wall_parted  `is_wall_parted(wall, is_inside)` tells whether the motion keeps clear of the wall, or of what is not at its rim
  template <class MeshScalar, class IsKnown, class IsWallParted, class Visit, class MayGoOn>
  FEELER_FLATTEN bool visit_unparted(const TriangleMesh<MeshScalar>& mesh, const Moving& moving, int& work, const IsKnown& is_known,
                                     const IsWallParted& is_wall_parted, const Visit& visit, const MayGoOn& may_go_on) noexcept {
    const auto look_at = [&](std::int32_t leaf, std::size_t lane) {
      if (leaf == noted_leaf_ ? has_passed(lane) : planes_->leaves().is_parted(leaf, lane)) return true;
      const int triangle = mesh.bvh().leaves()[std::size_t(leaf)].triangle[lane];
      if (is_known(triangle) || is_parted_first_time(mesh, leaf, lane, moving, work)) return true;
      const Matrix3<Scalar> corners = corners_of(mesh, triangle, moving);
      return is_parted(corners, moving) || visit(triangle, corners);
    };
    const auto plane_count = [this] { return hiding_planes_.size() + planes_->size(); };
    const auto sift = [&](int node, auto& passed) {
      sift_by_walls(mesh, node, is_wall_parted, passed, work);
      sift_by_leaves(mesh, node, passed);
    };
    const bool is_done = visit_unpassed(mesh.bvh(), coarse_, plane_count, *place_, work, sift, look_at, may_go_on);
    count_hits();
    return is_done;
  }

  /// Whether a cached plane parts the tool from a triangle: where it does not turn with the tool, `last_parting_`.
  FEELER_FLATTEN bool is_parted(const Matrix3<Scalar>& corners, const Moving& moving) noexcept {
    if (last_parting_ < planes_->size() && is_behind(corners, last_parting_)) return true;
    const int turning = planes_->with_tool().parting(corners);
    if (turning >= 0) {
      if (planes_->with_tool().lend(turning)) add_plane(planes_->with_tool().normal_at_end(turning), moving);
      return true;
    }
    for (int i = 0; i < planes_->size(); ++i) {
      if (i == last_parting_ || !is_behind(corners, i)) continue;
      last_parting_ = i;
      return true;
    }
    return false;
  }
  /// Whether a remembered plane of a wall does.
  template <class MeshScalar>
  bool is_parted_by_wall(const TriangleMesh<MeshScalar>& mesh, int triangle, const Moving& moving, int& work) noexcept {
    if (walls_ == nullptr) return false;
    const bool parts = walls_->parts_triangle(mesh, triangle, moving, start_, end_, clearance_);
    heights_.add(walls_->take_evaluations(), work);
    return parts;
  }

  /// Relative to the motion's origin [m].
  template <class MeshScalar>
  static Matrix3<Scalar> corners_of(const TriangleMesh<MeshScalar>& mesh, int triangle, const Moving& moving) noexcept {
    return mesh.corners(triangle).template cast<Scalar>().colwise() - moving.origin();
  }

 private:
  /// Marks the children of a node as passed that hold nothing but a wall which is parted.
  template <class MeshScalar, class IsWallParted, class Passed>
  void sift_by_walls(const TriangleMesh<MeshScalar>& mesh, int node, const IsWallParted& is_wall_parted, Passed& passed, int& work) noexcept {
    if (walls_ == nullptr || mesh.walls().count() == 0) return;
    const auto& walls = mesh.walls().under(node);
    for (std::size_t i = 0; i < passed.size(); ++i) {
      if (passed[i] == 0 && walls[i] >= 0 && is_wall_parted(walls[i], mesh.walls().is_inside(node, i))) passed[i] = -1;
    }
    heights_.add(walls_->take_evaluations(), work);
  }
  /// Marks those all of whose leaves are parted by planes of their own.
  template <class MeshScalar, class Passed>
  void sift_by_leaves(const TriangleMesh<MeshScalar>& mesh, int node, Passed& passed) noexcept {
    for (std::size_t i = 0; i < passed.size() && !planes_->leaves().empty(); ++i) {
      const std::int32_t child = mesh.bvh().nodes()[std::size_t(node)].child[i];
      if (passed[i] != 0 || child == 0) continue;
      const auto under = mesh.bvh().leaves_under(child);
      if (planes_->leaves().are_parted(under[0], under[1])) passed[i] = -1;
    }
  }

  /// Whether a triangle is parted that its leaf had no plane for: by a wall's, or where leaves are remembered by one that is noted from now on.
  template <class MeshScalar>
  bool is_parted_first_time(const TriangleMesh<MeshScalar>& mesh, std::int32_t leaf, std::size_t lane, const Moving& moving, int& work) noexcept {
    if (!planes_->leaves().is_kept()) return is_parted_by_wall(mesh, mesh.bvh().leaves()[std::size_t(leaf)].triangle[lane], moving, work);
    if (leaf == noted_leaf_) return false;
    note_planes(mesh, leaf, lane, moving, work);
    return has_passed(lane);
  }

  /// Planes that part the tool from the triangles of a leaf, all of them: the leaf that has one for each need not be visited again.
  /// @param unparted  a lane that the front was asked for
  template <class MeshScalar>
  void note_planes(const TriangleMesh<MeshScalar>& mesh, std::int32_t leaf, std::size_t unparted, const Moving& moving, int& work) noexcept {
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
      if (is_parted_by_wall(mesh, triangles[i], moving, work)) {
        note(i, walls_->parting_normal(), walls_->parting_room());
        continue;
      }
      const Matrix3<Scalar> corners = corners_of(mesh, triangles[i], moving);
      if (!is_parted(corners, moving)) continue;
      // Where a plane that turns with the tool parts the triangle, this one may at the start: `note` looks how far.
      const int plane = last_parting_;
      if (plane < planes_->size()) note(i, planes_->normal(plane), planes_->height(plane) - highest_corner(corners, planes_->normal(plane)));
      else passed_lanes_ |= 1U << i;
    }
  }
  /// Whether a triangle of the leaf whose planes were noted last was passed.
  bool has_passed(std::size_t lane) const noexcept { return (passed_lanes_ >> lane & 1U) != 0; }

  /// Whether one of the cached planes parts the tool from a triangle.
  bool is_behind(const Matrix3<Scalar>& corners, int plane) noexcept {
    const Scalar height = highest_corner(corners, planes_->normal(plane));
    if (!(height <= planes_->limit(plane) || (!keeps_off_ && planes_->parts_closely(plane, height, clearance_)))) return false;
    planes_->count_hits(plane, 1);
    return true;
  }

  void count_hits() noexcept {
    coarse_.take_hits(hiding_planes_.size() + planes_->size(), [this](int i, int hits) {
      if (i >= hiding_planes_.size()) planes_->count_hits(i - hiding_planes_.size(), hits);
    });
  }

  PlaneCache<Scalar>* planes_;
  WallPlanes<Scalar>* walls_;
  Clearance<Scalar> clearance_;
  int piece_;
  bool keeps_off_ = false;
  WorkMeter<16> heights_;  // above remembered planes
  std::optional<TraversalPlace<Order>> place_;
  Frame start_;
  Frame end_;
  std::int32_t noted_leaf_ = -1;  // the last whose planes were noted, and its triangles that were passed then
  unsigned passed_lanes_ = 0;
  int last_parting_ = 0;  // the world's plane that last parted a triangle: its neighbours come next
  typename KnownTriangles<Scalar>::Planes hiding_planes_;
  CoarsePlanes<Scalar, PlaneCache<Scalar>::capacity + KnownTriangles<Scalar>::plane_capacity> coarse_;
};

}  // namespace feeler
