// The point of a segment, triangle or tetrahedron that is closest to the origin.
#pragma once

#include <array>

#include <Eigen/Geometry>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler::detail {

/// Up to four points, the weights of the point of their hull closest to the origin, and that point.
template <class Scalar>
struct Simplex {
  int size = 0;
  std::array<Vector3<Scalar>, 4> points;
  std::array<int, 4> tool_vertices{};  ///< the tool vertex of each point
  std::array<int, 4> corners{};        ///< the triangle corner of each point
  std::array<Scalar, 4> weights{};
  Vector3<Scalar> closest = Vector3<Scalar>::Zero();

  /// Keeps those of three points, at positions in ascending order, that have weight.
  void keep(const std::array<int, 3>& positions, const std::array<Scalar, 3>& their_weights) noexcept {
    std::size_t to = 0;
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(their_weights[i] > Scalar(0))) continue;
      const auto from = std::size_t(positions[i]);
      const Vector3<Scalar> point = points[from];
      points[to] = point;
      tool_vertices[to] = tool_vertices[from];
      corners[to] = corners[from];
      weights[to] = their_weights[i];
      sum += their_weights[i] * point;
      ++to;
    }
    size = int(to);
    closest = sum;
  }
};

/// Weights of the point closest to the origin on the hull of up to three points; a weight of zero marks a point not needed.
template <class Scalar>
std::array<Scalar, 3> weights_on_segment(const Vector3<Scalar>& a, const Vector3<Scalar>& b) noexcept {
  const Vector3<Scalar> ab = b - a;
  const Scalar along = -a.dot(ab);
  const Scalar length = ab.squaredNorm();
  if (!(along > Scalar(0))) return {Scalar(1), Scalar(0), Scalar(0)};
  if (along >= length) return {Scalar(0), Scalar(1), Scalar(0)};
  const Scalar t = along / length;
  return {Scalar(1) - t, t, Scalar(0)};
}

/// The same for the edges of a triangle: all there is of one without area.
template <class Scalar>
std::array<Scalar, 3> weights_on_edges(const Vector3<Scalar>& a, const Vector3<Scalar>& b, const Vector3<Scalar>& c) noexcept {
  const auto ab = weights_on_segment(a, b), bc = weights_on_segment(b, c), ca = weights_on_segment(c, a);
  const Scalar on_ab = (ab[0] * a + ab[1] * b).squaredNorm();
  const Scalar on_bc = (bc[0] * b + bc[1] * c).squaredNorm();
  const Scalar on_ca = (ca[0] * c + ca[1] * a).squaredNorm();
  if (on_ab <= on_bc && on_ab <= on_ca) return ab;
  if (on_bc <= on_ca) return {Scalar(0), bc[0], bc[1]};
  return {ca[1], Scalar(0), ca[0]};
}

/// The same for a triangle, by its Voronoi regions (C. Ericson, "Real-Time Collision Detection", section 5.1.5).
template <class Scalar>
FEELER_FLATTEN std::array<Scalar, 3> weights_on_triangle(const Vector3<Scalar>& a, const Vector3<Scalar>& b, const Vector3<Scalar>& c) noexcept {
  const Vector3<Scalar> ab = b - a;
  const Vector3<Scalar> ac = c - a;
  const Scalar d1 = -ab.dot(a), d2 = -ac.dot(a);
  if (d1 <= Scalar(0) && d2 <= Scalar(0)) return {Scalar(1), Scalar(0), Scalar(0)};
  const Scalar d3 = -ab.dot(b), d4 = -ac.dot(b);
  if (d3 >= Scalar(0) && d4 <= d3) return {Scalar(0), Scalar(1), Scalar(0)};
  const Scalar d5 = -ab.dot(c), d6 = -ac.dot(c);
  if (d6 >= Scalar(0) && d5 <= d6) return {Scalar(0), Scalar(0), Scalar(1)};
  // Areas of the sub-triangles, from the normal rather than from products of the dots above: exact to rounding near the plane.
  const Vector3<Scalar> normal = ab.cross(ac);
  const Scalar va = normal.dot(b.cross(c)), vb = normal.dot(c.cross(a)), vc = normal.dot(a.cross(b));
  if (vc <= Scalar(0) && d1 >= Scalar(0) && d3 <= Scalar(0) && d1 > d3) {
    const Scalar t = d1 / (d1 - d3);
    return {Scalar(1) - t, t, Scalar(0)};
  }
  if (vb <= Scalar(0) && d2 >= Scalar(0) && d6 <= Scalar(0) && d2 > d6) {
    const Scalar t = d2 / (d2 - d6);
    return {Scalar(1) - t, Scalar(0), t};
  }
  if (va <= Scalar(0) && d4 - d3 >= Scalar(0) && d5 - d6 >= Scalar(0) && (d4 - d3) + (d5 - d6) > Scalar(0)) {
    const Scalar t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {Scalar(0), Scalar(1) - t, t};
  }
  const Scalar sum = va + vb + vc;
  if (!(sum > Scalar(0))) return weights_on_edges(a, b, c);
  return {va / sum, vb / sum, vc / sum};
}

/// Reduces the simplex to the points that carry its point closest to the origin; false when it contains the origin.
///
/// All four faces are searched, also the one opposite to the newest point, which is the last. The origin lies beyond that face only if its three
/// points were flat, or came unreduced from a warm start; then no other face shows that the origin is outside.
template <class Scalar>
FEELER_FLATTEN bool reduce_to_closest(Simplex<Scalar>& simplex) noexcept {
  const auto& p = simplex.points;
  switch (simplex.size) {
    case 1:
      simplex.weights[0] = Scalar(1);
      simplex.closest = p[0];
      return true;
    case 2: simplex.keep({0, 1, 1}, weights_on_segment(p[0], p[1])); return true;
    case 3: simplex.keep({0, 1, 2}, weights_on_triangle(p[0], p[1], p[2])); return true;
    default: break;
  }
  constexpr std::array<std::array<int, 4>, 4> faces{{{0, 1, 3, 2}, {1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 2, 3}}};
  Scalar best = std::numeric_limits<Scalar>::infinity();
  std::array<int, 3> positions{};
  std::array<Scalar, 3> weights{};
  for (const auto& face : faces) {
    const auto &a = p[std::size_t(face[0])], &b = p[std::size_t(face[1])], &c = p[std::size_t(face[2])];
    const Vector3<Scalar> normal = (b - a).cross(c - a);
    const Scalar inside = normal.dot(p[std::size_t(face[3])] - a);
    const Scalar origin = -normal.dot(a);
    const bool origin_is_beyond = inside > Scalar(0) ? origin <= Scalar(0) : inside < Scalar(0) ? origin >= Scalar(0) : true;
    if (!origin_is_beyond) continue;
    const auto w = weights_on_triangle(a, b, c);
    const Scalar distance = (w[0] * a + w[1] * b + w[2] * c).squaredNorm();
    if (distance < best) {
      best = distance;
      positions = {face[0], face[1], face[2]};
      weights = w;
    }
  }
  if (best == std::numeric_limits<Scalar>::infinity()) {
    simplex.closest.setZero();
    return false;
  }
  simplex.keep(positions, weights);
  return true;
}

}  // namespace feeler::detail
