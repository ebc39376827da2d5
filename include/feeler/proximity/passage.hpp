// How far a moving tool passes one triangle for certain.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/clearance.hpp"
#include "feeler/proximity/highest_corner.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/proximity/separation.hpp"

namespace feeler {

/// Result of `pass`: free of collision on [0, time]; `is_blocked` where that is not the whole motion.
template <class Scalar>
struct Passage {
  Scalar time = Scalar(1);
  bool is_blocked = false;
  Vector3<Scalar> normal = Vector3<Scalar>::Zero();  ///< world normal of a plane that holds at both ends, or zero
  WitnessFeatures features;                          ///< of the last query, or those given
  bool turns = false;                                ///< the plane holds where it turns with the tool, as it is at the end
  bool is_cut = false;                               ///< the work limit was reached: it may be free for longer
  Scalar slack = std::numeric_limits<Scalar>::infinity();  ///< separation at the end, where that was measured [m]
};

/// A triangle as the tool passes it.
template <class Scalar>
struct PassedTriangle {
  Matrix3<Scalar> corners;                           ///< relative to `MovingTool::origin()` [m]
  Vector3<Scalar> normal = Vector3<Scalar>::Zero();  ///< a plane known to separate at the start, or zero
  WitnessFeatures features;                          ///< of an earlier query, or empty
  bool is_exact = false;  ///< find the time of contact to `Clearance::resolution`, not to a sixteenth of the motion
  Vector3<Scalar> last_normal = Vector3<Scalar>::Zero();  ///< of a plane likely to separate at the end, or zero
};

namespace detail {

/// The planes of one triangle at one time: a normal with the slack it has there.
template <class Scalar>
struct HeldPlane {
  Vector3<Scalar> normal;
  Scalar slack;
};

/// Part of a motion over which a plane certainly holds; 1 for all of it.
template <class Scalar>
struct HeldPart {
  Scalar part;
  bool turns;  ///< with the tool
};

/// Part of [from, to] over which one plane certainly holds, fixed to the world or to the tool, whichever is more.
/// `plane` is given at the frame `at`, which is one end; `required` is subtracted from its slack.
template <ConvexTool Tool>
FEELER_FLATTEN HeldPart<typename Tool::Scalar> held_part(const MovingTool<Tool>& moving, const Matrix3<typename Tool::Scalar>& corners,
                                                         const HeldPlane<typename Tool::Scalar>& plane, const MotionFrame<typename Tool::Scalar>& at,
                                                         const MotionFrame<typename Tool::Scalar>& other, typename Tool::Scalar required,
                                                         bool at_is_start) noexcept {
  using Scalar = typename Tool::Scalar;
  using std::sqrt;
  const Scalar duration = other.time - at.time;
  const Scalar here = plane.slack - required;
  // Fixed to the tool: the tool's height does not change, the triangle's does.
  const Vector3<Scalar> turned = other.rotation * (at.rotation.transpose() * plane.normal);
  const Scalar height = plane.slack + highest_corner(corners, plane.normal) - plane.normal.dot(at.shift);
  const Scalar there_tool = height + turned.dot(other.shift) - highest_corner(corners, turned) - required;
  const Scalar reach = sqrt((std::max)((corners.colwise() - at.shift).colwise().squaredNorm().maxCoeff(),
                                       (corners.colwise() - other.shift).colwise().squaredNorm().maxCoeff()));
  const Scalar sagitta_tool = moving.sagitta_of_object(plane.normal, duration, reach);
  const Scalar part_tool = at_is_start ? first_root(here, there_tool, sagitta_tool) : first_root(there_tool, here, sagitta_tool);
  if (!(part_tool < Scalar(1))) return {Scalar(1), true};
  // Fixed to the world.
  const Scalar there = moving.lowest(plane.normal, other) - highest_corner(corners, plane.normal) - required;
  const Scalar sagitta = moving.sagitta(plane.normal, duration);
  const Scalar part_world = at_is_start ? first_root(here, there, sagitta) : first_root(there, here, sagitta);
  return {(std::max)(part_tool, part_world), part_world < part_tool};
}

}  // namespace detail

namespace detail {

/// Whether a plane that turns from one normal to another certainly holds over [start, end].
///
/// Edges that roll over each other turn their common normal, and no fixed plane follows. With n(t) = (1−t)n₀ + t n₁ and chords for the
/// tool points, n(t)·(x(t) − y) is a quadratic in Bernstein form with the coefficients b₀ = n₀·(x₀ − y), b₁ = ½(n₀·(x₁ − y) + n₁·(x₀ − y))
/// and b₂ = n₁·(x₁ − y); each has its minimum over the tool at one support point. Less the sagitta g of the chords, 4g t(1 − t), it
/// stays positive where b₁ − 2g > −√(b₀b₂).
template <ConvexTool Tool>
FEELER_FLATTEN bool turning_plane_holds(const MovingTool<Tool>& moving, const Matrix3<typename Tool::Scalar>& corners,
                                        const HeldPlane<typename Tool::Scalar>& first, const MotionFrame<typename Tool::Scalar>& start,
                                        const HeldPlane<typename Tool::Scalar>& last, const MotionFrame<typename Tool::Scalar>& end,
                                        typename Tool::Scalar required) noexcept {
  using Scalar = typename Tool::Scalar;
  using std::sqrt;
  const Scalar b0 = first.slack - required;
  const Scalar b2 = last.slack - required;
  if (!(b0 >= Scalar(0)) || !(b2 >= Scalar(0))) return false;
  const Vector3<Scalar> across = end.rotation.transpose() * first.normal + start.rotation.transpose() * last.normal;
  const Scalar lowest = moving.lowest_in_tool(across) + first.normal.dot(end.shift) + last.normal.dot(start.shift);
  Scalar b1 = (lowest - highest_corner<Scalar>(corners, first.normal + last.normal)) / 2 - required;
  // For a ball of radius r, r|n(t)| is subtracted, and |n(t)| ≤ 1 − (1 − n₀·n₁) t (1 − t), whose coefficients are 1, ½(1 + n₀·n₁) and 1.
  if constexpr (SweptTool<Tool>) b1 -= swept_radius(moving.tool()) * (Scalar(1) + first.normal.dot(last.normal)) / 2;
  const Scalar duration = end.time - start.time;
  const Scalar sagitta = (std::max)(moving.sagitta(first.normal, duration), moving.sagitta(last.normal, duration));
  return b1 - 2 * sagitta >= -sqrt(b0 * b2);
}

}  // namespace detail

/// Certifies the motion past one triangle up to `end.time`, or up to where it may be blocked.
///
/// A plane that separates at both ends of a part of the motion, less its sagitta, separates in between; so does a plane that turns from
/// one separating normal to another. From the start the motion advances by such parts until the end, or until parts get shorter
/// than the resolution; turning planes are looked for by bisection. A normal that is likely to separate at the
/// end is tried before the triangle is measured there.
/// @param work    grows by one for each distance query
/// @param enough  of a triangle that is in the way at the end it is enough to know that it does not block before this time
/// @param limit   value of `work` at which it ends with what it has: some queries more at most
/// @cost  0 queries for a plane that holds, 1 to 4 as a rule, at most 27
template <ConvexTool Tool>
FEELER_FLATTEN Passage<typename Tool::Scalar> pass(const MovingTool<Tool>& moving, const PassedTriangle<typename Tool::Scalar>& triangle,
                                                   const MotionFrame<typename Tool::Scalar>& start, const MotionFrame<typename Tool::Scalar>& end,
                                                   const Clearance<typename Tool::Scalar>& clearance, int& work,
                                                   typename Tool::Scalar enough = std::numeric_limits<typename Tool::Scalar>::infinity(),
                                                   int limit = (std::numeric_limits<int>::max)()) noexcept {
  using Scalar = typename Tool::Scalar;
  using Plane = detail::HeldPlane<Scalar>;
  const Matrix3<Scalar>& corners = triangle.corners;
  WitnessFeatures warm = triangle.features;
  // Where shapes overlap only the sign matters, unless they touched from the start: then the least overlap decides.
  const auto query = [&](const MotionFrame<Scalar>& frame, bool touches) {
    ++work;
    const Matrix3<Scalar> in_tool = moving.in_tool(corners, frame);
    auto closest = gjk(moving.tool(), in_tool, warm, clearance.touching);
    warm = closest.features;
    if (closest.is_touching) {
      // The core of a swept tool touches nothing before the tool is in it by the radius.
      if (SweptTool<Tool> || !touches) return Plane{Vector3<Scalar>::Zero(), -std::numeric_limits<Scalar>::infinity()};
      if constexpr (!SweptTool<Tool>) closest = separation_of_touching(moving.tool(), in_tool, closest, clearance.allowance);
    }
    return Plane{frame.rotation * closest.normal, closest.distance};
  };
  const auto slack_at = [&](const Vector3<Scalar>& normal, const MotionFrame<Scalar>& frame) {
    return moving.lowest(normal, frame) - highest_corner(corners, normal);
  };
  const bool is_known = triangle.normal.squaredNorm() > Scalar(0);
  Plane plane{triangle.normal, is_known ? slack_at(triangle.normal, start) : Scalar(0)};
  bool touches = is_known && plane.slack < 2 * clearance.touching;
  Scalar part_from_start(0);  // over which a known plane holds
  if (is_known) {
    part_from_start = detail::held_part(moving, corners, plane, start, end, clearance.required(plane.slack), true).part;
    if (!(part_from_start < Scalar(1))) return {end.time, false, plane.normal, warm};
  }
  if (is_known && triangle.last_normal.squaredNorm() > Scalar(0)) {
    const Plane guess{triangle.last_normal, slack_at(triangle.last_normal, end)};
    if (detail::turning_plane_holds(moving, corners, plane, start, guess, end, clearance.required(plane.slack)))
      return {end.time, false, guess.normal, warm};
  }
  Plane last = query(end, touches);
  if (last.slack > -std::numeric_limits<Scalar>::infinity()) {
    const Scalar known = (std::max)(slack_at(last.normal, start), is_known ? plane.slack : Scalar(0));
    const Scalar required = clearance.required((std::max)(known, Scalar(0)));
    const auto held = detail::held_part(moving, corners, last, end, start, required, false);
    if (!(held.part < Scalar(1))) return {end.time, false, last.normal, warm, held.turns, false, last.slack};
  }
  if (!is_known) {
    plane = query(start, true);
    touches = plane.slack < 2 * clearance.touching;
    if (touches) last = query(end, true);
  }
  const Scalar required = clearance.required(plane.slack);
  if (detail::turning_plane_holds(moving, corners, plane, start, last, end, required))
    return {end.time, false, last.normal, warm, false, false, last.slack};
  const Scalar length = moving.length() * end.time;
  const Scalar resolution = triangle.is_exact ? clearance.resolution : (std::max)(clearance.resolution, length / 16);
  const int maximum_steps = triangle.is_exact ? 24 : 10;
  MotionFrame<Scalar> frame = start;
  Scalar beyond = end.time;  // to where no turning plane is known to hold
  bool rolls = false;
  const auto is_late = [&](Scalar time) { return last.slack < required && 4 * (enough - time) * moving.length() <= resolution; };
  bool is_cut = false;
  for (int step = 0; step < maximum_steps; ++step) {
    is_cut = work >= limit;
    if (is_cut) break;
    const Scalar whole = end.time - frame.time;
    const bool is_found = is_known && step == 0;
    Scalar advance = whole * (is_found ? part_from_start : detail::held_part(moving, corners, plane, frame, end, required, true).part);
    if (advance < whole && 3 * advance < whole) {
      // A sagitta falls with the square of the duration: over a shorter part the same plane holds for longer.
      const Scalar shorter = (std::max)(3 * advance, whole / 8);
      const MotionFrame<Scalar> near_end = moving.frame_at(frame.time + shorter);
      advance = (std::max)(advance, shorter * detail::held_part(moving, corners, plane, frame, near_end, required, true).part);
    }
    if (!(advance < whole)) return {end.time, false, last.normal, warm, false, false, last.slack};
    const Scalar half = (beyond - frame.time) / 2;
    if (rolls && half > advance && half * moving.length() >= resolution) {
      const MotionFrame<Scalar> middle = moving.frame_at(frame.time + half);
      const Plane next = query(middle, touches);
      if (!detail::turning_plane_holds(moving, corners, plane, frame, next, middle, required)) {
        beyond = middle.time;
        continue;
      }
      frame = middle;
      plane = next;
    } else {
      const bool is_short = advance * moving.length() < resolution;
      frame = moving.frame_at(frame.time + advance);
      if (is_short || is_late(frame.time)) break;
      const Plane next = query(frame, true);
      // The plane gave out, yet the shapes are as far apart: it turns, and a fixed one would follow in tiny steps.
      rolls = triangle.is_exact && 2 * (next.slack - required) > plane.slack - required;
      plane = next;
    }
    if (detail::turning_plane_holds(moving, corners, plane, frame, last, end, required))
      return {end.time, false, last.normal, warm, false, false, last.slack};
  }
  return {.time = frame.time, .is_blocked = true, .normal = plane.normal, .features = warm, .is_cut = is_cut};
}

}  // namespace feeler
