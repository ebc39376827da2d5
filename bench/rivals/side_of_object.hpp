// On which side of an object a point is that was on the free side when it set out.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "support/penetration_checker.hpp"

namespace feeler::rivals {

/// A point inside a convex tool, and near the middle of any: the mean of its vertices, in the tool frame [m].
inline Eigen::Vector3d middle_of(const std::vector<test::CheckedTool>& pieces) {
  test::WideVector sum = test::WideVector::Zero();
  std::size_t count = 0;
  for (const auto& piece : pieces) {
    for (const auto& v : piece.vertices) sum += v, ++count;
  }
  return (sum / test::WideReal(count)).cast<double>();
}

/// Counts how often the way of a point crosses triangles: an odd number of times, and it is on the other
/// side.
///
/// So a sheet or a plate has sides without being closed, and a way around its rim is none through it. In
/// wider arithmetic, over every triangle, with nothing of the library.
class SideOfObject {
 public:
  /// @param object  outlives this
  SideOfObject(const test::CheckedObject& object, const Eigen::Vector3d& start)
      : object_(object), place_(start) {}

  bool is_other() const { return crossings_ % 2 != 0; }

  /// A straight line on from the last place [m].
  void move_to(const Eigen::Vector3d& place) {
    Eigen::AlignedBox3d way(place_);
    way.extend(place);
    for (std::size_t group = 0; group < object_.block_bounds.size(); ++group) {
      if (!object_.block_bounds[group].intersects(way)) continue;
      const std::size_t first = group * test::CheckedObject::block;
      for (std::size_t i = first; i < std::min(first + test::CheckedObject::block, object_.bounds.size());
           ++i) {
        if (object_.bounds[i].intersects(way) && is_crossed(int(i), place)) ++crossings_;
      }
    }
    place_ = place;
  }

 private:
  using Vector = test::WideVector;

  static bool is_positive(const Vector& a, const Vector& b, const Vector& c) {
    return a.dot(b.cross(c)) >= 0;
  }

  /// Ends on two sides of the plane, and all edges passed on the same side. An edge gives two triangles
  /// opposite signs, so none is passed between them.
  bool is_crossed(int triangle, const Eigen::Vector3d& place) const {
    const Vector a = place_.cast<test::WideReal>(), b = place.cast<test::WideReal>();
    std::array<Vector, 3> corners;
    for (int k = 0; k < 3; ++k) corners[std::size_t(k)] = object_.corner(triangle, k);
    const auto is_above = [&](const Vector& point) {
      return is_positive(corners[0] - point, corners[1] - point, corners[2] - point);
    };
    if (is_above(a) == is_above(b)) return false;
    const auto is_passed = [&](std::size_t from, std::size_t to) {
      return is_positive(b - a, corners[from] - a, corners[to] - a);
    };
    return is_passed(0, 1) == is_passed(1, 2) && is_passed(1, 2) == is_passed(2, 0);
  }

  const test::CheckedObject& object_;
  Eigen::Vector3d place_;
  long crossings_ = 0;
};

}  // namespace feeler::rivals
