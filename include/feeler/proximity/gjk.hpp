// Closest points of a convex tool and a triangle, by the algorithm of Gilbert, Johnson and Keerthi.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_normal.hpp"
#include "feeler/proximity/closest_on_simplex.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/near_part.hpp"
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

namespace detail {

/// A triangle as a query sees it: corners, and the one that is highest along a direction.
template <class Scalar>
struct WholeTriangle {
  const Matrix3<Scalar>& corners;

  Vector3<Scalar> corner(int i) const noexcept { return corners.col(i); }
  Vector3<Scalar> middle() const noexcept { return corners.rowwise().mean(); }
  int highest(const Vector3<Scalar>& direction) const noexcept {
    const Vector3<Scalar> heights = corners.transpose() * direction;
    const int best = heights[1] > heights[0] ? 1 : 0;
    return heights[2] > heights[best] ? 2 : best;
  }
};

/// The same of a part of a triangle.
template <class Scalar>
struct PartOfTriangle {
  const CutTriangle<Scalar>& corners;

  Vector3<Scalar> corner(int i) const noexcept { return corners[i].point; }
  Vector3<Scalar> middle() const noexcept {
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    for (const auto& corner : corners) sum += corner.point;
    return sum / Scalar(corners.size());
  }
  int highest(const Vector3<Scalar>& direction) const noexcept {
    int best = 0;
    for (int i = 1; i < corners.size(); ++i) {
      if (direction.dot(corners[i].point) > direction.dot(corners[best].point)) best = i;
    }
    return best;
  }
};

/// A query, and how far its bounds on the distance are apart [m].
template <class Scalar>
struct GjkResult {
  ClosestPoints<Scalar> closest;
  Simplex<Scalar> simplex;
  Scalar upper_bound = Scalar(0);  ///< of the distance [m]
  Scalar size = Scalar(0);         ///< of the tool, as far as it was looked at [m]
};

/// Adds the difference of a tool vertex and a corner to the simplex of a query.
template <ConvexTool Tool, class Object>
void add_pair(const Tool& tool, const Object& object, int vertex, int corner, GjkResult<typename Tool::Scalar>& query) noexcept {
  using Scalar = typename Tool::Scalar;
  Simplex<Scalar>& simplex = query.simplex;
  const auto i = std::size_t(simplex.size++);
  const Vector3<Scalar> point = tool.vertex(vertex);
  query.size = (std::max)(query.size, point.template lpNorm<Eigen::Infinity>());
  simplex.points[i] = point - object.corner(corner);
  simplex.tool_vertices[i] = vertex;
  simplex.corners[i] = corner;
}

/// Makes the simplex that a query starts from: the features of an earlier one, or a point along the way between the middles.
template <ConvexTool Tool, class Object>
void start_simplex(const Tool& tool, const Object& object, const WitnessFeatures& warm, GjkResult<typename Tool::Scalar>& query) noexcept {
  using Scalar = typename Tool::Scalar;
  if (warm.size > 0) {
    for (std::size_t i = 0; i < std::size_t(warm.size); ++i) add_pair(tool, object, warm.tool_vertices[i], warm.corners[i], query);
  } else {
    const Vector3<Scalar> towards = object.middle() - tool.vertex(0);
    const int vertex = tool.support(towards);
    add_pair(tool, object, vertex, object.highest(Vector3<Scalar>(tool.vertex(vertex) - object.middle())), query);
  }
  reduce_to_closest(query.simplex);
}

/// Whether a simplex has the difference of a tool vertex and a corner: then no point leads nearer to the origin.
template <class Scalar>
bool has_pair(const Simplex<Scalar>& simplex, int vertex, int corner) noexcept {
  bool is_known = false;
  for (std::size_t i = 0; i < std::size_t(simplex.size); ++i) {
    is_known = is_known || (simplex.tool_vertices[i] == vertex && simplex.corners[i] == corner);
  }
  return is_known;
}

/// The iteration of Gilbert, Johnson and Keerthi: the simplex of differences comes closer to the origin by one support point at a time.
template <ConvexTool Tool, class Object>
[[gnu::always_inline]] inline GjkResult<typename Tool::Scalar> run_gjk(const Tool& tool, const Object& object, const WitnessFeatures& warm,
                                                                       typename Tool::Scalar touching_distance) noexcept {
  using Scalar = typename Tool::Scalar;
  using std::sqrt;
  constexpr int maximum_iterations = 32;
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

  GjkResult<Scalar> answer;
  Simplex<Scalar>& simplex = answer.simplex;
  ClosestPoints<Scalar>& result = answer.closest;
  start_simplex(tool, object, warm, answer);

  Scalar best_distance = -std::numeric_limits<Scalar>::infinity();
  for (int iteration = 0; iteration < maximum_iterations; ++iteration) {
    const Vector3<Scalar> v = simplex.closest;
    const Scalar length_squared = v.squaredNorm();
    if (!(length_squared > touching_distance * touching_distance)) {
      result.is_touching = true;
      break;
    }
    const Scalar length = sqrt(length_squared);
    answer.upper_bound = length;
    const Vector3<Scalar> normal = v / length;
    const int vertex = tool.support(Vector3<Scalar>(-normal));
    const int corner = object.highest(normal);
    const Scalar distance = normal.dot(tool.vertex(vertex) - object.corner(corner));
    if (distance > best_distance) {
      best_distance = distance;
      result.normal = normal;
      result.distance = distance;
    }
    if (length - distance <= Scalar(1e-12) * length + 4 * epsilon * answer.size) break;
    if (has_pair(simplex, vertex, corner)) break;
    const Simplex<Scalar> last = simplex;
    add_pair(tool, object, vertex, corner, answer);
    const bool is_apart = reduce_to_closest(simplex);
    if (is_apart && simplex.closest.squaredNorm() < length_squared) continue;
    // No closer, or around the origin though a plane parts the shapes: the simplex is flat to rounding, as the four points of two
    // edges are. The points before the last one stand.
    result.is_touching = !is_apart && !(best_distance > touching_distance);
    if (!result.is_touching) simplex = last;
    break;
  }
  return answer;
}

/// Closest points of a tool and the part of a large triangle that is near it; where there is none, what is known stands.
///
/// The normal is that of the whole triangle's feature: perpendicular to its face or edge to rounding, so that it parts far corners too.
template <ConvexTool Tool>
[[gnu::noinline]]
ClosestPoints<typename Tool::Scalar> closest_to_large(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                                      const GjkResult<typename Tool::Scalar>& known, typename Tool::Scalar touching_distance,
                                                      ClosestPoints<typename Tool::Scalar> closest) noexcept {
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  const auto part = near_part(tool, triangle, 2 * known.upper_bound);
  if (part.empty()) return closest;
  const auto answer = run_gjk(tool, PartOfTriangle<Scalar>{part}, {}, touching_distance);
  if (answer.closest.is_touching) return closest;
  unsigned mask = 0;
  FixedVector<short, 3> vertices, corners;
  closest.tool_point = closest.triangle_point = Vector::Zero();
  for (std::size_t i = 0; i < std::size_t((std::min)(answer.simplex.size, 3)); ++i) {
    const PartCorner<Scalar>& corner = part[answer.simplex.corners[i]];
    mask |= corner.corners;
    closest.tool_point += answer.simplex.weights[i] * tool.vertex(answer.simplex.tool_vertices[i]);
    closest.triangle_point += answer.simplex.weights[i] * corner.point;
    const short vertex = short(answer.simplex.tool_vertices[i]);
    if (std::find(vertices.begin(), vertices.end(), vertex) == vertices.end()) vertices.push_back(vertex);
  }
  for (int k = 0; k < 3; ++k) {
    if ((mask >> unsigned(k) & 1U) != 0) corners.push_back(short(k));
  }
  closest.features.size = (std::max)(vertices.size(), corners.size());
  for (int i = 0; i < closest.features.size; ++i) {
    closest.features.tool_vertices[std::size_t(i)] = vertices[(std::min)(i, vertices.size() - 1)];
    closest.features.corners[std::size_t(i)] = corners[(std::min)(i, corners.size() - 1)];
  }
  Vector normal = answer.closest.normal;
  if (corners.size() == 2) {
    const Vector along = (triangle.col(corners[1]) - triangle.col(corners[0])).stableNormalized();
    normal = (normal - along.dot(normal) * along).normalized();
  }
  const auto attempt = [&](const Vector& candidate) {
    const Scalar distance = candidate.dot(tool.vertex(tool.support(Vector(-candidate)))) - highest_corner(triangle, candidate);
    if (!(distance > closest.distance)) return;
    closest.normal = candidate;
    closest.distance = distance;
  };
  attempt(normal);
  const Vector own = triangle_normal<Scalar>(triangle.col(0), triangle.col(1), triangle.col(2));
  if (!own.isZero(Scalar(0))) attempt(own.dot(normal) < Scalar(0) ? Vector(-own) : own);
  return closest;
}

}  // namespace detail

/// Closest points of a tool and a triangle.
///
/// Minimises |x − y| over x in the tool and y in the triangle (E. Gilbert, D. Johnson, S. Keerthi, IEEE J. Robotics and Automation 4,
/// 1988). The distance returned is min n·x − max n·y for the unit normal n returned, so it is a lower bound whatever rounding did. Where a triangle
/// is so large that rounding keeps the bounds apart, the part of it that is near the tool decides.
/// @param triangle  3×3, one corner in each column, in the tool frame [m]; may be degenerate
/// @param warm      features of an earlier query, or empty
/// @param touching_distance  below it the shapes count as touching [m]
/// @cost  noexcept, no allocation, at most 32 support calls, mostly 2 to 5; of a large triangle twice that
template <ConvexTool Tool>
FEELER_FLATTEN ClosestPoints<typename Tool::Scalar> gjk(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle, const WitnessFeatures& warm,
                                                        typename Tool::Scalar touching_distance) noexcept {
  using Scalar = typename Tool::Scalar;
  auto answer = detail::run_gjk(tool, detail::WholeTriangle<Scalar>{triangle}, warm, touching_distance);
  ClosestPoints<Scalar>& result = answer.closest;
  const auto& simplex = answer.simplex;
  result.features.size = (std::min)(simplex.size, 3);
  for (std::size_t i = 0; i < std::size_t(result.features.size); ++i) {
    result.features.tool_vertices[i] = short(simplex.tool_vertices[i]);
    result.features.corners[i] = short(simplex.corners[i]);
    result.tool_point += simplex.weights[i] * tool.vertex(simplex.tool_vertices[i]);
    result.triangle_point += simplex.weights[i] * triangle.col(simplex.corners[i]);
  }
  const Scalar large = Scalar(16);  // times the tool
  if (!result.is_touching && answer.upper_bound - result.distance > Scalar(1e-9) * answer.upper_bound &&
      triangle.template lpNorm<Eigen::Infinity>() > large * answer.size)
    return detail::closest_to_large(tool, triangle, answer, touching_distance, result);
  return result;
}

/// Closest points of the core of a swept tool and a triangle, and the distance of its surface: less by the radius, and negative where the ball
/// overlaps the triangle. The algorithm compares squares, so that at a distance it knows the direction to √ε only, which a large triangle
/// makes into nanometres: where the triangle's own plane shows as much distance, it is taken.
template <SweptTool Tool>
FEELER_FLATTEN ClosestPoints<typename Tool::Scalar> gjk(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle, const WitnessFeatures& warm,
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
