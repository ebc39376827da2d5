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
  SideOfObject(const test::CheckedObject& object, const Eigen::Vector3d& start) : object_(object), place_(start) {}

  bool is_other() const { return crossings_ % 2 != 0; }

  /// A straight line on from the last place [m]; in short steps, or the line cuts a corner that the way went
  /// around.
  void move_to(const Eigen::Vector3d& place) {
    Eigen::AlignedBox3d way(place_);
    way.extend(place);
    for (std::size_t group = 0; group < object_.block_bounds.size(); ++group) {
      if (!object_.block_bounds[group].intersects(way)) continue;
      const std::size_t first = group * test::CheckedObject::block;
      for (std::size_t i = first; i < std::min(first + test::CheckedObject::block, object_.bounds.size()); ++i) {
        if (object_.bounds[i].intersects(way) && is_crossed(int(i), place)) ++crossings_;
      }
    }
    place_ = place;
  }

 private:
  using Vector = test::WideVector;

  static test::WideReal volume(const Vector& a, const Vector& b, const Vector& c) { return a.dot(b.cross(c)); }

  /// On which side the line through a along `way` passes an edge. Reversed, the edge has the other sign to
  /// the last bit, and where the line meets it, the order of its ends decides: of two triangles that share
  /// it, exactly one is crossed.
  static bool is_passed_left(const Vector& a, const Vector& way, const Vector& from, const Vector& to) {
    const test::WideReal v = volume(way, from - a, to - a);
    if (v != 0) return v > 0;
    return std::lexicographical_compare(from.data(), from.data() + 3, to.data(), to.data() + 3);
  }

  /// Ends on two sides of the plane, and all edges passed on the same side.
  bool is_crossed(int triangle, const Eigen::Vector3d& place) const {
    const Vector a = place_.cast<test::WideReal>(), b = place.cast<test::WideReal>();
    std::array<Vector, 3> corners;
    for (int k = 0; k < 3; ++k) corners[std::size_t(k)] = object_.corner(triangle, k);
    const auto is_above = [&](const Vector& point) { return volume(corners[0] - point, corners[1] - point, corners[2] - point) >= 0; };
    if (is_above(a) == is_above(b)) return false;
    const bool first = is_passed_left(a, b - a, corners[0], corners[1]);
    return first == is_passed_left(a, b - a, corners[1], corners[2]) && first == is_passed_left(a, b - a, corners[2], corners[0]);
  }

  const test::CheckedObject& object_;
  Eigen::Vector3d place_;
  long crossings_ = 0;
};

}  // namespace feeler::rivals
