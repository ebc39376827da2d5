// A bumpy height field of any number of triangles and a pebble that rolls over it: scale.
#pragma once

#include "scenes/height_field.hpp"
#include "scenes/motions.hpp"

namespace feeler::scenes {

/// The hull of 32 points on an ellipsoid of half axes 15, 12 and 10 mm.
inline ConvexPolytope<double> pebble(std::uint32_t seed) {
  RandomBits random(seed);
  Points<double> points(32, 3);
  for (int i = 0; i < 32; ++i) {
    points.row(i) = random.direction().cwiseProduct(Vector(0.015, 0.012, 0.010)).transpose();
  }
  return ConvexPolytope<double>::hull_of(points);
}

/// Terrain of cells × cells squares, 2 cells² triangles; 22, 71, 224 and 707 give 1e3, 1e4, 1e5 and 1e6.
inline Scene terrain(int cells = 71, std::uint32_t seed = 1) {
  Scene scene;
  scene.name = "terrain";
  scene.description = "The convex hull of 32 points presses and rolls over bumps of three sizes.";
  mesh_height_field(
      {-0.1, 0.1, -0.1, 0.1, cells, cells},
      [](double x, double y) {
        return 0.002 * std::sin(180.0 * x) * std::cos(150.0 * y) + 0.0006 * std::sin(900.0 * x + 1.0) * std::sin(800.0 * y) +
               0.00008 * std::sin(6000.0 * x) * std::sin(5200.0 * y);
      },
      scene.vertices, scene.triangles);
  scene.tool = pebble(seed);
  scene.motion = [](double t) {
    return pose_of({0.4 * std::sin(4.5 * t), 0.4 * std::sin(3.9 * t), 0.6 * std::sin(2.0 * t)},
                   {0.045 * std::sin(4.0 * t), 0.04 * std::sin(2.7 * t), 0.03 - approach(t) * (0.0235 + 0.002 * std::sin(6.0 * t))});
  };
  scene.start = scene.motion(0.0);
  scene.length = 0.010;
  scene.duration = cells > 500 ? 4.0 : 6.0;
  return scene;
}

}  // namespace feeler::scenes
