// A feature of a polyhedral surface: a vertex, an edge or a face, by its number.
#pragma once

#include <compare>

namespace feeler {

enum class FeatureKind : unsigned char { vertex, edge, face };

constexpr const char* to_string(FeatureKind kind) noexcept {
  switch (kind) {
    case FeatureKind::vertex: return "vertex";
    case FeatureKind::edge: return "edge";
    case FeatureKind::face: return "face";
  }
  return "unknown feature";
}

/// Vertices, edges and faces are numbered apart, each from 0. Features are ordered by kind, then by number.
struct Feature {
  FeatureKind kind = FeatureKind::vertex;
  int index = -1;

  friend constexpr auto operator<=>(const Feature&, const Feature&) noexcept = default;
};

}  // namespace feeler
