// Closest points of points, segments and triangles in long double; shares nothing with the library.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace feeler::test {

using WideReal = long double;
static_assert(std::numeric_limits<WideReal>::digits > std::numeric_limits<double>::digits,
              "the checker needs a long double that is wider than double");
using WideVector = Eigen::Matrix<WideReal, 3, 1>;

namespace detail {

constexpr WideReal rounding = std::numeric_limits<WideReal>::epsilon();

/// Unit normal of the plane of two directions, for any length of the two; zero when they are parallel to the
/// last bit.
///
/// The cross product of directions at a small angle α has a relative error of rounding/α. Its part along `a`
/// is removed; what is left turns the normal about `a`, where the two directions span a width of α only, so
/// that the error of a separation measured along it is rounding × length, however small α is. No
/// near-parallel pair has to be skipped.
inline WideVector normal_of(const WideVector& a, const WideVector& b) {
  const WideVector unit_a = a.stableNormalized();
  WideVector normal = unit_a.cross(b.stableNormalized());
  if (!(normal.norm() > rounding)) return WideVector::Zero();
  normal.normalize();
  normal -= unit_a.dot(normal) * unit_a;
  return normal.normalized();
}

}  // namespace detail

/// A pair of points, one of either shape.
struct WidePair {
  WideReal distance = std::numeric_limits<WideReal>::infinity();
  WideVector on_first = WideVector::Zero(), on_second = WideVector::Zero();

  void take(const WideVector& first, const WideVector& second) {
    const WideReal d = (first - second).norm();
    if (d < distance) distance = d, on_first = first, on_second = second;
  }
};

inline WideVector closest_on_wide_segment(const WideVector& point, const WideVector& a, const WideVector& b) {
  const WideReal length = (b - a).squaredNorm();
  if (!(length > 0)) return a;
  return a + std::clamp((point - a).dot(b - a) / length, WideReal(0), WideReal(1)) * (b - a);
}

/// By the edges, and, where the foot of the perpendicular is inside all of them, by the plane.
inline WideVector closest_on_wide_triangle(const WideVector& point, const WideVector& a, const WideVector& b, const WideVector& c) {
  WidePair best;
  best.take(point, closest_on_wide_segment(point, a, b));
  best.take(point, closest_on_wide_segment(point, b, c));
  best.take(point, closest_on_wide_segment(point, c, a));
  const WideVector normal = detail::normal_of(b - a, c - a);
  if (normal.isZero(0)) return best.on_second;
  const WideVector foot = point - normal.dot(point - a) * normal;
  const auto side = [&](const WideVector& start, const WideVector& end) { return (end - start).cross(foot - start).dot(normal); };
  if (side(a, b) > 0 && side(b, c) > 0 && side(c, a) > 0) best.take(point, foot);
  return best.on_second;
}

inline void take_segments(const WideVector& a, const WideVector& b, const WideVector& c, const WideVector& d, WidePair& best) {
  best.take(a, closest_on_wide_segment(a, c, d));
  best.take(b, closest_on_wide_segment(b, c, d));
  best.take(closest_on_wide_segment(c, a, b), c);
  best.take(closest_on_wide_segment(d, a, b), d);
  const WideVector normal = detail::normal_of(b - a, d - c);
  if (normal.isZero(0)) return;
  // Where the lines cross as seen along their common normal.
  const WideVector u = b - a, v = d - c, w = c - a;
  const WideReal area = u.cross(v).dot(normal);
  const WideReal s = w.cross(v).dot(normal) / area, t = w.cross(u).dot(normal) / area;
  if (s > 0 && s < 1 && t > 0 && t < 1) best.take(a + s * u, c + t * v);
}

}  // namespace feeler::test
