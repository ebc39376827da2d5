// Surfaces of triangles for the laws: grids, rings and troughs of flat facets, and the same surface cut otherwise.
#pragma once

#include <array>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "fuzz/random_object.hpp"

namespace feeler::laws {

using fuzz::below;
using fuzz::fraction;
using fuzz::magnitude;
using fuzz::random_direction;
using fuzz::random_rotation;
using fuzz::random_vector;
using fuzz::unit;
using Vector = Eigen::Vector3d;

/// Vertices [m] and triangles, in the axes of a scene.
struct Surface {
  std::vector<Vector> vertices;
  std::vector<Eigen::Vector3i> triangles;

  int add(const Vector& vertex) {
    vertices.push_back(vertex);
    return int(vertices.size()) - 1;
  }
  /// Four corners in order round a flat quadrilateral, cut along one of its diagonals.
  void quad(std::mt19937& bits, int a, int b, int c, int d) {
    if (below(bits, 2) == 0) triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    else triangles.insert(triangles.end(), {{b, c, d}, {b, d, a}});
  }
  /// A parallelogram of columns × rows cells, whose inner vertices are moved within its plane by a share of a cell.
  void sheet(std::mt19937& bits, const Vector& corner, const Vector& along, const Vector& across, int columns, int rows, double jitter = 0) {
    const int first = int(vertices.size());
    for (int i = 0; i <= columns; ++i)
      for (int j = 0; j <= rows; ++j) {
        const bool is_inner = i > 0 && i < columns && j > 0 && j < rows;
        const double u = (i + (is_inner ? jitter * unit(bits) : 0)) / columns, v = (j + (is_inner ? jitter * unit(bits) : 0)) / rows;
        add(corner + u * along + v * across);
      }
    const auto at = [&](int i, int j) { return first + i * (rows + 1) + j; };
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) quad(bits, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  void triangle_of(const Vector& a, const Vector& b, const Vector& c) {
    const int i = add(a), j = add(b), k = add(c);
    triangles.emplace_back(i, j, k);
  }
};

inline Points<double> points_of(const Surface& surface) { return scenes::points_from(surface.vertices); }
inline Triangles rows_of(const Surface& surface) { return scenes::triangles_from(surface.triangles); }

/// Points that divide the sides of a closed polygon into so many pieces each.
inline std::vector<Eigen::Vector2d> divided(const std::vector<Eigen::Vector2d>& polygon, int pieces) {
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    for (int k = 0; k < pieces; ++k) points.push_back(polygon[i] + (polygon[(i + 1) % polygon.size()] - polygon[i]) * (double(k) / pieces));
  return points;
}

/// A closed ring: a plate from −height/2 to height/2 with a hole of one section and a rim of another, corner by corner.
/// @param strips  of the wall of the hole along its axis
/// @param taper   share by which the hole is wider a metre higher up [1/m]
inline Surface ring(std::mt19937& bits, const std::vector<Eigen::Vector2d>& hole, const std::vector<Eigen::Vector2d>& rim, double height, int strips,
                    double taper = 0) {
  Surface surface;
  const int n = int(hole.size());
  const auto layer = [&](const std::vector<Eigen::Vector2d>& section, double z, double scale) {
    for (const auto& p : section) surface.add({scale * p.x(), scale * p.y(), z});
  };
  for (int k = 0; k <= strips; ++k) {
    const double z = height * (double(k) / strips - 0.5);
    layer(hole, z, 1 + taper * z);
  }
  layer(rim, -height / 2, 1);
  layer(rim, height / 2, 1);
  const int low_rim = (strips + 1) * n, high_rim = low_rim + n, top = strips * n;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    for (int k = 0; k < strips; ++k) surface.quad(bits, k * n + i, (k + 1) * n + i, (k + 1) * n + j, k * n + j);
    surface.quad(bits, low_rim + i, low_rim + j, high_rim + j, high_rim + i);
    surface.quad(bits, top + i, high_rim + i, high_rim + j, top + j);
    surface.quad(bits, i, j, low_rim + j, low_rim + i);
  }
  return surface;
}

/// The same surface, every triangle cut into four at the middles of its sides.
inline Surface cut_finer(const Surface& coarse) {
  Surface fine{coarse.vertices, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), int(fine.vertices.size()));
    if (is_new) fine.add((coarse.vertices[std::size_t(a)] + coarse.vertices[std::size_t(b)]) / 2);
    return place->second;
  };
  for (const auto& t : coarse.triangles) {
    const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    fine.triangles.insert(fine.triangles.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
  }
  return fine;
}

/// The same surface, its triangles and their corners in another order.
inline Surface shuffled(Surface surface, std::mt19937& bits) {
  for (std::size_t i = surface.triangles.size(); i > 1; --i) std::swap(surface.triangles[i - 1], surface.triangles[bits() % i]);
  for (auto& t : surface.triangles) {
    const int turn = below(bits, 3);
    t = Eigen::Vector3i(t[turn], t[(turn + 1) % 3], t[(turn + 2) % 3]);
  }
  return surface;
}

/// The mirror image in the plane x = 0.
inline Surface mirrored(Surface surface) {
  for (Vector& vertex : surface.vertices) vertex.x() = -vertex.x();
  for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  return surface;
}

}  // namespace feeler::laws
