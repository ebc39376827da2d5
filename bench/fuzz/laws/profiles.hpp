// What is the same all along one axis: grooves, creases, ridges, steps and wedges. A convex tool goes about on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fuzz/laws/law_scene.hpp"

namespace feeler::laws {

/// A line from left to right, x and height: two slopes that meet in a groove or a ridge, steps, a comb of wedges, or any.
inline std::vector<Eigen::Vector2d> random_profile(std::mt19937& bits, double width) {
  const int kind = below(bits, 4), pieces = kind == 0 ? 2 : 3 + below(bits, 14);
  const double steepest = kind == 0 ? magnitude(bits, -4, 0.5) : magnitude(bits, -2, 0.5);
  std::vector<Eigen::Vector2d> profile{{-width, 0}};
  for (int i = 0; i < pieces; ++i) {
    const double last = profile.back().y(), length = 2 * width / pieces;
    const double side = kind == 0 || kind == 2 ? (i % 2 == 0 ? -1.0 : 1.0) : 2 * fraction(bits) - 1;
    const bool is_level = kind == 1 && i % 2 == 0;
    profile.emplace_back(profile.back().x() + length, is_level ? last : last + side * steepest * length);
  }
  if (below(bits, 2) == 0)
    for (auto& p : profile) p.y() = -p.y();
  return profile;
}

/// Some points on an ellipsoid, or the corners of a box.
inline ConvexPolytope<double> random_lump(std::mt19937& bits) {
  const Vector half = Vector::Constant(0.001) + 0.004 * (random_vector(bits) + Vector::Ones()) / 2;
  const bool is_box = below(bits, 2) == 0;
  Points<double> points(is_box ? 8 : 6 + below(bits, 25), 3);
  for (int i = 0; i < points.rows(); ++i) {
    Vector place = random_direction(bits);
    if (is_box) place = {(i & 1) == 0 ? 1.0 : -1.0, (i & 2) == 0 ? 1.0 : -1.0, (i & 4) == 0 ? 1.0 : -1.0};
    else if (i < 6) place = (i % 2 == 0 ? 1.0 : -1.0) * Vector::Unit(i / 2);
    points.row(i) = half.cwiseProduct(place);
  }
  return ConvexPolytope<double>::hull_of(points);
}

/// No contact can push along the axis of the profile; there are folds, as where a ridge slips off an edge of the tool.
inline LawScene<ConvexPolytope<double>> lump_on_profile(std::mt19937& bits) {
  constexpr double width = 0.03, half_length = 0.04;
  LawScene<ConvexPolytope<double>> scene{.family = "profile", .surface = {}, .tool = random_lump(bits)};
  scene.settings = random_law_settings(bits);
  const std::vector<Eigen::Vector2d> profile = random_profile(bits, width);
  const int strips = 1 + below(bits, 4), layers = strips + 1;
  for (const auto& p : profile)
    for (int k = 0; k <= strips; ++k) scene.surface.add({p.x(), half_length * (2.0 * k / strips - 1), p.y()});
  for (int i = 0; i + 1 < int(profile.size()); ++i)
    for (int k = 0; k < strips; ++k) scene.surface.quad(bits, i * layers + k, (i + 1) * layers + k, (i + 1) * layers + k + 1, i * layers + k + 1);
  const auto height_at = [profile](double x) {
    std::size_t i = 1;
    while (i + 1 < profile.size() && profile[i].x() < x) ++i;
    const Eigen::Vector2d a = profile[i - 1], b = profile[i];
    return a.y() + (b.y() - a.y()) * (x - a.x()) / (b.x() - a.x());
  };
  double highest = profile.front().y();
  for (const auto& p : profile) highest = std::max(highest, p.y());
  scene.placed = random_placement(bits);
  scene.start = {Vector(0, 0, highest + radius_of(scene.tool) + 1e-3), random_rotation(bits)};
  scene.random_hand = [=, start = scene.start.rotation](std::mt19937& random) {
    const double x = 0.5 * width * unit(random);
    Pose<double> pose{Vector(x, 0.01 * unit(random), height_at(x) + 0.004 * unit(random)), start};
    if (below(random, 3) > 0) pose.rotation = exp_rotation<double>(magnitude(random, -4, -0.5) * random_direction(random)) * pose.rotation;
    return pose;
  };
  scene.free_axes = {{Vector::UnitY(), false, false}};
  return scene;
}

}  // namespace feeler::laws
