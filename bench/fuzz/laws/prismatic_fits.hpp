// Fits: a peg through a hole of its own section, convex, tapered or an L of two pieces, and two boxes in a slot.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "fuzz/laws/law_scene.hpp"
#include "fuzz/laws/sections.hpp"

namespace feeler::laws {

/// A hand that goes aside, along and about by amounts of all sizes, or not at all.
/// @param along  the most it goes along each axis [m]
inline std::function<Pose<double>(std::mt19937&)> hand_in_a_fit(const Vector& along, bool turns) {
  return [along, turns](std::mt19937& bits) {
    Pose<double> pose;
    const double angle = 2 * std::numbers::pi * fraction(bits);
    const Vector aside =
        below(bits, 4) == 0 ? Vector(Vector::Zero()) : Vector(magnitude(bits, -7, -3.3) * Vector(std::cos(angle), std::sin(angle), 0));
    pose.translation = aside + (below(bits, 3) == 0 ? Vector(Vector::Zero()) : Vector(along.cwiseProduct(random_vector(bits))));
    if (turns && below(bits, 3) > 0) pose.rotation = exp_rotation<double>(magnitude(bits, -5, -1.7) * random_direction(bits));
    return pose;
  };
}

/// The hole of a plate: open at both ends, and longer pegs stand out of it by 8 mm, more than a hand goes along.
inline constexpr double peg_overhang = 0.008, way_along = 0.002;

/// @param taper  share by which it is wider a metre higher up [1/m]
inline Points<double> prism(const Section& section, double half_length, double taper = 0) {
  Points<double> points(2 * Eigen::Index(section.size()), 3);
  for (std::size_t i = 0; i < section.size(); ++i)
    for (const int end : {0, 1}) {
      const double z = end == 0 ? -half_length : half_length, scale = 1 + taper * z;
      points.row(2 * Eigen::Index(i) + end) << scale * section[i].x(), scale * section[i].y(), z;
    }
  return points;
}

/// A hole with play on each side about a section, its walls cut at random.
inline Surface hole_about(std::mt19937& bits, const Section& section, double play, double height, double taper = 0) {
  const int pieces = 1 + below(bits, section.size() > 12 ? 2 : 4), strips = 1 + below(bits, 4);
  return ring(bits, divided(play > 0 ? parallel(section, play) : section, pieces), divided(parallel(section, play + 0.006), pieces), height, strips,
              taper);
}

/// What has a section and goes along the z axis: nothing can push it there, as all contacts are with its sides.
template <class Tool>
LawScene<Tool> fit(std::mt19937& bits, const char* family, const Section& section, double height, const Tool& tool) {
  LawScene<Tool> scene{.family = family, .surface = {}, .tool = tool};
  scene.settings = random_law_settings(bits);
  scene.play = random_play(bits, scene.settings.margin);
  scene.surface = hole_about(bits, section, scene.play, height);
  scene.placed = random_placement(bits);
  scene.random_hand = hand_in_a_fit({0, 0, way_along}, true);
  scene.lever = 2 * radius_of(tool) / height;
  scene.free_axes = {{Vector::UnitZ(), true, false}};
  return scene;
}

/// A convex peg of a section.
inline LawScene<ConvexPolytope<double>> peg_in_hole(std::mt19937& bits, const char* family, const Section& section) {
  const double height = 0.005 + 0.015 * fraction(bits);
  return fit(bits, family, section, height, ConvexPolytope<double>::hull_of(prism(section, height / 2 + peg_overhang)));
}

/// A convex peg that is thinner below, in a hole that is too: the hand presses it into its seat, or lifts it off.
inline LawScene<ConvexPolytope<double>> taper_in_hole(std::mt19937& bits, const char* family, const Section& section) {
  const double height = 0.005 + 0.015 * fraction(bits), taper = magnitude(bits, 0, 1.6);
  LawScene<ConvexPolytope<double>> scene{
      .family = family, .surface = {}, .tool = ConvexPolytope<double>::hull_of(prism(section, height / 2 + peg_overhang, taper))};
  scene.settings = random_law_settings(bits);
  scene.play = random_play(bits, scene.settings.margin);
  scene.surface = hole_about(bits, section, scene.play, height, taper);
  scene.placed = random_placement(bits);
  scene.random_hand = hand_in_a_fit({0, 0, way_along}, true);
  double radius = 0;
  for (const auto& corner : section) radius = std::max(radius, corner.norm());
  scene.lever = std::max(2 * radius_of(scene.tool) / height, 2 / (taper * radius));
  return scene;
}

/// An L of two bars, which overlap where they meet, about a point of the first.
inline LawScene<CompoundTool<ConvexPolytope<double>>> angle_in_hole(std::mt19937& bits) {
  const double a = 0.002 + 0.002 * fraction(bits), b = a + 0.001 + 0.005 * fraction(bits), c = a + 0.001 + 0.005 * fraction(bits);
  const double height = 0.005 + 0.015 * fraction(bits), half_length = height / 2 + peg_overhang;
  const Section outline{{-a, -a}, {b, -a}, {b, a}, {a, a}, {a, c}, {-a, c}};
  std::vector<ConvexPolytope<double>> bars;
  bars.push_back(ConvexPolytope<double>::hull_of(prism({{-a, -a}, {b, -a}, {b, a}, {-a, a}}, half_length)));
  bars.push_back(ConvexPolytope<double>::hull_of(prism({{-a, -a}, {a, -a}, {a, c}, {-a, c}}, half_length)));
  return fit(bits, "angle", outline, height, CompoundTool<ConvexPolytope<double>>(std::move(bars)));
}

/// Two boxes side by side between two flat walls: both directions along the walls are free, and the turn in their plane.
inline LawScene<CompoundTool<ConvexPolytope<double>>> boxes_in_slot(std::mt19937& bits) {
  const double half = 0.001 + 0.004 * fraction(bits), a = 0.002 + 0.006 * fraction(bits), b = 0.002 + 0.006 * fraction(bits);
  const auto box = [&](double x0, double x1, double y0, double y1) {
    return ConvexPolytope<double>::hull_of(prism({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, half));
  };
  std::vector<ConvexPolytope<double>> boxes;
  boxes.push_back(box(-a, 0.2 * a, -b, b));
  boxes.push_back(box(0, 1.5 * a, -0.3 * b, 1.2 * b));
  LawScene<CompoundTool<ConvexPolytope<double>>> scene{
      .family = "slot", .surface = {}, .tool = CompoundTool<ConvexPolytope<double>>(std::move(boxes))};
  scene.settings = random_law_settings(bits);
  scene.play = random_play(bits, scene.settings.margin);
  const double size = 0.06;
  const int cells = 1 + below(bits, 6);
  for (const double side : {-1.0, 1.0})
    scene.surface.sheet(bits, {-size / 2, -size / 2, side * (half + scene.play)}, {size, 0, 0}, {0, size, 0}, cells, cells, 0.3);
  scene.placed = random_placement(bits);
  const auto hand = hand_in_a_fit({way_along, way_along, 0}, true);
  scene.random_hand = [hand](std::mt19937& random) {
    Pose<double> pose = hand(random);
    if (below(random, 2) == 0) pose.translation.z() = magnitude(random, -7, -3) * (below(random, 2) == 0 ? 1 : -1);
    return pose;
  };
  scene.lever = radius_of(scene.tool) / std::min(a, b);
  scene.free_axes = {{Vector::UnitX(), false, false}, {Vector::UnitY(), false, false}, {Vector::UnitZ(), false, true}};
  return scene;
}

}  // namespace feeler::laws
