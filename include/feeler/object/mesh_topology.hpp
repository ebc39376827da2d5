// How the triangles of a mesh hang together: neighbours, and which edges and vertices stick out.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"
#include "feeler/object/edge_pairing.hpp"
#include "feeler/object/triangle_normal.hpp"

namespace feeler {

/// The shape of a surface at an edge or a vertex, seen from the side that the triangle normals point to.
enum class Convexity : std::uint8_t {
  convex,        ///< a ridge or a tip
  concave,       ///< a valley or a pit
  flat,          ///< to rounding of the coordinates
  mixed,         ///< vertices only: ridges and valleys meet
  boundary,      ///< the surface ends here
  non_manifold,  ///< three triangles or more share the edge
};

/// Neighbours and convexities of the edges and vertices of a mesh. Knows indices only, so a copied mesh
/// copies it as it is.
///
/// Edge k of a triangle goes from its corner k to its corner (k+1)%3. All calls are noexcept, allocate
/// nothing and cost a look-up.
class MeshTopology {
 public:
  static constexpr int boundary = detail::boundary_neighbour;  ///< no triangle is across the edge
  static constexpr int non_manifold = detail::non_manifold_neighbour;  ///< two triangles or more are across the edge

  MeshTopology() = default;
  /// @param report  receives the counts of edges, duplicates and non-manifold vertices
  /// @cost  linear in the triangles, allocates
  template <RealScalar Scalar>
  MeshTopology(const std::vector<Vector3<Scalar>>& vertices, const std::vector<std::array<int, 3>>& triangles, MeshReport& report) {
    detail::EdgePairing pairing(int(vertices.size()), triangles, report);
    neighbours_ = std::move(pairing.neighbours);
    vertex_neighbour_begin_ = std::move(pairing.vertex_neighbour_begin);
    vertex_neighbours_ = std::move(pairing.vertex_neighbours);
    edge_convexity_.resize(neighbours_.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) edge_convexity_[3 * t + k] = convexity_of(vertices, triangles, int(t), int(k));
    summarise_vertices(int(vertices.size()), triangles);
  }

  /// The triangle across an edge, or `boundary` or `non_manifold`, which are negative.
  int neighbour(int triangle, int k) const noexcept { return neighbours_[std::size_t(3 * triangle + k)]; }
  /// Never `mixed`.
  Convexity edge_convexity(int triangle, int k) const noexcept { return edge_convexity_[std::size_t(3 * triangle + k)]; }
  /// `convex` or `concave` if all of the vertex's edges that are not flat are so; `boundary` if one has not
  /// exactly two triangles.
  Convexity vertex_convexity(int vertex) const noexcept { return vertex_convexity_[std::size_t(vertex)]; }
  /// The vertices that share an edge with a vertex, each once.
  std::span<const int> vertex_neighbours(int vertex) const noexcept {
    const auto begin = std::size_t(vertex_neighbour_begin_[std::size_t(vertex)]);
    const auto end = std::size_t(vertex_neighbour_begin_[std::size_t(vertex) + 1]);
    return std::span<const int>(vertex_neighbours_.data() + begin, end - begin);
  }

 private:
  template <RealScalar Scalar>
  Convexity convexity_of(const std::vector<Vector3<Scalar>>& vertices, const std::vector<std::array<int, 3>>& triangles, int triangle,
                         int k) const noexcept {
    using Working = WorkingScalar<Scalar>;
    const int other = neighbour(triangle, k);
    if (other == boundary) return Convexity::boundary;
    if (other == non_manifold) return Convexity::non_manifold;
    const auto& corners = triangles[std::size_t(triangle)];
    const int a = corners[std::size_t(k)], b = corners[std::size_t((k + 1) % 3)], c = corners[std::size_t((k + 2) % 3)];
    int d = b;
    for (const int corner : triangles[std::size_t(other)])
      if (corner != a && corner != b) d = corner;
    const auto at = [&vertices](int v) { return Vector3<Working>(vertices[std::size_t(v)].template cast<Working>()); };
    const Vector3<Working> along = (at(b) - at(a)).normalized();
    // From the edge into either triangle, perpendicular to the edge.
    const auto inward = [&](int v) {
      const Vector3<Working> w = at(v) - at(a);
      return Vector3<Working>(w - along * along.dot(w));
    };
    const Vector3<Working> own = inward(c), across = inward(d);
    const Working own_height = own.norm(), across_height = across.norm();
    const Vector3<Working> normal = triangle_normal<Working>(at(a), at(b), at(c));
    const Working lowest = (std::min)(own_height, across_height);
    if (!(lowest > Working(0)) || normal.isZero()) return Convexity::flat;
    // A corner is known to its rounding, which tilts a low triangle more than a high one.
    const Working size =
        (std::max)({at(a).cwiseAbs().maxCoeff(), at(b).cwiseAbs().maxCoeff(), at(c).cwiseAbs().maxCoeff(), at(d).cwiseAbs().maxCoeff()});
    const Working tolerance = 8 * Working(std::numeric_limits<Scalar>::epsilon()) * (1 + size / lowest);
    const Working sine = normal.dot(across) / across_height;
    if (sine > tolerance) return Convexity::concave;
    if (sine < -tolerance) return Convexity::convex;
    return own.dot(across) > Working(0) ? Convexity::convex : Convexity::flat;  // folded back on itself: a knife edge
  }

  void summarise_vertices(int vertex_count, const std::vector<std::array<int, 3>>& triangles) {
    vertex_convexity_.assign(std::size_t(vertex_count), Convexity::flat);
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t end : {k, (k + 1) % 3}) {
          Convexity& vertex = vertex_convexity_[std::size_t(triangles[t][end])];
          vertex = together(vertex, edge_convexity_[3 * t + k]);
        }
  }
  static Convexity together(Convexity vertex, Convexity edge) noexcept {
    if (vertex == Convexity::boundary || edge == Convexity::boundary || edge == Convexity::non_manifold) return Convexity::boundary;
    if (edge == Convexity::flat || vertex == edge) return vertex;
    return vertex == Convexity::flat ? edge : Convexity::mixed;
  }

  std::vector<std::int32_t> neighbours_;
  std::vector<std::int32_t> vertex_neighbour_begin_;
  std::vector<std::int32_t> vertex_neighbours_;
  std::vector<Convexity> edge_convexity_;
  std::vector<Convexity> vertex_convexity_;
};

}  // namespace feeler
