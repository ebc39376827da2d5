// Closed meshes whose inside is known by a formula.
#pragma once

#include <cmath>
#include <initializer_list>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"

namespace feeler_test {

/// Vertices [m] and triangles, counter-clockwise seen from outside.
struct ClosedMesh {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;

  ClosedMesh inverted() const {
    ClosedMesh result = *this;
    result.triangles.col(1) = triangles.col(2);
    result.triangles.col(2) = triangles.col(1);
    return result;
  }
  ClosedMesh moved(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) const {
    return {(vertices * rotation.toRotationMatrix().transpose()).rowwise() + translation.transpose(), triangles};
  }
  /// Without its first triangles.
  ClosedMesh opened(int count = 1) const { return {vertices, triangles.bottomRows(triangles.rows() - count)}; }
  ClosedMesh with(const ClosedMesh& other) const {
    ClosedMesh result;
    result.vertices.resize(vertices.rows() + other.vertices.rows(), 3);
    result.vertices << vertices, other.vertices;
    result.triangles.resize(triangles.rows() + other.triangles.rows(), 3);
    result.triangles << triangles, (other.triangles.array() + int(vertices.rows())).matrix();
    return result;
  }
};

/// A closed surface over a grid of u × v squares that joins itself at the ends: `at(i, j)` is a vertex.
template <class At>
ClosedMesh wrapped_grid(int u, int v, const At& at) {
  ClosedMesh mesh{feeler::Points<double>(u * v, 3), feeler::Triangles(2 * u * v, 3)};
  for (int i = 0; i < u; ++i) {
    for (int j = 0; j < v; ++j) {
      const int next_i = (i + 1) % u, next_j = (j + 1) % v;
      mesh.vertices.row(i * v + j) = at(i, j).transpose();
      mesh.triangles.row(2 * (i * v + j)) << i * v + j, next_i * v + j, next_i * v + next_j;
      mesh.triangles.row(2 * (i * v + j) + 1) << i * v + j, next_i * v + next_j, i * v + next_j;
    }
  }
  return mesh;
}

/// A torus about z: it holds the points within `tube` of the circle of `radius`, but for what its facets cut
/// off.
inline ClosedMesh torus(double radius, double tube, int u, int v) {
  return wrapped_grid(u, v, [=](int i, int j) {
    const double a = 2 * M_PI * i / u, b = 2 * M_PI * j / v, r = radius + tube * std::cos(b);
    return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
  });
}

inline ClosedMesh block(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  ClosedMesh mesh{feeler::Points<double>(8, 3), feeler::Triangles(12, 3)};
  for (int i = 0; i < 8; ++i) mesh.vertices.row(i) << ((i & 1) ? high : low).x(), ((i & 2) ? high : low).y(), ((i & 4) ? high : low).z();
  mesh.triangles << 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6;
  return mesh;
}

/// The unit sphere as a cube of n × n squares a face, blown up; it holds all points within `cos` of its
/// largest facet.
inline ClosedMesh ball(double radius, int n) {
  ClosedMesh mesh{feeler::Points<double>(6 * (n + 1) * (n + 1), 3), feeler::Triangles(12 * n * n, 3)};
  int triangle = 0;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, first = face * (n + 1) * (n + 1);
    const bool is_high = face % 2 == 1;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        Eigen::Vector3d point;
        point[axis] = is_high ? n : -n;
        point[u] = 2 * i - n;
        point[v] = 2 * j - n;
        // Summed in one order by all faces, so that the vertices of two agree to the last bit.
        point *= radius / std::sqrt(point.x() * point.x() + point.y() * point.y() + point.z() * point.z());
        const int row = first + i * (n + 1) + j, across = row + n + 1;
        mesh.vertices.row(row) = point.transpose();
        if (i == n || j == n) continue;
        mesh.triangles.row(triangle++) << row, (is_high ? across : across + 1), (is_high ? across + 1 : across);
        mesh.triangles.row(triangle++) << row, (is_high ? across + 1 : row + 1), (is_high ? row + 1 : across + 1);
      }
    }
  }
  return mesh;
}

}  // namespace feeler_test
