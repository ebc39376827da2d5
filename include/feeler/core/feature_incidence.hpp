// Which vertices, edges and faces of a surface bound each other.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "feeler/core/feature.hpp"
#include "feeler/core/fixed_vector.hpp"

namespace feeler {

namespace detail {

/// Lists of numbers, one a row, end to end in one array.
class NumberLists {
 public:
  NumberLists() = default;
  /// @param pairs  (row, number), in any order; repeated ones are kept once, and each list is sorted
  NumberLists(int row_count, std::vector<std::pair<int, int>> pairs) : begin_(std::size_t(row_count) + 1, 0) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    numbers_.reserve(pairs.size());
    for (const auto& [row, number] : pairs) {
      ++begin_[std::size_t(row) + 1];
      numbers_.push_back(number);
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  }

  std::span<const int> operator[](int row) const noexcept {
    const auto begin = std::size_t(begin_[std::size_t(row)]), end = std::size_t(begin_[std::size_t(row) + 1]);
    return {numbers_.data() + begin, end - begin};
  }

 private:
  std::vector<int> begin_{0};
  std::vector<int> numbers_;
};

}  // namespace detail

/// The smallest features that hold two others; on a convex tool at most one.
using FeatureJoin = FixedVector<Feature, 4>;

/// Incidence of features. Every call is noexcept and allocates nothing.
///
/// The closure of an edge is the edge and its ends; that of a face is the face, its edges and its vertices.
class FeatureIncidence {
 public:
  FeatureIncidence() = default;
  /// @param edge_ends     the two vertices of each edge
  /// @param edge_faces    (edge, face) for each edge that bounds a face
  /// @param vertex_faces  (vertex, face) for each vertex that bounds a face
  /// @cost  O(n log n), allocates
  FeatureIncidence(int vertex_count, std::vector<std::array<int, 2>> edge_ends, int face_count, const std::vector<std::pair<int, int>>& edge_faces,
                   const std::vector<std::pair<int, int>>& vertex_faces)
      : vertex_count_(vertex_count), face_count_(face_count), edge_ends_(std::move(edge_ends)) {
    std::vector<std::pair<int, int>> vertex_edges;
    vertex_edges.reserve(2 * edge_ends_.size());
    for (std::size_t e = 0; e < edge_ends_.size(); ++e)
      for (const int vertex : edge_ends_[e]) vertex_edges.emplace_back(vertex, int(e));
    const auto swapped = [](std::vector<std::pair<int, int>> pairs) {
      for (auto& [row, number] : pairs) std::swap(row, number);
      return pairs;
    };
    vertex_edges_ = detail::NumberLists(vertex_count, std::move(vertex_edges));
    vertex_faces_ = detail::NumberLists(vertex_count, vertex_faces);
    edge_faces_ = detail::NumberLists(edge_count(), edge_faces);
    face_edges_ = detail::NumberLists(face_count, swapped(edge_faces));
    face_vertices_ = detail::NumberLists(face_count, swapped(vertex_faces));
  }

  int vertex_count() const noexcept { return vertex_count_; }
  int edge_count() const noexcept { return int(edge_ends_.size()); }
  int face_count() const noexcept { return face_count_; }

  const std::array<int, 2>& edge_vertices(int edge) const noexcept { return edge_ends_[std::size_t(edge)]; }
  // The lists below are sorted and hold no number twice.
  std::span<const int> edge_faces(int edge) const noexcept { return edge_faces_[edge]; }
  std::span<const int> vertex_edges(int vertex) const noexcept { return vertex_edges_[vertex]; }
  std::span<const int> vertex_faces(int vertex) const noexcept { return vertex_faces_[vertex]; }
  std::span<const int> face_edges(int face) const noexcept { return face_edges_[face]; }
  std::span<const int> face_vertices(int face) const noexcept { return face_vertices_[face]; }

  /// Whether `part` is in the closure of `whole`. @cost  the length of a list of the smaller feature
  bool contains(const Feature& whole, const Feature& part) const noexcept {
    if (whole == part) return true;
    if (part.kind >= whole.kind) return false;
    if (whole.kind == FeatureKind::edge) {
      const auto& ends = edge_vertices(whole.index);
      return ends[0] == part.index || ends[1] == part.index;
    }
    const auto faces = part.kind == FeatureKind::vertex ? vertex_faces(part.index) : edge_faces(part.index);
    return std::find(faces.begin(), faces.end(), whole.index) != faces.end();
  }

  /// The smallest features whose closures hold both of two features; none where they share no face. Where there are more than
  /// `FeatureJoin::capacity()`, the first.
  FeatureJoin join(const Feature& a, const Feature& b) const noexcept {
    FeatureJoin result;
    if (contains(a, b)) {
      result.push_back(a);
      return result;
    }
    if (contains(b, a)) {
      result.push_back(b);
      return result;
    }
    const Feature& low = a.kind < b.kind ? a : b;
    const Feature& high = a.kind < b.kind ? b : a;
    if (high.kind == FeatureKind::vertex) {
      for (const int edge : vertex_edges(low.index))
        if (contains({FeatureKind::edge, edge}, high)) result.push_back({FeatureKind::edge, edge});
      if (!result.empty()) return result;
    }
    if (low.kind == FeatureKind::face) return result;
    const auto faces = low.kind == FeatureKind::vertex ? vertex_faces(low.index) : edge_faces(low.index);
    for (const int face : faces)
      if (contains({FeatureKind::face, face}, high)) result.push_back({FeatureKind::face, face});
    return result;
  }

 private:
  int vertex_count_ = 0;
  int face_count_ = 0;
  std::vector<std::array<int, 2>> edge_ends_;
  detail::NumberLists vertex_edges_, vertex_faces_, edge_faces_, face_edges_, face_vertices_;
};

}  // namespace feeler
