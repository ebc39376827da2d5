// Closest points of a convex tool and a triangle, by the algorithm of Gilbert, Johnson and Keerthi.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/closest_on_simplex.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// The features on which a query ended, to start the next one from: pairs of tool vertex and triangle corner. Where shapes overlap, three of
/// the four around what they share.
struct WitnessFeatures {
  int size = 0;
  std::array<short, 3> tool_vertices{};
  std::array<short, 3> corners{};
};

/// Result of `gjk`, in the tool frame. Of a swept tool the distance is that of its surface, all else is its core's.
template <class Scalar>
struct ClosestPoints {
  bool is_touching = false;  ///< the shapes touch or overlap to rounding: the normal means nothing
  Vector3<Scalar> normal = Vector3<Scalar>::UnitZ();  ///< unit, from the triangle to the tool
  Scalar distance = Scalar(0);                        ///< least separation along the normal [m]; a proof, not an estimate
  Vector3<Scalar> tool_point = Vector3<Scalar>::Zero();
  Vector3<Scalar> triangle_point = Vector3<Scalar>::Zero();
  WitnessFeatures features;
};

/// Closest points of a tool and a triangle.
///
/// Minimises |x − y| over x in the tool and y in the triangle (E. Gilbert, D. Johnson, S. Keerthi, IEEE J. Robotics and Automation 4,
/// 1988). The distance returned is min n·x − max n·y for the unit normal n returned, so it is a lower bound whatever rounding did.
/// @param triangle  3×3, a corner a column, in the tool frame [m]; may be degenerate
/// @param warm      features of an earlier query, or empty
/// @param touching_distance  below it the shapes count as touching [m]
/// @cost  noexcept, no allocation, at most 32 support calls, mostly 2 to 5
template <ConvexTool Tool>
[[gnu::flatten, gnu::noinline]]
ClosestPoints<typename Tool::Scalar> gjk(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                         const WitnessFeatures& warm,
                                         typename Tool::Scalar touching_distance) noexcept {
  using Scalar = typename Tool::Scalar;
  using std::sqrt;
  constexpr int maximum_iterations = 32;
  constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

  const auto corner_along = [&triangle](const Vector3<Scalar>& direction) {
    const Vector3<Scalar> heights = triangle.transpose() * direction;
    int best = heights[1] > heights[0] ? 1 : 0;
    return heights[2] > heights[best] ? 2 : best;
  };
  detail::Simplex<Scalar> simplex;
  Scalar size(0);  // of the tool, as far as it is looked at [m]
  const auto add = [&](int vertex, int corner) {
    const auto i = std::size_t(simplex.size++);
    const Vector3<Scalar> point = tool.vertex(vertex);
    size = std::max(size, point.template lpNorm<Eigen::Infinity>());
    simplex.points[i] = point - triangle.col(corner);
    simplex.tool_vertices[i] = vertex;
    simplex.corners[i] = corner;
  };
  if (warm.size > 0) {
    for (std::size_t i = 0; i < std::size_t(warm.size); ++i) add(warm.tool_vertices[i], warm.corners[i]);
  } else {
    const Vector3<Scalar> towards = triangle.rowwise().mean() - tool.vertex(0);
    const int vertex = tool.support(towards);
    add(vertex, corner_along(Vector3<Scalar>(tool.vertex(vertex) - triangle.rowwise().mean())));
  }
  reduce_to_closest(simplex);

  ClosestPoints<Scalar> result;
  Scalar best_distance = -std::numeric_limits<Scalar>::infinity();
  for (int iteration = 0; iteration < maximum_iterations; ++iteration) {
    const Vector3<Scalar> v = simplex.closest;
    const Scalar length_squared = v.squaredNorm();
    if (!(length_squared > touching_distance * touching_distance)) {
      result.is_touching = true;
      break;
    }
    const Scalar length = sqrt(length_squared);
    const Vector3<Scalar> normal = v / length;
    const int vertex = tool.support(Vector3<Scalar>(-normal));
    const int corner = corner_along(normal);
    const Scalar distance = normal.dot(tool.vertex(vertex) - triangle.col(corner));
    if (distance > best_distance) {
      best_distance = distance;
      result.normal = normal;
      result.distance = distance;
    }
    if (length - distance <= Scalar(1e-12) * length + 4 * epsilon * size) break;
    bool is_known = false;
    for (std::size_t i = 0; i < std::size_t(simplex.size); ++i) {
      is_known = is_known || (simplex.tool_vertices[i] == vertex && simplex.corners[i] == corner);
    }
    if (is_known) break;
    const detail::Simplex<Scalar> last = simplex;
    add(vertex, corner);
    const bool is_apart = reduce_to_closest(simplex);
    if (is_apart && simplex.closest.squaredNorm() < length_squared) continue;
    // No closer, or around the origin though a plane parts the shapes: the simplex is flat to rounding, as the four points of two
    // edges are. The points before the last one stand.
    result.is_touching = !is_apart && !(best_distance > touching_distance);
    if (!result.is_touching) simplex = last;
    break;
  }
  result.features.size = std::min(simplex.size, 3);
  for (std::size_t i = 0; i < std::size_t(result.features.size); ++i) {
    result.features.tool_vertices[i] = short(simplex.tool_vertices[i]);
    result.features.corners[i] = short(simplex.corners[i]);
    result.tool_point += simplex.weights[i] * tool.vertex(simplex.tool_vertices[i]);
    result.triangle_point += simplex.weights[i] * triangle.col(simplex.corners[i]);
  }
  return result;
}

/// Closest points of the core of a swept tool and a triangle, and the distance of its surface: less by the radius, and negative where the ball
/// overlaps the triangle. The algorithm compares squares, so that at a distance it knows the direction to √ε only, which a large triangle
/// makes into nanometres: where the triangle's own plane shows as much distance, it is taken.
template <SweptTool Tool>
[[gnu::flatten, gnu::noinline]]
ClosestPoints<typename Tool::Scalar> gjk(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                         const WitnessFeatures& warm,
                                         typename Tool::Scalar touching_distance) noexcept {
  using Scalar = typename Tool::Scalar;
  auto closest = gjk(tool.core(), triangle, warm, touching_distance);
  const Vector3<Scalar> across = Vector3<Scalar>(triangle.col(1) - triangle.col(0)).cross(Vector3<Scalar>(triangle.col(2) - triangle.col(0)));
  const Scalar area = across.norm();
  if (area > Scalar(0) && !closest.is_touching) {
    const Vector3<Scalar> normal = across / (across.dot(closest.normal) < Scalar(0) ? -area : area);
    const int vertex = tool.support(Vector3<Scalar>(-normal));
    const Scalar distance = normal.dot(tool.vertex(vertex)) - highest_corner(triangle, normal);
    if (distance >= closest.distance) {
      closest.normal = normal;
      closest.distance = distance;
    }
  }
  closest.distance -= tool.swept_radius();
  return closest;
}

}  // namespace feeler
