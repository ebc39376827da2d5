// How the time of a tick grows with the object and with the tool.
#pragma once

#include <vector>

#include "rivals/contest.hpp"

namespace feeler::rivals {

/// Scores at one size: triangles of the object, or vertices or pieces of the tool.
struct ScalingPoint {
  int size = 0;
  std::vector<Score> scores;  ///< Feeler first; times alone
};

/// A hull of 32 points on terrain of 1e3 to 1e6 triangles; Feeler, and ODE with 4 substeps where it is
/// installed.
std::vector<ScalingPoint> grow_object(const ContestOptions& options);

/// Hulls of 4 to 256 points on terrain of 1e4 triangles; Feeler, and ODE with 4 substeps where it is
/// installed.
std::vector<ScalingPoint> grow_tool(const ContestOptions& options);

/// A rod that stands on terrain of 1e4 triangles, cut into 1 to 64 pieces of which the lowest is in contact;
/// Feeler, and ODE with 4 substeps where it is installed.
std::vector<ScalingPoint> cut_tool(const ContestOptions& options);

}  // namespace feeler::rivals
