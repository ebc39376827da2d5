// Rows of pairs of features, made of what is known in the frame of a tool.
#pragma once

#include <algorithm>

#include "feeler/contact/contact_row.hpp"
#include "feeler/contact/swept_contact_row.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// The rows of one pair of a tool and a triangle.
template <class Scalar, class Row = ContactRow<Scalar>>
using PatchRows = FixedVector<Row, 24>;

/// Turns a pair of features in the tool frame into a row in world axes.
///
/// Of a swept tool the features are those of its core, and each gap is less by the radius. Where they are points or lines, the row knows how the
/// normal turns about them.
template <ConvexTool Tool>
class PatchRowMaker {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Row = ContactRowOf<Tool>;

  /// @param world_from_tool  axes of the tool, kept by reference
  /// @param reference        reference point in the tool frame [m]
  /// @param least_room       of a row [m]
  PatchRowMaker(const Tool& tool, const Matrix3<Scalar>& world_from_tool, const Vector& reference, Scalar least_room) noexcept
      : tool_(tool), world_from_tool_(world_from_tool), reference_(reference), least_room_(least_room) {}

  /// The gap of the tool's surface where its features, of a swept tool those of its core, are so far away [m].
  Scalar on_surface(Scalar distance) const noexcept {
    if constexpr (SweptTool<Tool>) {
      return distance - tool_.swept_radius();
    } else {
      return distance;
    }
  }

  /// A row whose features meet anywhere within `room` of the point. About a corner the normal turns within the gap, and there is next to no room:
  /// with a twentieth of the gap a tool that was about to slip off a ridge passed for one at rest.
  FEELER_FLATTEN Row row_of(FeaturePair kind, const Vector& normal, const Vector& point, Scalar gap, Scalar room = Scalar(0)) const noexcept {
    Row row;
    row.kind = kind;
    row.room = (std::max)({room, gap / 64, least_room_});
    row.normal = world_from_tool_ * normal;
    row.arm = world_from_tool_ * (point - reference_);
    row.gap = gap;
    return row;
  }
  /// The row of two edges that cross.
  /// @param object_edge, tool_edge  unit directions
  Row row_of_edges(const Vector& normal, const Vector& point, Scalar gap, Scalar room, const Vector& object_edge,
                   const Vector& tool_edge) const noexcept {
    Row row = row_of(FeaturePair::edge_edge, normal, point, gap, room);
    row.object_edge = world_from_tool_ * object_edge;
    row.tool_edge = world_from_tool_ * tool_edge;
    if constexpr (SweptTool<Tool>) set_core_distance(row);
    return row;
  }
  /// The row of a point of a core and an edge.
  /// @param object_edge  unit direction
  Row row_of_point_and_edge(const Vector& normal, const Vector& point, Scalar gap, const Vector& object_edge) const noexcept
    requires SweptTool<Tool>
  {
    Row row = row_of(FeaturePair::vertex_face, normal, point, gap);
    row.object_edge = world_from_tool_ * object_edge;
    set_core_distance(row);
    return row;
  }

  /// The row of the closest points of a core, with its curvature from the features that they lie on.
  Row row_of_closest(const ClosestPoints<Scalar>& closest, const Matrix3<Scalar>& triangle) const noexcept
    requires SweptTool<Tool>
  {
    Row row = row_of(FeaturePair::vertex_face, closest.normal, closest.tool_point, closest.distance);
    FixedVector<int, 3> vertices, corners;
    const auto insert = [](FixedVector<int, 3>& list, int i) {
      if (std::find(list.begin(), list.end(), i) == list.end()) list.push_back(i);
    };
    for (std::size_t i = 0; i < std::size_t(closest.features.size); ++i) {
      insert(vertices, closest.features.tool_vertices[i]);
      insert(corners, closest.features.corners[i]);
    }
    const Vector on_core = vertices.size() == 1 ? Vector(tool_.vertex(vertices[0])) : closest.tool_point;
    row.arm = world_from_tool_ * (on_core - reference_);
    if (vertices.size() == 3) {  // a face of the core
      row.kind = FeaturePair::face_vertex;
      row.arm = world_from_tool_ * (closest.triangle_point - reference_);
    } else if (!vertices.empty() && corners.size() < 3) {
      if (vertices.size() == 2) row.tool_edge = world_from_tool_ * Vector(tool_.vertex(vertices[1]) - tool_.vertex(vertices[0])).normalized();
      if (corners.size() == 2) row.object_edge = world_from_tool_ * Vector(triangle.col(corners[1]) - triangle.col(corners[0])).normalized();
      // Lines in parallel are as near at one place as at another: one of the places stands for them.
      if (row.tool_edge.cross(row.object_edge).squaredNorm() < Scalar(1e-6) && !row.object_edge.isZero(Scalar(0))) row.tool_edge.setZero();
      set_core_distance(row);
    }
    return row;
  }

 private:
  /// About a point or a line the normal of a swept tool turns with the tool; the row knows, and lasts until that is much.
  void set_core_distance(Row& row) const noexcept
    requires SweptTool<Tool>
  {
    row.core_distance = (std::max)(row.gap + tool_.swept_radius(), tool_.swept_radius() / 2);
    row.room = (std::max)(row.room, row.core_distance / 20);
  }

  const Tool& tool_;
  const Matrix3<Scalar>& world_from_tool_;
  Vector reference_;
  Scalar least_room_;
};

}  // namespace feeler
