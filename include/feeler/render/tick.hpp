// The result of one tick of the renderer.
#pragma once

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/status.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/wrench.hpp"

namespace feeler {

/// A contact that holds the tool: one active row of the optimisation, at the graphic pose.
template <RealScalar ScalarType>
struct ActiveContact {
  using Scalar = ScalarType;

  int piece = 0;                                           ///< of the tool; 0 for a convex one
  int triangle = -1;                                       ///< row of `triangles` as given to the mesh
  Vector3<Scalar> point_world = Vector3<Scalar>::Zero();   ///< [m]
  Vector3<Scalar> normal_world = Vector3<Scalar>::Zero();  ///< unit, from the object to the tool
  Scalar gap = Scalar(0);                                  ///< separation along the normal [m], close to the margin
  Scalar force = Scalar(0);  ///< share of the contact force [N]; shares are not unique where faces touch, their sum is
};

/// Result of `HapticRenderer::update`; every field is valid after every status.
template <RealScalar ScalarType>
struct Tick {
  using Scalar = ScalarType;
  static constexpr int contact_capacity = 8;
  static constexpr int path_capacity = 32;

  Pose<Scalar> graphic_pose;
  Wrench<Scalar> wrench;  ///< on the hand, world axes, at the reference point of the haptic pose
  FixedVector<ActiveContact<Scalar>, contact_capacity> contacts;
  TickStatus status = TickStatus::not_reset;

  /// The way from the last graphic pose to this one, which is its last pose, free of collision all along. Between poses the reference point moves on
  /// a straight line and the axes turn at a constant rate, by 3 rad at most and so the shorter way round. Empty when the tool did not move. After
  /// `update_until_converged` it is the way of the last update.
  FixedVector<Pose<Scalar>, path_capacity> path;

  int iterations = 0;  ///< motions looked for, each by up to four linearisations
  int rows = 0;  ///< rows of the last optimisation
  int work = 0;  ///< in the unit of `Settings::work_budget`

  bool converged() const noexcept { return status == TickStatus::converged; }
};

}  // namespace feeler
