// Tools and triangles for random tests of proximity and contact.
#pragma once

#include <random>

#include "feeler/core/scalar.hpp"
#include "feeler/tool/box.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/segment.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/random_geometry.hpp"
#include "support/wide_distance.hpp"

namespace feeler_test {

using Vector = Eigen::Vector3d;

inline feeler::Box<double> random_box(std::mt19937& bits) {
  const double x = magnitude(bits, -2, -1), y = magnitude(bits, -2, -1), z = magnitude(bits, -2, -1);
  return feeler::Box<double>(Vector(x, y, z));
}
inline feeler::Segment<double> random_segment(std::mt19937& bits) {
  return feeler::Segment<double>(0.1 * random_vector(bits), 0.1 * random_vector(bits));
}
/// A hull of `count` points on an ellipsoid of about 0.1 m.
inline feeler::ConvexPolytope<double> random_hull(std::mt19937& bits, int count) {
  feeler::Points<double> points(count, 3);
  const Vector radii(0.1, magnitude(bits, -2, -1), magnitude(bits, -1.5, -1));
  for (int i = 0; i < count; ++i) points.row(i) = random_direction(bits).cwiseProduct(radii).transpose();
  return feeler::ConvexPolytope<double>::hull_of(points);
}

/// A tool of any of these swept by a ball of 1 to 50 mm.
template <class Core>
feeler::SphereSwept<Core> swept(std::mt19937& bits, const Core& core) {
  return {core, magnitude(bits, -3, -1.3)};
}
inline feeler::Sphere<double> random_sphere(std::mt19937& bits) { return swept(bits, feeler::Point<double>(0.1 * random_vector(bits))); }
inline feeler::Capsule<double> random_capsule(std::mt19937& bits) { return swept(bits, random_segment(bits)); }
inline feeler::RoundedBox<double> random_rounded_box(std::mt19937& bits) { return swept(bits, random_box(bits)); }

enum class Shape { ordinary, small, large, sliver, needle, segment, point };

/// A triangle about the origin; the last two shapes are degenerate.
inline Eigen::Matrix3d random_triangle(std::mt19937& bits, Shape shape) {
  Eigen::Matrix3d corners;
  const double size = shape == Shape::small ? 1e-3 : shape == Shape::large ? 3 : 0.1;
  for (int k = 0; k < 3; ++k) corners.col(k) = size * random_vector(bits);
  const Vector edge = corners.col(1) - corners.col(0);
  if (shape == Shape::sliver) corners.col(2) = corners.col(0) + fraction(bits) * edge + magnitude(bits, -13, -5) * random_vector(bits);
  if (shape == Shape::needle) corners.col(2) = corners.col(1) + magnitude(bits, -13, -5) * random_vector(bits);
  if (shape == Shape::segment) corners.col(2) = below(bits, 2) == 0 ? corners.col(1) : Vector(corners.col(0) + edge / 2);
  if (shape == Shape::point) corners.col(2) = corners.col(1) = corners.col(0);
  return corners;
}
inline Shape random_shape(std::mt19937& bits) { return below(bits, 2) == 0 ? Shape::ordinary : Shape(below(bits, 7)); }

inline feeler::test::WideTriangle wide(const Eigen::Matrix3d& corners) {
  using feeler::test::WideReal;
  return {corners.col(0).cast<WideReal>(), corners.col(1).cast<WideReal>(), corners.col(2).cast<WideReal>()};
}

/// The triangle moved along the shortest way to the tool until it is `gap` away; both shapes in the tool
/// frame.
template <class Tool>
Eigen::Matrix3d at_gap(const Tool& tool, const Eigen::Matrix3d& corners, double gap) {
  const feeler::test::WideTool wide_tool(tool);
  const auto closest = feeler::test::closest_features(wide_tool, wide(corners));
  const Vector normal = ((closest.on_first - closest.on_second) / closest.distance).cast<double>();
  return corners.colwise() + normal * (double(closest.distance - wide_tool.radius) - gap);
}

/// A triangle `gap` away from the tool, to rounding; in the tool frame.
template <class Tool>
Eigen::Matrix3d triangle_near(const Tool& tool, std::mt19937& bits, Shape shape, double gap) {
  for (;;) {
    const Eigen::Matrix3d corners = random_triangle(bits, shape).colwise() + 0.2 * random_vector(bits);
    if (feeler::test::intersect(feeler::test::WideTool(tool), wide(corners))) continue;
    return at_gap(tool, corners, gap);
  }
}

}  // namespace feeler_test
