// What tests of the renderer share: scenes run tick by tick, and the checker along the way of every tick.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "feeler/feeler.hpp"
#include "scenes/renderers.hpp"
#include "scenes/round_renderers.hpp"
#include "scenes/scene.hpp"
#include "support/penetration_checker.hpp"
#include "support/sanitized.hpp"

namespace feeler::test {

/// Whether a motion has the ticks to get where it should: what it must meet on its way is not asked of a part of it.
constexpr bool runs_all_ticks = FEELER_TEST_SANITIZED == 0;

/// Depth that counts as touching: the rounding of the checker.
constexpr double touching_depth = 1e-17;
/// Depth that rounding may leave where there is no clearance at all [m].
constexpr double no_clearance_depth = 1e-11;

/// Error of a pose against another: translation [m] and angle [rad].
struct PoseError {
  double distance = 0;
  double angle = 0;
  /// Bound on the displacement of a tool point at a radius [m].
  double at(double radius) const { return distance + radius * angle; }
};

inline WideVector rotation_vector(const Eigen::Quaternion<WideReal>& rotation) {
  Eigen::Quaternion<WideReal> q = rotation.normalized();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const WideReal sine = q.vec().norm();
  return sine > 0 ? WideVector(2 * std::atan2(sine, q.w()) / sine * q.vec()) : WideVector(WideVector::Zero());
}

inline Eigen::Quaternion<WideReal> rotation_by(const WideVector& v) {
  const WideReal angle = v.norm();
  if (!(angle > 0)) return Eigen::Quaternion<WideReal>::Identity();
  return Eigen::Quaternion<WideReal>(Eigen::AngleAxis<WideReal>(angle, v / angle));
}

/// e = (p − p₀, Log(R R₀ᵀ)) in wider arithmetic.
struct WideTwist {
  WideVector linear, angular;
};

template <class PoseA, class PoseB>
WideTwist twist_between(const PoseA& from, const PoseB& to) {
  const CheckedPose a = checked_pose(from), b = checked_pose(to);
  return {b.translation - a.translation, rotation_vector(b.rotation * a.rotation.conjugate())};
}

template <class PoseA, class PoseB>
PoseError pose_error(const PoseA& a, const PoseB& b) {
  const WideTwist e = twist_between(a, b);
  return {static_cast<double>(e.linear.norm()), static_cast<double>(e.angular.norm())};
}

/// ½ |p − p_h|² + ½ L² |φ|² [m²].
template <class PoseA, class PoseB>
WideReal energy_of(const PoseA& graphic, const PoseB& haptic, WideReal length) {
  const WideTwist e = twist_between(haptic, graphic);
  return (e.linear.squaredNorm() + length * length * e.angular.squaredNorm()) / 2;
}

template <class Pose>
bool is_same(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

/// Whether a tick kept its budget of 20 or more: a fifth more work than that, and two units, is the most.
inline bool keeps_budget(int work, int budget) { return 5 * (work - 2) <= 6 * budget; }

/// Whether every number of a tick is finite, its quaternion unit, and its lists within bounds.
template <class Scalar>
bool is_valid(const Tick<Scalar>& tick, int triangle_count) {
  const Scalar unit_tolerance = 8 * std::numeric_limits<Scalar>::epsilon();
  const auto is_unit = [&](const auto& coefficients) { return std::abs(coefficients.norm() - Scalar(1)) <= unit_tolerance; };
  bool valid = tick.graphic_pose.translation.allFinite() && is_unit(tick.graphic_pose.rotation.coeffs()) && tick.wrench.force.allFinite() &&
               tick.wrench.torque.allFinite();
  for (const auto& contact : tick.contacts) {
    valid = valid && contact.triangle >= 0 && contact.triangle < triangle_count && contact.point_world.allFinite() && is_unit(contact.normal_world) &&
            std::isfinite(contact.gap) && contact.force >= Scalar(0) && std::isfinite(contact.force);
  }
  for (const auto& pose : tick.path) valid = valid && pose.translation.allFinite() && is_unit(pose.rotation.coeffs());
  return valid && (tick.path.empty() || is_same(tick.path.back(), tick.graphic_pose));
}

/// An object and a tool as the checker sees them.
struct Witness {
  CheckedObject object;
  CheckedTool tool;

  template <class Tool>
  Witness(const Points<double>& vertices, const Triangles& triangles, const Tool& tool_shape)
      : object(vertices, triangles), tool(checked_tool(tool_shape)) {}

  template <class Pose>
  double depth_at(const Pose& pose) const {
    return static_cast<double>(deepest_penetration(object, tool, checked_pose(pose)).depth);
  }

  /// Deepest penetration along the way of a tick that began at a pose; only for a reference point at the origin of the tool frame.
  template <class Scalar>
  double depth_on_way(const Pose<Scalar>& from, const Tick<Scalar>& tick, int samples_a_leg) const {
    double deepest = depth_at(tick.graphic_pose);
    CheckedPose last = checked_pose(from);
    for (const auto& pose : tick.path) {
      const CheckedPose next = checked_pose(pose);
      deepest = std::max(deepest, static_cast<double>(deepest_penetration_on_path(object, tool, last, next, samples_a_leg).depth));
      last = next;
    }
    return deepest;
  }
};

/// Calls a function with the tool of a scene in its own type.
template <class Function>
decltype(auto) with_tool_of(const scenes::Scene& scene, Function&& function) {
  return std::visit(std::forward<Function>(function), scene.tool);
}

}  // namespace feeler::test
