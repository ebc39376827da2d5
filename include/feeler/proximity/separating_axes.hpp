// The best separating plane of a convex tool and a triangle that touch or overlap, by trying every candidate axis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/tool/convex_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// A plane between triangle and tool in the tool frame: unit normal towards the tool, signed separation along it [m].
template <class Scalar>
struct SeparatingAxis {
  Vector3<Scalar> normal = Vector3<Scalar>::UnitZ();
  Scalar distance = -std::numeric_limits<Scalar>::infinity();
};

/// min n·x − max n·y over tool points x and triangle points y.
template <ConvexTool Tool>
typename Tool::Scalar separation_along(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                       const Vector3<typename Tool::Scalar>& normal) noexcept {
  return -highest_along(tool, Vector3<typename Tool::Scalar>(-normal)) - highest_corner(triangle, normal);
}

template <SweptTool Tool>
typename Tool::Scalar separation_along(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                       const Vector3<typename Tool::Scalar>& unit_normal) noexcept {
  return separation_along(tool.core(), triangle, unit_normal) - tool.swept_radius();
}

/// Takes a normal, or the opposite one, where the tool is farther along it by more than `least` [m].
template <ConvexTool Tool>
void take_better_axis(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle, const Vector3<typename Tool::Scalar>& normal,
                      typename Tool::Scalar least, SeparatingAxis<typename Tool::Scalar>& best) noexcept {
  for (const Vector3<typename Tool::Scalar>& n : {normal, Vector3<typename Tool::Scalar>(-normal)}) {
    const typename Tool::Scalar distance = separation_along(tool, triangle, n);
    if (distance > best.distance + least) best = {n, distance};
  }
}

/// Maximises the separation over the face normals of the Minkowski difference: the triangle's normal, the tool's face normals and the
/// cross products of their edges. Exact for shapes that touch or overlap (the separating axis theorem); for shapes apart it
/// may fall short of the distance. The first axis along which they overlap by no more than is accepted is taken, faces before edges, so that
/// flat contacts keep the normal of the face.
/// @param accepted  overlap that needs no better axis [m]; rounding is accepted anyway
/// @cost  two support calls an axis: at most 13 axes for a box, some hundreds for a hull of 32 points; one where a face touches
template <ConvexTool Tool>
SeparatingAxis<typename Tool::Scalar> best_separating_axis(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                                           typename Tool::Scalar accepted = 0) noexcept {
  using Scalar = typename Tool::Scalar;
  using std::sqrt;
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  SeparatingAxis<Scalar> best;
  const Scalar size = triangle.cwiseAbs().maxCoeff() + tool.vertex(0).cwiseAbs().maxCoeff();
  const Scalar enough = -(std::max)(accepted, 4 * epsilon * size);
  Scalar handicap = Scalar(0);
  const auto attempt = [&](const Vector3<Scalar>& normal) {
    take_better_axis(tool, triangle, normal, handicap, best);
    return best.distance >= enough;
  };
  std::array<Vector3<Scalar>, 3> edges;
  for (int k = 0; k < 3; ++k) edges[std::size_t(k)] = (triangle.col((k + 1) % 3) - triangle.col(k)).stableNormalized();
  const Vector3<Scalar> normal = edges[0].cross(edges[1]);
  const Scalar sine = normal.norm();
  if (sine > 64 * epsilon && attempt(normal / sine)) return best;
  handicap = 32 * epsilon * size;
  for (int i = 0; i < tool.face_axis_count(); ++i) {
    if (attempt(tool.face_axis(i))) return best;
  }
  for (int i = 0; i < tool.edge_direction_count(); ++i) {
    const Vector3<Scalar> direction = tool.edge_direction(i).stableNormalized();
    for (const Vector3<Scalar>& edge : edges) {
      const Vector3<Scalar> axis = direction.cross(edge);
      const Scalar length = axis.norm();
      // Parallel edges add no axis: their common plane is bounded by other crosses and by the faces beside them.
      if (length > Scalar(1e-7) && attempt(axis / length)) return best;
    }
  }
  return best;
}

}  // namespace feeler
