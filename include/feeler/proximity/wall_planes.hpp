// Planes of the object's walls, and which of them parted the tool from which triangle: tried first the next time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/height_on_motion.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"

namespace feeler {

/// The planes of walls near the tool, from tick to tick.
///
/// A shaft in its bore has walls on all sides, so no few planes part it from all of them; but the plane of each wall does, and from what lies behind
/// that wall too. How high the tool is above a plane is found once a motion, from the vertex that was lowest the last time; for a triangle that a
/// plane parted before, one comparison is left. Planes, and triangles, take the place of others with the same hash.
template <class ScalarType>
class WallPlanes {
 public:
  using Scalar = ScalarType;

  /// @param has_walls  whether the object has any; else no room is taken
  explicit WallPlanes(bool has_walls = true) : planes_(has_walls ? plane_capacity : 0), remembered_(has_walls ? remembered_capacity : 0) {}

  void clear() noexcept {
    std::fill(planes_.begin(), planes_.end(), Plane());
    std::fill(remembered_.begin(), remembered_.end(), RememberedPlane());
    motion_ = end_ = last_end_ = 0;
    keeps_axes_ = false;
    axes_at_end_.setZero();
  }

  /// Before a motion of a piece of the tool.
  /// @param may_be_near  whether a motion may end nearer to a surface than `Clearance::kept`, where it started so
  template <class MeshScalar, class Moving>
  void begin(const TriangleMesh<MeshScalar>& mesh, int piece, const Moving& moving, const MotionFrame<Scalar>& start, bool may_be_near) noexcept {
    piece_ = piece;
    may_be_near_ = may_be_near;
    to_mesh_ = moving.origin() - mesh.bvh().origin().template cast<Scalar>();
    keeps_axes_ = start.rotation == axes_at_end_;
    last_shift_ = shift_;
    last_end_ = end_;
    ++motion_;
  }
  /// The motion ends at a frame, and may have ended later before.
  void end(const MotionFrame<Scalar>& end) noexcept {
    ++end_;
    axes_at_end_ = end.rotation;
    shift_ = end.shift;
  }
  /// A triangle of the working set: what else lies in its wall, or behind it, may be as near.
  template <class MeshScalar, class Moving>
  void know(const TriangleMesh<MeshScalar>& mesh, int triangle, const Moving& moving, const MotionFrame<Scalar>& start) noexcept {
    const int wall = mesh.walls().of_triangle(triangle);
    if (wall >= 0) plane_of(mesh, wall, moving, start).known = motion_;
  }

  /// Whether its plane parts the tool from a whole wall.
  template <class MeshScalar, class Moving>
  bool parts_wall(const TriangleMesh<MeshScalar>& mesh, int wall, const Moving& moving, const MotionFrame<Scalar>& start,
                  const MotionFrame<Scalar>& end, const Clearance<Scalar>& clearance) noexcept {
    const Plane& plane = refreshed(plane_of(mesh, wall, moving, start), moving, start, end, clearance);
    return parts(plane, plane.height, clearance);
  }
  /// Time up to which it does so: that of the end, or earlier; negative if the tool is on both sides of it.
  template <class MeshScalar, class Moving>
  Scalar parts_wall_until(const TriangleMesh<MeshScalar>& mesh, int wall, const Moving& moving, const MotionFrame<Scalar>& start,
                          const MotionFrame<Scalar>& end, const Clearance<Scalar>& clearance) noexcept {
    const Plane& plane = refreshed(plane_of(mesh, wall, moving, start), moving, start, end, clearance);
    if (parts(plane, plane.height, clearance)) return end.time;
    const Scalar height = plane.height - plane.offset, gap = plane.heights.start - height, required = clearance.required(gap);
    if (gap < -2 * clearance.allowance) return Scalar(-1);
    const Scalar fraction = first_root(gap - required, plane.heights.last - height - required, plane.sagitta);
    return (std::min)(fraction, Scalar(1) - std::numeric_limits<Scalar>::epsilon()) * end.time;
  }
  /// The triangle of a wall under the tool's lowest vertex at a time of the motion, or -1 if that is beside the wall.
  template <class MeshScalar, class Moving>
  int triangle_below(const TriangleMesh<MeshScalar>& mesh, int wall, const Moving& moving, const MotionFrame<Scalar>& start, Scalar time) noexcept {
    const MotionFrame<Scalar> frame = moving.frame_at(time);
    const Vector3<Scalar> direction = frame.rotation.transpose() * -plane_of(mesh, wall, moving, start).heights.normal;
    const Vector3<Scalar> lowest = moving.tool().vertex(moving.tool().support(direction));
    return triangle_of_wall_under<MeshScalar, Scalar>(mesh, wall, moving.to_world(lowest, frame) + moving.origin());
  }
  /// Notes that a wall is asked for in a motion; false where it was before.
  template <class MeshScalar, class Moving>
  bool note_question(const TriangleMesh<MeshScalar>& mesh, int wall, const Moving& moving, const MotionFrame<Scalar>& start) noexcept {
    return std::exchange(plane_of(mesh, wall, moving, start).asked, motion_) != motion_;
  }
  /// What is below the tool's lowest vertex blocks the motion: no other triangle of that wall does so before its plane gives out.
  void meet(int wall) noexcept {
    Plane& plane = planes_[hash(wall) % plane_capacity];
    if (plane.wall == wall && plane.piece == piece_) plane.met = motion_;
  }
  bool has_met(int wall) const noexcept {
    const Plane& plane = planes_[hash(wall) % plane_capacity];
    return plane.wall == wall && plane.piece == piece_ && plane.met == motion_;
  }
  /// Whether the plane that parted a triangle of a wall before, its own, or that of a neighbour parts the tool from it.
  template <class MeshScalar, class Moving>
  bool parts_triangle(const TriangleMesh<MeshScalar>& mesh, int triangle, const Moving& moving, const MotionFrame<Scalar>& start,
                      const MotionFrame<Scalar>& end, const Clearance<Scalar>& clearance) noexcept {
    const int own = mesh.walls().of_triangle(triangle);
    if (own < 0) return false;
    RememberedPlane& remembered = remembered_[place_of(triangle)];
    if (remembered.triangle == triangle && remembered.piece == piece_) {
      const Plane& plane = refreshed(plane_of(mesh, remembered.wall, moving, start), moving, start, end, clearance);
      if (plane.is_front == remembered.is_front && parts(plane, remembered.height, clearance)) return note_parting(plane, remembered.height);
    }
    const auto parted_by = [&](int wall) {
      const Plane& plane = refreshed(plane_of(mesh, wall, moving, start), moving, start, end, clearance);
      const Scalar height = height_of(mesh, triangle, plane.heights.normal);
      if (!parts(plane, height, clearance)) return false;
      remembered = {triangle, std::int32_t(piece_), std::int32_t(wall), plane.is_front, height};
      return note_parting(plane, height);
    };
    if (parted_by(own)) return true;
    for (int k = 0; k < 3; ++k) {
      const int neighbour = mesh.topology().neighbour(triangle, k);
      if (neighbour < 0) continue;
      const RememberedPlane& others = remembered_[place_of(neighbour)];
      const int wall = others.triangle == neighbour && others.piece == piece_ ? others.wall : mesh.walls().of_triangle(neighbour);
      if (wall >= 0 && wall != own && parted_by(wall)) return true;
    }
    return false;
  }

  /// The plane that parted the last triangle, and how far the tool was above it where the motion starts [m].
  const Vector3<Scalar>& parting_normal() const noexcept { return parting_normal_; }
  Scalar parting_room() const noexcept { return parting_room_; }

  /// Heights found since this was last called.
  int take_evaluations() noexcept { return std::exchange(evaluations_, 0); }

 private:
  static constexpr std::size_t plane_capacity = 512, remembered_capacity = 1024;

  struct Plane {
    std::int32_t wall = 0;
    std::int32_t piece = -1;
    std::uint32_t motion = 0, end = 0;  // that its heights are of
    std::uint32_t asked = 0;            // motion in which `note_question` was called
    std::uint32_t met = 0;              // motion that is blocked below the lowest vertex
    std::uint32_t known = 0;            // motion before which a triangle of it was in the working set
    int vertex = 0;                     // of the tool, that was lowest
    bool is_front = true;               // the normal is that of the surface, not its opposite
    PlaneOnMotion<Scalar> heights = PlaneOnMotion<Scalar>();
    Scalar height = Scalar(0);  // of the wall, from the origin of the hierarchy [m]
    Scalar sagitta = Scalar(0);  // of the motion along it [m]
    Scalar limit = Scalar(0);   // what is as high is parted, in the same coordinates [m]
    Scalar offset = Scalar(0);  // of the motion's origin in them [m]
  };
  /// The plane that parted a triangle.
  struct RememberedPlane {
    std::int32_t triangle = -1;
    std::int32_t piece = -1;
    std::int32_t wall = 0;
    bool is_front = true;       // the side that the plane is seen from
    Scalar height = Scalar(0);  // of the triangle along the plane's normal, from the origin of the hierarchy [m]
  };

  std::size_t hash(int i) const noexcept { return std::size_t((std::uint32_t(i) * 2654435769U + std::uint32_t(piece_) * 40503U) >> 16U); }
  std::size_t place_of(int triangle) const noexcept { return hash(triangle) % remembered_capacity; }

  template <class MeshScalar>
  static Scalar height_of(const TriangleMesh<MeshScalar>& mesh, int triangle, const Vector3<Scalar>& normal) noexcept {
    const Matrix3<Scalar> corners = (mesh.corners(triangle).colwise() - mesh.bvh().origin()).template cast<Scalar>();
    return highest_corner(corners, normal);
  }

  /// The plane of a wall, seen from the side on which the tool is farther out of it.
  template <class MeshScalar, class Moving>
  Plane& plane_of(const TriangleMesh<MeshScalar>& mesh, int wall, const Moving& moving, const MotionFrame<Scalar>& start) noexcept {
    Plane& plane = planes_[hash(wall) % plane_capacity];
    if (plane.wall == wall && plane.piece == piece_) return plane;
    const int triangle = mesh.walls()[wall].triangle;
    plane = {};
    plane.wall = wall;
    plane.piece = piece_;
    const Vector3<Scalar> front = mesh.normal(triangle).template cast<Scalar>(), back = -front;
    const auto room = [&](const Vector3<Scalar>& normal) {
      return moving.lowest(normal, start) + normal.dot(to_mesh_) - height_of(mesh, triangle, normal);
    };
    plane.is_front = room(front) >= room(back);
    const Vector3<Scalar>& normal = plane.is_front ? front : back;
    plane.heights = PlaneOnMotion<Scalar>(normal);
    plane.height = height_of(mesh, triangle, normal) + Scalar(mesh.walls()[wall].flatness);
    evaluations_ += 2;
    return plane;
  }

  template <class Moving>
  Plane& refreshed(Plane& plane, const Moving& moving, const MotionFrame<Scalar>& start, const MotionFrame<Scalar>& end,
                   const Clearance<Scalar>& clearance) noexcept {
    PlaneOnMotion<Scalar>& heights = plane.heights;
    if (plane.motion != motion_) {
      if (keeps_axes_ && plane.motion != 0 && plane.end == last_end_) {
        heights.go_on(last_shift_);
      } else {
        heights.start = moving.lowest(heights.normal, start, plane.vertex);
        ++evaluations_;
      }
      plane.motion = motion_;
      plane.end = 0;
      plane.offset = heights.normal.dot(to_mesh_);
    }
    if (plane.end != end_) {
      plane.sagitta = moving.sagitta(heights.normal, end.time);
      if (moving.is_still()) {
        heights.end_at(heights.start, Scalar(0));
      } else {
        heights.end_at(moving.lowest(heights.normal, end, plane.vertex), plane.sagitta);
        ++evaluations_;
      }
      plane.limit = heights.least - clearance.kept + plane.offset;
      plane.end = end_;
    }
    return plane;
  }

  /// Notes the plane that parts a triangle; true.
  bool note_parting(const Plane& plane, Scalar height) noexcept {
    parting_normal_ = plane.heights.normal;
    parting_room_ = plane.heights.start + plane.offset - height;
    return true;
  }

  bool parts(const Plane& plane, Scalar height, const Clearance<Scalar>& clearance) const noexcept {
    if (height <= plane.limit) return true;
    const bool is_behind = plane.known == motion_ && height <= plane.height + clearance.kept / 1000;
    return (may_be_near_ || is_behind) && plane.heights.parts_closely(height - plane.offset, clearance);
  }

  int piece_ = 0;
  bool may_be_near_ = true;
  Vector3<Scalar> to_mesh_;  // from the origin of the hierarchy to that of the motion [m]
  bool keeps_axes_ = false;     // the tool is turned as where the last motion ended
  std::uint32_t motion_ = 0, end_ = 0, last_end_ = 0;  // counts
  Matrix3<Scalar> axes_at_end_ = Matrix3<Scalar>::Zero();
  Vector3<Scalar> shift_ = Vector3<Scalar>::Zero(), last_shift_ = Vector3<Scalar>::Zero();  // to the end of the motion at hand, and of the last [m]
  int evaluations_ = 0;
  Vector3<Scalar> parting_normal_ = Vector3<Scalar>::Zero();
  Scalar parting_room_ = Scalar(0);
  std::vector<Plane> planes_;
  std::vector<RememberedPlane> remembered_;
};

}  // namespace feeler
