// The groove between a tooth and its gum, from a formula, and the slender probe that a dentist puts into it.
#pragma once

#include <numbers>

#include "scenes/height_field.hpp"
#include "scenes/motions.hpp"

namespace feeler::scenes {

/// The point of the slender probe, in the tool frame [m].
inline const Vector probe_tip(0.0, 0.0, -0.0204);

/// A probe of 40 mm along z with a pointed tip: the hull of 13 points.
inline ConvexPolytope<double> slender_probe() {
  Points<double> points(13, 3);
  for (int i = 0; i < 6; ++i) {
    const double angle = double(i) * std::numbers::pi / 3.0;
    points.row(i) << 0.0005 * std::cos(angle), 0.0005 * std::sin(angle), -0.020;
    points.row(6 + i) << 0.0008 * std::cos(angle), 0.0008 * std::sin(angle), 0.020;
  }
  points.row(12) = probe_tip.transpose();
  return ConvexPolytope<double>::hull_of(points);
}

/// Height of gum, groove and tooth at a place [m]; steep and curved, as in a mouth.
inline double sulcus_height(double x, double y) {
  const double b = y - 0.0006 * std::sin(300.0 * x);
  const double w = 0.0011 + 0.0003 * std::sin(170.0 * x);
  if (b < -w) return 0.004 * (1.0 - std::exp((b + w) / 0.0004));
  if (b > w) {
    return 0.005 * (1.0 - std::exp(-(b - w) / 0.0006)) +
           0.0004 * std::sin(900.0 * x) * std::exp(-(b - w) / 0.002) * (1.0 - std::exp(-(b - w) / 0.0003));
  }
  return -0.001 * (1.0 - b * b / (w * w));
}

/// 14,400 triangles of gum and tooth, probed along the groove.
inline Scene sulcus() {
  Scene scene;
  scene.name = "sulcus";
  scene.description = "A slender probe follows the groove between tooth and gum.";
  mesh_height_field({-0.025, 0.025, -0.012, 0.012, 120, 60}, sulcus_height, scene.vertices, scene.triangles);
  scene.tool = slender_probe();
  scene.tip = probe_tip;
  scene.motion = [](double t) {
    return pose_of({0.35 * std::sin(2.9 * t), 0.3 * std::sin(3.7 * t), 0.5 * std::sin(2.0 * t)},
                   {0.018 * std::sin(3.0 * t), 0.002 * std::sin(11.0 * t), 0.028 - approach(t) * (0.0105 + 0.002 * std::sin(7.0 * t))});
  };
  scene.start = scene.motion(0.0);
  scene.length = 0.0055;
  return scene;
}

}  // namespace feeler::scenes
