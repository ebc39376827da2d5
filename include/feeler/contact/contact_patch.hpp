// The rows of one tool–triangle pair: every pair of features that meets in the patch where the two are close.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "feeler/contact/contact_row.hpp"
#include "feeler/contact/edge_edge_rows.hpp"
#include "feeler/contact/feature_band.hpp"
#include "feeler/contact/outer_rows.hpp"
#include "feeler/contact/patch_lengths.hpp"
#include "feeler/contact/patch_row_maker.hpp"
#include "feeler/contact/patch_triangle.hpp"
#include "feeler/contact/surface_around.hpp"
#include "feeler/contact/swept_contact_row.hpp"
#include "feeler/contact/vertex_set.hpp"
#include "feeler/contact/wall_rim.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// Finds the rows of a pair.
///
/// In a band above the separating plane of the closest points it pairs tool vertices with the triangle, triangle corners with tool
/// faces, and edges with edges, each with the normal of its own features. A contact between faces so gets the rows that also stop it
/// from tilting. Where no such pair is as close as the closest points are, they give a row of their own.
///
/// A normal outside the normal cone of the mesh there is a ghost: a neighbour is nearer, and its own rows hold the tool.
/// Such rows are left out, so that edges inside a flat surface do not catch; `keep_ghost` keeps the closest one. In a valley the tool is
/// above the planes of both sides, and each will hold it: there the plane of the face takes the ghost's place, and the row says that it is
/// assumed.
///
/// All input in the tool frame. @cost O(vertices in the band), and the features at them
template <ConvexTool Tool, class MeshScalar>
class ContactPatch {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;
  using Row = ContactRowOf<Tool>;
  using Rows = PatchRows<Scalar, Row>;

  /// @param incidence        `incidence_of(tool)`
  /// @param world_from_tool  axes of the tool; rows come out in world axes
  /// @param reference        reference point in the tool frame [m]
  /// @param band             height above the separating plane up to which features count, where their gap is at most a quarter of it [m]
  /// @param may_assume  let the planes of valleys hold the tool before it is over them, and edges past their ends
  /// @param near_vertices    is filled with the tool vertices in the band; made for at least as many as the tool has
  ContactPatch(const Tool& tool, const FeatureIncidence& incidence, const TriangleMesh<MeshScalar>& mesh, const Matrix3<Scalar>& world_from_tool,
               const Vector& reference, Scalar band, bool may_assume, VertexSet& near_vertices) noexcept
      : tool_(tool),
        world_from_tool_(world_from_tool),
        lengths_(band),
        may_assume_(may_assume),
        maker_(tool, world_from_tool_, reference, lengths_.seam),
        surface_(mesh, world_from_tool_, lengths_.seam),
        features_(tool, incidence, near_vertices),
        near_(near_vertices) {}
  ContactPatch(const ContactPatch&) = delete;
  ContactPatch& operator=(const ContactPatch&) = delete;

  /// Rows of a triangle with the closest points given; false when it had none but a ghost and that was left out.
  FEELER_FLATTEN bool find(int triangle, const Matrix3<Scalar>& corners, const ClosestPoints<Scalar>& closest, bool keep_ghost, Rows& rows) noexcept {
    rows.clear();
    is_filler_ = is_ghost_ = false;
    surface_.stand_on(triangle);
    using std::abs;
    normal_ = closest.normal;
    features_.clear();
    triangle_.set(corners, normal_);
    // Farther away one row is enough: a step that comes near is linearised again.
    if (closest.distance <= lengths_.largest_gap) {
      triangle_.measure_edges();
      features_.gather(closest, normal_, lengths_.band);
      add_vertices_on_face(rows);
      if (near_.size() > 1) EdgeEdgeRows<Tool, MeshScalar>(features_, triangle_, surface_, maker_, normal_, lengths_, may_assume_).add_to(rows);
      if (tool_.face_count() > 0 && near_.size() > 2)
        features_.for_each_face([&](const ToolFace<Scalar>& face) { this->add_corners_on_face(face, rows); });
    }
    const Scalar close_enough = closest.distance + abs(closest.distance) / 1000 + lengths_.seam + rounding_of(closest.distance);
    const bool is_met = std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.gap <= close_enough; });
    // Overlapping shapes have no closest points: the deepest vertex may lie beside the triangle, where nothing holds it.
    if (is_met || (closest.is_touching && closest.distance < -lengths_.seam && !rows.empty())) return true;
    if (!near_.empty() && surface_.is_inside_wall()) return true;
    if (!keep_ghost && !is_in_cone(closest)) {
      is_ghost_ = true;
      if (may_assume_) add_concave_face(closest, rows);
      return !rows.empty();
    }
    is_filler_ = rows.empty() && near_.size() > 1 && is_own_plane();
    if (rows.full()) rows.pop_back();
    if constexpr (SweptTool<Tool>) {
      rows.push_back(maker_.row_of_closest(closest, triangle_.corners()));
    } else {
      rows.push_back(closest.is_touching ? row_of_touching(closest)
                                         : maker_.row_of(FeaturePair::vertex_face, normal_, closest.tool_point, closest.distance));
    }
    return true;
  }

  /// Whether the only row is that of the closest points, in the triangle's own plane: other triangles of its wall hold the tool as well.
  bool is_filler() const noexcept { return is_filler_; }
  /// Whether the closest points are a ghost: a neighbour is nearer to the tool, though the triangle may have rows of its own.
  bool is_ghost() const noexcept { return is_ghost_; }
  /// After `find`: calls `visit(triangle)` for each triangle in the plane of this one, beside it, that is under a tool vertex no farther from that
  /// plane than `gap` [m]: it holds that vertex. Some are visited more than once.
  template <class Visit>
  void visit_continuations(Scalar gap, const Visit& visit) const noexcept {
    using std::abs;
    if (!triangle_.has_face()) return;
    for (const int i : near_) {
      const Vector vertex = tool_.vertex(i);
      if (abs(gap_above_face(vertex)) > gap) continue;
      const bool is_inside = triangle_.room_inside(0, vertex) >= -lengths_.seam && triangle_.room_inside(1, vertex) >= -lengths_.seam &&
                             triangle_.room_inside(2, vertex) >= -lengths_.seam;
      if (is_inside) continue;
      const int under = surface_.triangle_under(vertex, triangle_.corner(0));
      if (under >= 0) visit(under);
    }
  }

  /// After `find`, of a triangle in a wall: calls `visit(triangle)` for those at the wall's rim where the tool's face over it ends.
  /// @param is_known  of triangles that share such a point those are preferred
  template <class IsKnown, class Visit>
  void visit_rim(const IsKnown& is_known, const Visit& visit) const noexcept {
    if (surface_.wall() < 0 || near_.size() < 3) return;
    features_.for_each_face([&](const ToolFace<Scalar>& face) {
      if (-face.normal.dot(normal_) < least_cosine) return;
      const auto corner = [&](int i) { return surface_.in_world(tool_.vertex(face.vertices[std::size_t(i)]), triangle_.corner(0)); };
      const Vector outward = world_from_tool_ * face.normal;
      OutermostAtRim<Scalar, MeshScalar>(surface_.mesh(), surface_.wall(), int(face.vertices.size()), corner, outward).find(is_known, visit);
    });
  }

  /// After `find`, of a triangle whose closest points are a ghost: a neighbour that is nearer to the tool, or -1.
  int nearer_triangle(const ClosestPoints<Scalar>& closest) const noexcept { return surface_.nearer_neighbour(place_on_triangle(closest), normal_); }

 private:
  inline static const Scalar &least_cosine = PatchTriangle<Scalar>::least_cosine, &plane_tolerance = SurfaceAround<Scalar, MeshScalar>::tolerance;

  /// What a distance may fall short of the truth by [m]: the direction between points so near is rounded, which shows at the ends of a long triangle.
  Scalar rounding_of(Scalar distance) const noexcept {
    using std::abs;
    return 16 * std::numeric_limits<Scalar>::epsilon() * triangle_.squared_size() / (std::max)(abs(distance), lengths_.band / 1000);
  }

  void add_vertices_on_face(Rows& rows) noexcept {
    if (!triangle_.has_face() || !triangle_.faces_tool()) return;
    if (tool_.vertex_count() > most_outer_rows && near_.size() > most_outer_rows) return add_outer_vertices_on_face(rows);
    visit_vertices_on_face([&rows](const Row& row) { rows.push_back(row); });
  }
  /// Calls `visit(row)` for each near vertex over the face.
  template <class Visit>
  void visit_vertices_on_face(const Visit& visit) const noexcept {
    for (const int vertex : near_) visit_vertex_on_face(vertex, visit);
  }
  template <class Visit>
  void visit_vertex_on_face(int tool_vertex, const Visit& visit) const noexcept {
    using std::abs;
    const Vector vertex = tool_.vertex(tool_vertex);
    const Scalar gap = gap_above_face(vertex);
    if (abs(gap) > lengths_.largest_gap) return;
    Scalar room = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Scalar inside = triangle_.room_inside(k, vertex);
      if (inside >= -lengths_.seam) room = (std::min)(room, inside);
      // Beyond a valley what is free is above both faces, and the step may lead back over this one.
      else if (!(inside >= -lengths_.band) || !surface_.rises_across(k, triangle_.outward())) return;
    }
    visit(maker_.row_of(FeaturePair::vertex_face, triangle_.outward(), vertex, gap, room));
  }
  /// Gap of a tool vertex above the triangle's plane, on the side of the tool [m].
  Scalar gap_above_face(const Vector& vertex) const noexcept { return maker_.on_surface(triangle_.height_of(vertex)); }

  /// Of many vertices, as of a round end, those that hold it up.
  FEELER_FLATTEN void add_outer_vertices_on_face(Rows& rows) noexcept {
    take_outer_rows<Row>([this](const auto& visit) { this->visit_vertices_on_face(visit); }, lengths_.band / 16, rows);
  }

  /// The triangle's own plane, where the lowest tool vertex is beside it, near, and every edge between them is a valley's.
  FEELER_FLATTEN void add_concave_face(const ClosestPoints<Scalar>& closest, Rows& rows) noexcept {
    if (!triangle_.has_face() || rows.full() || closest.distance > 4 * lengths_.band) return;
    for (const Scalar& side : {Scalar(1), Scalar(-1)}) {
      const Vector normal = side * triangle_.face_normal();
      const Vector vertex = tool_.vertex(tool_.support(Vector(-normal)));
      const Scalar gap = maker_.on_surface(normal.dot(vertex - triangle_.corner(0)));
      if (!(gap > Scalar(0)) || !is_across_valleys(vertex, normal)) continue;
      rows.push_back(maker_.row_of(FeaturePair::vertex_face, normal, vertex, gap));
      rows.back().is_assumed = true;
      return;
    }
  }

  /// Whether the mesh rises from the triangle's plane, on the side given, across each edge that a point lies beyond.
  bool is_across_valleys(const Vector& point, const Vector& normal) const noexcept {
    for (int k = 0; k < 3; ++k) {
      const Vector start = triangle_.corner(k), edge = triangle_.corner((k + 1) % 3) - start;
      if (area_inside<Scalar>(start, edge, point, triangle_.face_normal()) < Scalar(0) && !surface_.rises_across(k, normal)) return false;
    }
    return true;
  }

  FEELER_FLATTEN void add_corners_on_face(const ToolFace<Scalar>& face, Rows& rows) noexcept {
    using std::abs;
    const Vector outward = face.normal;
    if (-outward.dot(normal_) < least_cosine) return;
    const auto& loop = face.vertices;
    for (int k = 0; k < 3; ++k) {
      if (surface_.is_inside_wall(k)) continue;
      const Vector corner = triangle_.corner(k);
      const Scalar gap = maker_.on_surface(outward.dot(corner - tool_.vertex(loop[0])));
      if (abs(gap) > lengths_.largest_gap) continue;
      Scalar room = std::numeric_limits<Scalar>::infinity();
      for (std::size_t i = 0; i < loop.size() && room >= -lengths_.seam; ++i) {
        const Vector start = tool_.vertex(loop[i]), edge = tool_.vertex(loop[(i + 1) % loop.size()]) - start;
        room = (std::min)(room, area_inside<Scalar>(start, edge, corner, outward) / edge.norm());
      }
      if (!(room >= -lengths_.seam) || !surface_.is_clear_of_neighbours_at_corner(k, Vector(-outward))) continue;
      rows.push_back(maker_.row_of(FeaturePair::face_vertex, Vector(-outward), corner, gap, room));
    }
  }

  /// A row of shapes that touch along a plane. Which of the two the plane belongs to decides whether it turns with the tool, and where they are
  /// in contact: another plane, a hair askew, would ask for what its neighbours forbid.
  FEELER_FLATTEN Row row_of_touching(const ClosestPoints<Scalar>& closest) const noexcept {
    if (is_own_plane()) {
      const Vector normal = triangle_.outward();
      return maker_.row_of(FeaturePair::vertex_face, normal, closest.tool_point, normal.dot(closest.tool_point - triangle_.corner(0)));
    }
    for (const int f : features_.faces_at(near_[0])) {
      const Vector normal = -tool_.face(f).normal;
      if (!((normal - normal_).norm() < plane_tolerance)) continue;
      Eigen::Index highest;
      (normal.transpose() * triangle_.corners()).maxCoeff(&highest);
      const Vector corner = triangle_.corner(int(highest));
      return maker_.row_of(FeaturePair::face_vertex, normal, corner, normal.dot(closest.tool_point - corner));
    }
    return maker_.row_of(FeaturePair::vertex_face, normal_, closest.tool_point, closest.distance);
  }

  /// Whether the plane that parts them is the triangle's.
  bool is_own_plane() const noexcept { return triangle_.has_plane(normal_, plane_tolerance); }

  bool is_in_cone(const ClosestPoints<Scalar>& closest) const noexcept {
    const PlaceOnTriangle place = place_on_triangle(closest);
    if (place.corners == 1) return surface_.is_in_vertex_cone(place.index, normal_);
    if (place.corners == 2) return surface_.is_in_edge_cone(place.index, normal_);
    return place.corners == 3 || !is_own_plane() || surface_.is_under(closest.tool_point, triangle_.corner(0));
  }

  const Tool& tool_;
  Matrix3<Scalar> world_from_tool_;
  bool is_filler_ = false, is_ghost_ = false;  // see `is_filler()`, `is_ghost()`
  PatchLengths<Scalar> lengths_;
  bool may_assume_;
  PatchRowMaker<Tool> maker_;
  SurfaceAround<Scalar, MeshScalar> surface_;

  PatchTriangle<Scalar> triangle_;
  Vector normal_;  // of the contact
  FeatureBand<Tool> features_;
  const VertexSet& near_;  // those features' vertices
};

}  // namespace feeler
