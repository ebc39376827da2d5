// The rows of pairs of edges, one of the tool and one of the object.
#pragma once

#include <algorithm>
#include <cmath>

#include "feeler/contact/feature_band.hpp"
#include "feeler/contact/patch_lengths.hpp"
#include "feeler/contact/patch_row_maker.hpp"
#include "feeler/contact/patch_triangle.hpp"
#include "feeler/contact/surface_around.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// Pairs the tool's edges in the band with those of the triangle where the surface has an edge.
///
/// Edges that cross touch in a point, with the normal of both; edges in parallel along an interval, with that of the contact at its ends. An edge
/// across which the surface rises towards the normal has no row: there the neighbour is nearer.
///
/// All in the tool frame.
template <ConvexTool Tool, class MeshScalar>
class EdgeEdgeRows {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Rows = PatchRows<Scalar, ContactRowOf<Tool>>;

  /// All are kept by reference.
  /// @param triangle  with its edges measured
  /// @param normal    unit, of the contact, towards the tool
  /// @param may_assume  let edges hold the tool past their ends, as `ContactPatch` has it
  EdgeEdgeRows(const FeatureBand<Tool>& features, const PatchTriangle<Scalar>& triangle, const SurfaceAround<Scalar, MeshScalar>& surface,
               const PatchRowMaker<Tool>& maker, const Vector& normal, const PatchLengths<Scalar>& lengths, bool may_assume) noexcept
      : features_(features), triangle_(triangle), surface_(surface), maker_(maker), normal_(normal), lengths_(lengths), may_assume_(may_assume) {}

  void add_to(Rows& rows) const noexcept {
    FixedVector<ObjectEdge, 3> object_edges;
    for (int k = 0; k < 3; ++k) {
      // An edge inside a flat part of the surface touches nothing.
      if (surface_.is_flat_across(k)) continue;
      const Vector& span = triangle_.edge(k);
      const Scalar length = triangle_.edge_length(k);
      if (length > Scalar(0)) object_edges.push_back({k, triangle_.corner(k), span, span / length, length});
    }
    if (object_edges.empty()) return;
    features_.for_each_edge([&](const Vector& tool_start, const Vector& tool) {
      for (const ObjectEdge& object : object_edges) add_pair(tool_start, tool, object, rows);
    });
  }

 private:
  inline static const Scalar& least_cosine = PatchTriangle<Scalar>::least_cosine;

  /// An edge of the triangle.
  struct ObjectEdge {
    int number = 0;
    Vector start, span, direction;  // direction: unit
    Scalar length = Scalar(0);
  };

  void add_pair(const Vector& tool_start, const Vector& tool, const ObjectEdge& object, Rows& rows) const noexcept {
    using std::abs;
    using std::sqrt;
    const Vector& u = object.direction;
    const Vector cross = tool.cross(u);
    const Scalar tool_squared = tool.squaredNorm(), cross_squared = cross.squaredNorm();
    if (cross_squared < Scalar(1e-6) * tool_squared) {
      add_parallel(tool_start, tool, object, rows);
      return;
    }
    const Scalar along_normal = cross.dot(normal_);
    if (along_normal * along_normal < least_cosine * least_cosine * cross_squared) return;
    // The lines are closest where the difference of their points is along the normal.
    const Vector between = tool_start - object.start;
    const Vector across = u.cross(tool);
    const Scalar along_object = between.cross(tool).dot(across) / cross_squared;
    const Scalar part_of_tool = between.cross(u).dot(across) / cross_squared;
    if (!(part_of_tool >= Scalar(0) && part_of_tool <= Scalar(1))) return;
    const Scalar beyond = (std::max)(-along_object, along_object - object.length);
    const bool is_assumed = beyond > lengths_.seam;
    if (!(beyond <= lengths_.band) || (is_assumed && !may_assume_)) return;
    const Vector normal = cross / (along_normal < Scalar(0) ? -sqrt(cross_squared) : sqrt(cross_squared));
    const Scalar gap = maker_.on_surface(normal.dot(between));
    if (abs(gap) > lengths_.largest_gap || !surface_.is_clear_of_neighbour_across(object.number, normal)) return;
    // Past its end the edge holds nothing. But where its line goes on into the object, seen along the tool's edge, a step may lead back to it: that it
    // holds the tool is assumed, as beyond a valley.
    if (is_assumed) {
      const Vector sideways = normal.cross(tool);
      const bool is_before = along_object < Scalar(0);
      if (!surface_.leads_under_a_neighbour(is_before ? object.number : (object.number + 1) % 3,
                                            (sideways.dot(u) < Scalar(0)) == is_before ? sideways : Vector(-sideways), normal))
        return;
    }
    const Scalar tool_length = sqrt(tool_squared);
    const Scalar room = (std::min)({(std::max)(-beyond, Scalar(0)), part_of_tool * tool_length, (1 - part_of_tool) * tool_length});
    if (rows.push_back(maker_.row_of_edges(normal, Vector(tool_start + part_of_tool * tool), gap, room, u, Vector(tool / tool_length))))
      rows.back().is_assumed = is_assumed;
  }

  /// Edges in parallel touch along an interval; its ends hold the tool.
  FEELER_FLATTEN void add_parallel(const Vector& tool_start, const Vector& tool, const ObjectEdge& edge, Rows& rows) const noexcept {
    using std::abs;
    const Vector &start = edge.start, &object = edge.span;
    const Scalar length_squared = tool.squaredNorm();
    const Scalar first = object.dot(tool) > Scalar(0) ? tool.dot(start - tool_start) : tool.dot(start + object - tool_start);
    const Scalar extent = abs(object.dot(tool));
    const Scalar from = (std::max)(Scalar(0), first / length_squared);
    const Scalar to = (std::min)(Scalar(1), (first + extent) / length_squared);
    if (!(from < to) || !surface_.is_clear_of_neighbour_across(edge.number, normal_)) return;
    for (const Scalar& t : {from, to}) {
      const Vector on_tool = tool_start + t * tool;
      const Scalar along = object.dot(on_tool - start) / object.squaredNorm();
      const Vector between = on_tool - start - along * object;
      const Scalar height = normal_.dot(between);
      // Far apart across the normal they only look parallel: no contact there.
      if (abs(maker_.on_surface(height)) > lengths_.largest_gap || (between - height * normal_).norm() > abs(height) + lengths_.seam) continue;
      if constexpr (SweptTool<Tool>) {
        const Scalar distance = between.norm();
        rows.push_back(maker_.row_of_point_and_edge(Vector(between / distance), on_tool, maker_.on_surface(distance), object.normalized()));
      } else {
        rows.push_back(maker_.row_of(FeaturePair::vertex_face, normal_, on_tool, height));
      }
    }
  }

  const FeatureBand<Tool>& features_;
  const PatchTriangle<Scalar>& triangle_;
  const SurfaceAround<Scalar, MeshScalar>& surface_;
  const PatchRowMaker<Tool>& maker_;
  const Vector& normal_;
  const PatchLengths<Scalar>& lengths_;
  bool may_assume_;
};

}  // namespace feeler
