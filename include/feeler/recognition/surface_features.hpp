// The vertices, edges and faces of an object's surface, whatever triangles it is made of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "feeler/core/disjoint_sets.hpp"
#include "feeler/core/feature.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/recognition/coplanar_faces.hpp"
#include "feeler/recognition/sharp_edges.hpp"
#include "feeler/recognition/surface_feature.hpp"

namespace feeler {

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
    const detail::CoplanarFaces<Scalar> planes(mesh);
    const detail::SharpEdges<Scalar> sharp(mesh, planes);
    faces_ = planes.faces();
    triangle_face_ = planes.of_triangle();
    triangle_edge_ = sharp.of_triangle();
    detail::DisjointSets chains(sharp.edges().size());
    Incidences incidences;
    const std::vector<int> corners = find_vertices(mesh, sharp, chains, incidences);
    find_edges(sharp, chains, corners, incidences);
    incidence_ = FeatureIncidence(vertex_count(), std::move(incidences.edge_ends), face_count(), incidences.edge_faces, incidences.vertex_faces);
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
  /// What is at what, by the numbers of the features.
  struct Incidences {
    std::vector<std::array<int, 2>> edge_ends;
    std::vector<std::pair<int, int>> edge_faces, vertex_faces;
  };

  /// Finds the vertices; of a vertex of the mesh its number among them, or −1.
  /// @param chains  sharp edges that are one straight edge are joined, with the first as root
  std::vector<int> find_vertices(const TriangleMesh<Scalar>& mesh, const detail::SharpEdges<Scalar>& sharp, detail::DisjointSets& chains,
                                 Incidences& incidences) {
    std::vector<std::pair<int, int>> at_vertex, faces_at_vertex;
    for (std::size_t e = 0; e < sharp.edges().size(); ++e)
      for (const int end : sharp.edges()[e].ends) at_vertex.emplace_back(end, int(e));
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (const int v : mesh.triangle(t)) faces_at_vertex.emplace_back(v, face_of_triangle(t));
    const detail::NumberLists edges_of(mesh.vertex_count(), std::move(at_vertex));
    const detail::NumberLists faces_of(mesh.vertex_count(), std::move(faces_at_vertex));

    vertex_feature_.resize(as_index(mesh.vertex_count()));
    std::vector<int> corners(as_index(mesh.vertex_count()), -1);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const auto edges = edges_of[v];
      const auto faces = faces_of[v];
      if (edges.empty() && faces.size() <= 1) {
        vertex_feature_[as_index(v)] = {FeatureKind::face, faces[0]};
      } else if (edges.size() == 2 &&
                 detail::SharpEdges<Scalar>::continues(mesh, v, sharp.edges()[as_index(edges[0])], sharp.edges()[as_index(edges[1])], faces.size())) {
        const int a = chains.root(edges[0]), b = chains.root(edges[1]);
        chains.join((std::max)(a, b), (std::min)(a, b));
      } else {
        corners[as_index(v)] = vertex_count();
        vertex_feature_[as_index(v)] = {FeatureKind::vertex, vertex_count()};
        for (const int f : faces) incidences.vertex_faces.emplace_back(vertex_count(), f);
        vertices_.push_back({v, false, false, false, mesh.vertex(v)});
      }
    }
    return corners;
  }

  /// Finds the straight edges between corners.
  void find_edges(const detail::SharpEdges<Scalar>& sharp, detail::DisjointSets& chains, const std::vector<int>& corners, Incidences& incidences) {
    std::vector<int> number(sharp.edges().size(), -1);
    for (std::size_t e = 0; e < sharp.edges().size(); ++e) {
      const auto root = as_index(chains.root(int(e)));
      const detail::MeshEdge& first = sharp.edges()[root];
      if (number[root] < 0) {
        number[root] = edge_count();
        edges_.emplace_back();
        edges_.back().convexity = first.convexity;
        incidences.edge_ends.push_back({-1, -1});
        for (const int f : first.faces) incidences.edge_faces.emplace_back(number[root], f);
      }
      number[e] = number[root];
      for (const int end : sharp.edges()[e].ends) {
        const int corner = corners[as_index(end)];
        if (corner < 0) {
          vertex_feature_[as_index(end)] = {FeatureKind::edge, number[e]};
          continue;
        }
        auto& both = incidences.edge_ends[as_index(number[e])];
        (both[0] < 0 ? both[0] : both[1]) = corner;
        note_edge(sharp.edges()[e].convexity, vertices_[as_index(corner)]);
      }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      edges_[e].start = vertices_[as_index(incidences.edge_ends[e][0])].point;
      edges_[e].end = vertices_[as_index(incidences.edge_ends[e][1])].point;
    }
    for (Feature& feature : triangle_edge_)
      if (feature.kind == FeatureKind::edge) feature.index = number[as_index(feature.index)];
  }

  /// An edge ends in a vertex.
  static void note_edge(Convexity convexity, SurfaceVertex<Scalar>& vertex) noexcept {
    (convexity == Convexity::convex ? vertex.has_ridge : convexity == Convexity::concave ? vertex.has_valley : vertex.has_rim) = true;
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
