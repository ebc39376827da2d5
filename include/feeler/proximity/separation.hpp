// Signed separation of a convex tool and a triangle, near or far, apart or overlapping.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/separating_axes.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// Distance under which closest points of a tool of a size no longer tell a direction, at the latest, and separating axes take over [m].
template <class Scalar>
Scalar touching_distance(Scalar size) noexcept {
  return Scalar(1e6) * std::numeric_limits<Scalar>::epsilon() * size;
}

/// Separating plane of a tool and a triangle that touch or overlap, by trying every candidate axis; the distance is negative by the least
/// translation that parts them.
/// @param closest   what `gjk` said of them
/// @param accepted  overlap that needs no better plane [m]
template <ConvexTool Tool>
[[gnu::noinline]]
ClosestPoints<typename Tool::Scalar> separation_of_touching(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                                            ClosestPoints<typename Tool::Scalar> closest,
                                                            typename Tool::Scalar accepted = 0) noexcept {
  using Scalar = typename Tool::Scalar;
  const SeparatingAxis<Scalar> axis = best_separating_axis(tool, triangle, accepted);
  // A segment along a degenerate triangle has no axis at all; then the last direction of the closest points stands.
  if (axis.distance == -std::numeric_limits<Scalar>::infinity()) {
    closest.distance = separation_along(tool, triangle, closest.normal);
    return closest;
  }
  closest.normal = axis.normal;
  closest.distance = axis.distance;
  closest.features.size = 0;
  closest.tool_point = tool.vertex(tool.support(Vector3<Scalar>(-axis.normal)));
  closest.triangle_point = closest.tool_point - axis.distance * axis.normal;
  return closest;
}

template <SweptTool Tool>
[[gnu::noinline]]
ClosestPoints<typename Tool::Scalar> separation_of_touching(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                                            ClosestPoints<typename Tool::Scalar> closest,
                                                            typename Tool::Scalar accepted = 0) noexcept {
  closest = separation_of_touching(tool.core(), triangle, closest, accepted);
  closest.distance -= tool.swept_radius();
  return closest;
}

/// Separating plane of a tool and a triangle: max over unit n of min n·x − max n·y, x in the tool, y in the triangle.
///
/// Closest points (GJK) where the shapes are apart, separating axes where they touch or overlap. The distance is proved by the normal
/// returned with it.
/// @param triangle  3×3, one corner in each column, in the tool frame [m]; may be degenerate
template <ConvexTool Tool>
ClosestPoints<typename Tool::Scalar> separation(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle, const WitnessFeatures& warm,
                                                typename Tool::Scalar touching) noexcept {
  const ClosestPoints<typename Tool::Scalar> closest = gjk(tool, triangle, warm, touching);
  return closest.is_touching ? separation_of_touching(tool, triangle, closest) : closest;
}

}  // namespace feeler
