// The neighbours of a feature, from which candidate contacts are made (paper, Fig. 8).
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "feeler/core/feature.hpp"
#include "feeler/core/feature_incidence.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/tool/tool_incidence.hpp"

namespace feeler {

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
