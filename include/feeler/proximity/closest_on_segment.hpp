// Closest points of a point, a segment and a triangle, feature by feature.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"

namespace feeler {

/// The point of a segment nearest to a point; a segment may be a point.
template <class Scalar>
Vector3<Scalar> closest_on_segment(const Vector3<Scalar>& point, const Vector3<Scalar>& start, const Vector3<Scalar>& end) noexcept {
  const Vector3<Scalar> along = end - start;
  const Scalar length_squared = along.squaredNorm();
  if (!(length_squared > Scalar(0))) return start;
  const Scalar t = along.dot(point - start) / length_squared;
  return start + std::clamp(t, Scalar(0), Scalar(1)) * along;
}

/// Where two segments cross as seen along their common perpendicular.
template <class Scalar>
struct SegmentCrossing {
  bool exists = false;  ///< false where they are parallel to rounding, or cross beyond an end
  Vector3<Scalar> on_first = Vector3<Scalar>::Zero();
  Vector3<Scalar> on_second = Vector3<Scalar>::Zero();
};

template <class Scalar>
SegmentCrossing<Scalar> crossing_of_segments(const Vector3<Scalar>& first_start, const Vector3<Scalar>& first_end,
                                             const Vector3<Scalar>& second_start, const Vector3<Scalar>& second_end) noexcept {
  SegmentCrossing<Scalar> result;
  const Vector3<Scalar> u = first_end - first_start, v = second_end - second_start, between = second_start - first_start;
  const Vector3<Scalar> normal = u.cross(v);
  const Scalar area_squared = normal.squaredNorm();
  const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
  if (!(area_squared > rounding * rounding * u.squaredNorm() * v.squaredNorm())) return result;
  const Scalar s = between.cross(v).dot(normal) / area_squared, t = between.cross(u).dot(normal) / area_squared;
  if (!(s >= Scalar(0) && s <= Scalar(1) && t >= Scalar(0) && t <= Scalar(1))) return result;
  result.exists = true;
  result.on_first = first_start + s * u;
  result.on_second = second_start + t * v;
  return result;
}

/// The point of a triangle nearest to a point.
/// @param triangle  3×3, one corner in each column [m]; may be degenerate
/// @param normal    its unit normal, or zero where it is degenerate
template <class Scalar>
Vector3<Scalar> closest_on_triangle(const Vector3<Scalar>& point, const Matrix3<Scalar>& triangle, const Vector3<Scalar>& normal) noexcept {
  bool is_over = !normal.isZero(Scalar(0));
  Vector3<Scalar> closest = triangle.col(0);
  Scalar least = std::numeric_limits<Scalar>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3<Scalar> start = triangle.col(k), end = triangle.col((k + 1) % 3);
    is_over = is_over && (end - start).cross(point - start).dot(normal) >= Scalar(0);
    const Vector3<Scalar> candidate = closest_on_segment<Scalar>(point, start, end);
    const Scalar distance_squared = (candidate - point).squaredNorm();
    if (distance_squared < least) {
      least = distance_squared;
      closest = candidate;
    }
  }
  if (!is_over) return closest;
  return point - normal.dot(point - triangle.col(0)) * normal;
}

}  // namespace feeler
