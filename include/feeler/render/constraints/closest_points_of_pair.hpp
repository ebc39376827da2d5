// Closest points of a piece of the tool and a triangle, also where the tool overlaps it on the way.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_normal.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/separation.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

namespace detail {
/// The plane of a triangle, where it parts the tool from it but for a touch, and better than the one given.
template <ConvexTool Piece>
void prefer_own_plane(const Piece& piece, const Matrix3<typename Piece::Scalar>& corners, typename Piece::Scalar touching,
                      ClosestPoints<typename Piece::Scalar>& closest) noexcept {
  using Scalar = typename Piece::Scalar;
  const Vector3<Scalar> normal = triangle_normal<Scalar>(corners.col(0), corners.col(1), corners.col(2));
  if (normal.isZero()) return;
  for (const Vector3<Scalar>& own : {normal, Vector3<Scalar>(-normal)}) {
    const Scalar distance = separation_along(piece, corners, own);
    if (!(distance > -touching) || !(distance > closest.distance)) continue;
    closest.normal = own;
    closest.distance = distance;
  }
}
}  // namespace detail

/// Closest points of a pair of the working set. On the way the tool may overlap its triangle; then the plane that the pair had where the motion
/// starts says which features meet.
/// @param pair     keeps the features, to start the next query from
/// @param scene    `RenderedScene`
/// @param corners  of its triangle in the tool frame, one corner in each column [m]
/// @param axes     of the tool
template <class Pair, class Scene, class Scalar = typename Scene::Scalar>
ClosestPoints<Scalar> closest_points_of(Pair& pair, const Scene& scene, const Matrix3<Scalar>& corners, const Matrix3<Scalar>& axes,
                                        [[maybe_unused]] bool is_at_start) noexcept {
  using Piece = typename Scene::Piece;
  const Piece& piece = scene.piece(pair.piece);
  ClosestPoints<Scalar> closest = gjk(piece, corners, pair.features, scene.clearance().touching);
  pair.features = closest.features;
  if (!closest.is_touching) return closest;
  if constexpr (!SweptTool<Piece>) {  // whose core touches nothing but on the way, and there by far
    if (is_at_start || pair.slack < 2 * scene.clearance().touching) {
      return separation_of_touching(piece, corners, closest, scene.clearance().allowance);
    }
  }
  closest.normal = axes.transpose() * pair.normal;
  closest.distance = separation_along(piece, corners, closest.normal);
  if (pair.is_ghost) detail::prefer_own_plane(piece, corners, scene.clearance().touching, closest);
  closest.features = {};
  closest.tool_point = piece.vertex(piece.support(Vector3<Scalar>(-closest.normal)));
  return closest;
}

}  // namespace feeler
