// A box on a flat plate of 2 to 2000 triangles and a millimetre to a hundred metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fuzz/laws/law_scene.hpp"

namespace feeler::laws {

/// The hand slides the box about a place of the plate; in half of the scenes it keeps it flat, else it tilts it too.
///
/// All contacts push along the plate's normal: nothing along the plate, no turn about the normal. Kept flat, it rests at half its height and the margin.
/// @param must_be_flat  in all scenes
inline LawScene<Box<double>> box_on_plate(std::mt19937& bits, bool must_be_flat = false) {
  const double size = below(bits, 3) == 0 ? magnitude(bits, 0.5, 2) : magnitude(bits, -2.3, 0.5);
  const double longest = std::min(size / 10, 0.02);
  const Vector half(longest * (0.3 + 0.7 * fraction(bits)) / 2, longest * (0.3 + 0.7 * fraction(bits)) / 2,
                    longest * (0.3 + 0.7 * fraction(bits)) / 2);
  LawScene<Box<double>> scene{.family = "plate", .surface = {}, .tool = Box<double>(half)};
  scene.settings = random_law_settings(bits);
  const int cells = int(std::sqrt(magnitude(bits, 0, 3)));
  scene.surface.sheet(bits, {-size / 2, -size / 2, 0}, {size, 0, 0}, {0, size, 0}, cells, cells, below(bits, 2) == 0 ? 0 : 0.3);
  scene.placed = random_placement(bits);
  const Vector place(0.25 * size * unit(bits), 0.25 * size * unit(bits), 0);
  const double turn = below(bits, 2) == 0 ? 0 : std::numbers::pi * unit(bits);
  const auto turned = [](double angle) { return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector::UnitZ())); };
  scene.start = {place + Vector(0, 0, half.norm() + 1e-4), turned(turn)};
  scene.is_turned_as_hand = below(bits, 2) == 0 || must_be_flat;
  const double way = std::min(0.1 * size, 0.01), depth = std::log10(std::min(size / 20, 5e-3));
  scene.random_hand = [=, keeps_flat = scene.is_turned_as_hand](std::mt19937& random) {
    Pose<double> pose{place + way * Vector(unit(random), unit(random), 0), turned(turn + (below(random, 2) == 0 ? 0 : 0.2 * unit(random)))};
    pose.translation.z() = half.z() - magnitude(random, -6, depth);
    if (!keeps_flat) pose.rotation = exp_rotation<double>(magnitude(random, -5, -1.7) * random_direction(random)) * pose.rotation;
    return pose;
  };
  scene.walls = {{WideVector(0, 0, 1), 0}};
  scene.free_axes = {{Vector::UnitX(), false, false}, {Vector::UnitY(), false, false}, {Vector::UnitZ(), false, true}};
  return scene;
}

}  // namespace feeler::laws
