// The vertices, edges and faces of an object's surface, whatever triangles it is made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/feature.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// The side of a surface that a tool is on: that of the triangle normals, or the other one.
enum class SurfaceSide : signed char { front = 1, back = -1 };

/// A maximal connected patch of coplanar triangles.
template <class Scalar>
struct SurfaceFace {
  int first_triangle = -1;  ///< the smallest one
  Vector3<Scalar> normal = Vector3<Scalar>::Zero();  ///< unit, of the largest triangle; zero where all are degenerate
  Vector3<Scalar> point = Vector3<Scalar>::Zero();   ///< a corner of the largest triangle, world [m]
};

/// A straight edge between two corners. World axes [m].
template <class Scalar>
struct SurfaceEdge {
  Convexity convexity = Convexity::convex;  ///< from the front; convex, concave, boundary or non_manifold
  Vector3<Scalar> start = Vector3<Scalar>::Zero();
  Vector3<Scalar> end = Vector3<Scalar>::Zero();
};

/// A corner of the surface. World axes [m].
template <class Scalar>
struct SurfaceVertex {
  int mesh_vertex = -1;
  bool has_ridge = false;   ///< from the front
  bool has_valley = false;  ///< from the front
  bool has_rim = false;     ///< an edge that has not two triangles: a ridge from both sides
  Vector3<Scalar> point = Vector3<Scalar>::Zero();
};

/// Features of a surface: coplanar triangles that are joined by flat edges are one face, collinear edges between the same faces one edge,
/// and vertices inside of either are no features. So another triangulation of a surface has the same features.
///
/// Flat is what `MeshTopology` calls so. Triangles without area join a face, but join no faces to each other. Rims of open sheets, and
/// edges of three triangles or more, count as convex: they can be touched like a ridge. Where neighbouring triangles face opposite sides,
/// the front is that of the smallest triangle of the face. Holds copies: the mesh may go.
template <RealScalar Scalar_>
class SurfaceFeatures {
 public:
  using Scalar = Scalar_;

  /// @cost  O(n log n), allocates
  explicit SurfaceFeatures(const TriangleMesh<Scalar>& mesh) {
    find_faces(mesh);
    const std::vector<MeshEdge> mesh_edges = sharp_edges(mesh);
    find_edges_and_vertices(mesh, mesh_edges);
  }

  int face_count() const noexcept { return int(faces_.size()); }
  int edge_count() const noexcept { return int(edges_.size()); }
  int vertex_count() const noexcept { return int(vertices_.size()); }
  const SurfaceFace<Scalar>& face(int i) const noexcept { return faces_[std::size_t(i)]; }
  const SurfaceEdge<Scalar>& edge(int i) const noexcept { return edges_[std::size_t(i)]; }
  const SurfaceVertex<Scalar>& vertex(int i) const noexcept { return vertices_[std::size_t(i)]; }
  const FeatureIncidence& incidence() const noexcept { return incidence_; }

  /// The face that a triangle belongs to.
  int face_of_triangle(int triangle) const noexcept { return triangle_face_[std::size_t(triangle)]; }
  /// The edge that edge k of a triangle is a piece of, or the face that it is inside of.
  Feature feature_of_edge(int triangle, int k) const noexcept { return triangle_edge_[std::size_t(3 * triangle + k)]; }
  /// What a vertex of the mesh is, or is inside of.
  Feature feature_of_vertex(int mesh_vertex) const noexcept { return vertex_feature_[std::size_t(mesh_vertex)]; }

  /// Shape of a feature seen from a side: convex, concave, mixed (vertices only), or flat for a face.
  Convexity convexity(const Feature& feature, SurfaceSide side) const noexcept {
    if (feature.kind == FeatureKind::face) return Convexity::flat;
    bool ridge = false, valley = false;
    if (feature.kind == FeatureKind::edge) {
      const Convexity own = edge(feature.index).convexity;
      if (own == Convexity::boundary || own == Convexity::non_manifold) return Convexity::convex;
      ridge = own == Convexity::convex;
      valley = own == Convexity::concave;
      if (side == SurfaceSide::back) std::swap(ridge, valley);
    } else {
      const SurfaceVertex<Scalar>& own = vertex(feature.index);
      ridge = own.has_ridge;
      valley = own.has_valley;
      if (side == SurfaceSide::back) std::swap(ridge, valley);
      ridge = ridge || own.has_rim;
    }
    return ridge && valley ? Convexity::mixed : valley ? Convexity::concave : Convexity::convex;
  }

 private:
  /// An edge of triangles that is no part of the inside of a face.
  struct MeshEdge {
    std::array<int, 2> ends;
    Convexity convexity;
    std::vector<int> faces;  // sorted, each once
  };

  static std::size_t at(int i) noexcept { return std::size_t(i); }

  void find_faces(const TriangleMesh<Scalar>& mesh) {
    const MeshTopology& topology = mesh.topology();
    triangle_face_.assign(at(mesh.triangle_count()), -1);
    std::vector<int> open;
    const auto grow = [&](int seed) {
      const int face = face_count();
      faces_.emplace_back();
      faces_.back().first_triangle = seed;
      Scalar largest = Scalar(-1);
      open.assign(1, seed);
      triangle_face_[at(seed)] = face;
      std::vector<signed char> orientation{1};  // of the triangles in `open`
      for (std::size_t i = 0; i < open.size(); ++i) {
        const int triangle = open[i];
        faces_.back().first_triangle = (std::min)(faces_.back().first_triangle, triangle);
        const Matrix3<Scalar> corners = mesh.corners(triangle);
        const Vector3<Scalar> normal = mesh.normal(triangle);
        const Scalar area = Vector3<Scalar>(corners.col(1) - corners.col(0)).cross(Vector3<Scalar>(corners.col(2) - corners.col(0))).norm();
        if (area > largest) {
          largest = area;
          faces_.back().normal = Scalar(orientation[i]) * normal;
          faces_.back().point = corners.col(0);
        }
        if (normal.isZero()) continue;  // no bridge: it lies in any plane through its line
        for (int k = 0; k < 3; ++k) {
          const int neighbour = topology.neighbour(triangle, k);
          if (neighbour < 0 || triangle_face_[at(neighbour)] >= 0) continue;
          if (topology.edge_convexity(triangle, k) != Convexity::flat) continue;
          triangle_face_[at(neighbour)] = face;
          open.push_back(neighbour);
          orientation.push_back(faces_same_side(mesh, triangle, k, neighbour) ? orientation[i] : static_cast<signed char>(-orientation[i]));
        }
      }
    };
    for (const bool with_area : {true, false})
      for (int t = 0; t < mesh.triangle_count(); ++t)
        if (triangle_face_[at(t)] < 0 && mesh.normal(t).isZero() != with_area) grow(t);
  }

  /// Neighbours face the same side if they pass their common edge in opposite directions.
  static bool faces_same_side(const TriangleMesh<Scalar>& mesh, int triangle, int k, int neighbour) noexcept {
    const int start = mesh.triangle(triangle)[at(k)], end = mesh.triangle(triangle)[at((k + 1) % 3)];
    const auto& other = mesh.triangle(neighbour);
    for (int j = 0; j < 3; ++j)
      if (other[at(j)] == start && other[at((j + 1) % 3)] == end) return false;
    return true;
  }

  /// The edges of triangles between two faces, around one, or of three triangles or more; fills in the edges inside faces.
  std::vector<MeshEdge> sharp_edges(const TriangleMesh<Scalar>& mesh) {
    const MeshTopology& topology = mesh.topology();
    struct Slot {
      int low, high, slot;
    };
    std::vector<Slot> all_slots;
    triangle_edge_.resize(3 * at(mesh.triangle_count()));
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int face = face_of_triangle(t), neighbour = topology.neighbour(t, k);
        triangle_edge_[at(3 * t + k)] = {FeatureKind::face, face};
        if (neighbour >= 0 && face_of_triangle(neighbour) == face) continue;
        const auto [low, high] = std::minmax(mesh.triangle(t)[at(k)], mesh.triangle(t)[at((k + 1) % 3)]);
        if (low != high) all_slots.push_back({low, high, 3 * t + k});
      }
    }
    std::sort(all_slots.begin(), all_slots.end(),
              [](const Slot& a, const Slot& b) { return std::array<int, 3>{a.low, a.high, a.slot} < std::array<int, 3>{b.low, b.high, b.slot}; });
    std::vector<MeshEdge> result;
    for (const Slot& slot : all_slots) {
      const int triangle = slot.slot / 3;
      if (result.empty() || result.back().ends != std::array<int, 2>{slot.low, slot.high})
        result.push_back({{slot.low, slot.high}, convexity_of(mesh, triangle, slot.slot % 3), {}});
      triangle_edge_[at(slot.slot)] = {FeatureKind::edge, int(result.size()) - 1};  // of the mesh, for now
      result.back().faces.push_back(face_of_triangle(triangle));
    }
    for (MeshEdge& edge : result) {
      std::sort(edge.faces.begin(), edge.faces.end());
      edge.faces.erase(std::unique(edge.faces.begin(), edge.faces.end()), edge.faces.end());
    }
    return result;
  }

  Convexity convexity_of(const TriangleMesh<Scalar>& mesh, int triangle, int k) const noexcept {
    const Convexity known = mesh.topology().edge_convexity(triangle, k);
    if (known != Convexity::flat) return known;
    // Between two faces all the same: one of the triangles has no area. Then the planes of the faces tell.
    const int neighbour = mesh.topology().neighbour(triangle, k);
    const Vector3<Scalar> along = mesh.vertex(mesh.triangle(triangle)[at((k + 1) % 3)]) - mesh.vertex(mesh.triangle(triangle)[at(k)]);
    const Vector3<Scalar> turn = face(face_of_triangle(triangle)).normal.cross(face(face_of_triangle(neighbour)).normal);
    return turn.dot(along) < Scalar(0) ? Convexity::concave : Convexity::convex;
  }

  void find_edges_and_vertices(const TriangleMesh<Scalar>& mesh, const std::vector<MeshEdge>& mesh_edges) {
    std::vector<std::pair<int, int>> at_vertex, faces_at_vertex;
    for (std::size_t e = 0; e < mesh_edges.size(); ++e)
      for (const int end : mesh_edges[e].ends) at_vertex.emplace_back(end, int(e));
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (const int v : mesh.triangle(t)) faces_at_vertex.emplace_back(v, face_of_triangle(t));
    const detail::NumberLists edges_of(mesh.vertex_count(), std::move(at_vertex));
    const detail::NumberLists faces_of(mesh.vertex_count(), std::move(faces_at_vertex));

    std::vector<int> parent(mesh_edges.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](int e) {
      while (parent[at(e)] != e) e = parent[at(e)] = parent[at(parent[at(e)])];
      return e;
    };
    std::vector<char> is_corner(at(mesh.vertex_count()), 0);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const auto edges = edges_of[v];
      if (edges.empty()) {
        is_corner[at(v)] = faces_of[v].size() > 1;
      } else if (edges.size() == 2 && continues(mesh, v, mesh_edges[at(edges[0])], mesh_edges[at(edges[1])], faces_of[v].size())) {
        const int a = root(edges[0]), b = root(edges[1]);
        parent[at((std::max)(a, b))] = (std::min)(a, b);
      } else {
        is_corner[at(v)] = 1;
      }
    }

    vertex_feature_.resize(at(mesh.vertex_count()));
    std::vector<int> corner_number(at(mesh.vertex_count()), -1);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (!is_corner[at(v)]) continue;
      corner_number[at(v)] = vertex_count();
      vertex_feature_[at(v)] = {FeatureKind::vertex, vertex_count()};
      vertices_.push_back({v, false, false, false, mesh.vertex(v)});
    }

    std::vector<int> number(mesh_edges.size(), -1);
    std::vector<std::array<int, 2>> ends;
    std::vector<std::pair<int, int>> edge_faces, vertex_faces;
    for (std::size_t e = 0; e < mesh_edges.size(); ++e) {
      const auto r = at(root(int(e)));
      if (number[r] < 0) {
        number[r] = edge_count();
        edges_.emplace_back();
        edges_.back().convexity = mesh_edges[r].convexity;
        ends.push_back({-1, -1});
        for (const int f : mesh_edges[r].faces) edge_faces.emplace_back(number[r], f);
      }
      number[e] = number[r];
      for (const int end : mesh_edges[e].ends) {
        const int corner = corner_number[at(end)];
        if (corner >= 0) {
          auto& both = ends[at(number[e])];
          (both[0] < 0 ? both[0] : both[1]) = corner;
          const Convexity convexity = mesh_edges[e].convexity;
          auto& vertex = vertices_[at(corner)];
          (convexity == Convexity::convex ? vertex.has_ridge : convexity == Convexity::concave ? vertex.has_valley : vertex.has_rim) = true;
        } else {
          vertex_feature_[at(end)] = {FeatureKind::edge, number[e]};
        }
      }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      edges_[e].start = vertices_[at(ends[e][0])].point;
      edges_[e].end = vertices_[at(ends[e][1])].point;
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      if (is_corner[at(v)]) {
        for (const int f : faces_of[v]) vertex_faces.emplace_back(corner_number[at(v)], f);
      } else if (edges_of[v].empty()) {
        vertex_feature_[at(v)] = {FeatureKind::face, faces_of[v][0]};
      }
    }
    for (Feature& feature : triangle_edge_)
      if (feature.kind == FeatureKind::edge) feature.index = number[at(feature.index)];
    incidence_ = FeatureIncidence(vertex_count(), std::move(ends), face_count(), edge_faces, vertex_faces);
  }

  /// Whether two edges that meet in a vertex are one straight edge there.
  static bool continues(const TriangleMesh<Scalar>& mesh, int vertex, const MeshEdge& a, const MeshEdge& b, std::size_t faces_at_vertex) noexcept {
    if (a.convexity != b.convexity || a.faces != b.faces || faces_at_vertex != a.faces.size()) return false;
    using Working = WorkingScalar<Scalar>;
    const auto other_end = [&](const MeshEdge& edge) {
      return Vector3<Working>(mesh.vertex(edge.ends[0] == vertex ? edge.ends[1] : edge.ends[0]).template cast<Working>());
    };
    const Vector3<Working> middle = mesh.vertex(vertex).template cast<Working>();
    const Vector3<Working> first = other_end(a) - middle, second = other_end(b) - middle;
    const Working shortest = (std::min)(first.norm(), second.norm());
    const Working size = (std::max)({middle.cwiseAbs().maxCoeff(), other_end(a).cwiseAbs().maxCoeff(), other_end(b).cwiseAbs().maxCoeff()});
    const Working sine = first.normalized().cross(second.normalized()).norm();
    // A vertex is known to its rounding, which turns a short edge more than a long one.
    return first.dot(second) < Working(0) && sine <= 16 * Working(std::numeric_limits<Scalar>::epsilon()) * (1 + size / shortest);
  }

  std::vector<SurfaceFace<Scalar>> faces_;
  std::vector<SurfaceEdge<Scalar>> edges_;
  std::vector<SurfaceVertex<Scalar>> vertices_;
  FeatureIncidence incidence_;
  std::vector<int> triangle_face_;
  std::vector<Feature> triangle_edge_;
  std::vector<Feature> vertex_feature_;
};

}  // namespace feeler
