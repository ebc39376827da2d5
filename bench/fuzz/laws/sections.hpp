// Sections of pegs and holes: polygons, counter-clockwise, and their parallels.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "fuzz/laws/surface.hpp"

namespace feeler::laws {

using Section = std::vector<Eigen::Vector2d>;

/// A convex polygon of 3 to 40 sides and some millimetres about the origin; regular, or on an ellipse at uneven angles.
inline Section random_section(std::mt19937& bits) {
  const int n = 3 + below(bits, below(bits, 2) == 0 ? 10 : 38);
  const double radius = 0.002 + 0.006 * fraction(bits);
  const bool is_regular = below(bits, 3) == 0;
  const double flatness = is_regular ? 1 : 0.4 + 0.6 * fraction(bits), unevenness = is_regular ? 0 : n < 5 ? 0.4 : 0.8;
  const double turn = is_regular && below(bits, 2) == 0 ? 0 : 2 * std::numbers::pi * fraction(bits);
  Section section;
  for (int i = 0; i < n; ++i) {
    const double angle = turn + 2 * std::numbers::pi * (i + unevenness * fraction(bits)) / n;
    section.emplace_back(radius * std::cos(angle), flatness * radius * std::sin(angle));
  }
  return section;
}

/// A polygon of 40 to 250 sides on a circle or an ellipse of some millimetres about the origin.
inline Section round_section(std::mt19937& bits) {
  const int n = 40 + below(bits, 211);
  const double radius = 0.002 + 0.006 * fraction(bits), flatness = below(bits, 2) == 0 ? 1 : 0.6 + 0.4 * fraction(bits);
  Section section;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    section.emplace_back(radius * std::cos(angle), flatness * radius * std::sin(angle));
  }
  return section;
}

/// The polygon whose sides lie a distance outside those of another [m]; negative for inside.
inline Section parallel(const Section& section, double distance) {
  const std::size_t n = section.size();
  const auto normal_of = [&](std::size_t i) {
    const Eigen::Vector2d side = (section[(i + 1) % n] - section[i]).normalized();
    return Eigen::Vector2d(side.y(), -side.x());
  };
  Section moved;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d before = normal_of((i + n - 1) % n), after = normal_of(i);
    moved.push_back(section[i] + distance / (1 + before.dot(after)) * (before + after));
  }
  return moved;
}

}  // namespace feeler::laws
