// A face, an edge and a vertex of an object's surface, and the side that it is seen from.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/object/mesh_topology.hpp"

namespace feeler {

/// The side of a surface that a tool is on: that of the triangle normals, or the other one.
enum class SurfaceSide : signed char { front = 1, back = -1 };

/// A maximal connected patch of coplanar triangles.
template <class Scalar>
struct SurfaceFace {
  int first_triangle = -1;  ///< the smallest one
  Vector3<Scalar> normal = Vector3<Scalar>::Zero();  ///< unit, of the largest triangle; zero where all are degenerate
  Vector3<Scalar> point = Vector3<Scalar>::Zero();   ///< a corner of the largest triangle, world [m]
};

/// A straight edge between two corners. World axes [m].
template <class Scalar>
struct SurfaceEdge {
  Convexity convexity = Convexity::convex;  ///< from the front; convex, concave, boundary or non_manifold
  Vector3<Scalar> start = Vector3<Scalar>::Zero();
  Vector3<Scalar> end = Vector3<Scalar>::Zero();
};

/// A corner of the surface. World axes [m].
template <class Scalar>
struct SurfaceVertex {
  int mesh_vertex = -1;
  bool has_ridge = false;   ///< from the front
  bool has_valley = false;  ///< from the front
  bool has_rim = false;     ///< an edge that has not two triangles: a ridge from both sides
  Vector3<Scalar> point = Vector3<Scalar>::Zero();
};

}  // namespace feeler
