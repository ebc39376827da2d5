// Walks from triangle to triangle over the surface of a mesh, towards a point above it.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/object/triangle_query.hpp"

namespace feeler {

/// Signed distance of a point from the line along an edge, positive on the inner side of a loop around `normal`, times the edge's length [m²].
template <class Scalar>
Scalar area_inside(const Vector3<Scalar>& start, const Vector3<Scalar>& edge, const Vector3<Scalar>& point, const Vector3<Scalar>& normal) noexcept {
  return edge.cross(Vector3<Scalar>(point - start)).dot(normal);
}

/// The edge of a triangle that a point lies farthest beyond, seen along the triangle's normal, or -1 if it lies over the triangle.
///
/// @param point  [m]
/// @param seam   a point no farther beyond an edge than this is over the triangle still [m]
template <class MeshScalar, class Scalar>
int edge_towards(const TriangleMesh<MeshScalar>& mesh, int triangle, const Vector3<Scalar>& point, Scalar seam = Scalar(0)) noexcept {
  const Matrix3<Scalar> corners = mesh.corners(triangle).template cast<Scalar>();
  const Vector3<Scalar> normal = mesh.normal(triangle).template cast<Scalar>();
  int edge = -1;
  Scalar farthest = -seam;
  for (int k = 0; k < 3; ++k) {
    const Vector3<Scalar> side = corners.col((k + 1) % 3) - corners.col(k);
    const Scalar area = area_inside<Scalar>(corners.col(k), side, point, normal);
    if (!(area < Scalar(0))) continue;
    const Scalar inside = area / side.norm();
    if (!(inside < farthest)) continue;
    farthest = inside;
    edge = k;
  }
  return edge;
}

/// The triangle of a wall that a point lies over, seen along the wall's normal, or -1 if it lies beside the wall.
///
/// @param seam  as `edge_towards` has it [m]
/// @cost  a path down the hierarchy
template <class MeshScalar, class Scalar>
int triangle_of_wall_under(const TriangleMesh<MeshScalar>& mesh, int wall, const Vector3<Scalar>& point, Scalar seam = Scalar(0)) noexcept {
  const Wall& plane = mesh.walls()[wall];
  const Vector3<Scalar> normal = mesh.normal(plane.triangle).template cast<Scalar>();
  const Vector3<Scalar> corner = mesh.vertex(mesh.triangle(plane.triangle)[0]).template cast<Scalar>();
  const Vector3<Scalar> below = point - normal * normal.dot(point - corner);
  const Vector3<Scalar> around = Vector3<Scalar>::Constant(Scalar(plane.flatness) + seam);
  int found = -1;
  visit_triangles_in(mesh, Eigen::AlignedBox<Scalar, 3>(below - around, below + around), [&](int triangle) {
    if (mesh.walls().of_triangle(triangle) != wall || edge_towards(mesh, triangle, below, seam) >= 0) return true;
    found = triangle;
    return false;
  });
  return found;
}

/// The triangle that a point lies over, found by walking from one near it; -1 if the surface ends on the way.
///
/// Where the surface is bent sharply the walk may come to no such triangle: it ends after `longest_walk` steps, near the point.
template <class MeshScalar, class Scalar>
int triangle_under(const TriangleMesh<MeshScalar>& mesh, int triangle, const Vector3<Scalar>& point) noexcept {
  constexpr int longest_walk = 8;
  for (int step = 0; step < longest_walk && triangle >= 0; ++step) {
    const int edge = edge_towards(mesh, triangle, point);
    if (edge < 0) return triangle;
    triangle = mesh.topology().neighbour(triangle, edge);
  }
  return triangle >= 0 ? triangle : -1;
}

}  // namespace feeler
