// Which vertices, edges and faces of a tool bound each other.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "feeler/core/feature_incidence.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// The incidence of a tool's features, numbered as the tool numbers them. @cost  O(n log n), allocates
template <ConvexTool Tool>
FeatureIncidence incidence_of(const Tool& tool) {
  std::vector<std::array<int, 2>> edges;
  std::vector<std::pair<int, int>> edge_faces, vertex_faces;
  for (int e = 0; e < tool.edge_count(); ++e) edges.push_back({tool.edge(e).start, tool.edge(e).end});
  const auto key = [](int a, int b) { return std::pair((std::min)(a, b), (std::max)(a, b)); };
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

}  // namespace feeler
