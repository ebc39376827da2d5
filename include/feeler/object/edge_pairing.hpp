// Which triangles share an edge, and which vertices: the combinatorial part of a mesh's topology.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "feeler/core/disjoint_sets.hpp"
#include "feeler/object/mesh_report.hpp"

namespace feeler::detail {

inline constexpr std::int32_t boundary_neighbour = -1;
inline constexpr std::int32_t non_manifold_neighbour = -2;

/// Pairs the edges of triangles, in linear time: edges are counted into buckets by their smaller vertex, and
/// matched inside a bucket.
///
/// Edge k of a triangle goes from corner k to corner (k+1)%3. A triangle with a repeated corner joins
/// nothing: its edges are boundary and are not counted, though they join vertices.
class EdgePairing {
 public:
  std::vector<std::int32_t> neighbours;              // 3 a triangle
  std::vector<std::int32_t> vertex_neighbour_begin;  // a vertex, and one more
  std::vector<std::int32_t> vertex_neighbours;

  /// @param report  receives the counts of edges, duplicates and non-manifold vertices
  EdgePairing(int vertex_count, const std::vector<std::array<int, 3>>& triangles, MeshReport& report)
      : neighbours(triangles.size() * 3, boundary_neighbour), triangles_(triangles) {
    std::vector<std::pair<int, int>> joined = pair_edges(vertex_count, report);
    list_vertex_neighbours(vertex_count, joined);
    count_non_manifold_vertices(vertex_count, report);
    count_duplicates(vertex_count, report);
  }

 private:
  struct Edge {
    int larger;         // vertex
    std::int32_t slot;  // 3 · triangle + k
  };

  static bool has_repeated_corner(const std::array<int, 3>& t) noexcept { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }
  int start_of(std::int32_t slot) const noexcept { return triangles_[std::size_t(slot / 3)][std::size_t(slot % 3)]; }
  int end_of(std::int32_t slot) const noexcept { return triangles_[std::size_t(slot / 3)][std::size_t((slot % 3 + 1) % 3)]; }

  /// Fills `neighbours`, and returns each pair of joined vertices once.
  std::vector<std::pair<int, int>> pair_edges(int vertex_count, MeshReport& report) {
    const auto slot_count = std::int32_t(neighbours.size());
    std::vector<std::int32_t> begin(std::size_t(vertex_count) + 1, 0);
    for (std::int32_t s = 0; s < slot_count; ++s) ++begin[std::size_t((std::min)(start_of(s), end_of(s))) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Edge> edges(neighbours.size());
    std::vector<std::int32_t> next = begin;
    for (std::int32_t s = 0; s < slot_count; ++s) {
      const auto [smaller, larger] = std::minmax({start_of(s), end_of(s)});
      edges[std::size_t(next[std::size_t(smaller)]++)] = {larger, s};
    }
    std::vector<std::pair<int, int>> joined;
    joined.reserve(neighbours.size() / 2 + 8);
    for (int v = 0; v < vertex_count; ++v) {
      const auto first = edges.begin() + begin[std::size_t(v)], last = edges.begin() + begin[std::size_t(v) + 1];
      std::sort(first, last, [](const Edge& a, const Edge& b) { return a.larger != b.larger ? a.larger < b.larger : a.slot < b.slot; });
      for (auto group = first; group != last;) {
        auto group_end = group;
        while (group_end != last && group_end->larger == group->larger) ++group_end;
        if (group->larger != v) {
          joined.emplace_back(v, group->larger);
          join(&*group, int(group_end - group), report);
        }
        group = group_end;
      }
    }
    return joined;
  }

  /// Joins the triangles around one edge.
  void join(const Edge* edges, int count, MeshReport& report) {
    int used = 0;
    std::array<std::int32_t, 2> both{};
    for (int i = 0; i < count; ++i) {
      if (has_repeated_corner(triangles_[std::size_t(edges[i].slot / 3)])) continue;
      if (used < 2) both[std::size_t(used)] = edges[i].slot;
      ++used;
    }
    if (used == 1) ++report.boundary_edges;
    if (used == 2) {
      neighbours[std::size_t(both[0])] = both[1] / 3;
      neighbours[std::size_t(both[1])] = both[0] / 3;
      if (start_of(both[0]) == start_of(both[1])) ++report.inconsistent_edges;
    }
    if (used <= 2) return;
    ++report.non_manifold_edges;
    for (int i = 0; i < count; ++i)
      if (!has_repeated_corner(triangles_[std::size_t(edges[i].slot / 3)])) neighbours[std::size_t(edges[i].slot)] = non_manifold_neighbour;
  }

  void list_vertex_neighbours(int vertex_count, const std::vector<std::pair<int, int>>& joined) {
    vertex_neighbour_begin.assign(std::size_t(vertex_count) + 1, 0);
    for (const auto& [a, b] : joined) {
      ++vertex_neighbour_begin[std::size_t(a) + 1];
      ++vertex_neighbour_begin[std::size_t(b) + 1];
    }
    std::partial_sum(vertex_neighbour_begin.begin(), vertex_neighbour_begin.end(), vertex_neighbour_begin.begin());
    vertex_neighbours.resize(joined.size() * 2);
    std::vector<std::int32_t> next = vertex_neighbour_begin;
    for (const auto& [a, b] : joined) {
      vertex_neighbours[std::size_t(next[std::size_t(a)]++)] = b;
      vertex_neighbours[std::size_t(next[std::size_t(b)]++)] = a;
    }
  }

  /// Corners at a vertex that are joined by manifold edges form a fan; a vertex with two fans is not
  /// manifold.
  void count_non_manifold_vertices(int vertex_count, MeshReport& report) const {
    DisjointSets corners(neighbours.size());
    const auto corner_at = [this](std::int32_t triangle, int vertex) {
      const auto& t = triangles_[std::size_t(triangle)];
      return 3 * triangle + (t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2);
    };
    for (std::int32_t s = 0; s < std::int32_t(neighbours.size()); ++s) {
      const std::int32_t neighbour = neighbours[std::size_t(s)];
      if (neighbour < s / 3) continue;  // none, or done from the other side
      for (const int vertex : {start_of(s), end_of(s)}) corners.join(corner_at(s / 3, vertex), corner_at(neighbour, vertex));
    }
    std::vector<std::uint8_t> fans(std::size_t(vertex_count), 0);
    for (std::int32_t s = 0; s < std::int32_t(neighbours.size()); ++s) {
      if (!corners.is_root(s) || has_repeated_corner(triangles_[std::size_t(s / 3)])) continue;
      std::uint8_t& count = fans[std::size_t(start_of(s))];
      if (count == 2) continue;
      ++count;
      if (count == 2) ++report.non_manifold_vertices;
    }
  }

  void count_duplicates(int vertex_count, MeshReport& report) const {
    std::vector<std::int32_t> begin(std::size_t(vertex_count) + 1, 0);
    for (const auto& t : triangles_) ++begin[std::size_t((std::min)({t[0], t[1], t[2]})) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::pair<int, int>> rest(triangles_.size());  // the two larger corners
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    for (std::array<int, 3> t : triangles_) {
      std::sort(t.begin(), t.end());
      rest[std::size_t(next[std::size_t(t[0])]++)] = {t[1], t[2]};
    }
    for (int v = 0; v < vertex_count; ++v) {
      const auto first = rest.begin() + begin[std::size_t(v)], last = rest.begin() + begin[std::size_t(v) + 1];
      std::sort(first, last);
      for (auto i = first; i != last && i + 1 != last; ++i)
        if (*i == *(i + 1)) ++report.duplicate_triangles;
    }
  }

  const std::vector<std::array<int, 3>>& triangles_;
};

}  // namespace feeler::detail
