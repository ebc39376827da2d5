// The object: any set of triangles, with what contact needs to know about them.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/requirement.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh.hpp"
#include "feeler/object/given_mesh.hpp"
#include "feeler/object/mesh_report.hpp"
#include "feeler/object/mesh_topology.hpp"
#include "feeler/object/triangle_normal.hpp"
#include "feeler/object/vertex_weld.hpp"
#include "feeler/object/walls.hpp"

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
  /// @param vertices   n×3 [m], or in the unit of the scale
  /// @param triangles  m×3, indices into `vertices`, counter-clockwise seen from outside
  /// @param scale      metres a unit: 0.001 for vertices in millimetres
  /// @cost  O(m log m), allocates; about a second for a million triangles
  TriangleMesh(const Points<Scalar>& vertices, const Triangles& triangles, Scalar scale = Scalar(1)) {
    refuse_for(reason_against(vertices, triangles, scale));
    build(vertices, triangles, scale);
  }
  /// The same from arrays as engines keep them, x, y, z of one vertex after the other, three indices of one triangle after the other. They are
  /// read in place, and not needed afterwards.
  /// @param vertices   3·`vertex_count` numbers of any type
  /// @param triangles  3·`triangle_count` integers of any type
  template <class Number, std::integral Index>
  TriangleMesh(const Number* vertices, std::size_t vertex_count, const Index* triangles, std::size_t triangle_count, Scalar scale = Scalar(1)) {
    refuse_for(reason_against(vertices, vertex_count, triangles, triangle_count, scale));
    build(detail::rows_of_three(vertices, vertex_count), detail::rows_of_three(triangles, triangle_count), scale);
  }

  /// The sentence with which a constructor refuses what it is given; empty where it does not.
  static std::string reason_against(const Points<Scalar>& vertices, const Triangles& triangles, Scalar scale = Scalar(1)) {
    const std::string reason = detail::reason_against_counts("TriangleMesh", std::size_t(vertices.rows()), std::size_t(triangles.rows()));
    return reason.empty() ? reason_against_rows(vertices, triangles, scale) : reason;
  }
  template <class Number, std::integral Index>
  static std::string reason_against(const Number* vertices, std::size_t vertex_count, const Index* triangles, std::size_t triangle_count,
                                    Scalar scale = Scalar(1)) {
    const std::string reason = detail::reason_against_arrays("TriangleMesh", vertices, vertex_count, triangles, triangle_count);
    if (!reason.empty()) return reason;  // nothing is read
    return reason_against_rows(detail::rows_of_three(vertices, vertex_count), detail::rows_of_three(triangles, triangle_count), scale);
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
  const Walls<Scalar>& walls() const noexcept { return walls_; }
  const MeshReport& report() const noexcept { return report_; }

 private:
  template <class VertexRows, class IndexRows>
  static std::string reason_against_rows(const VertexRows& vertices, const IndexRows& triangles, Scalar scale) {
    if (triangles.rows() == 0) return "TriangleMesh: there are no triangles; give at least one row of three indices";
    return detail::reason_against_mesh("TriangleMesh", "", vertices, triangles, scale);
  }

  template <class VertexRows, class IndexRows>
  void build(const VertexRows& vertices, const IndexRows& triangles, Scalar scale) {
    weld(vertices, triangles, scale);
    for (const Vector3<Scalar>& v : vertices_) bounds_.extend(v);
    topology_ = MeshTopology(vertices_, triangles_, report_);
    const Vector3<Scalar> middle = (bounds_.min)() / 2 + (bounds_.max)() / 2;  // the sum could overflow
    bvh_ = Bvh<Scalar>(vertices_, triangles_, middle);
    walls_ = Walls<Scalar>(vertices_, triangles_, topology_, bvh_, bounds_.sizes().maxCoeff());
    report_.triangles = triangle_count();
    report_.vertices = vertex_count();
    for (int i = 0; i < triangle_count(); ++i)
      if (normal(i).isZero()) ++report_.degenerate_triangles;
    for (std::size_t k = 0; k < 3; ++k) {
      report_.lower[k] = static_cast<double>((bounds_.min)()[Eigen::Index(k)]);
      report_.upper[k] = static_cast<double>((bounds_.max)()[Eigen::Index(k)]);
    }
  }

  template <class VertexRows, class IndexRows>
  void weld(const VertexRows& vertices, const IndexRows& triangles, Scalar scale) {
    std::vector<int> number(std::size_t(vertices.rows()), -1);
    for (Eigen::Index i = 0; i < triangles.rows(); ++i)
      for (int k = 0; k < 3; ++k) number[std::size_t(triangles(i, k))] = 0;
    detail::VertexWeld<Scalar> welded(number.size());
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      const auto known = welded.vertices().size();
      number[v] = welded.number(vertices.row(Eigen::Index(v)).transpose().template cast<Scalar>() * scale);
      if (welded.vertices().size() == known) ++report_.welded_vertices;
    }
    vertices_ = std::move(welded.vertices());
    vertices_.shrink_to_fit();
    triangles_.resize(std::size_t(triangles.rows()));
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) triangles_[i][k] = number[std::size_t(triangles(Eigen::Index(i), Eigen::Index(k)))];
  }

  std::vector<Vector3<Scalar>> vertices_;
  std::vector<std::array<int, 3>> triangles_;
  Eigen::AlignedBox<Scalar, 3> bounds_;
  MeshTopology topology_;
  Bvh<Scalar> bvh_;
  Walls<Scalar> walls_;
  MeshReport report_;
};

}  // namespace feeler
