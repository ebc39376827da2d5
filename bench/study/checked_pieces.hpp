// The pieces of a scene's tool for the checker of penetration.
#pragma once

#include <vector>

#include "study/scenes.hpp"
#include "support/penetration_checker.hpp"

namespace feeler::study {

inline std::vector<test::CheckedTool> checked_pieces(const StudyScene& scene) {
  std::vector<test::CheckedTool> pieces;
  for (const auto& points : scene.pieces) pieces.push_back(test::checked_tool(ConvexPolytope<double>::hull_of(points)));
  return pieces;
}

}  // namespace feeler::study
