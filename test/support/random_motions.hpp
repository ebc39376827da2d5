// Random motions of a tool, for the library and, in long double, for what judges it.
#pragma once

#include <cmath>
#include <random>

#include "feeler/proximity/motion.hpp"
#include "support/random_tools.hpp"
#include "support/wide_distance.hpp"

namespace feeler_test {

/// A tool, where it is and where it goes: translations to 0.3 m, turns to π about a reference point of its
/// own.
template <class Tool>
struct RandomMotion {
  RandomMotion(std::mt19937& bits, const Tool& moved_tool, double offset = 0)
      : tool(moved_tool),
        reference(below(bits, 2) == 0 ? Vector(Vector::Zero()) : Vector(0.1 * random_vector(bits))),
        radius(feeler::radius_about(tool, reference)) {
    pose.translation = offset * random_vector(bits) + 0.1 * random_vector(bits);
    pose.rotation = random_rotation(bits);
    const int kind = below(bits, 6);
    motion.linear = kind == 0 ? Vector(Vector::Zero()) : Vector(magnitude(bits, -6, -0.5) * random_direction(bits));
    motion.angular = kind == 1   ? Vector(Vector::Zero())
                     : kind == 2 ? Vector(3.14159 * random_direction(bits))
                                 : Vector(magnitude(bits, -5, 0.4) * random_direction(bits));
  }

  feeler::MovingTool<Tool> moving() const { return {tool, reference, radius, pose, motion}; }
  feeler::test::WideMotion wide() const {
    using feeler::test::WideReal;
    return {reference.cast<WideReal>(), pose.translation.cast<WideReal>(), motion.linear.cast<WideReal>(), motion.angular.cast<WideReal>(),
            pose.rotation.cast<WideReal>()};
  }

  Tool tool;
  Vector reference;
  double radius;
  feeler::Pose<double> pose;
  feeler::Twist<double> motion;
};

}  // namespace feeler_test
