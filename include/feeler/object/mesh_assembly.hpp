// Several meshes as one object.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string>
#include <vector>

#include "feeler/core/requirement.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/given_mesh.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/spatial/pose.hpp"

namespace feeler {

/// Puts meshes together, each at a pose of its own, into one object for the renderer. Its parts may touch or intersect; a contact's
/// triangle tells which part it is on. Equal vertices are welded, across parts too, so parts that meet edge to edge join smoothly.
template <RealScalar ScalarType>
class MeshAssembly {
 public:
  using Scalar = ScalarType;

  /// Refuses an index out of range, as it could mean a vertex of another part, and what is not finite.
  /// @param vertices   n×3, in the frame of the part [m], or in the unit of the scale
  /// @param triangles  m×3, indices into `vertices`, counter-clockwise seen from outside
  /// @param pose       of the part in the world [m]; its quaternion need not be unit
  /// @param scale      metres a unit of `vertices`
  /// @return  its number
  int add(const Points<Scalar>& vertices, const Triangles& triangles, const Pose<Scalar>& pose = {}, Scalar scale = Scalar(1)) {
    return add_rows(vertices, triangles, pose, scale);
  }
  /// The same from arrays as engines keep them; see `TriangleMesh`.
  template <class Number, std::integral Index>
  int add(const Number* vertices, std::size_t vertex_count, const Index* triangles, std::size_t triangle_count, const Pose<Scalar>& pose = {},
          Scalar scale = Scalar(1)) {
    refuse_for(detail::reason_against_arrays("MeshAssembly", vertices, vertex_count, triangles, triangle_count));  // before they are looked at
    return add_rows(detail::rows_of_three(vertices, vertex_count), detail::rows_of_three(triangles, triangle_count), pose, scale);
  }

  /// The sentence with which `add` refuses a part; empty where it does not.
  std::string reason_against(const Points<Scalar>& vertices, const Triangles& triangles, const Pose<Scalar>& pose = {},
                             Scalar scale = Scalar(1)) const {
    return reason_against_rows(vertices, triangles, pose, scale);
  }
  template <class Number, std::integral Index>
  std::string reason_against(const Number* vertices, std::size_t vertex_count, const Index* triangles, std::size_t triangle_count,
                             const Pose<Scalar>& pose = {}, Scalar scale = Scalar(1)) const {
    const std::string reason = detail::reason_against_arrays("MeshAssembly", vertices, vertex_count, triangles, triangle_count);
    if (!reason.empty()) return reason;
    return reason_against_rows(detail::rows_of_three(vertices, vertex_count), detail::rows_of_three(triangles, triangle_count), pose, scale);
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
  template <class VertexRows, class IndexRows>
  std::string reason_against_rows(const VertexRows& vertices, const IndexRows& triangles, const Pose<Scalar>& pose, Scalar scale) const {
    const std::string part = " of part " + std::to_string(part_count());
    if (!pose.is_finite())
      return "MeshAssembly: the pose" + part +
             " has a NaN, a number too large to be squared, or a quaternion near zero; give metres, and w = 1 for no rotation";
    std::string reason = detail::reason_against_counts("MeshAssembly", std::size_t(vertices_.rows() + vertices.rows()),
                                                       std::size_t(triangles_.rows() + triangles.rows()));
    if (reason.empty()) reason = detail::reason_against_mesh("MeshAssembly", part, vertices, triangles, scale);
    if (reason.empty() && !placed(vertices, pose, scale).allFinite())
      reason = "MeshAssembly: a vertex" + part + " is too far away for the scalar of the mesh where the pose puts it; give metres";
    return reason;
  }
  template <class VertexRows>
  static Points<Scalar> placed(const VertexRows& vertices, const Pose<Scalar>& pose, Scalar scale) {
    const Matrix3<Scalar> axes = pose.rotation.normalized().toRotationMatrix();
    return (vertices.template cast<Scalar>() * scale * axes.transpose()).rowwise() + pose.translation.transpose();
  }

  template <class VertexRows, class IndexRows>
  int add_rows(const VertexRows& vertices, const IndexRows& triangles, const Pose<Scalar>& pose, Scalar scale) {
    refuse_for(reason_against_rows(vertices, triangles, pose, scale));
    const Eigen::Index first_vertex = vertices_.rows(), first_triangle = triangles_.rows();
    vertices_.conservativeResize(first_vertex + vertices.rows(), 3);
    vertices_.bottomRows(vertices.rows()) = placed(vertices, pose, scale);
    triangles_.conservativeResize(first_triangle + triangles.rows(), 3);
    triangles_.bottomRows(triangles.rows()) = triangles.template cast<int>().array() + int(first_vertex);
    first_triangles_.push_back(int(first_triangle));
    return part_count() - 1;
  }

  Points<Scalar> vertices_ = Points<Scalar>(0, 3);
  Triangles triangles_ = Triangles(0, 3);
  std::vector<int> first_triangles_;
};

}  // namespace feeler
