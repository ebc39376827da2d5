// The edges of triangles at which the faces of a surface end.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/feature.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/recognition/coplanar_faces.hpp"

namespace feeler::detail {

/// An edge of triangles that is no part of the inside of a face.
struct MeshEdge {
  std::array<int, 2> ends;
  Convexity convexity;
  std::vector<int> faces;  // sorted, each once
};

/// The edges between two faces, around one, or of three triangles or more.
template <RealScalar Scalar>
class SharpEdges {
 public:
  /// @cost  O(n log n), allocates
  SharpEdges(const TriangleMesh<Scalar>& mesh, const CoplanarFaces<Scalar>& faces) {
    const MeshTopology& topology = mesh.topology();
    struct Slot {
      int low, high, slot;
    };
    std::vector<Slot> all_slots;
    triangle_edge_.resize(3 * as_index(mesh.triangle_count()));
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int face = faces.of_triangle()[as_index(t)], neighbour = topology.neighbour(t, k);
        triangle_edge_[as_index(3 * t + k)] = {FeatureKind::face, face};
        if (neighbour >= 0 && faces.of_triangle()[as_index(neighbour)] == face) continue;
        const auto [low, high] = std::minmax(mesh.triangle(t)[as_index(k)], mesh.triangle(t)[as_index((k + 1) % 3)]);
        if (low != high) all_slots.push_back({low, high, 3 * t + k});
      }
    }
    std::sort(all_slots.begin(), all_slots.end(),
              [](const Slot& a, const Slot& b) { return std::array<int, 3>{a.low, a.high, a.slot} < std::array<int, 3>{b.low, b.high, b.slot}; });
    for (const Slot& slot : all_slots) {
      const int triangle = slot.slot / 3;
      if (edges_.empty() || edges_.back().ends != std::array<int, 2>{slot.low, slot.high})
        edges_.push_back({{slot.low, slot.high}, convexity_of(mesh, faces, triangle, slot.slot % 3), {}});
      triangle_edge_[as_index(slot.slot)] = {FeatureKind::edge, int(edges_.size()) - 1};
      edges_.back().faces.push_back(faces.of_triangle()[as_index(triangle)]);
    }
    for (MeshEdge& edge : edges_) {
      std::sort(edge.faces.begin(), edge.faces.end());
      edge.faces.erase(std::unique(edge.faces.begin(), edge.faces.end()), edge.faces.end());
    }
  }

  const std::vector<MeshEdge>& edges() const noexcept { return edges_; }
  /// Of edge k of triangle t, at 3t + k: which of the edges it is, or the face that it is inside of.
  const std::vector<Feature>& of_triangle() const noexcept { return triangle_edge_; }

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

 private:
  static Convexity convexity_of(const TriangleMesh<Scalar>& mesh, const CoplanarFaces<Scalar>& faces, int triangle, int k) noexcept {
    const Convexity known = mesh.topology().edge_convexity(triangle, k);
    if (known != Convexity::flat) return known;
    // Between two faces all the same: one of the triangles has no area. Then the planes of the faces tell.
    const int neighbour = mesh.topology().neighbour(triangle, k);
    const Vector3<Scalar> along = mesh.vertex(mesh.triangle(triangle)[as_index((k + 1) % 3)]) - mesh.vertex(mesh.triangle(triangle)[as_index(k)]);
    const auto normal_at = [&](int t) { return faces.faces()[as_index(faces.of_triangle()[as_index(t)])].normal; };
    const Vector3<Scalar> turn = normal_at(triangle).cross(normal_at(neighbour));
    return turn.dot(along) < Scalar(0) ? Convexity::concave : Convexity::convex;
  }

  std::vector<MeshEdge> edges_;
  std::vector<Feature> triangle_edge_;
};

}  // namespace feeler::detail
