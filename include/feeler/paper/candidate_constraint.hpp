// One inequality of a candidate principal contact, and its row at a pose.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "feeler/contact/contact_row.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// One inequality of a candidate, by the features that it is between.
struct CandidateConstraint {
  FeaturePair kind = FeaturePair::vertex_face;
  int tool_feature = -1;  ///< number of the vertex, face or edge, by kind
  int triangle = -1;      ///< the triangle whose plane, corner or edge it is
  int corner = 0;         ///< of the triangle: its corner or the edge that starts there, by kind
  bool is_behind = false; ///< the tool is on the side that the triangle's normal points away from
};

namespace detail {
/// A direction out of the object between the two sides of a ridge; at a rim, out over it.
template <class Scalar, class MeshScalar>
Vector3<Scalar> out_of_ridge(const TriangleMesh<MeshScalar>& mesh, int triangle, int k, Scalar side) noexcept {
  const Vector3<Scalar> own = side * mesh.normal(triangle).template cast<Scalar>();
  const int other = mesh.topology().neighbour(triangle, k);
  if (other >= 0) return own + side * mesh.normal(other).template cast<Scalar>();
  const Matrix3<Scalar> corners = mesh.corners(triangle).template cast<Scalar>();
  const Vector3<Scalar> along = corners.col((k + 1) % 3) - corners.col(k);
  return own + side * Vector3<Scalar>(along.cross(own)).normalized();
}
}  // namespace detail

/// The inequality of a constraint at a pose, as a row; `room` is how far inside both features the contact is, negative outside [m].
/// @param pose  of the tool frame; the row's arm is relative to `reference_world` [m]
template <ConvexTool Tool, class MeshScalar>
ContactRow<typename Tool::Scalar> row_of(const CandidateConstraint& constraint, const Tool& tool, const TriangleMesh<MeshScalar>& mesh,
                                         const Pose<typename Tool::Scalar>& pose, const Vector3<typename Tool::Scalar>& reference_world) noexcept {
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  const Matrix3<Scalar> corners = mesh.corners(constraint.triangle).template cast<Scalar>();
  const Scalar side = constraint.is_behind ? Scalar(-1) : Scalar(1);
  ContactRow<Scalar> row;
  row.kind = constraint.kind;
  row.triangle = constraint.triangle;
  row.room = std::numeric_limits<Scalar>::infinity();
  const Vector corner = corners.col(constraint.corner);
  Vector point = corner;
  switch (constraint.kind) {
    case FeaturePair::vertex_face: {  // eq. 6
      point = pose * tool.vertex(constraint.tool_feature);
      row.normal = side * mesh.normal(constraint.triangle).template cast<Scalar>();
      row.gap = row.normal.dot(point - corners.col(0));
      break;
    }
    case FeaturePair::face_vertex: {
      const auto face = tool.face(constraint.tool_feature);
      row.normal = -(pose.rotation * face.normal);
      row.gap = row.normal.dot(pose * tool.vertex(face.vertices[0]) - corner);
      for (std::size_t i = 0; i < face.vertices.size(); ++i) {
        const Vector start = pose * tool.vertex(face.vertices[i]);
        const Vector edge = pose * tool.vertex(face.vertices[(i + 1) % face.vertices.size()]) - start;
        row.room = (std::min)(row.room, area_inside<Scalar>(start, edge, corner, -row.normal) / edge.norm());
      }
      break;
    }
    case FeaturePair::edge_edge: {  // eq. 7
      const ToolEdge edge = tool.edge(constraint.tool_feature);
      const Vector start = pose * tool.vertex(edge.start);
      const Vector along_tool = pose * tool.vertex(edge.end) - start;
      const Vector along_object = corners.col((constraint.corner + 1) % 3) - corner;
      const Scalar tool_length = along_tool.norm(), object_length = along_object.norm();
      row.tool_edge = along_tool / tool_length;
      row.object_edge = along_object / object_length;
      const Vector cross = row.tool_edge.cross(row.object_edge);
      const Scalar sine = (std::max)(cross.norm(), std::numeric_limits<Scalar>::epsilon());
      row.normal = cross / sine;
      if (row.normal.dot(detail::out_of_ridge<Scalar>(mesh, constraint.triangle, constraint.corner, side)) < Scalar(0)) row.normal = -row.normal;
      const Vector between = start - corner;
      const Vector turn = row.object_edge.cross(row.tool_edge);
      const Scalar on_object = between.cross(row.tool_edge).dot(turn) / (sine * sine);
      const Scalar on_tool = between.cross(row.object_edge).dot(turn) / (sine * sine);
      row.room = (std::min)({on_object, object_length - on_object, on_tool, tool_length - on_tool});
      point = start + on_tool * row.tool_edge;
      row.gap = row.normal.dot(between);
      break;
    }
  }
  row.arm = point - reference_world;
  return row;
}

}  // namespace feeler
