// Walks from triangle to triangle over the surface of a mesh, towards a point above it.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// Signed distance of a point from a line, positive on the inner side of a loop around `normal` [m].
template <class Scalar>
Scalar distance_inside(const Vector3<Scalar>& start, const Vector3<Scalar>& end, const Vector3<Scalar>& point, const Vector3<Scalar>& normal) noexcept {
  const Vector3<Scalar> edge = end - start;
  return edge.cross(Vector3<Scalar>(point - start)).dot(normal) / edge.norm();
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
    const Scalar scaled = side.cross(Vector3<Scalar>(point - corners.col(k))).dot(normal);
    if (!(scaled < Scalar(0))) continue;
    const Scalar inside = scaled / side.norm();
    if (!(inside < farthest)) continue;
    farthest = inside;
    edge = k;
  }
  return edge;
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
