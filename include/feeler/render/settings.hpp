// Everything a user can choose about the renderer at run time.
#pragma once

#include <optional>

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/wrench.hpp"

namespace feeler {

/// Settings of a `HapticRenderer`; every field has a default that fits a tool of millimetres to decimetres.
template <RealScalar ScalarType>
struct Settings {
  using Scalar = ScalarType;

  /// Point of the tool, in the tool frame [m], about which rotations are measured and torques are given. Put it where the hand
  /// holds the tool: the same metric about another point is another problem with another solution.
  Vector3<Scalar> reference_point = Vector3<Scalar>::Zero();

  /// K of the paper's eq. 4 [N/m, N·m/rad]. Take it from the device: more than it can render makes it buzz. A zero, where no force or torque
  /// is to be felt, needs a `metric`: nothing else would draw the tool to the hand there.
  Stiffness<Scalar> stiffness = {};

  /// M of the paper's eq. 3, along the same axes as K: those of the poses, or those that `update` is given. Unset, it is proportional to K, and the
  /// wrench is the exact sum of the contact forces; another metric bends the wrench out of the contact cone.
  std::optional<Metric<Scalar>> metric = {};
  Metric<Scalar> metric_in_use() const noexcept { return metric ? metric->normalized() : Metric<Scalar>::proportional_to(stiffness); }

  /// Distance kept between tool and object [m]. It smooths the edges of the obstacle: less is more exact and needs more iterations; below 1e-8
  /// convergence is lost, above 1e-5 it can be felt. Tighter fits than twice the margin are still rendered. Less than 1e-10 is refused, and more than
  /// 1e-3. With poses of `float` it is not less than ten times their rounding, which exceeds the default where the object reaches a metre from the
  /// origin.
  Scalar margin = Scalar(1e-6);

  /// Whether what a closed surface of the object encloses is solid, so that `reset` refuses a tool inside. False for a room whose normals point
  /// outwards; where they point inwards it is free anyway (`MeshInterior`). Ticks do not ask: all triangles are obstacles from both sides.
  bool closed_means_solid = true;

  /// Longest motion of any tool point between two linearisations in contact [m]; up to eight times as long where nothing has stopped a few
  /// such motions. More follows a fast hand with fewer iterations, and
  /// makes one bad linearisation cost more. 1e-6 to 1.
  Scalar trust_radius = Scalar(4e-4);

  /// A step may end a tick as converged if it moves no tool point farther than a fiftieth of this; or than this, where steps shrink so fast that the
  /// next one would be as short as that [m]. 1e-12 to 1e-3.
  Scalar step_tolerance = Scalar(5e-6);

  /// Iterations a tick, at most 32: each finds a motion, by up to four linearisations, and certifies it. When they are spent the rest of the motion
  /// is left for the next ticks.
  int maximum_iterations = 12;

  /// Work a tick, in units of one distance query between the tool and a triangle, or one optimisation (with all that goes with it, 0.7 to 1 µs for
  /// 32 vertices). A tick ends within a fifth more than it, on the certified pose that it has, and the next tick goes on where it stopped. A smaller
  /// budget makes the worst tick shorter, and the tool later where the solution jumps, or where a fit all around it takes some ticks to examine. 1 to
  /// 1e8; with less than 20 a tool may not come to rest.
  int work_budget = 128;
};

}  // namespace feeler
