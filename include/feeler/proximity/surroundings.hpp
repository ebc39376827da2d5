// What is near a tool that stands still: walls that are not known, and the ends of those that hold it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/coarse_planes.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/traversal_order.hpp"
#include "feeler/proximity/unpassed_triangles.hpp"

namespace feeler {

/// Finds triangles within a distance of a tool where a motion of it starts: one of each wall, which is what lies in one plane; and those at
/// the ends of a wall that holds the tool, which would turn if it were held between them alone.
template <ConvexTool Tool, class MeshScalar>
class Surroundings {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;

  /// Triangles looked at one by one that count as much work as one distance query.
  static constexpr int triangles_per_work = 8;

  /// @param within  what is farther is of no interest [m]
  Surroundings(const TriangleMesh<MeshScalar>& mesh, const MovingTool<Tool>& moving, const Clearance<Scalar>& clearance, Scalar within) noexcept
      : mesh_(mesh), moving_(moving), start_(moving.frame_at_start()), touching_(clearance.touching), flat_(clearance.none()), within_(within) {
    coarse_.begin(moving.origin() - mesh.bvh().origin().template cast<Scalar>(), Scalar(mesh.bounds().diagonal().norm()));
    for (int axis = 0; axis < 3; ++axis) {
      const Scalar lower = moving.lowest_along_axis(axis, Scalar(1), start_), upper = -moving.lowest_along_axis(axis, Scalar(-1), start_);
      coarse_.set_sides(axis, lower - within, upper + within);
    }
  }

  /// A world normal along which much may be far from the tool.
  void add_normal(const Vector& normal) noexcept { pass_below(normal, limit_along(normal)); }
  /// A triangle that is known, and the world normal along which it is near: what does not stand out of its wall is hidden.
  /// @param corners  a column each, relative to `MovingTool::origin()` [m]
  /// @param holds    the tool
  void add_known(const Matrix3<Scalar>& corners, const Vector& normal, bool holds) noexcept {
    const Scalar height = highest_corner(corners, normal);
    auto wall = std::find_if(walls_.begin(), walls_.end(), [&](const Wall& w) { return std::abs(w.height - height) < flat_ && is_same(w.normal, normal); });
    if (wall == walls_.end()) {
      if (!walls_.push_back(wall_of(normal, height, longest_side(corners)))) {
        pass_below(normal, height + flat_);
        return;
      }
      wall = &walls_.back();
      pass_below(normal, std::max(height - flat_, limit_along(normal)));
    }
    wall->holds = wall->holds || holds;
    for (End& end : wall->ends) end.reach = std::max(end.reach, end.reach_of(corners));
  }

  /// Calls `found(triangle)` for them. It gives up where one touches: where there is no clearance all of a fit does.
  /// @param work   grows by the work done
  /// @param limit  value of `work` at which it gives up
  /// @cost  noexcept, no allocation
  template <class Found>
  void visit(int& work, int limit, const Found& found) noexcept {
    int count = 0;
    const auto look_at = [&](int triangle) {
      work += ++count / triangles_per_work;
      count %= triangles_per_work;
      const Matrix3<Scalar> corners = mesh_.corners(triangle).template cast<Scalar>().colwise() - moving_.origin();
      if (is_hidden(triangle, corners) || is_passed(corners)) return true;
      ++work;
      const auto closest = gjk(moving_.tool(), moving_.in_tool(corners, start_), {}, touching_);
      if (closest.is_touching || closest.distance < flat_) return false;
      const Vector normal = start_.rotation * closest.normal;
      if (closest.distance < within_) {
        found(triangle);
        add_known(corners, normal, false);
      } else {
        add_normal(normal);
      }
      return true;
    };
    const auto plane_count = [this] { return planes_.size(); };
    const auto may_go_on = [&] { return work <= limit; };
    visit_unpassed(mesh_.bvh(), coarse_, plane_count, InBatches(Vector3<float>::Zero()), work, look_at, may_go_on);
    for (const Wall& wall : walls_) {
      for (const End& end : wall.ends) {
        if (end.triangle >= 0) found(end.triangle);
      }
    }
  }

 private:
  static constexpr int most_planes = 24, most_walls = 16;

  /// Passes what is no higher than a limit along a normal.
  struct Plane {
    Vector normal = Vector::Zero();
    Scalar limit = Scalar(0);
  };
  /// A corner of the part of a wall that the tool is over.
  struct End {
    Vector towards = Vector::Zero();                          // along the wall
    Scalar limit = Scalar(0);                                 // how far the tool reaches
    Scalar reach = -std::numeric_limits<Scalar>::infinity();  // of the farthest triangle so far
    int triangle = -1;                                        // that one, or none if it is known

    /// How far a triangle reaches, as far as the tool does.
    Scalar reach_of(const Matrix3<Scalar>& corners) const noexcept { return std::min(highest_corner(corners, towards), limit); }
  };
  struct Wall {
    Vector normal = Vector::Zero();
    Scalar height = Scalar(0);  // along it
    bool holds = false;         // the tool
    std::array<End, 4> ends{};
  };

  static bool is_same(const Vector& a, const Vector& b) noexcept {
    constexpr Scalar angle = Scalar(1e-9);
    return (a - b).squaredNorm() < angle * angle;
  }

  static Vector longest_side(const Matrix3<Scalar>& corners) noexcept {
    Vector longest = Vector::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector side = corners.col((k + 1) % 3) - corners.col(k);
      if (side.squaredNorm() > longest.squaredNorm()) longest = side;
    }
    return longest;
  }

  /// What is no higher along a normal is far from the tool.
  Scalar limit_along(const Vector& normal) const noexcept { return moving_.lowest(normal, start_) - within_; }

  /// @param side  a vector along the wall: its ends are looked for along the diagonals of a rectangle with that side
  Wall wall_of(const Vector& normal, Scalar height, const Vector& side) const noexcept {
    const Vector along = (side - normal.dot(side) * normal).normalized(), across = normal.cross(along);
    Wall wall{normal, height};
    wall.ends[0].towards = along + across;
    wall.ends[1].towards = along - across;
    wall.ends[2].towards = across - along;
    wall.ends[3].towards = -along - across;
    for (End& end : wall.ends) end.limit = -moving_.lowest(-end.towards, start_);
    return wall;
  }

  /// Whether a triangle does not stand out of a wall that is known; one that lies in it may be at an end.
  bool is_hidden(int triangle, const Matrix3<Scalar>& corners) noexcept {
    for (Wall& wall : walls_) {
      if (highest_corner(corners, wall.normal) > wall.height + flat_) continue;
      if (wall.holds && -highest_corner(corners, Vector(-wall.normal)) > wall.height - flat_) note_end(wall, triangle, corners);
      return true;
    }
    return false;
  }
  void note_end(Wall& wall, int triangle, const Matrix3<Scalar>& corners) const noexcept {
    for (End& end : wall.ends) {
      const Scalar reach = end.reach_of(corners);
      if (!(reach > end.reach + within_)) continue;
      end.reach = reach;
      end.triangle = triangle;
    }
  }

  bool is_passed(const Matrix3<Scalar>& corners) const noexcept {
    return std::any_of(planes_.begin(), planes_.end(), [&corners](const Plane& plane) { return highest_corner(corners, plane.normal) <= plane.limit; });
  }

  /// Of planes with one normal it keeps the highest; where there are too many the last gives way.
  void pass_below(const Vector& normal, Scalar limit) noexcept {
    int place = 0;
    while (place < planes_.size() && !is_same(planes_[place].normal, normal)) ++place;
    if (place == planes_.size() && !planes_.push_back({normal, limit})) planes_[--place] = {normal, limit};
    planes_[place].limit = std::max(planes_[place].limit, limit);
    coarse_.set_plane(place, planes_[place].normal, planes_[place].limit);
  }

  const TriangleMesh<MeshScalar>& mesh_;
  const MovingTool<Tool>& moving_;
  MotionFrame<Scalar> start_;
  Scalar touching_, flat_, within_;
  FixedVector<Plane, most_planes> planes_;
  FixedVector<Wall, most_walls> walls_;
  CoarsePlanes<Scalar, most_planes> coarse_;
};

}  // namespace feeler
