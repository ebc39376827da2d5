// A rod that stands on bumpy ground, in one piece or many: what a piece costs that is far from everything.
#pragma once

#include <cmath>

#include "scenes/terrain.hpp"

namespace feeler::scenes {

/// A rod of 4 × 4 × 60 mm, cut across, that stands and slides on the terrain of cells × cells squares.
inline CompoundScene rod(int cells, int pieces) {
  CompoundScene scene{terrain(cells), {}};
  scene.name = "rod";
  scene.description = "A rod in pieces stands on bumps of three sizes; only the lowest piece touches.";
  for (int i = 0; i < pieces; ++i) {
    Points<double>& corners = scene.pieces.emplace_back(8, 3);
    for (int k = 0; k < 8; ++k) {
      corners.row(k) << ((k & 1) != 0 ? 0.002 : -0.002), ((k & 2) != 0 ? 0.002 : -0.002), 0.06 * (i + (k >> 2)) / pieces;
    }
  }
  scene.motion = [](double t) {
    return pose_of({0.3 * std::sin(4.5 * t), 0.3 * std::sin(3.9 * t), 0.6 * std::sin(2.0 * t)},
                   {0.045 * std::sin(4.0 * t), 0.04 * std::sin(2.7 * t), 0.02 - 0.022 * approach(t)});
  };
  scene.start = scene.motion(0.0);
  return scene;
}

}  // namespace feeler::scenes
