// Where a face of the tool that lies on a wall ends over the rim of that wall.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// The outermost points of where a convex face lies over a wall, as far as they are points of the wall's rim: in each of eight directions the
/// triangle that has it. Such a face is held there, and at those of its vertices that are over the wall; what is between them holds it no better.
///
/// Each edge of the rim is clipped by the face (Cyrus and Beck, 1978), seen along the wall's normal.
template <class Scalar, class MeshScalar>
class OutermostAtRim {
 public:
  using Vector = Vector3<Scalar>;
  static constexpr int capacity = 128;  ///< vertices of a face; of more some are left out, which makes it smaller

  /// @param count    of the corners of the face
  /// @param corner   `corner(i)`, anticlockwise about its normal [m]
  /// @param outward  that normal
  template <class Corner>
  OutermostAtRim(const TriangleMesh<MeshScalar>& mesh, int wall, int count, const Corner& corner, const Vector& outward) noexcept
      : mesh_(mesh),
        wall_(wall),
        normal_(mesh.normal(mesh.walls()[wall].triangle).template cast<Scalar>()),
        is_clockwise_(normal_.dot(outward) < Scalar(0)) {
    origin_ = corner(0);
    along_ = corner(1) - origin_;
    along_ = (along_ - normal_.dot(along_) * normal_).normalized();
    across_ = normal_.cross(along_);
    Vector lower = origin_, upper = origin_;
    const int stride = (count + capacity - 1) / capacity;
    for (int i = 0; i < count; i += stride) {
      const Vector point = corner(i);
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
      face_.push_back(flat(point));
    }
    const Wall& plane = mesh.walls()[wall];
    const Scalar around = Scalar(plane.flatness) + (upper - lower).norm() / 1000;  // the face lies a little above the wall
    const Vector centre = mesh.vertex(mesh.triangle(plane.triangle)[0]).template cast<Scalar>(), extent = Vector::Constant(Scalar(plane.radius));
    lower = lower.cwiseMax(centre - extent);
    upper = upper.cwiseMin(centre + extent);
    const Vector to_boxes = mesh.bvh().origin().template cast<Scalar>();
    lower_ = lower - to_boxes - Vector::Constant(around);
    upper_ = upper - to_boxes + Vector::Constant(around);
    outermost_.fill(-std::numeric_limits<Scalar>::infinity());
    triangles_.fill(-1);
  }

  /// Calls `visit(triangle)` for each, some more than once.
  /// @param is_preferred  of triangles that share a point
  /// @cost  the nodes of the hierarchy at the rim, in the box of the face
  template <class IsPreferred, class Visit>
  void find(const IsPreferred& is_preferred, const Visit& visit) noexcept {
    FixedVector<std::int32_t, Bvh<MeshScalar>::stack_capacity> stack;
    stack.push_back(0);
    const auto& walls = mesh_.walls();
    while (!stack.empty()) {
      const std::int32_t entry = stack.back();
      stack.pop_back();
      if (BvhNode::is_leaf(entry)) {
        for (const std::int32_t triangle : mesh_.bvh().leaves()[std::size_t(~entry)].triangle) {
          if (triangle >= 0 && walls.of_triangle(triangle) == wall_) look_at(triangle, is_preferred);
        }
        continue;
      }
      const BvhNode& node = mesh_.bvh().nodes()[std::size_t(entry)];
      for (std::size_t i = 0; i < std::size_t(BvhNode::width); ++i) {
        const int under = walls.under(entry)[i];
        if (node.child[i] == 0 || (under >= 0 && under != wall_) || walls.is_inside(entry, i) || is_apart(node, i)) continue;
        stack.push_back(node.child[i]);
      }
    }
    for (const int triangle : triangles_) {
      if (triangle >= 0) visit(triangle);
    }
  }

 private:
  using Point = Eigen::Matrix<Scalar, 2, 1>;

  Point flat(const Vector& point) const noexcept { return {along_.dot(point - origin_), across_.dot(point - origin_)}; }

  bool is_apart(const BvhNode& node, std::size_t i) const noexcept {
    for (int k = 0; k < 3; ++k) {
      if (upper_[k] < Scalar(node.lower[k][i]) || lower_[k] > Scalar(node.upper[k][i])) return true;
    }
    return false;
  }

  template <class IsPreferred>
  void look_at(int triangle, const IsPreferred& is_preferred) noexcept {
    const auto& corners = mesh_.triangle(triangle);
    for (int k = 0; k < 3; ++k) {
      const int neighbour = mesh_.topology().neighbour(triangle, k);
      if (neighbour >= 0 && mesh_.walls().of_triangle(neighbour) == wall_) continue;
      const Point start = flat(mesh_.vertex(corners[std::size_t(k)]).template cast<Scalar>()),
                  end = flat(mesh_.vertex(corners[std::size_t((k + 1) % 3)]).template cast<Scalar>());
      Scalar first(0), last(1);
      if (!clip(start, end, first, last)) continue;
      const bool is_first = is_preferred(triangle);
      for (const Scalar& t : {first, last}) take(Point(start + t * (end - start)), triangle, is_first);
    }
  }

  /// The part of an edge over the face.
  bool clip(const Point& start, const Point& end, Scalar& first, Scalar& last) const noexcept {
    for (int i = 0; i < face_.size(); ++i) {
      const Point side = face_[(i + 1) % face_.size()] - face_[i];
      const auto inside = [&](const Point& point) {
        const Scalar area = side.x() * (point.y() - face_[i].y()) - side.y() * (point.x() - face_[i].x());
        return is_clockwise_ ? -area : area;
      };
      const Scalar a = inside(start), b = inside(end);
      if (a < Scalar(0) && b < Scalar(0)) return false;
      if (a < Scalar(0)) first = (std::max)(first, a / (a - b));
      else if (b < Scalar(0)) last = (std::min)(last, a / (a - b));
    }
    return first <= last;
  }

  void take(const Point& point, int triangle, bool is_preferred) noexcept {
    using std::abs;
    const Scalar tie = (abs(point.x()) + abs(point.y())) / 1000000;
    for (std::size_t i = 0; i < directions; ++i) {
      constexpr std::array<int, directions> x{1, 1, 0, -1, -1, -1, 0, 1}, y{0, 1, 1, 1, 0, -1, -1, -1};
      const Scalar distance = Scalar(x[i]) * point.x() + Scalar(y[i]) * point.y();
      if (!(distance > outermost_[i] + (is_preferred ? -tie : tie))) continue;
      outermost_[i] = (std::max)(outermost_[i], distance);
      triangles_[i] = triangle;
    }
  }

  static constexpr std::size_t directions = 8;

  const TriangleMesh<MeshScalar>& mesh_;
  int wall_;
  Vector normal_;  // of the wall
  bool is_clockwise_;  // the face, seen from there
  Vector origin_, along_, across_;  // a corner of the face, and two axes from it in the wall
  Vector lower_, upper_;  // box of the face, from the origin of the hierarchy [m]
  FixedVector<Point, capacity> face_;  // along those axes [m]
  std::array<Scalar, directions> outermost_;
  std::array<int, directions> triangles_;
};

}  // namespace feeler
