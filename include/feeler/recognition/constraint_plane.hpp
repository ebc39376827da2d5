// The planes that a principal contact may not cross (paper, eq. 6 to 8).
#pragma once

#include <algorithm>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/recognition/surface_features.hpp"

namespace feeler {

/// A unilateral constraint on a point: g(p) = n · (p − p_o) ≥ 0 (paper, eq. 6). World axes [m].
///
/// The rows that the renderer uses are the same planes with their derivatives by the motion of the tool: see `ContactRow`.
template <class ScalarType>
struct ConstraintPlane {
  using Scalar = ScalarType;

  Vector3<Scalar> normal = Vector3<Scalar>::UnitZ();  ///< unit, from the object to the tool
  Vector3<Scalar> point = Vector3<Scalar>::Zero();

  Scalar value(const Vector3<Scalar>& p) const noexcept { return normal.dot(p - point); }
};

/// The planes of one contact: all of them hold at once.
template <class Scalar>
using ConstraintPlanes = FixedVector<ConstraintPlane<Scalar>, 16>;

/// Eq. 6: the plane of a face, as seen from a side of the surface.
template <class Scalar>
ConstraintPlane<Scalar> face_plane(const SurfaceFeatures<Scalar>& surface, int face, SurfaceSide side) noexcept {
  return {Scalar(int(side)) * surface.face(face).normal, surface.face(face).point};
}

/// Eq. 7: the plane of two edges that cross, through the object's edge and along the tool's; it turns with the tool.
/// @param object_edge, tool_edge  directions of any length and sign, not parallel
/// @param point_on_object_edge    world [m]
/// @param toward_tool             any vector on the tool's side
template <class Scalar>
ConstraintPlane<Scalar> edge_edge_plane(const Vector3<Scalar>& object_edge, const Vector3<Scalar>& tool_edge,
                                        const Vector3<Scalar>& point_on_object_edge, const Vector3<Scalar>& toward_tool) noexcept {
  const Vector3<Scalar> normal = object_edge.normalized().cross(tool_edge.normalized()).normalized();
  return {normal.dot(toward_tool) < Scalar(0) ? Vector3<Scalar>(-normal) : normal, point_on_object_edge};
}

/// Eq. 8: the planes of the faces that meet in a feature, each once; they bound the free space together where the feature is concave.
/// Planes beyond 16 are left out.
template <class Scalar>
ConstraintPlanes<Scalar> planes_around(const SurfaceFeatures<Scalar>& surface, const Feature& feature, SurfaceSide side) noexcept {
  ConstraintPlanes<Scalar> planes;
  const auto& incidence = surface.incidence();
  if (feature.kind == FeatureKind::face) {
    planes.push_back(face_plane(surface, feature.index, side));
    return planes;
  }
  const auto faces = feature.kind == FeatureKind::edge ? incidence.edge_faces(feature.index) : incidence.vertex_faces(feature.index);
  for (const int face : faces)
    if (!surface.face(face).normal.isZero()) planes.push_back(face_plane(surface, face, side));
  return planes;
}

/// The side of the surface that a tool is on which touches a feature at a point.
///
/// A tool that touches a ridge without crossing it lies outside of the wedge behind its faces, one that touches a valley inside of the wedge
/// before them: so the directions from the point to all points of the tool have one sign of max n·d, or of min n·d. Their sum decides, so
/// that rounding at the places of touching does not. A tool that lies in the surface, as a segment can, is in front.
/// @param feature        in whose closure the point lies
/// @param rounding       sum of depths that still counts as in front [m]
/// @param for_each_from  calls its argument with the vector to each vertex of the tool from the point [m, world axes]
template <class Scalar, class ForEach>
SurfaceSide side_of_tool(const SurfaceFeatures<Scalar>& surface, const Feature& feature, Scalar rounding, const ForEach& for_each_from) noexcept {
  const auto& incidence = surface.incidence();
  // Where real ridges and valleys meet, either answer gives the same shape.
  const bool is_valley = feature.kind == FeatureKind::vertex ? surface.vertex(feature.index).has_valley && !surface.vertex(feature.index).has_ridge
                                                             : surface.convexity(feature, SurfaceSide::front) == Convexity::concave;
  Scalar sum = Scalar(0);
  for_each_from([&](const Vector3<Scalar>& direction) {
    const auto height = [&](int face) { return surface.face(face).normal.dot(direction); };
    if (feature.kind == FeatureKind::face) {
      sum += height(feature.index);
      return;
    }
    const auto faces = feature.kind == FeatureKind::edge ? incidence.edge_faces(feature.index) : incidence.vertex_faces(feature.index);
    Scalar margin = height(faces[0]);
    for (const int face : faces.subspan(1)) margin = is_valley ? (std::min)(margin, height(face)) : (std::max)(margin, height(face));
    sum += margin;
  });
  return sum < -rounding ? SurfaceSide::back : SurfaceSide::front;
}

}  // namespace feeler
