// The closed surfaces of a mesh: which triangles bound a solid, and on which side of them it is.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <utility>
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
/// left alone; surfaces that would be open there are one, as those of two blocks are that share a face, but for
/// what they close without, as a wall within a solid. A triangle that is given twice counts once. A surface is
/// closed where its triangles can be turned so that each edge is passed as often one way as the other.
template <class Scalar>
class ClosedSurfaces {
 public:
  explicit ClosedSurfaces(const TriangleMesh<Scalar>& mesh)
      : mesh_(mesh), surface_(std::size_t(mesh.triangle_count()), -1), facing_(std::size_t(mesh.triangle_count()), 0) {
    const std::vector<bool> repeats = repeated();
    for (int t = 0; t < mesh.triangle_count(); ++t)
      if (surface_[as_index(t)] < 0 && !is_collapsed(t) && !repeats[as_index(t)]) flood(t);
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
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      const int s = surface_[as_index(t)];
      if (s >= 0 && is_solid(side, as_index(s))) result[as_index(t)] = std::int8_t(side[as_index(s)] * facing_[as_index(t)]);
    }
    // A surface that faces inwards is the wall of a cavity where it lies in a solid; else it is a room.
    const std::vector<bool> is_cavity = cavities(side, result);
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      const int s = surface_[as_index(t)];
      if (s >= 0 && is_cavity[as_index(s)]) result[as_index(t)] = 1;
    }
    return result;
  }

  /// The sum of the crossings of a ray from a point, each with the weight of its triangle.
  static int winding(const TriangleMesh<Scalar>& mesh, const std::vector<std::int8_t>& weights, const Vector3<double>& point) noexcept {
    Eigen::AlignedBox<double, 3> ray(point);
    (ray.max)().x() = std::numeric_limits<double>::infinity();
    int sum = 0;
    visit_triangles_in(mesh, ray, [&](int t) {
      if (weights[as_index(t)] != 0) sum += weights[as_index(t)] * ray_crossing(point, mesh.corners(t).template cast<double>());
      return true;
    });
    return sum;
  }

 private:
  /// Of a surface along an edge that more than two triangles share.
  struct Passage {
    int smaller, larger;  // vertices
    int surface;
    int direction;  // from the smaller vertex to the larger one as the triangles are turned, less those the other way
  };
  using Passages = std::span<const Passage>;

  bool is_collapsed(int t) const noexcept {
    const auto& v = mesh_.triangle(t);
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
  }
  /// Triangles with the corners of an earlier one, turned the same way.
  std::vector<bool> repeated() const {
    std::vector<std::pair<std::array<int, 3>, int>> shared;  // such a triangle has others at all its edges
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      int edges = 0;
      for (int k = 0; k < 3; ++k) edges += mesh_.topology().neighbour(t, k) == MeshTopology::non_manifold ? 1 : 0;
      if (edges < 3) continue;
      std::array<int, 3> corners = mesh_.triangle(t);
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      shared.emplace_back(corners, t);
    }
    std::sort(shared.begin(), shared.end());
    std::vector<bool> result(surface_.size());
    for (std::size_t i = 1; i < shared.size(); ++i)
      if (shared[i].first == shared[i - 1].first) result[as_index(shared[i].second)] = true;
    return result;
  }
  /// Of each surface: 1 faces outwards, −1 inwards, 0 encloses nothing.
  std::vector<int> sides() const {
    std::vector<double> volume(is_closed_.size(), 0.0);
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      if (surface_[as_index(t)] < 0) continue;
      const Matrix3<double> from = mesh_.corners(t).template cast<double>().colwise() - middle();
      volume[as_index(surface_[as_index(t)])] += facing_[as_index(t)] * from.determinant();
    }
    std::vector<int> side(is_closed_.size(), 0);
    for (std::size_t s = 0; s < side.size(); ++s)
      if (joined_.is_root(int(s)) && is_closed_[s]) side[s] = volume[s] < 0 ? -1 : 1;
    return side;
  }
  /// Whether a surface bounds a solid: it faces outwards, or does not say itself which side is out.
  bool is_solid(const std::vector<int>& side, std::size_t s) const { return side[s] > 0 || (side[s] != 0 && is_turned_[s]); }
  /// Which surfaces face inwards in a solid: half of their triangles, of some, lie in it.
  std::vector<bool> cavities(const std::vector<int>& side, const std::vector<std::int8_t>& weights) const {
    constexpr int most_asked = 16;  // of a surface, as some may lie in the wall of the solid
    std::vector<int> asked(side.size(), 0), found(side.size(), 0);
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      const int s = surface_[as_index(t)];
      if (s < 0 || !(side[as_index(s)] < 0) || is_solid(side, as_index(s)) || asked[as_index(s)] == most_asked) continue;
      ++asked[as_index(s)];
      found[as_index(s)] += winding(mesh_, weights, mesh_.corners(t).template cast<double>().rowwise().mean()) > 0;
    }
    std::vector<bool> result(side.size());
    for (std::size_t s = 0; s < side.size(); ++s) result[s] = 2 * found[s] > asked[s];
    return result;
  }
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
    is_left_out_.push_back(false);
    surface_[as_index(first)] = surface;
    facing_[as_index(first)] = 1;
    std::vector<int> open{first};
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) cross_edge(t, k, open);
    }
  }

  /// Takes what is behind an edge into the last surface, and among the triangles that are open.
  void cross_edge(int t, int k, std::vector<int>& open) {
    const int from = mesh_.triangle(t)[as_index(k)], to = mesh_.triangle(t)[as_index((k + 1) % 3)], next = mesh_.topology().neighbour(t, k);
    if (next == MeshTopology::boundary) is_closed_.back() = false;
    if (next == MeshTopology::non_manifold) {
      const int direction = (from < to ? 1 : -1) * facing_[as_index(t)];
      passages_.push_back({(std::min)(from, to), (std::max)(from, to), surface_[as_index(t)], direction});
    }
    if (next < 0) return;
    const auto facing = std::int8_t(passes(next, from, to) ? -facing_[as_index(t)] : facing_[as_index(t)]);
    if (surface_[as_index(next)] < 0) {
      surface_[as_index(next)] = surface_[as_index(t)];
      facing_[as_index(next)] = facing;
      if (facing < 0) is_turned_.back() = true;
      open.push_back(next);
    } else if (facing_[as_index(next)] != facing) {
      is_closed_.back() = false;  // it has one side
    }
  }

  /// What surfaces are one, and which of them enclose nothing.
  void join_at_shared_edges() {
    if (passages_.empty()) return;  // each surface is by itself
    gather_passages();
    measure_areas();
    each_edge([this](Passages at) {
      const Passage* last = nullptr;  // of a surface that would be open there
      for (const Passage& passage : at) {
        if (passage.direction % 2 == 0) continue;
        if (last != nullptr) join(last->surface, passage.surface);
        last = &passage;
      }
    });
    while (leave_out_some()) continue;
    each_edge([this](Passages at) {
      for (const Passage& passage : at)
        if (surplus(at, passage) != 0) is_closed_[as_index(joined_.root(passage.surface))] = false;
    });
    for (int& surface : surface_)
      if (surface >= 0) surface = is_left_out_[as_index(surface)] ? -1 : joined_.root(surface);
  }
  /// Sums the directions of each surface at each shared edge.
  void gather_passages() {
    const auto key = [](const Passage& p) { return std::array{p.smaller, p.larger, p.surface}; };
    std::sort(passages_.begin(), passages_.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::size_t count = 0;
    for (const Passage& passage : passages_) {
      if (count > 0 && key(passages_[count - 1]) == key(passage)) passages_[count - 1].direction += passage.direction;
      else passages_[count++] = passage;
    }
    passages_.resize(count);
  }
  void measure_areas() {
    area_.assign(is_closed_.size(), 0.0);
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      const int surface = surface_[as_index(t)];
      if (surface < 0) continue;
      const Matrix3<double> corners = mesh_.corners(t).template cast<double>();
      area_[as_index(surface)] += (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
    }
  }
  template <class Visit>
  void each_edge(const Visit& visit) const {
    for (auto begin = passages_.begin(), end = begin; begin != passages_.end(); begin = end) {
      end = std::find_if(begin, passages_.end(), [&](const Passage& p) { return p.smaller != begin->smaller || p.larger != begin->larger; });
      visit(Passages(begin, end));
    }
  }
  bool is_of(const Passage& one, const Passage& other) {
    return !is_left_out_[as_index(one.surface)] && joined_.root(one.surface) == joined_.root(other.surface);
  }
  /// By how much an edge is passed more often one way than the other by all that was joined with a surface.
  int surplus(Passages at, const Passage& passage) {
    int sum = 0;
    for (const Passage& other : at) sum += is_of(other, passage) ? other.direction : 0;
    return sum;
  }

  /// Leaves out surfaces without which edges are passed more evenly: of those that meet, the smallest. False if there are none.
  bool leave_out_some() {
    std::vector<int> gain(is_closed_.size(), 0);
    each_edge([&](Passages at) {
      for (const Passage& p : at) {
        const int now = surplus(at, p);
        gain[as_index(p.surface)] += std::abs(now) - std::abs(now - p.direction);
      }
    });
    std::vector<bool> waits(gain.size());
    each_edge([&](Passages at) {
      for (const Passage& p : at) {
        const auto goes_before = [&](const Passage& q) {
          const std::size_t a = as_index(q.surface), b = as_index(p.surface);
          return is_of(q, p) && gain[a] > 0 && std::pair(area_[a], a) < std::pair(area_[b], b);
        };
        if (std::any_of(at.begin(), at.end(), goes_before)) waits[as_index(p.surface)] = true;
      }
    });
    bool is_any = false;
    for (std::size_t s = 0; s < gain.size(); ++s) {
      if (gain[s] <= 0 || waits[s] || is_left_out_[s]) continue;
      is_any = true;
      is_left_out_[s] = true;
    }
    return is_any;
  }
  void join(int a, int b) {
    const int from = joined_.root(a), to = joined_.root(b);
    if (from == to) return;
    joined_.join(from, to);
    if (!is_closed_[as_index(from)]) is_closed_[as_index(to)] = false;
    if (is_turned_[as_index(from)]) is_turned_[as_index(to)] = true;
  }

  const TriangleMesh<Scalar>& mesh_;
  std::vector<int> surface_;                 // of a triangle; −1 where it has two equal corners, or is left out
  std::vector<std::int8_t> facing_;          // of a triangle: −1 where it is turned
  std::vector<Passage> passages_;            // at edges of more than two triangles
  DisjointSets joined_;                      // surfaces
  std::vector<bool> is_closed_, is_turned_, is_left_out_;  // of a surface: is_turned_ where a triangle is
  std::vector<double> area_;                 // likewise, twice its area, where edges are shared [m²]
};

}  // namespace detail

}  // namespace feeler
