// The polygons of a convex hull: triangles that are coplanar to a tolerance become one face.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "feeler/tool/convex_hull.hpp"

namespace feeler::detail {

/// A face of a hull: corners counter-clockwise seen from outside, and the sum of the normals of its
/// triangles.
struct HullFace {
  std::vector<int> corners;
  std::array<long double, 3> normal{};
};

/// Merges the triangles of a hull into faces.
///
/// A face grows from the largest triangle left, over edges, to triangles whose corners all lie within
/// `tolerance` of its plane.
/// @cost  O(n log n) in the triangles
class HullFaces {
 public:
  HullFaces(const std::vector<LatticePoint>& points, const std::vector<HullTriangle>& triangles, long double tolerance)
      : points_(points), triangles_(triangles), tolerance_(tolerance), face_of_(triangles.size(), -1) {
    std::vector<int> order(triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return triangles[std::size_t(a)].plane.length() > triangles[std::size_t(b)].plane.length(); });
    for (const int seed : order) {
      if (face_of_[std::size_t(seed)] >= 0) continue;
      regions_.push_back(grow(seed));
    }
  }

  /// The vertices where three faces or more meet; the others are inside a face or in the middle of an edge,
  /// and are no corners.
  std::vector<int> corners() const {
    std::vector<std::pair<int, int>> incidences;  // vertex, face
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (const int v : triangles_[t].corners) incidences.emplace_back(v, face_of_[t]);
    std::sort(incidences.begin(), incidences.end());
    incidences.erase(std::unique(incidences.begin(), incidences.end()), incidences.end());
    std::vector<int> result;
    for (std::size_t i = 0; i + 2 < incidences.size(); ++i) {
      const bool is_first = i == 0 || incidences[i - 1].first != incidences[i].first;
      if (is_first && incidences[i + 2].first == incidences[i].first) result.push_back(incidences[i].first);
    }
    return result;
  }

  /// The faces as polygons. A region that is no convex polygon, which only happens where the shape is as fine
  /// as the tolerance, stays in triangles.
  std::vector<HullFace> polygons() const {
    std::vector<HullFace> result;
    for (const std::vector<int>& region : regions_) {
      HullFace face = outline(region);
      if (is_convex(face)) {
        result.push_back(std::move(face));
        continue;
      }
      for (const int triangle : region) result.push_back(outline({triangle}));
    }
    return result;
  }

 private:
  std::vector<int> grow(int seed) {
    const int face = int(regions_.size());
    const LatticePlane& plane = triangles_[std::size_t(seed)].plane;
    std::vector<int> region(1, seed);
    face_of_[std::size_t(seed)] = face;
    for (std::size_t i = 0; i < region.size(); ++i) {
      for (const int next : triangles_[std::size_t(region[i])].neighbours) {
        if (face_of_[std::size_t(next)] >= 0 || !lies_in(triangles_[std::size_t(next)], plane)) continue;
        face_of_[std::size_t(next)] = face;
        region.push_back(next);
      }
    }
    return region;
  }

  bool lies_in(const HullTriangle& triangle, const LatticePlane& plane) const {
    if (!(dot(triangle.plane.normal(), plane.normal()) > 0)) return false;
    return std::all_of(triangle.corners.begin(), triangle.corners.end(), [&](int v) { return plane.height(points_[std::size_t(v)]) >= -tolerance_; });
  }

  /// The boundary of a region; empty if it is not one simple cycle through all of its vertices.
  HullFace outline(const std::vector<int>& region) const {
    HullFace face;
    std::vector<std::pair<int, int>> edges;  // start, end
    for (const int t : region) {
      const HullTriangle& triangle = triangles_[std::size_t(t)];
      for (std::size_t k = 0; k < 3; ++k) {
        const int neighbour = triangle.neighbours[k];
        const bool is_inside = region.size() > 1 && std::find(region.begin(), region.end(), neighbour) != region.end();
        if (!is_inside) edges.emplace_back(triangle.corners[k], triangle.corners[(k + 1) % 3]);
        face.normal[k] += triangle.plane.normal()[k];
      }
    }
    std::sort(edges.begin(), edges.end());
    // A disk of n triangles without inner vertices has n + 2 edges around it.
    if (edges.size() != region.size() + 2) return face;
    int vertex = edges.front().first;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto edge = std::lower_bound(edges.begin(), edges.end(), std::make_pair(vertex, -1));
      if (edge == edges.end() || edge->first != vertex || (i > 0 && vertex == edges.front().first)) {
        face.corners.clear();
        return face;
      }
      face.corners.push_back(vertex);
      vertex = edge->second;
    }
    return face;
  }

  bool is_convex(const HullFace& face) const {
    const std::size_t n = face.corners.size();
    const long double length = std::sqrt(dot(face.normal.data(), face.normal.data()));
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<long double, 3> u = difference(face.corners[i], face.corners[(i + 1) % n]);
      const std::array<long double, 3> v = difference(face.corners[(i + 1) % n], face.corners[(i + 2) % n]);
      const std::array<long double, 3> cross{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      const long double longest = std::sqrt((std::max)(dot(u.data(), u.data()), dot(v.data(), v.data())));
      if (dot(cross.data(), face.normal.data()) < -tolerance_ * longest * length) return false;
    }
    return n >= 3;
  }

  std::array<long double, 3> difference(int from, int to) const {
    const LatticePoint& a = points_[std::size_t(from)];
    const LatticePoint& b = points_[std::size_t(to)];
    return {static_cast<long double>(b.x - a.x), static_cast<long double>(b.y - a.y), static_cast<long double>(b.z - a.z)};
  }
  static long double dot(const long double* a, const long double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  const std::vector<LatticePoint>& points_;
  const std::vector<HullTriangle>& triangles_;
  long double tolerance_;
  std::vector<int> face_of_;
  std::vector<std::vector<int>> regions_;
};

}  // namespace feeler::detail
