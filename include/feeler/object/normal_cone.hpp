// The directions in which an edge or a vertex of a mesh can be touched: what tells a contact from a ghost.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// More edges than this at a vertex are not looked at in a tick: the cone then counts as containing every
/// direction.
inline constexpr int maximum_cone_valence = 64;

namespace detail {

/// direction · b ≤ tolerance for the unit vector b from an edge into a triangle, perpendicular to the edge;
/// true if there is no such vector.
template <RealScalar Scalar>
bool points_away(const Vector3<Scalar>& start, const Vector3<Scalar>& end, const Vector3<Scalar>& opposite, const Vector3<Scalar>& direction,
                 const Scalar& tolerance) noexcept {
  using std::sqrt;
  const Vector3<Scalar> along = end - start;
  Vector3<Scalar> inward = opposite - start;
  const Scalar along_squared = along.squaredNorm();
  if (along_squared > Scalar(0)) inward -= along * (along.dot(inward) / along_squared);
  return direction.dot(inward) <= tolerance * sqrt(inward.squaredNorm());
}

}  // namespace detail

/// Whether a direction points away from the triangle across an edge: the normal cone of the edge but for the triangle's own side.
/// True where not exactly one triangle is across.
template <RealScalar Scalar>
bool neighbour_points_away(const TriangleMesh<Scalar>& mesh, int triangle, int k, const Vector3<Scalar>& direction,
                           const Scalar& tolerance) noexcept {
  const int neighbour = mesh.topology().neighbour(triangle, k);
  if (neighbour < 0) return true;
  const std::array<int, 3>& corners = mesh.triangle(triangle);
  const int start = corners[std::size_t(k)], end = corners[std::size_t((k + 1) % 3)];
  for (const int corner : mesh.triangle(neighbour)) {
    if (corner == start || corner == end) continue;
    return detail::points_away<Scalar>(mesh.vertex(start), mesh.vertex(end), mesh.vertex(corner), direction, tolerance);
  }
  return true;
}

/// Whether a direction points along none of the edges at a corner of a triangle, its own two left out.
template <RealScalar Scalar>
bool neighbours_point_away(const TriangleMesh<Scalar>& mesh, int triangle, int corner, const Vector3<Scalar>& direction,
                           const Scalar& tolerance) noexcept {
  using std::sqrt;
  const std::array<int, 3>& corners = mesh.triangle(triangle);
  const int vertex = corners[std::size_t(corner)];
  const auto neighbours = mesh.topology().vertex_neighbours(vertex);
  if (int(neighbours.size()) > maximum_cone_valence) return true;
  for (const int neighbour : neighbours) {
    if (neighbour == corners[0] || neighbour == corners[1] || neighbour == corners[2]) continue;
    const Vector3<Scalar> along = mesh.vertex(neighbour) - mesh.vertex(vertex);
    if (!(direction.dot(along) <= tolerance * sqrt(along.squaredNorm()))) return false;
  }
  return true;
}

/// Whether a point just off an edge in a direction has its closest mesh point on that edge: the normal cone
/// of the edge.
///
/// True iff the direction points into neither of the edge's triangles. On a boundary, and where triangles of
/// an edge are more than two, the triangle given is tested alone.
/// @param k          edge of the triangle, from corner k to corner (k+1)%3
/// @param direction  unit vector, world axes, from the mesh to the tool
/// @param tolerance  sine by which the direction may leave the cone
/// @cost  noexcept, no allocation
template <RealScalar Scalar>
bool edge_cone_contains(const TriangleMesh<Scalar>& mesh, int triangle, int k, const Vector3<Scalar>& direction, const Scalar& tolerance) noexcept {
  const std::array<int, 3>& corners = mesh.triangle(triangle);
  const int start = corners[std::size_t(k)], end = corners[std::size_t((k + 1) % 3)];
  const bool is_own_away =
      detail::points_away<Scalar>(mesh.vertex(start), mesh.vertex(end), mesh.vertex(corners[std::size_t((k + 2) % 3)]), direction, tolerance);
  return is_own_away && neighbour_points_away(mesh, triangle, k, direction, tolerance);
}

/// Whether a point just off a vertex in a direction has its closest mesh point in that vertex: the normal
/// cone of the vertex.
///
/// True iff the direction points along none of the vertex's edges; always true with more than
/// `maximum_cone_valence` of them.
/// @param direction  unit vector, world axes, from the mesh to the tool
/// @param tolerance  sine by which the direction may leave the cone
/// @cost  noexcept, no allocation, at most `maximum_cone_valence` dot products and square roots
template <RealScalar Scalar>
bool vertex_cone_contains(const TriangleMesh<Scalar>& mesh, int vertex, const Vector3<Scalar>& direction, const Scalar& tolerance) noexcept {
  using std::sqrt;
  const auto neighbours = mesh.topology().vertex_neighbours(vertex);
  if (int(neighbours.size()) > maximum_cone_valence) return true;
  for (const int neighbour : neighbours) {
    const Vector3<Scalar> along = mesh.vertex(neighbour) - mesh.vertex(vertex);
    if (!(direction.dot(along) <= tolerance * sqrt(along.squaredNorm()))) return false;
  }
  return true;
}

/// The other triangles at a corner of a triangle, found by walking around it.
/// @param visit  `visit(triangle, which of its corners that is)`; false ends the walk
/// @cost  noexcept, no allocation, at most twice `maximum_cone_valence` triangles
template <RealScalar Scalar, class Visit>
void visit_triangles_around(const TriangleMesh<Scalar>& mesh, int triangle, int corner, const Visit& visit) noexcept {
  const int vertex = mesh.triangle(triangle)[std::size_t(corner)];
  for (const int side : {0, 2}) {  // across the edge that leaves the vertex, and, if the surface ends there, across the one that comes to it
    int current = triangle, k = corner;
    for (int step = 0; step < maximum_cone_valence; ++step) {
      current = mesh.topology().neighbour(current, (k + side) % 3);
      if (current < 0) break;
      const std::array<int, 3>& corners = mesh.triangle(current);
      k = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
      if (current == triangle || !visit(current, k)) return;
    }
  }
}

/// The triangle at a corner of another one whose edges there point most along a direction; -1 if none of them points along it.
///
/// Where a direction leaves the normal cone of the vertex, the mesh is nearer there to what is off the vertex in that direction.
/// @cost  noexcept, no allocation, at most twice `maximum_cone_valence` triangles
template <RealScalar Scalar>
int triangle_along(const TriangleMesh<Scalar>& mesh, int triangle, int corner, const Vector3<Scalar>& direction) noexcept {
  using std::sqrt;
  const int vertex = mesh.triangle(triangle)[std::size_t(corner)];
  int best = -1;
  Scalar highest(0);
  visit_triangles_around(mesh, triangle, corner, [&](int current, int) {
    for (const int other : mesh.triangle(current)) {
      if (other == vertex) continue;
      const Vector3<Scalar> along = mesh.vertex(other) - mesh.vertex(vertex);
      const Scalar height = direction.dot(along) / sqrt(along.squaredNorm());
      if (!(height > highest)) continue;
      highest = height;
      best = current;
    }
    return true;
  });
  return best;
}

/// Whether a ray from a corner of a triangle leads under another triangle there, in a view along a line.
/// @param ray        in the view, at right angles to the line, any length
/// @param upward     in the view, at right angles to the ray, unit
/// @param tolerance  sine by which an edge of the other triangle must rise from the ray, and by which one on the ray may miss it
/// @cost  noexcept, no allocation, at most twice `maximum_cone_valence` triangles
template <RealScalar Scalar>
bool leads_under_a_neighbour(const TriangleMesh<Scalar>& mesh, int triangle, int corner, const Vector3<Scalar>& ray, const Vector3<Scalar>& upward,
                             const Scalar& tolerance) noexcept {
  using std::sqrt;
  const int vertex = mesh.triangle(triangle)[std::size_t(corner)];
  bool is_under = false;
  visit_triangles_around(mesh, triangle, corner, [&](int current, int k) {
    const std::array<int, 3>& corners = mesh.triangle(current);
    Vector3<Scalar> upper = mesh.vertex(corners[std::size_t((k + 1) % 3)]) - mesh.vertex(vertex);
    Vector3<Scalar> lower = mesh.vertex(corners[std::size_t((k + 2) % 3)]) - mesh.vertex(vertex);
    if (upward.dot(upper) < upward.dot(lower)) upper.swap(lower);
    const Scalar rise = upward.dot(upper), fall = -upward.dot(lower);
    const Scalar miss = tolerance * sqrt(lower.squaredNorm());
    // Of edges on both sides of the ray's line, some point between the two is on that line: on the ray, or behind the corner.
    is_under =
        rise > tolerance * sqrt(upper.squaredNorm()) && fall >= -miss && ray.dot(lower) * rise + ray.dot(upper) * (std::max)(fall, miss) > Scalar(0);
    return !is_under;
  });
  return is_under;
}

}  // namespace feeler
