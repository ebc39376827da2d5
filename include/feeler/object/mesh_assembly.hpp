// Several meshes as one object.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "feeler/core/requirement.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/spatial/pose.hpp"

namespace feeler {

/// Puts meshes together, each at a pose of its own, into one object for the renderer. Its parts may touch or intersect; a contact's
/// triangle tells which part it is on. Equal vertices are welded, across parts too, so parts that meet edge to edge join smoothly.
template <RealScalar ScalarType>
class MeshAssembly {
 public:
  using Scalar = ScalarType;

  /// Refuses an index out of range, as it could mean a vertex of another part.
  /// @param vertices   n×3, in the frame of the part [m]
  /// @param triangles  m×3, indices into `vertices`, counter-clockwise seen from outside
  /// @param pose       of the part in the world
  /// @return  its number
  int add(const Points<Scalar>& vertices, const Triangles& triangles, const Pose<Scalar>& pose = {}) {
    for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
      for (int k = 0; k < 3; ++k) {
        if (triangles(i, k) >= 0 && triangles(i, k) < vertices.rows()) continue;
        refuse("MeshAssembly: triangle " + std::to_string(i) + " of part " + std::to_string(part_count()) + " has the index " +
               std::to_string(triangles(i, k)) + ", but the part has " + std::to_string(vertices.rows()) +
               " vertices; indices start at 0 in each part and must be less than that");
      }
    }
    const Eigen::Index first_vertex = vertices_.rows(), first_triangle = triangles_.rows();
    const Matrix3<Scalar> axes = pose.rotation.normalized().toRotationMatrix();
    vertices_.conservativeResize(first_vertex + vertices.rows(), 3);
    vertices_.bottomRows(vertices.rows()) = (vertices * axes.transpose()).rowwise() + pose.translation.transpose();
    triangles_.conservativeResize(first_triangle + triangles.rows(), 3);
    triangles_.bottomRows(triangles.rows()) = triangles.array() + int(first_vertex);
    first_triangles_.push_back(int(first_triangle));
    return part_count() - 1;
  }

  int part_count() const noexcept { return int(first_triangles_.size()); }
  /// The part that a triangle of the object belongs to.
  int part_of(int triangle) const noexcept {
    return int(std::upper_bound(first_triangles_.begin(), first_triangles_.end(), triangle) - first_triangles_.begin()) - 1;
  }
  /// The number in the object of the first triangle of a part; the others follow in their order.
  int first_triangle(int part) const noexcept { return first_triangles_[std::size_t(part)]; }

  /// The object; refuses what `TriangleMesh` refuses.
  TriangleMesh<Scalar> mesh() const { return {vertices_, triangles_}; }
  /// All vertices in world axes [m], and the triangles over them.
  const Points<Scalar>& vertices() const noexcept { return vertices_; }
  const Triangles& triangles() const noexcept { return triangles_; }

 private:
  Points<Scalar> vertices_ = Points<Scalar>(0, 3);
  Triangles triangles_ = Triangles(0, 3);
  std::vector<int> first_triangles_;
};

}  // namespace feeler
