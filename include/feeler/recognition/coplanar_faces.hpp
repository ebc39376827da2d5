// The faces of a surface: its triangles as they hang together in planes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/recognition/surface_feature.hpp"

namespace feeler::detail {

/// Joins triangles across flat edges. Those without area join a face, but join no faces to each other.
template <RealScalar Scalar>
class CoplanarFaces {
 public:
  /// @cost  linear in the triangles, allocates
  explicit CoplanarFaces(const TriangleMesh<Scalar>& mesh) {
    triangle_face_.assign(as_index(mesh.triangle_count()), -1);
    for (const bool with_area : {true, false})
      for (int t = 0; t < mesh.triangle_count(); ++t)
        if (triangle_face_[as_index(t)] < 0 && mesh.normal(t).isZero() != with_area) grow(mesh, t);
  }

  const std::vector<SurfaceFace<Scalar>>& faces() const noexcept { return faces_; }
  /// The face of each triangle.
  const std::vector<int>& of_triangle() const noexcept { return triangle_face_; }

 private:
  /// A triangle of the face at hand, and whether it faces the side of the first one.
  struct Member {
    int triangle;
    Scalar orientation;  // 1 or −1
  };

  /// Adds the face that a triangle is in.
  void grow(const TriangleMesh<Scalar>& mesh, int seed) {
    const int number = int(faces_.size());
    SurfaceFace<Scalar>& face = faces_.emplace_back();
    face.first_triangle = seed;
    Scalar largest = Scalar(-1);
    triangle_face_[as_index(seed)] = number;
    std::vector<Member> members{{seed, Scalar(1)}};
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto [triangle, orientation] = members[i];
      face.first_triangle = (std::min)(face.first_triangle, triangle);
      const Matrix3<Scalar> corners = mesh.corners(triangle);
      const Vector3<Scalar> normal = mesh.normal(triangle);
      const Scalar area = Vector3<Scalar>(corners.col(1) - corners.col(0)).cross(Vector3<Scalar>(corners.col(2) - corners.col(0))).norm();
      if (area > largest) {
        largest = area;
        face.normal = orientation * normal;
        face.point = corners.col(0);
      }
      if (normal.isZero()) continue;  // no bridge: it lies in any plane through its line
      for (int k = 0; k < 3; ++k) {
        const int neighbour = mesh.topology().neighbour(triangle, k);
        if (neighbour < 0 || triangle_face_[as_index(neighbour)] >= 0 || mesh.topology().edge_convexity(triangle, k) != Convexity::flat) continue;
        triangle_face_[as_index(neighbour)] = number;
        members.push_back({neighbour, faces_same_side(mesh, triangle, k, neighbour) ? orientation : Scalar(-orientation)});
      }
    }
  }

  /// Neighbours face the same side if they pass their common edge in opposite directions.
  static bool faces_same_side(const TriangleMesh<Scalar>& mesh, int triangle, int k, int neighbour) noexcept {
    const int start = mesh.triangle(triangle)[as_index(k)], end = mesh.triangle(triangle)[as_index((k + 1) % 3)];
    const auto& other = mesh.triangle(neighbour);
    for (int j = 0; j < 3; ++j)
      if (other[as_index(j)] == start && other[as_index((j + 1) % 3)] == end) return false;
    return true;
  }

  std::vector<SurfaceFace<Scalar>> faces_;
  std::vector<int> triangle_face_;
};

}  // namespace feeler::detail
