// The points of a convex hull on an integer lattice, and four of them to start from.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/tool/lattice.hpp"

namespace feeler::detail {

/// The points of a hull on an integer lattice over their bounding box, where sides of planes are decided exactly; or what is wrong with them.
template <RealScalar Scalar>
struct HullLattice {
  using Working = WorkingScalar<Scalar>;

  std::vector<LatticePoint> points;
  long double tolerance = 0;  // in lattice units
  std::string reason;         // against a hull; the rest is then of no use

  explicit HullLattice(const Points<Scalar>& input) {
    if (input.rows() < 4) {
      reason = "ConvexPolytope: " + std::to_string(input.rows()) + " points have no volume; give at least 4, or use Segment for a line";
      return;
    }
    for (int i = 0; i < int(input.rows()); ++i) {
      if (input.row(i).allFinite()) continue;
      reason = "ConvexPolytope: point " + std::to_string(i) + " has a NaN or an infinity; remove it or correct its coordinates";
      return;
    }
    const Points<Working> wide = input.template cast<Working>();
    const Eigen::Matrix<Working, 1, 3> lower = wide.colwise().minCoeff();
    const Eigen::Matrix<Working, 1, 3> sides = wide.colwise().maxCoeff() - lower;
    const Working side = sides.maxCoeff();
    if (!(side > Working(0))) {
      reason = "ConvexPolytope: all points are equal; give at least 4 that are not in one plane";
      return;
    }
    if (!sides.allFinite()) {
      reason = "ConvexPolytope: the points are too far apart for the scalar; give metres";
      return;
    }
    using std::ldexp;
    const auto on_lattice = [&](const Working& x) { return static_cast<std::int64_t>(ldexp(Working(x / side), lattice_bits)); };
    points.reserve(std::size_t(wide.rows()));
    for (int i = 0; i < int(wide.rows()); ++i)
      points.push_back({on_lattice(wide(i, 0) - lower[0]), on_lattice(wide(i, 1) - lower[1]), on_lattice(wide(i, 2) - lower[2])});
    const Working size = (sides / side).norm() + wide.cwiseAbs().maxCoeff() / side;
    tolerance = static_cast<long double>(ldexp(Working(4 * Working(std::numeric_limits<Scalar>::epsilon()) * size), lattice_bits));
    tolerance = (std::max)(tolerance, 4.0L);
  }

  /// Four points far apart: the ends of the longest axis, the point farthest from their line, the point farthest from their plane.
  /// Points thinner than `thinnest` span none: the sides of planes through them would be matters of rounding.
  std::array<int, 4> simplex(const std::vector<LatticePoint>& corners) {
    std::array<int, 4> result{};
    std::int64_t longest = -1;
    for (const auto axis : {&LatticePoint::x, &LatticePoint::y, &LatticePoint::z}) {
      const auto [low, high] =
          std::minmax_element(corners.begin(), corners.end(), [axis](const auto& a, const auto& b) { return a.*axis < b.*axis; });
      if ((*high).*axis - (*low).*axis <= longest) continue;
      longest = (*high).*axis - (*low).*axis;
      result[0] = int(low - corners.begin());
      result[1] = int(high - corners.begin());
    }
    const auto& a = corners[std::size_t(result[0])];
    const auto& b = corners[std::size_t(result[1])];
    long double width = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const long double height = LatticePlane(a, b, corners[i]).length();
      if (height > width) {
        width = height;
        result[2] = int(i);
      }
    }
    const long double base = std::sqrt(square(b.x - a.x) + square(b.y - a.y) + square(b.z - a.z));
    const long double thinnest = 16 * tolerance;
    if (!(width > thinnest * base)) {
      reason = "ConvexPolytope: all points are on one line; give points with a volume, or use Segment";
      return result;
    }
    const LatticePlane plane(a, b, corners[std::size_t(result[2])]);
    long double thickness = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const long double height = std::abs(plane.height(corners[i]));
      if (height > thickness) {
        thickness = height;
        result[3] = int(i);
      }
    }
    if (!(thickness > thinnest)) reason = "ConvexPolytope: all points are in one plane; give points with a volume, for a sheet two layers of them";
    return result;
  }

 private:
  static long double square(std::int64_t x) { return static_cast<long double>(x) * static_cast<long double>(x); }
};

}  // namespace feeler::detail
