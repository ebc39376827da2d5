// Rooms with flat walls that are concave to each other: a ball in a trough, a cone or a bowl of facets, and a box in a box.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "fuzz/laws/law_scene.hpp"

namespace feeler::laws {

/// Puts the ball in mid-air over a room that opens upwards, and lets hands go below its floor.
/// @param width  half of what the hand may take of the room; from there a ball touches within the walls [m]
inline void put_ball_above(LawScene<Sphere<double>>& scene, double width, double length) {
  const std::vector<HalfSpace> room = closed_in(scene.walls, scene.tool, {1, 0, 0, 0}, scene.settings.margin);
  const auto floor_at = [room](double x, double y) {
    Wide height = -std::numeric_limits<Wide>::infinity();
    for (const HalfSpace& space : room)
      if (space.normal.z() > 0.05L)
        height = std::max(height, (space.offset - space.normal.x() * Wide(x) - space.normal.y() * Wide(y)) / space.normal.z());
    return double(height);
  };
  scene.start.translation = {0, 0, floor_at(0, 0) + 0.002};
  scene.is_turned_as_hand = true;
  scene.random_hand = [=](std::mt19937& bits) {
    const double x = width * unit(bits), y = length * unit(bits);
    const double depth = below(bits, 8) == 0 ? -1e-3 : std::min(magnitude(bits, -6, -2), 0.4 * width);
    return Pose<double>{{x, y, floor_at(x, y) - depth}, Eigen::Quaterniond::Identity()};
  };
}

/// Facets along the y axis, 2 to 400 of them: half cylinders, V-grooves and uneven troughs; some have a wall across at one end or both.
inline LawScene<Sphere<double>> ball_in_trough(std::mt19937& bits) {
  const double width = 0.02 + 0.03 * fraction(bits), length = 0.05, radius = width * (0.05 + 0.2 * fraction(bits));
  LawScene<Sphere<double>> scene{.family = "trough", .surface = {}, .tool = Sphere<double>(radius)};
  scene.settings = random_law_settings(bits);
  const int kind = below(bits, 3), n = kind == 0 ? 2 : int(magnitude(bits, std::log10(3.0), std::log10(400.0)));
  const double steepest = kind == 0 ? magnitude(bits, -3, 0.1) : 0.3 + fraction(bits);
  std::vector<double> slopes;
  for (int i = 0; i < n; ++i) slopes.push_back(kind == 2 ? steepest * unit(bits) : steepest * (2.0 * i / (n - 1) - 1));
  if (kind == 0) slopes[1] *= below(bits, 2) == 0 ? 1 : 0.1 + 0.9 * fraction(bits);
  std::sort(slopes.begin(), slopes.end());
  std::vector<WideVector> profile{WideVector::Zero()};
  for (const double slope : slopes) {
    const Wide part = Wide(kind == 2 ? 0.2 + fraction(bits) : 1.0) * Wide(kind == 0 ? 1 / std::cos(slope) : 1.0);
    profile.emplace_back(profile.back() + part * WideVector(std::cos(Wide(slope)), 0, std::sin(Wide(slope))));
  }
  const Wide scale = 2 * Wide(width) / profile.back().x();
  for (WideVector& p : profile) p = scale * p - WideVector(Wide(width), 0, 0);
  const int strips = 1 + below(bits, 3);
  std::vector<Vector> corners;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= strips; ++k)
      corners.emplace_back(double(profile[std::size_t(i)].x()), length * (2.0 * k / strips - 1), double(profile[std::size_t(i)].z()));
  scene.surface.vertices = corners;
  const WideVector inside(0, 0, 1);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < strips; ++k)
      scene.surface.quad(bits, i * (strips + 1) + k, (i + 1) * (strips + 1) + k, (i + 1) * (strips + 1) + k + 1, i * (strips + 1) + k + 1);
    scene.walls.push_back(HalfSpace::through(corners[std::size_t(i * (strips + 1))].cast<Wide>(),
                                             corners[std::size_t((i + 1) * (strips + 1))].cast<Wide>(),
                                             corners[std::size_t((i + 1) * (strips + 1) + strips)].cast<Wide>(), inside));
  }
  const double end = radius + 0.004;
  double travel = 0.01;
  if (below(bits, 3) == 0) {
    const double side = below(bits, 2) == 0 ? 1 : -1;
    scene.surface.sheet(bits, {-3 * width, side * end, -3 * width}, {6 * width, 0, 0}, {0, 0, 9 * width}, 1, 1);
    scene.walls.push_back({WideVector(0, Wide(-side), 0), -Wide(end)});
    travel = 0.005;
  }
  scene.placed = random_placement(bits);
  put_ball_above(scene, 0.4 * width, travel);
  return scene;
}

/// Rings of flat facets about the z axis: a cone with its tip, or a bowl.
inline LawScene<Sphere<double>> ball_in_bowl(std::mt19937& bits) {
  const int rings = below(bits, 2) == 0 ? 1 : 2 + below(bits, 6), n = rings == 1 ? 3 + below(bits, 98) : 3 + below(bits, 40);
  const double width = 0.02 + 0.02 * fraction(bits), radius = width * (0.05 + 0.15 * fraction(bits));
  LawScene<Sphere<double>> scene{.family = rings == 1 ? "cone" : "bowl", .surface = {}, .tool = Sphere<double>(radius)};
  scene.settings = random_law_settings(bits);
  const double steepest = rings == 1 ? magnitude(bits, -2.5, 0) : 0.3 + 0.7 * fraction(bits),
               gentlest = below(bits, 3) == 0 ? 0 : steepest * 0.5 * fraction(bits);
  std::vector<double> slopes;
  for (int k = 0; k < rings; ++k) slopes.push_back(rings == 1 ? steepest : gentlest + (steepest - gentlest) * (k + 0.5 * fraction(bits)) / rings);
  std::vector<double> angles;
  const double unevenness = below(bits, 2) == 0 ? 0 : n < 5 ? 0.4 : 0.8;
  for (int i = 0; i < n; ++i) angles.push_back(2 * std::numbers::pi * (i + unevenness * fraction(bits)) / n);
  Surface& surface = scene.surface;
  surface.add({0, 0, 0});
  double out = 0, up = 0;
  for (int k = 0; k < rings; ++k) {
    out += width / rings, up += width / rings * std::tan(slopes[std::size_t(k)]);
    for (int i = 0; i < n; ++i) surface.add({out * std::cos(angles[std::size_t(i)]), out * std::sin(angles[std::size_t(i)]), up});
  }
  const WideVector inside(0, 0, 1);
  const auto at = [&](int k, int i) { return k == 0 ? 0 : 1 + (k - 1) * n + i % n; };
  const auto place = [&](int vertex) { return WideVector(surface.vertices[std::size_t(vertex)].cast<Wide>()); };
  for (int k = 0; k < rings; ++k)
    for (int i = 0; i < n; ++i) {
      if (k == 0) surface.triangles.emplace_back(0, at(1, i), at(1, i + 1));
      else surface.quad(bits, at(k, i), at(k + 1, i), at(k + 1, i + 1), at(k, i + 1));
      scene.walls.push_back(HalfSpace::through(place(at(k, i)), place(at(k + 1, i)), place(at(k + 1, i + 1)), inside));
    }
  scene.placed = random_placement(bits);
  // The walls of a triangle are half as far as its corners.
  put_ball_above(scene, 0.25 * width * (n < 5 ? 0.5 : 1), 0.25 * width * (n < 5 ? 0.5 : 1));
  return scene;
}

/// A box in a room of its own shape, as the hand holds it along the walls: each coordinate is the hand's, cut off where the play ends.
inline LawScene<Box<double>> box_in_box(std::mt19937& bits) {
  const Vector half = Vector::Constant(0.002) + 0.01 * (random_vector(bits) + Vector::Ones()) / 2;
  LawScene<Box<double>> scene{.family = "cavity", .surface = {}, .tool = Box<double>(half)};
  scene.settings = random_law_settings(bits);
  scene.play = std::min(2e-3, scene.settings.margin * magnitude(bits, 0.02, 3));
  const Vector room = half + Vector::Constant(scene.play);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3, cells = 1 + below(bits, 4);
      const Vector normal = -side * Vector::Unit(axis);
      scene.surface.sheet(bits, -room.cwiseProduct(Vector::Ones() - Vector::Unit(axis)) + side * room[axis] * Vector::Unit(axis),
                          2 * room[u] * Vector::Unit(u), 2 * room[v] * Vector::Unit(v), cells, cells, 0.3);
      scene.walls.push_back({normal.cast<Wide>(), -Wide(room[axis])});
    }
  scene.placed = random_placement(bits);
  scene.is_turned_as_hand = true;
  scene.random_hand = [=, play = scene.play](std::mt19937& random) {
    Pose<double> pose;
    for (int axis = 0; axis < 3; ++axis) pose.translation[axis] = (below(random, 3) == 0 ? play : play + magnitude(random, -6, -2.7)) * unit(random);
    return pose;
  };
  return scene;
}

}  // namespace feeler::laws
