// The paper's contact switches (Fig. 12 and 13): a line-shaped tool over a profile of convex and concave
// edges.
#pragma once

#include <array>
#include <numbers>

#include "scenes/motions.hpp"

namespace feeler::scenes {

namespace detail {

/// The stepped profile, extruded along y as an open sheet, with the motion of the probing hand.
inline Scene steps_without_tool() {
  constexpr std::array<std::array<double, 2>, 10> profile{
      {{-0.06, 0.0}, {-0.03, 0.0}, {-0.03, 0.01}, {0.0, 0.01}, {0.0, 0.02}, {0.012, 0.02}, {0.018, 0.012}, {0.03, 0.016}, {0.03, 0.0}, {0.06, 0.0}}};
  Scene scene;
  scene.vertices.resize(2 * Eigen::Index(profile.size()), 3);
  scene.triangles.resize(2 * (Eigen::Index(profile.size()) - 1), 3);
  for (int i = 0; i < int(profile.size()); ++i) {
    const auto [x, z] = profile[std::size_t(i)];
    scene.vertices.row(2 * i) << x, -0.02, z;
    scene.vertices.row(2 * i + 1) << x, 0.02, z;
    if (i == 0) continue;
    const int before = 2 * (i - 1);
    scene.triangles.row(before) << before, before + 2, before + 3;
    scene.triangles.row(before + 1) << before, before + 3, before + 1;
  }
  scene.motion = [](double t) {
    return pose_of({0.5 * std::sin(2.3 * t), 0.2 + 0.7 * std::sin(2.1 * t), 0.3 * std::sin(1.1 * t)},
                   {-0.045 * std::cos(3.0 * t), 0.015 * std::sin(2.0 * t), 0.05 - approach(t) * (0.033 + 0.008 * std::sin(5.0 * t))});
  };
  scene.start = scene.motion(0.0);
  scene.tip = Vector(0.0, 0.0, -0.015);
  scene.length = 0.008;
  return scene;
}

}  // namespace detail

/// Steps probed with a segment of 30 mm.
inline Scene steps() {
  Scene scene = detail::steps_without_tool();
  scene.name = "steps";
  scene.description = "A line-shaped tool steps across convex and concave edges.";
  scene.tool = Segment<double>(Vector(0.0, 0.0, -0.015), Vector(0.004, 0.001, 0.015));
  return scene;
}

/// Steps probed with a hexagonal prism of radius 1 mm and the height of the segment.
inline Scene steps_with_prism() {
  Scene scene = detail::steps_without_tool();
  scene.name = "steps-prism";
  scene.description = "A hexagonal prism steps across convex and concave edges.";
  Points<double> points(12, 3);
  for (int i = 0; i < 6; ++i) {
    const double angle = double(i) * std::numbers::pi / 3.0;
    points.row(2 * i) << 0.001 * std::cos(angle), 0.001 * std::sin(angle), -0.015;
    points.row(2 * i + 1) << 0.001 * std::cos(angle), 0.001 * std::sin(angle), 0.015;
  }
  scene.tool = ConvexPolytope<double>::hull_of(points);
  return scene;
}

}  // namespace feeler::scenes
