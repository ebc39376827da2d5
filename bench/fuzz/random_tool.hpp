// Tools of all shapes, from micrometres to decimetres, many of them flat or slender.
#pragma once

#include <algorithm>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "feeler/feeler.hpp"
#include "fuzz/random_object.hpp"

namespace feeler::fuzz {

inline double random_size(std::mt19937& bits) {
  const double choice = fraction(bits);
  return choice < 0.6 ? magnitude(bits, -2.5, -1.7) : choice < 0.8 ? magnitude(bits, -6, -3) : magnitude(bits, -1.5, -0.5);
}
/// Half sides; of one tool in five one side is thin, of one in seven two.
inline Vector random_extents(std::mt19937& bits) {
  const double size = random_size(bits);
  Vector half(size * magnitude(bits, -1, 0), size * magnitude(bits, -1, 0), size);
  if (below(bits, 5) == 0) half.x() *= 1e-3;
  if (below(bits, 7) == 0) half.head<2>() *= 1e-3;
  return half;
}

inline Box<double> random_box(std::mt19937& bits) { return Box<double>(random_extents(bits)); }
inline Segment<double> random_segment(std::mt19937& bits) {
  const double size = random_size(bits);
  const Vector start = size * random_vector(bits);
  return Segment<double>(start, start + size * random_direction(bits));
}
/// A hull of 4 to 250 points, some of them equal or on a lattice; or a faceted cylinder or cone.
inline ConvexPolytope<double> random_polytope(std::mt19937& bits, const Vector& centre = Vector::Zero()) {
  for (;;) {
    const Vector half = random_extents(bits);
    const int count = 4 + below(bits, below(bits, 3) > 0 ? 20 : 246);
    try {
      if (below(bits, 8) == 0)
        return cylinder<double>(half.x(), half.z(), 3 + below(bits, 60), below(bits, 2) == 0 ? Facets::inscribed : Facets::circumscribed);
      if (below(bits, 8) == 0) return cone<double>(half.x(), half.z(), 3 + below(bits, 120));
      Points<double> points(count, 3);
      const bool is_lattice = below(bits, 3) == 0;
      for (int i = 0; i < count; ++i) {
        Vector direction = random_direction(bits);
        if (is_lattice) direction = (1.5 * direction).array().round();
        points.row(i) = (centre + direction.cwiseProduct(half)).transpose();
        if (i > 3 && below(bits, 10) == 0) points.row(i) = points.row(below(bits, i)).eval();
      }
      return ConvexPolytope<double>::hull_of(points);
    } catch (const std::invalid_argument&) {
      // flat, or too many facets: another one
    }
  }
}
template <class Core>
SphereSwept<Core> random_swept(std::mt19937& bits, const Core& core) {
  return {core, std::max(1e-6, random_size(bits))};
}
inline CompoundTool<ConvexPolytope<double>> random_compound(std::mt19937& bits) {
  std::vector<ConvexPolytope<double>> pieces;
  for (int i = below(bits, below(bits, 3) > 0 ? 5 : 64); i >= 0; --i) pieces.push_back(random_polytope(bits, 0.02 * random_vector(bits)));
  return CompoundTool<ConvexPolytope<double>>(std::move(pieces));
}

}  // namespace feeler::fuzz
