// The rows of one tool–triangle pair: every pair of features that meets in the patch where the two are close.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>

#include "feeler/contact/contact_row.hpp"
#include "feeler/contact/outer_rows.hpp"
#include "feeler/contact/swept_contact_row.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/normal_cone.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// The rows of one pair.
template <class Scalar, class Row = ContactRow<Scalar>>
using PatchRows = FixedVector<Row, 24>;

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
/// Of a swept tool the features are those of its core, and each gap is less by the radius. Where the closest features are points or lines,
/// their row knows how the normal turns about them.
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
  /// @param assumes_valleys  let the planes of valleys hold the tool before it is over them
  ContactPatch(const Tool& tool, const FeatureIncidence& incidence, const TriangleMesh<MeshScalar>& mesh,
               const Matrix3<Scalar>& world_from_tool, const Vector& reference, Scalar band, bool assumes_valleys) noexcept
      : tool_(tool),
        incidence_(incidence),
        mesh_(mesh),
        world_from_tool_(world_from_tool),
        reference_(reference),
        band_(band),
        largest_gap_(band / 4),
        seam_(band / 100000),
        assumes_valleys_(assumes_valleys) {}

  /// Rows of a triangle with the closest points given; false when it had none but a ghost and that was left out.
  [[gnu::flatten, gnu::noinline]]
  bool find(int triangle, const Matrix3<Scalar>& corners, const ClosestPoints<Scalar>& closest, bool keep_ghost,
            Rows& rows) noexcept {
    rows.clear();
    triangle_ = triangle;
    corners_ = corners;
    normal_ = closest.normal;
    near_.clear();
    measure_triangle();
    // Farther away one row is enough: a step that comes near is linearised again.
    if (closest.distance <= largest_gap_) {
      measure_edges();
      gather_near_vertices(closest);
      add_vertices_on_face(rows);
      if (near_.size() > 1) add_edges(rows);
      if (tool_.face_count() > 0 && near_.size() > 2) add_corners_on_faces(rows);
    }
    const Scalar close_enough = closest.distance + std::abs(closest.distance) / 1000 + seam_ + rounding_of(closest.distance);
    const bool is_met = std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.gap <= close_enough; });
    // Overlapping shapes have no closest points: the deepest vertex may lie beside the triangle, where nothing holds it.
    if (is_met || (closest.is_touching && closest.distance < -seam_ && !rows.empty())) return true;
    if (!keep_ghost && !is_in_cone(closest)) {
      if (assumes_valleys_) add_concave_face(closest, rows);
      return !rows.empty();
    }
    if (rows.full()) rows.pop_back();
    if constexpr (SweptTool<Tool>) {
      rows.push_back(row_of_closest(closest));
    } else {
      rows.push_back(closest.is_touching ? row_of_touching(closest) : row_of(FeaturePair::vertex_face, normal_, closest.tool_point, closest.distance));
    }
    return true;
  }

  /// After `find`: calls `visit(triangle)` for each triangle that continues the plane of this one, beside it, to a tool vertex no farther from that
  /// plane than `gap` [m]: it holds that vertex. Some are visited more than once.
  template <class Visit>
  void visit_continuations(Scalar gap, const Visit& visit) const noexcept {
    if (!has_face_) return;
    for (const int i : near_) {
      const Vector vertex = tool_.vertex(i);
      if (std::abs(gap_above_face(vertex)) > gap) continue;
      for (int k = 0; k < 3; ++k) {
        if (room_inside(k, vertex) >= -seam_) continue;
        const int neighbour = mesh_.topology().neighbour(triangle_, k);
        if (neighbour >= 0 && is_in_plane(neighbour)) visit(neighbour);
      }
    }
  }

  /// After `find`, of a triangle whose closest points are a ghost: a neighbour that is nearer to the tool, or -1.
  int nearer_triangle(const ClosestPoints<Scalar>& closest) const noexcept {
    const Place place = place_of(closest);
    if (place.corners == 1) return triangle_along(mesh_, triangle_, place.index, direction_of(normal_));
    if (place.corners == 2) return std::max(mesh_.topology().neighbour(triangle_, place.index), -1);
    return -1;
  }

 private:
  static constexpr int near_capacity = 256;  // all vertices that a tool may have: one end of a cylinder has 128
  // Features whose own normal differs more from the contact's belong to another part of the surface.
  static constexpr Scalar least_cosine = Scalar(9) / 10;
  static constexpr Scalar cone_tolerance = Scalar(1e-6);

  static std::size_t index(int i) noexcept { return std::size_t(i); }

  /// What a distance may fall short of the truth by [m]: the direction between points so near is rounded, which shows at the ends of a long triangle.
  Scalar rounding_of(Scalar distance) const noexcept {
    const Scalar squared_size = std::max((corners_.col(1) - corners_.col(0)).squaredNorm(), (corners_.col(2) - corners_.col(0)).squaredNorm());
    return 16 * std::numeric_limits<Scalar>::epsilon() * squared_size / std::max(std::abs(distance), band_ / 1000);
  }

  /// The tool vertices in the band, from the lowest along edges: below any height a convex tool hangs together.
  void gather_near_vertices(const ClosestPoints<Scalar>& closest) noexcept {
    const int lowest = closest.features.size > 0 ? closest.features.tool_vertices[0] : tool_.support(Vector(-normal_));
    const Scalar limit = normal_.dot(tool_.vertex(lowest)) + band_;
    is_near_.reset();
    const auto reach = [this](int vertex) {
      if (near_.push_back(vertex)) is_near_.set(index(vertex));
    };
    reach(lowest);
    for (int i = 0; i < near_.size(); ++i) {
      for (const int e : incidence_.vertex_edges(near_[i])) {
        for (const int vertex : incidence_.edge_vertices(e)) {
          if (!is_near_[index(vertex)] && normal_.dot(tool_.vertex(vertex)) <= limit) reach(vertex);
        }
      }
    }
  }

  void measure_triangle() noexcept {
    constexpr Scalar least_sine = 64 * std::numeric_limits<Scalar>::epsilon();
    const Vector edge0 = corners_.col(1) - corners_.col(0);
    const Vector edge1 = corners_.col(2) - corners_.col(0);
    const Vector cross = edge0.cross(edge1);
    const Scalar squared_area = cross.squaredNorm();
    has_face_ = squared_area > least_sine * least_sine * edge0.squaredNorm() * edge1.squaredNorm();
    if (has_face_) {
      face_normal_ = cross / std::sqrt(squared_area);
      const Scalar cosine = face_normal_.dot(normal_);
      side_ = cosine < Scalar(0) ? Scalar(-1) : Scalar(1);
      faces_tool_ = side_ * cosine >= least_cosine;
    }
  }

  void measure_edges() noexcept {
    for (int k = 0; k < 3; ++k) {
      edges_[index(k)] = corners_.col((k + 1) % 3) - corners_.col(k);
      edge_lengths_[index(k)] = edges_[index(k)].norm();
    }
  }

  /// Whether the plane that parts them is the triangle's.
  bool is_own_plane() const noexcept { return faces_tool_ && (side_ * face_normal_ - normal_).norm() < cone_tolerance; }

  /// Whether a point that may lie beside the triangle is over the flat part of the surface that it belongs to; past its rim nothing holds.
  [[gnu::flatten, gnu::noinline]]
  bool is_over_surface(const Vector& point) const noexcept {
    constexpr int longest_walk = 16;
    const Vector origin = mesh_.vertex(mesh_.triangle(triangle_)[0]).template cast<Scalar>();
    const Vector point_world = world_from_tool_ * (point - corners_.col(0)) + origin;
    int triangle = triangle_;
    for (int step = 0; step < longest_walk; ++step) {
      const int edge = edge_towards(mesh_, triangle, point_world, seam_);
      if (edge < 0) return true;
      if (mesh_.topology().edge_convexity(triangle, edge) != Convexity::flat) return false;
      triangle = mesh_.topology().neighbour(triangle, edge);
    }
    return true;
  }

  void add_vertices_on_face(Rows& rows) noexcept {
    if (!has_face_ || !faces_tool_) return;
    if (tool_.vertex_count() > most_outer_rows && near_.size() > most_outer_rows) return add_outer_vertices_on_face(rows);
    for (const int vertex : near_) add_vertex_on_face(vertex, rows);
  }
  template <int capacity>
  void add_vertex_on_face(int tool_vertex, FixedVector<Row, capacity>& rows) const noexcept {
    const Vector vertex = tool_.vertex(tool_vertex);
    const Scalar gap = gap_above_face(vertex);
    if (std::abs(gap) > largest_gap_) return;
    Scalar room = std::numeric_limits<Scalar>::infinity();
    for (int k = 0; k < 3; ++k) {
      room = std::min(room, room_inside(k, vertex));
      if (!(room >= -seam_)) return;
    }
    rows.push_back(row_of(FeaturePair::vertex_face, Vector(side_ * face_normal_), vertex, gap, room));
  }
  /// Gap of a tool vertex above the triangle's plane, on the side of the tool [m].
  Scalar gap_above_face(const Vector& vertex) const noexcept { return on_surface(side_ * face_normal_.dot(vertex - corners_.col(0))); }
  /// How far inside an edge of the triangle a point is, seen along its normal [m].
  Scalar room_inside(int edge, const Vector& point) const noexcept {
    return area_inside<Scalar>(corners_.col(edge), edges_[index(edge)], point, face_normal_) / edge_lengths_[index(edge)];
  }

  /// Of many vertices, as of a round end, those that hold it up.
  [[gnu::flatten, gnu::noinline]]
  void add_outer_vertices_on_face(Rows& rows) noexcept {
    FixedVector<Row, near_capacity> all;
    for (const int vertex : near_) add_vertex_on_face(vertex, all);
    take_outer_rows(all, band_ / 16, rows);
  }

  /// The triangle's own plane, where the lowest tool vertex is beside it, near, and every edge between them is a valley's.
  [[gnu::flatten, gnu::noinline]]
  void add_concave_face(const ClosestPoints<Scalar>& closest, Rows& rows) noexcept {
    if (!has_face_ || rows.full() || closest.distance > 4 * band_) return;
    for (const Scalar side : {Scalar(1), Scalar(-1)}) {
      const Vector normal = side * face_normal_;
      const Vector vertex = tool_.vertex(tool_.support(Vector(-normal)));
      const Scalar gap = on_surface(normal.dot(vertex - corners_.col(0)));
      if (!(gap > Scalar(0)) || !is_across_valleys(vertex, normal)) continue;
      rows.push_back(row_of(FeaturePair::vertex_face, normal, vertex, gap));
      rows.back().is_assumed = true;
      return;
    }
  }

  /// Whether the mesh rises from the triangle's plane, on the side given, across each edge that a point lies beyond.
  bool is_across_valleys(const Vector& point, const Vector& normal) const noexcept {
    const Vector normal_world = world_from_tool_ * normal;
    const auto& corners = mesh_.triangle(triangle_);
    for (int k = 0; k < 3; ++k) {
      const Vector start = corners_.col(k);
      const Vector edge = corners_.col((k + 1) % 3) - start;
      if (edge.cross(Vector(point - start)).dot(face_normal_) >= Scalar(0)) continue;
      const int neighbour = mesh_.topology().neighbour(triangle_, k);
      if (neighbour < 0) return false;
      const Vector start_world = mesh_.vertex(corners[index(k)]).template cast<Scalar>();
      bool rises = false;
      for (const int vertex : mesh_.triangle(neighbour)) {
        const Vector along = mesh_.vertex(vertex).template cast<Scalar>() - start_world;
        rises = rises || normal_world.dot(along) > cone_tolerance * along.norm();
      }
      if (!rises) return false;
    }
    return true;
  }

  /// Whether a triangle lies in the plane of this one.
  bool is_in_plane(int other) const noexcept {
    const Vector normal_world = world_from_tool_ * face_normal_;
    const Vector start_world = mesh_.vertex(mesh_.triangle(triangle_)[0]).template cast<Scalar>();
    const auto& corners = mesh_.triangle(other);
    return std::all_of(corners.begin(), corners.end(), [&](int corner) {
      const Vector along = mesh_.vertex(corner).template cast<Scalar>() - start_world;
      return std::abs(normal_world.dot(along)) <= cone_tolerance * along.norm();
    });
  }

  void add_corners_on_faces(Rows& rows) noexcept {
    for (const int vertex : near_) {
      for (const int f : incidence_.vertex_faces(vertex)) {
        const auto all = incidence_.face_vertices(f);
        if (all.front() != vertex) continue;  // each face once
        if (std::all_of(all.begin(), all.end(), [this](int v) { return is_near_[index(v)]; })) add_corners_on_face(tool_.face(f), rows);
      }
    }
  }

  [[gnu::flatten, gnu::noinline]]
  void add_corners_on_face(const ToolFace<Scalar>& face, Rows& rows) noexcept {
    const Vector outward = face.normal;
    if (-outward.dot(normal_) < least_cosine) return;
    const auto& loop = face.vertices;
    for (int k = 0; k < 3; ++k) {
      const Vector corner = corners_.col(k);
      const Scalar gap = on_surface(outward.dot(corner - tool_.vertex(loop[0])));
      if (std::abs(gap) > largest_gap_) continue;
      Scalar room = std::numeric_limits<Scalar>::infinity();
      for (std::size_t i = 0; i < loop.size() && room >= -seam_; ++i) {
        const Vector start = tool_.vertex(loop[i]), edge = tool_.vertex(loop[(i + 1) % loop.size()]) - start;
        room = std::min(room, area_inside<Scalar>(start, edge, corner, outward) / edge.norm());
      }
      if (!(room >= -seam_) || !is_clear_of_neighbours_at_corner(k, Vector(-outward))) continue;
      rows.push_back(row_of(FeaturePair::face_vertex, Vector(-outward), corner, gap, room));
    }
  }

  /// An edge of the triangle in the tool frame.
  struct ObjectEdge {
    int number = 0;
    Vector start, span, direction;  // direction: unit
    Scalar length = Scalar(0);
  };

  void add_edges(Rows& rows) noexcept {
    FixedVector<ObjectEdge, 3> object_edges;
    for (int k = 0; k < 3; ++k) {
      // An edge inside a flat part of the surface touches nothing.
      if (mesh_.topology().edge_convexity(triangle_, k) == Convexity::flat) continue;
      const Vector& span = edges_[index(k)];
      const Scalar length = edge_lengths_[index(k)];
      if (length > Scalar(0)) object_edges.push_back({k, corners_.col(k), span, span / length, length});
    }
    if (object_edges.empty()) return;
    for (const int vertex : near_) {
      for (const int e : incidence_.vertex_edges(vertex)) {
        const auto& ends = incidence_.edge_vertices(e);
        if (ends[0] != vertex || !is_near_[index(ends[1])]) continue;  // each edge once
        const Vector tool_start = tool_.vertex(vertex), tool = tool_.vertex(ends[1]) - tool_start;
        for (const ObjectEdge& object : object_edges) add_edge_pair(tool_start, tool, object, rows);
      }
    }
  }

  void add_edge_pair(const Vector& tool_start, const Vector& tool, const ObjectEdge& object, Rows& rows) noexcept {
    const Vector& u = object.direction;
    const Vector cross = tool.cross(u);
    const Scalar tool_squared = tool.squaredNorm(), cross_squared = cross.squaredNorm();
    if (cross_squared < Scalar(1e-6) * tool_squared) {
      add_parallel_edges(tool_start, tool, object, rows);
      return;
    }
    const Scalar along_normal = cross.dot(normal_);
    if (along_normal * along_normal < least_cosine * least_cosine * cross_squared) return;
    // The lines are closest where the difference of their points is along the normal.
    const Vector between = tool_start - object.start;
    const Vector across = u.cross(tool);
    const Scalar along_object = between.cross(tool).dot(across) / cross_squared;
    const Scalar part_of_tool = between.cross(u).dot(across) / cross_squared;
    if (!(along_object >= Scalar(0) && along_object <= object.length && part_of_tool >= Scalar(0) && part_of_tool <= Scalar(1))) return;
    const Vector normal = cross / (along_normal < Scalar(0) ? -std::sqrt(cross_squared) : std::sqrt(cross_squared));
    const Scalar gap = on_surface(normal.dot(between));
    if (std::abs(gap) > largest_gap_ || !is_clear_of_neighbour_across(object.number, normal)) return;
    const Scalar tool_length = std::sqrt(tool_squared);
    const Scalar room = std::min({along_object, object.length - along_object, part_of_tool * tool_length, (1 - part_of_tool) * tool_length});
    Row row = row_of(FeaturePair::edge_edge, normal, Vector(tool_start + part_of_tool * tool), gap, room);
    row.object_edge = world_from_tool_ * u;
    row.tool_edge = world_from_tool_ * tool / tool_length;
    if constexpr (SweptTool<Tool>) set_core_distance(row);
    rows.push_back(row);
  }

  /// Edges in parallel touch along an interval; its ends hold the tool.
  [[gnu::flatten, gnu::noinline]]
  void add_parallel_edges(const Vector& tool_start, const Vector& tool, const ObjectEdge& edge, Rows& rows) noexcept {
    const Vector &start = edge.start, &object = edge.span;
    const Scalar length_squared = tool.squaredNorm();
    const Scalar first = object.dot(tool) > Scalar(0) ? tool.dot(start - tool_start) : tool.dot(start + object - tool_start);
    const Scalar extent = std::abs(object.dot(tool));
    const Scalar from = std::max(Scalar(0), first / length_squared);
    const Scalar to = std::min(Scalar(1), (first + extent) / length_squared);
    if (!(from < to) || !is_clear_of_neighbour_across(edge.number, normal_)) return;
    for (const Scalar t : {from, to}) {
      const Vector on_tool = tool_start + t * tool;
      const Scalar along = object.dot(on_tool - start) / object.squaredNorm();
      const Vector between = on_tool - start - along * object;
      const Scalar height = normal_.dot(between);
      // Far apart across the normal they only look parallel: no contact there.
      if (std::abs(on_surface(height)) > largest_gap_ || (between - height * normal_).norm() > std::abs(height) + seam_) continue;
      if constexpr (SweptTool<Tool>) {
        const Scalar distance = between.norm();
        Row row = row_of(FeaturePair::vertex_face, Vector(between / distance), on_tool, on_surface(distance));
        row.object_edge = world_from_tool_ * object.normalized();
        set_core_distance(row);
        rows.push_back(row);
      } else {
        rows.push_back(row_of(FeaturePair::vertex_face, normal_, on_tool, height));
      }
    }
  }

  /// A row whose features meet anywhere within `room` of the point. About a corner the normal turns within the gap, and there is next to no room:
  /// with a twentieth of the gap a tool that was about to slip off a ridge passed for one at rest.
  [[gnu::flatten, gnu::noinline]]
  Row row_of(FeaturePair kind, const Vector& normal, const Vector& point, Scalar gap, Scalar room = Scalar(0)) const noexcept {
    Row row;
    row.kind = kind;
    row.room = std::max({room, gap / 64, seam_});
    row.normal = world_from_tool_ * normal;
    row.arm = world_from_tool_ * (point - reference_);
    row.gap = gap;
    return row;
  }

  /// The gap of the tool's surface where its features, of a swept tool those of its core, are so far away [m].
  Scalar on_surface(Scalar distance) const noexcept {
    if constexpr (SweptTool<Tool>) {
      return distance - tool_.swept_radius();
    } else {
      return distance;
    }
  }

  /// About a point or a line the normal of a swept tool turns with the tool; the row knows, and lasts until that is much.
  void set_core_distance(Row& row) const noexcept
    requires SweptTool<Tool>
  {
    row.core_distance = std::max(row.gap + tool_.swept_radius(), tool_.swept_radius() / 2);
    row.room = std::max(row.room, row.core_distance / 20);
  }

  /// A row of shapes that touch along a plane. Which of the two the plane belongs to decides whether it turns with the tool, and where they are
  /// in contact: another plane, a hair askew, would ask for what its neighbours forbid.
  [[gnu::flatten, gnu::noinline]]
  Row row_of_touching(const ClosestPoints<Scalar>& closest) const noexcept {
    if (is_own_plane()) {
      const Vector normal = side_ * face_normal_;
      return row_of(FeaturePair::vertex_face, normal, closest.tool_point, normal.dot(closest.tool_point - corners_.col(0)));
    }
    for (const int f : incidence_.vertex_faces(near_[0])) {
      const Vector normal = -tool_.face(f).normal;
      if (!((normal - normal_).norm() < cone_tolerance)) continue;
      Eigen::Index highest;
      (normal.transpose() * corners_).maxCoeff(&highest);
      const Vector corner = corners_.col(highest);
      return row_of(FeaturePair::face_vertex, normal, corner, normal.dot(closest.tool_point - corner));
    }
    return row_of(FeaturePair::vertex_face, normal_, closest.tool_point, closest.distance);
  }

  /// The row of the closest points of a core, with its curvature from the features that they lie on.
  Row row_of_closest(const ClosestPoints<Scalar>& closest) const noexcept
    requires SweptTool<Tool>
  {
    Row row = row_of(FeaturePair::vertex_face, normal_, closest.tool_point, closest.distance);
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
      if (corners.size() == 2) row.object_edge = world_from_tool_ * Vector(corners_.col(corners[1]) - corners_.col(corners[0])).normalized();
      // Lines in parallel are as near at one place as at another: one of the places stands for them.
      if (row.tool_edge.cross(row.object_edge).squaredNorm() < Scalar(1e-6) && !row.object_edge.isZero(Scalar(0))) row.tool_edge.setZero();
      set_core_distance(row);
    }
    return row;
  }

  /// Where on the triangle the closest point is.
  struct Place {
    int corners;  // that it is between; of overlapping shapes none
    int index;    // of the corner, if one, or the edge, if two
  };
  static Place place_of(const ClosestPoints<Scalar>& closest) noexcept {
    std::array<bool, 3> used{};
    for (std::size_t i = 0; i < std::size_t(closest.features.size); ++i) used[std::size_t(closest.features.corners[i])] = true;
    const int count = int(used[0]) + int(used[1]) + int(used[2]);
    if (count == 1) return {count, used[0] ? 0 : used[1] ? 1 : 2};
    return {count, !used[2] ? 0 : !used[0] ? 1 : 2};
  }
  Vector3<MeshScalar> direction_of(const Vector& normal) const noexcept { return (world_from_tool_ * normal).template cast<MeshScalar>(); }

  bool is_in_cone(const ClosestPoints<Scalar>& closest) const noexcept {
    const Place place = place_of(closest);
    if (place.corners == 1) return is_in_vertex_cone(place.index, normal_);
    if (place.corners == 2) return is_in_edge_cone(place.index, normal_);
    return place.corners == 3 || !is_own_plane() || is_over_surface(closest.tool_point);
  }
  bool is_in_vertex_cone(int corner, const Vector& normal) const noexcept {
    return vertex_cone_contains(mesh_, mesh_.triangle(triangle_)[index(corner)], direction_of(normal), MeshScalar(cone_tolerance));
  }
  bool is_in_edge_cone(int edge, const Vector& normal) const noexcept {
    return edge_cone_contains(mesh_, triangle_, edge, direction_of(normal), MeshScalar(cone_tolerance));
  }

  // In a patch the triangle itself may rise a little from one of its features to the next; both hold the tool. Its neighbours may not.
  bool is_clear_of_neighbours_at_corner(int corner, const Vector& normal) const noexcept {
    return neighbours_point_away(mesh_, triangle_, corner, direction_of(normal), MeshScalar(cone_tolerance));
  }
  bool is_clear_of_neighbour_across(int edge, const Vector& normal) const noexcept {
    return neighbour_points_away(mesh_, triangle_, edge, direction_of(normal), MeshScalar(cone_tolerance));
  }

  const Tool& tool_;
  const FeatureIncidence& incidence_;
  const TriangleMesh<MeshScalar>& mesh_;
  Matrix3<Scalar> world_from_tool_;
  Vector reference_;
  Scalar band_;
  Scalar largest_gap_;  // of a row of features that meet [m]
  Scalar seam_;  // a point so little beside a face counts as over it, or rounding would let it through between two faces [m]
  bool assumes_valleys_;

  int triangle_ = -1;
  Matrix3<Scalar> corners_;
  std::array<Vector, 3> edges_;  // from each corner to the next
  std::array<Scalar, 3> edge_lengths_;
  Vector normal_;
  bool has_face_ = false;
  bool faces_tool_ = false;
  Vector face_normal_ = Vector::Zero();
  Scalar side_ = Scalar(1);
  FixedVector<int, near_capacity> near_;
  std::bitset<256> is_near_;
};

}  // namespace feeler
