// The object: any set of triangles, with what contact needs to know about them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/requirement.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh.hpp"
#include "feeler/object/mesh_report.hpp"
#include "feeler/object/mesh_topology.hpp"
#include "feeler/object/triangle_normal.hpp"
#include "feeler/object/vertex_weld.hpp"

namespace feeler {

/// An immutable set of triangles in world axes [m]. It need not be closed, consistent or manifold; `report()`
/// says what it is.
///
/// Triangle i is row i of the input, also where it is degenerate or a duplicate: all are obstacles. Vertices
/// at equal positions are welded, and those of no triangle are left out, so vertex numbers differ from the
/// input's. Copies are independent.
template <RealScalar Scalar_>
class TriangleMesh {
 public:
  using Scalar = Scalar_;

  /// Refuses an empty list of triangles, an index out of range, and coordinates that are not finite.
  /// @param vertices   n×3 [m]
  /// @param triangles  m×3, indices into `vertices`, counter-clockwise seen from outside
  /// @cost  O(m log m), allocates; about a second for a million triangles
  TriangleMesh(const Points<Scalar>& vertices, const Triangles& triangles) {
    if (triangles.rows() == 0)
      refuse("TriangleMesh: there are no triangles; give at least one row of three indices");
    for (Eigen::Index i = 0; i < vertices.rows(); ++i)
      if (!vertices.row(i).allFinite())
        refuse("TriangleMesh: vertex " + std::to_string(i) +
               " has a NaN or an infinity; correct its coordinates or remove it and its triangles");
    for (Eigen::Index i = 0; i < triangles.rows(); ++i)
      for (int k = 0; k < 3; ++k)
        if (triangles(i, k) < 0 || triangles(i, k) >= vertices.rows())
          refuse("TriangleMesh: triangle " + std::to_string(i) + " has the index " +
                 std::to_string(triangles(i, k)) + ", but there are " + std::to_string(vertices.rows()) +
                 " vertices; indices start at 0 and must be less than that");
    weld(vertices, triangles);
    for (const Vector3<Scalar>& v : vertices_) bounds_.extend(v);
    topology_ = MeshTopology(vertices_, triangles_, report_);
    const Vector3<Scalar> middle = (bounds_.min)() / 2 + (bounds_.max)() / 2;  // the sum could overflow
    bvh_ = Bvh<Scalar>(vertices_, triangles_, middle);
    report_.triangles = triangle_count();
    report_.vertices = vertex_count();
    for (int i = 0; i < triangle_count(); ++i)
      if (normal(i).isZero()) ++report_.degenerate_triangles;
  }

  int triangle_count() const noexcept { return int(triangles_.size()); }
  int vertex_count() const noexcept { return int(vertices_.size()); }
  const Vector3<Scalar>& vertex(int i) const noexcept { return vertices_[std::size_t(i)]; }
  /// Vertex numbers of the corners, in the order given.
  const std::array<int, 3>& triangle(int i) const noexcept { return triangles_[std::size_t(i)]; }
  /// The corners of a triangle, one a column [m].
  Matrix3<Scalar> corners(int i) const noexcept {
    Matrix3<Scalar> result;
    for (int k = 0; k < 3; ++k) result.col(k) = vertex(triangle(i)[std::size_t(k)]);
    return result;
  }
  /// Unit normal by the right-hand rule; zero if the triangle is degenerate. @cost two square roots
  Vector3<Scalar> normal(int i) const noexcept {
    const std::array<int, 3>& t = triangle(i);
    return triangle_normal<Scalar>(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  }
  const Eigen::AlignedBox<Scalar, 3>& bounds() const noexcept { return bounds_; }
  const MeshTopology& topology() const noexcept { return topology_; }
  const Bvh<Scalar>& bvh() const noexcept { return bvh_; }
  const MeshReport& report() const noexcept { return report_; }

 private:
  void weld(const Points<Scalar>& vertices, const Triangles& triangles) {
    std::vector<int> number(std::size_t(vertices.rows()), -1);
    for (Eigen::Index i = 0; i < triangles.rows(); ++i)
      for (int k = 0; k < 3; ++k) number[std::size_t(triangles(i, k))] = 0;
    detail::VertexWeld<Scalar> welded(number.size());
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      const auto known = welded.vertices().size();
      number[v] = welded.number(vertices.row(Eigen::Index(v)).transpose());
      if (welded.vertices().size() == known) ++report_.welded_vertices;
    }
    vertices_ = std::move(welded.vertices());
    vertices_.shrink_to_fit();
    triangles_.resize(std::size_t(triangles.rows()));
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        triangles_[i][k] = number[std::size_t(triangles(Eigen::Index(i), Eigen::Index(k)))];
  }

  std::vector<Vector3<Scalar>> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  Eigen::AlignedBox<Scalar, 3> bounds_;
  MeshTopology topology_;
  Bvh<Scalar> bvh_;
  MeshReport report_;
};

}  // namespace feeler
