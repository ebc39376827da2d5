// A prism in a bore of the same section: the commonest fit, where many walls are near at once.
#pragma once

#include <numbers>

#include "scenes/motions.hpp"

namespace feeler::scenes {

namespace detail {

/// Corner of a regular polygon whose sides lie at a distance from the axis, seen along z.
inline Vector polygon_corner(int sides, double distance, int which, double z) {
  const double angle = 2.0 * std::numbers::pi * (double(which) + 0.5) / double(sides);
  const double radius = distance / std::cos(std::numbers::pi / double(sides));
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace detail

/// A shaft of 8 mm and 30 mm length in a bore of 12 mm depth, open at both ends, in a block with a flat top.
/// @param facets  of both, 3 to 128
/// @param play    between each facet of the shaft and its wall [m]
inline Scene shaft(int facets = 24, double play = 2e-5) {
  constexpr double radius = 0.004, half_length = 0.015, depth = 0.012, block = 0.012;
  Scene scene;
  scene.name = "shaft";
  scene.description = "A shaft turns and slides in a bore of the same section.";

  std::vector<Vector> vertices;
  const auto add_ring = [&](double distance, double z) {
    for (int i = 0; i < facets; ++i) vertices.push_back(detail::polygon_corner(facets, distance, i, z));
  };
  add_ring(radius + play, -depth);
  add_ring(radius + play, 0.0);
  add_ring(block, 0.0);
  add_ring(block, -depth);
  std::vector<Eigen::Vector3i> triangles;
  for (int ring = 0; ring < 4; ++ring) {
    const int from = ring * facets, to = (ring + 1) % 4 * facets;
    for (int i = 0; i < facets; ++i) {
      const int next = (i + 1) % facets;
      triangles.emplace_back(from + i, to + i, to + next);
      triangles.emplace_back(from + i, to + next, from + next);
    }
  }
  scene.vertices = points_from(vertices);
  scene.triangles = triangles_from(triangles);

  std::vector<Vector> corners;
  for (int i = 0; i < facets; ++i) {
    for (const double z : {-half_length, half_length}) corners.push_back(detail::polygon_corner(facets, radius, i, z));
  }
  scene.tool = ConvexPolytope<double>::hull_of(points_from(corners));
  scene.motion = [](double t) {
    return pose_of({0.1 * std::sin(4.0 * t), 0.1 * std::sin(3.3 * t), 0.4 * std::sin(2.5 * t)},
                   {0.002 * std::sin(6.0 * t), 0.002 * std::sin(7.0 * t), half_length + 0.002 - 0.006 * (1.0 - std::cos(2.0 * t))});
  };
  scene.start = scene.motion(0.0);
  scene.tip = Vector(0.0, 0.0, -half_length);
  scene.length = 0.010;
  return scene;
}

}  // namespace feeler::scenes
