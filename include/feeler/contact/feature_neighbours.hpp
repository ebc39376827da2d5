// The neighbours of a feature, from which candidate contacts are made (paper, Fig. 8).
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "feeler/core/feature.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// The incidence of a tool's features, numbered as the tool numbers them. @cost  O(n log n), allocates
template <ConvexTool Tool>
FeatureIncidence incidence_of(const Tool& tool) {
  std::vector<std::array<int, 2>> edges;
  std::vector<std::pair<int, int>> edge_faces, vertex_faces;
  for (int e = 0; e < tool.edge_count(); ++e) edges.push_back({tool.edge(e).start, tool.edge(e).end});
  const auto key = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  std::vector<std::pair<std::pair<int, int>, int>> numbered;
  for (int e = 0; e < tool.edge_count(); ++e) numbered.emplace_back(key(edges[std::size_t(e)][0], edges[std::size_t(e)][1]), e);
  std::sort(numbered.begin(), numbered.end());
  for (int f = 0; f < tool.face_count(); ++f) {
    const auto face = tool.face(f);
    const auto& loop = face.vertices;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      vertex_faces.emplace_back(loop[i], f);
      const auto side = std::pair(key(loop[i], loop[(i + 1) % loop.size()]), -1);
      const auto found = std::lower_bound(numbered.begin(), numbered.end(), side);
      if (found != numbered.end() && found->first == side.first) edge_faces.emplace_back(found->second, f);
    }
  }
  return FeatureIncidence(tool.vertex_count(), std::move(edges), tool.face_count(), edge_faces, vertex_faces);
}

/// The features that share a vertex with a feature, itself left out.
struct FeatureNeighbours {
  static constexpr int capacity = 256;

  FixedVector<Feature, capacity> features;
  int dropped = 0;  ///< neighbours for which there was no room

  bool contains(const Feature& feature) const noexcept {
    return std::find(features.begin(), features.end(), feature) != features.end();
  }
};

/// Every vertex, edge and face that has a vertex in common with a feature, each once; of a tool with `incidence_of`, of an object with
/// `SurfaceFeatures::incidence`. Generated from the incidence, where the paper has a look-up table made by hand.
/// @cost  noexcept, no allocation; at most quadratic in the neighbours, of which `capacity` are kept
inline FeatureNeighbours neighbours_of(const FeatureIncidence& incidence, const Feature& feature) noexcept {
  FeatureNeighbours result;
  const auto add = [&](FeatureKind kind, int index) {
    const Feature neighbour{kind, index};
    if (neighbour == feature || result.contains(neighbour)) return;
    if (!result.features.push_back(neighbour)) ++result.dropped;
  };
  const auto add_around = [&](int vertex) {
    add(FeatureKind::vertex, vertex);
    for (const int edge : incidence.vertex_edges(vertex)) add(FeatureKind::edge, edge);
    for (const int face : incidence.vertex_faces(vertex)) add(FeatureKind::face, face);
  };
  switch (feature.kind) {
    case FeatureKind::vertex: add_around(feature.index); break;
    case FeatureKind::edge:
      for (const int vertex : incidence.edge_vertices(feature.index)) add_around(vertex);
      break;
    case FeatureKind::face:
      for (const int vertex : incidence.face_vertices(feature.index)) add_around(vertex);
      break;
  }
  return result;
}

}  // namespace feeler
