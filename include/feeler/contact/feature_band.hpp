// The features of a tool that are close to a separating plane: what may meet the surface beyond it.
#pragma once

#include <algorithm>

#include "feeler/contact/vertex_set.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// The vertices of a tool in a band above a plane, and the edges and faces all of whose vertices they are.
///
/// All in the tool frame.
template <ConvexTool Tool>
class FeatureBand {
 public:
  using Scalar = typename Tool::Scalar;
  using Vector = Vector3<Scalar>;

  /// @param incidence  `incidence_of(tool)`
  /// @param vertices   is filled; made for at least as many as the tool has
  FeatureBand(const Tool& tool, const FeatureIncidence& incidence, VertexSet& vertices) noexcept
      : tool_(tool), incidence_(incidence), vertices_(vertices) {}

  void clear() noexcept { vertices_.clear(); }

  /// Finds the vertices from the lowest along edges: below any height a convex tool hangs together.
  /// @param normal  unit, of the plane, towards the tool
  /// @param height  of the band above the lowest vertex [m]
  /// @cost O(vertices in the band)
  void gather(const ClosestPoints<Scalar>& closest, const Vector& normal, Scalar height) noexcept {
    const int lowest = closest.features.size > 0 ? closest.features.tool_vertices[0] : tool_.support(Vector(-normal));
    const Scalar limit = normal.dot(tool_.vertex(lowest)) + height;
    vertices_.add(lowest);
    for (int i = 0; i < vertices_.size(); ++i) {
      for (const int e : incidence_.vertex_edges(vertices_[i])) {
        for (const int vertex : incidence_.edge_vertices(e)) {
          if (!vertices_.contains(vertex) && normal.dot(tool_.vertex(vertex)) <= limit) vertices_.add(vertex);
        }
      }
    }
  }

  const Tool& tool() const noexcept { return tool_; }
  const VertexSet& vertices() const noexcept { return vertices_; }

  /// Calls `visit(start, span)` with each edge: a vertex, and from there to the other [m].
  template <class Visit>
  void for_each_edge(const Visit& visit) const noexcept {
    for (const int vertex : vertices_) {
      for (const int e : incidence_.vertex_edges(vertex)) {
        const auto& ends = incidence_.edge_vertices(e);
        if (ends[0] != vertex || !vertices_.contains(ends[1])) continue;  // each edge once
        const Vector start = tool_.vertex(vertex), span = tool_.vertex(ends[1]) - start;
        visit(start, span);
      }
    }
  }
  /// Calls `visit(face)` with each face.
  template <class Visit>
  void for_each_face(const Visit& visit) const noexcept {
    for (const int vertex : vertices_) {
      for (const int f : incidence_.vertex_faces(vertex)) {
        const auto all = incidence_.face_vertices(f);
        if (all.front() != vertex) continue;  // each face once
        if (std::all_of(all.begin(), all.end(), [this](int v) { return vertices_.contains(v); })) visit(tool_.face(f));
      }
    }
  }
  /// The faces at a vertex, by number.
  auto faces_at(int vertex) const noexcept { return incidence_.vertex_faces(vertex); }

 private:
  const Tool& tool_;
  const FeatureIncidence& incidence_;
  VertexSet& vertices_;
};

}  // namespace feeler
