// What the closed surfaces of a mesh enclose, and whether a point is in there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "feeler/core/disjoint_sets.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/ray_crossing.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/object/triangle_query.hpp"

namespace feeler {

namespace detail {

/// The surfaces of a mesh, as sets of triangles that hang together by their edges, and which of them are
/// closed.
///
/// Two triangles at an edge belong to one surface. Of more, those of a surface that goes on at the edge are
/// left alone; surfaces that would be open there are one, as those of two blocks are that share a face. A
/// surface is closed where its triangles can be turned so that each edge is passed as often one way as the
/// other.
template <class Scalar>
class Surfaces {
 public:
  explicit Surfaces(const TriangleMesh<Scalar>& mesh)
      : mesh_(mesh), surface_(std::size_t(mesh.triangle_count()), -1), facing_(std::size_t(mesh.triangle_count()), 0) {
    for (int t = 0; t < mesh.triangle_count(); ++t)
      if (surface_[index(t)] < 0 && !is_collapsed(t)) flood(t);
    join_at_shared_edges();
  }

  /// By how much a crossing of each triangle along its normal leaves the solids: 1, −1 where the triangle
  /// faces another way than its surface, 0 for what encloses nothing. Empty where nothing does.
  std::vector<std::int8_t> weights() const {
    const std::vector<int> side = sides();
    std::vector<std::int8_t> result;
    bool is_any = false;
    for (std::size_t s = 0; s < side.size(); ++s) is_any = is_any || is_solid(side, s);
    if (!is_any) return result;
    result.assign(surface_.size(), 0);
    std::vector<int> first_inward(side.size(), -1);
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      if (surface_[index(t)] < 0) continue;
      const std::size_t s = index(surface_[index(t)]);
      if (is_solid(side, s)) result[index(t)] = std::int8_t(side[s] * facing_[index(t)]);
      else if (side[s] < 0 && first_inward[s] < 0) first_inward[s] = t;
    }
    // A surface that faces inwards is the wall of a cavity where it lies in a solid; else it is a room.
    std::vector<bool> is_cavity(side.size(), false);
    for (std::size_t s = 0; s < side.size(); ++s) {
      if (first_inward[s] < 0) continue;
      is_cavity[s] = winding(mesh_, result, mesh_.corners(first_inward[s]).col(0).template cast<double>()) > 0;
    }
    for (int t = 0; t < mesh_.triangle_count(); ++t)
      if (surface_[index(t)] >= 0 && is_cavity[index(surface_[index(t)])]) result[index(t)] = 1;
    return result;
  }

  /// The sum of the crossings of a ray from a point, each with the weight of its triangle.
  static int winding(const TriangleMesh<Scalar>& mesh, const std::vector<std::int8_t>& weights, const Vector3<double>& point) noexcept {
    Eigen::AlignedBox<double, 3> ray(point);
    (ray.max)().x() = std::numeric_limits<double>::infinity();
    int sum = 0;
    visit_triangles_in(mesh, ray, [&](int t) {
      if (weights[index(t)] != 0) sum += weights[index(t)] * ray_crossing(point, mesh.corners(t).template cast<double>());
      return true;
    });
    return sum;
  }

 private:
  struct SharedEdge {
    int smaller, larger;  // vertices
    int triangle;
    int direction;  // 1 from the smaller vertex to the larger one, as the triangle is turned
  };

  bool is_collapsed(int t) const noexcept {
    const auto& v = mesh_.triangle(t);
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
  }
  /// Of each surface: 1 faces outwards, −1 inwards, 0 encloses nothing.
  std::vector<int> sides() const {
    std::vector<double> volume(is_closed_.size(), 0.0);
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      if (surface_[index(t)] < 0) continue;
      const Matrix3<double> from = mesh_.corners(t).template cast<double>().colwise() - middle();
      volume[index(surface_[index(t)])] += facing_[index(t)] * from.determinant();
    }
    std::vector<int> side(is_closed_.size(), 0);
    for (std::size_t s = 0; s < side.size(); ++s)
      if (joined_.is_root(int(s)) && is_closed_[s]) side[s] = volume[s] < 0 ? -1 : 1;
    return side;
  }
  /// Whether a surface bounds a solid: it faces outwards, or does not say itself which side is out.
  bool is_solid(const std::vector<int>& side, std::size_t s) const { return side[s] > 0 || (side[s] != 0 && is_turned_[s]); }
  Vector3<double> middle() const { return mesh_.bvh().origin().template cast<double>(); }
  /// Whether a triangle passes an edge of another the same way.
  bool passes(int t, int from, int to) const noexcept {
    const auto& v = mesh_.triangle(t);
    for (std::size_t k = 0; k < 3; ++k)
      if (v[k] == from && v[(k + 1) % 3] == to) return true;
    return false;
  }

  /// Gathers the surface of a triangle over edges of two, and turns them all as the first.
  void flood(int first) {
    const int surface = int(is_closed_.size());
    joined_.add();
    is_closed_.push_back(true);
    is_turned_.push_back(false);
    surface_[index(first)] = surface;
    facing_[index(first)] = 1;
    std::vector<int> open{first};
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) cross_edge(t, k, open);
    }
  }

  /// Takes what is behind an edge into the last surface, and among the triangles that are open.
  void cross_edge(int t, int k, std::vector<int>& open) {
    const int from = mesh_.triangle(t)[index(k)], to = mesh_.triangle(t)[index((k + 1) % 3)], next = mesh_.topology().neighbour(t, k);
    if (next == MeshTopology::boundary) is_closed_.back() = false;
    if (next == MeshTopology::non_manifold) {
      const int direction = (from < to ? 1 : -1) * facing_[index(t)];
      shared_.push_back({(std::min)(from, to), (std::max)(from, to), t, direction});
    }
    if (next < 0) return;
    const auto facing = std::int8_t(passes(next, from, to) ? -facing_[index(t)] : facing_[index(t)]);
    if (surface_[index(next)] < 0) {
      surface_[index(next)] = surface_[index(t)];
      facing_[index(next)] = facing;
      if (facing < 0) is_turned_.back() = true;
      open.push_back(next);
    } else if (facing_[index(next)] != facing) {
      is_closed_.back() = false;  // it has one side
    }
  }

  void join_at_shared_edges() {
    const SharedEdge* last = nullptr;  // of a surface that would be open there
    each_passage([&](const SharedEdge& edge, int count, int) {
      if (count % 2 == 0) return;
      if (last != nullptr && last->smaller == edge.smaller && last->larger == edge.larger)
        join(surface_[index(last->triangle)], surface_[index(edge.triangle)]);
      last = &edge;
    });
    for (int& surface : surface_)
      if (surface >= 0) surface = joined_.root(surface);
    each_passage([&](const SharedEdge& edge, int, int direction) {
      if (direction != 0) is_closed_[index(surface_[index(edge.triangle)])] = false;
    });
  }
  /// Calls `visit(one of its triangles there, how many it has, the sum of their directions)` for each edge
  /// and each surface there.
  template <class Visit>
  void each_passage(const Visit& visit) {
    const auto key = [this](const SharedEdge& e) { return std::array{e.smaller, e.larger, surface_[index(e.triangle)]}; };
    std::sort(shared_.begin(), shared_.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    for (std::size_t begin = 0, end = 0; begin < shared_.size(); begin = end) {
      int direction = 0;
      for (; end < shared_.size() && key(shared_[end]) == key(shared_[begin]); ++end) direction += shared_[end].direction;
      visit(shared_[begin], int(end - begin), direction);
    }
  }
  void join(int a, int b) {
    const int from = joined_.root(a), to = joined_.root(b);
    if (from == to) return;
    joined_.join(from, to);
    if (!is_closed_[index(from)]) is_closed_[index(to)] = false;
    if (is_turned_[index(from)]) is_turned_[index(to)] = true;
  }

  const TriangleMesh<Scalar>& mesh_;
  std::vector<int> surface_;                 // of a triangle; −1 where it has two equal corners
  std::vector<std::int8_t> facing_;          // of a triangle: −1 where it is turned
  std::vector<SharedEdge> shared_;           // by more than two triangles
  DisjointSets joined_;                      // surfaces
  std::vector<bool> is_closed_, is_turned_;  // of a surface: is_turned_ where a triangle is
};

}  // namespace detail

/// What is solid of a mesh: what its closed surfaces enclose, surface by surface, so that open ones among
/// them do not matter.
///
/// Normals say which side is solid. A closed surface whose normals point outwards is a solid. One whose
/// normals point inwards is the wall of a cavity where it lies in a solid, and else a room: what it encloses
/// is free. Where the triangles of a surface do not agree, it is a solid. Solids may overlap.
class MeshInterior {
 public:
  /// @cost  linear in the triangles, allocates; a tenth of what the mesh took, half where most edges have
  /// more than two triangles
  template <RealScalar Scalar>
  explicit MeshInterior(const TriangleMesh<Scalar>& mesh) : weights_(detail::Surfaces<Scalar>(mesh).weights()) {}

  /// Whether the mesh encloses anything.
  bool is_empty() const noexcept { return weights_.empty(); }

  /// Whether a point is in a solid. Decided exactly; a point on a triangle is on either side.
  /// @param mesh   that which it was made from
  /// @param point  world axes [m]
  /// @cost  noexcept, no allocation; the triangles that a ray meets
  template <RealScalar Scalar>
  bool contains(const TriangleMesh<Scalar>& mesh, const Vector3<double>& point) const noexcept {
    return !is_empty() && detail::Surfaces<Scalar>::winding(mesh, weights_, point) > 0;
  }

  /// Whether all is solid around a point: a point nearer to a flat surface than half a distance is not
  /// enclosed.
  /// @param distance  [m]
  template <RealScalar Scalar>
  bool encloses(const TriangleMesh<Scalar>& mesh, const Vector3<double>& point, double distance) const noexcept {
    for (int k = 0; k < 6; ++k) {
      const Vector3<double> beside = point + (k % 2 == 0 ? distance : -distance) * Vector3<double>::Unit(k / 2);
      if (!contains(mesh, beside)) return false;
    }
    return true;
  }

 private:
  std::vector<std::int8_t> weights_;  // of the triangles
};

}  // namespace feeler
