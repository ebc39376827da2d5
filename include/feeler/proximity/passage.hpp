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

/// How much of a motion a plane certainly holds for; 1 for all of it.
template <class Scalar>
struct HeldFraction {
  Scalar fraction;
  bool turns;  ///< with the tool
};

/// How much of [from, to] one plane certainly holds for, fixed to the world or to the tool, whichever is more.
/// `plane` is given at the frame `at`, which is one end; `required` is subtracted from its slack.
template <ConvexTool Tool>
FEELER_FLATTEN HeldFraction<typename Tool::Scalar> held_fraction(const MovingTool<Tool>& moving, const Matrix3<typename Tool::Scalar>& corners,
                                                                 const HeldPlane<typename Tool::Scalar>& plane,
                                                                 const MotionFrame<typename Tool::Scalar>& at,
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
  const Scalar fraction_with_tool = at_is_start ? first_root(here, there_tool, sagitta_tool) : first_root(there_tool, here, sagitta_tool);
  if (!(fraction_with_tool < Scalar(1))) return {Scalar(1), true};
  // Fixed to the world.
  const Scalar there = moving.lowest(plane.normal, other) - highest_corner(corners, plane.normal) - required;
  const Scalar sagitta = moving.sagitta(plane.normal, duration);
  const Scalar fraction_in_world = at_is_start ? first_root(here, there, sagitta) : first_root(there, here, sagitta);
  return {(std::max)(fraction_with_tool, fraction_in_world), fraction_in_world < fraction_with_tool};
}

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

/// One triangle that a tool moves past, step by step as `pass` describes it.
template <ConvexTool Tool>
class TrianglePassage {
 public:
  using Scalar = typename Tool::Scalar;
  using Plane = HeldPlane<Scalar>;
  using Frame = MotionFrame<Scalar>;
  using Result = Passage<Scalar>;

  /// @param work  grows by one for each distance query; it and all else is kept by reference
  TrianglePassage(const MovingTool<Tool>& moving, const PassedTriangle<Scalar>& triangle, const Frame& start, const Frame& end,
                  const Clearance<Scalar>& clearance, int& work) noexcept
      : moving_(moving),
        triangle_(triangle),
        start_(start),
        end_(end),
        clearance_(clearance),
        work_(work),
        warm_(triangle.features),
        is_known_(triangle.normal.squaredNorm() > Scalar(0)) {}

  /// @param enough, limit  as of `pass`
  Result certify(Scalar enough, int limit) noexcept {
    plane_ = {triangle_.normal, is_known_ ? slack_at(triangle_.normal, start_) : Scalar(0)};
    if (is_known_) {
      touches_ = plane_.slack < 2 * clearance_.touching;
      required_ = clearance_.required(plane_.slack);
      fraction_from_start_ = fraction_held(start_, end_);
      if (!(fraction_from_start_ < Scalar(1))) return free_by(plane_.normal);
      if (turns_to_guess()) return free_by(triangle_.last_normal);
    }
    last_ = query(end_, touches_);
    if (const auto held = held_back_from_end(); !(held.fraction < Scalar(1))) return free_by_last(held.turns);
    if (!is_known_) measure_start();
    if (turns_to(last_, start_, end_)) return free_by_last();
    return advance(enough, limit);
  }

 private:
  /// A plane between the closest points. Where shapes overlap only the sign of its slack matters, unless they touched from the start: then the
  /// least overlap decides.
  Plane query(const Frame& frame, bool touches) noexcept {
    ++work_;
    const Matrix3<Scalar> in_tool = moving_.in_tool(triangle_.corners, frame);
    auto closest = gjk(moving_.tool(), in_tool, warm_, clearance_.touching);
    warm_ = closest.features;
    if (closest.is_touching) {
      // The core of a swept tool touches nothing before the tool is in it by the radius.
      if (SweptTool<Tool> || !touches) return {Vector3<Scalar>::Zero(), -std::numeric_limits<Scalar>::infinity()};
      if constexpr (!SweptTool<Tool>) closest = separation_of_touching(moving_.tool(), in_tool, closest, clearance_.allowance);
    }
    return {frame.rotation * closest.normal, closest.distance};
  }
  Scalar slack_at(const Vector3<Scalar>& normal, const Frame& frame) const noexcept {
    return moving_.lowest(normal, frame) - highest_corner(triangle_.corners, normal);
  }

  /// Of the way from one time to another, how much the plane at hand certainly holds for.
  Scalar fraction_held(const Frame& from, const Frame& to) const noexcept {
    return held_fraction(moving_, triangle_.corners, plane_, from, to, required_, true).fraction;
  }
  /// Whether a plane that turns from that at hand to another certainly holds.
  bool turns_to(const Plane& other, const Frame& from, const Frame& to) const noexcept {
    return turning_plane_holds(moving_, triangle_.corners, plane_, from, other, to, required_);
  }
  bool turns_to_guess() const noexcept {
    return triangle_.last_normal.squaredNorm() > Scalar(0) && turns_to({triangle_.last_normal, slack_at(triangle_.last_normal, end_)}, start_, end_);
  }

  /// How much of the motion, seen from the end, the plane measured there certainly holds for.
  HeldFraction<Scalar> held_back_from_end() const noexcept {
    if (!(last_.slack > -std::numeric_limits<Scalar>::infinity())) return {Scalar(0), false};
    const Scalar known = (std::max)(slack_at(last_.normal, start_), is_known_ ? plane_.slack : Scalar(0));
    const Scalar required = clearance_.required((std::max)(known, Scalar(0)));
    return held_fraction(moving_, triangle_.corners, last_, end_, start_, required, false);
  }
  /// Finds the plane at the start where none is known, and that at the end once more where the shapes touch from there.
  void measure_start() noexcept {
    plane_ = query(start_, true);
    touches_ = plane_.slack < 2 * clearance_.touching;
    if (touches_) last_ = query(end_, true);
    required_ = clearance_.required(plane_.slack);
  }

  /// Conservative advancement: by parts that a plane certainly holds for, or turns over, until it turns to that at the end, or parts are too short.
  Result advance(Scalar enough, int limit) noexcept {
    const int maximum_steps = triangle_.is_exact ? 24 : 10;
    resolution_ = triangle_.is_exact ? clearance_.resolution : (std::max)(clearance_.resolution, moving_.length() * end_.time / 16);
    beyond_ = end_.time;
    Frame frame = start_;
    bool is_cut = false;
    for (int step = 0; step < maximum_steps; ++step) {
      is_cut = work_ >= limit;
      if (is_cut) break;
      const Scalar whole = end_.time - frame.time;
      const Scalar certain = certain_time(frame, whole * (is_known_ && step == 0 ? fraction_from_start_ : fraction_held(frame, end_)));
      if (!(certain < whole)) return free_by_last();
      const Scalar half = (beyond_ - frame.time) / 2;
      if (rolls_ && half > certain && half * moving_.length() >= resolution_) {
        if (!roll(frame, half)) continue;
      } else {
        if (!move(frame, certain, enough)) break;
      }
      if (turns_to(last_, frame, end_)) return free_by_last();
    }
    return {.time = frame.time, .is_blocked = true, .normal = plane_.normal, .features = warm_, .is_cut = is_cut};
  }
  /// For how long the plane at hand certainly holds.
  /// @param time  that it holds for as is known from the whole way to the end
  Scalar certain_time(const Frame& frame, Scalar time) const noexcept {
    const Scalar whole = end_.time - frame.time;
    if (!(time < whole && 3 * time < whole)) return time;
    // A sagitta falls with the square of the duration: over a shorter part the same plane holds for longer.
    const Scalar shorter = (std::max)(3 * time, whole / 8);
    return (std::max)(time, shorter * fraction_held(frame, moving_.frame_at(frame.time + shorter)));
  }
  /// Moves on by half of what is left, if a plane certainly turns so far; if not, less is left.
  bool roll(Frame& frame, Scalar half) noexcept {
    const Frame middle = moving_.frame_at(frame.time + half);
    const Plane next = query(middle, touches_);
    if (!turns_to(next, frame, middle)) {
      beyond_ = middle.time;
      return false;
    }
    frame = middle;
    plane_ = next;
    return true;
  }
  /// Moves on for as long as the plane at hand certainly holds, and finds another there; false where that is no use any more.
  bool move(Frame& frame, Scalar time, Scalar enough) noexcept {
    const bool is_short = time * moving_.length() < resolution_;
    frame = moving_.frame_at(frame.time + time);
    if (is_short || is_late(frame.time, enough)) return false;
    const Plane next = query(frame, true);
    // The plane gave out, yet the shapes are as far apart: it turns, and a fixed one would follow in tiny steps.
    rolls_ = triangle_.is_exact && 2 * (next.slack - required_) > plane_.slack - required_;
    plane_ = next;
    return true;
  }
  /// Whether a triangle that is in the way at the end is known not to block before it need be.
  bool is_late(Scalar time, Scalar enough) const noexcept { return last_.slack < required_ && 4 * (enough - time) * moving_.length() <= resolution_; }

  Result free_by(const Vector3<Scalar>& normal) const noexcept { return {.time = end_.time, .normal = normal, .features = warm_}; }
  Result free_by_last(bool turns = false) const noexcept { return {.time = end_.time, .normal = last_.normal, .features = warm_, .turns = turns}; }

  const MovingTool<Tool>& moving_;
  const PassedTriangle<Scalar>& triangle_;
  const Frame &start_, &end_;
  const Clearance<Scalar>& clearance_;
  int& work_;
  WitnessFeatures warm_;  // of the last query
  bool is_known_;  // a plane that separates at the start, from before
  bool touches_ = false;  // at the start
  bool rolls_ = false;  // edge over edge, so that planes turn
  Plane plane_, last_;  // at hand, which separates at the time reached; at the end
  Scalar required_ = Scalar(0);  // of the slack at the start [m]
  Scalar fraction_from_start_ = Scalar(0);  // that a known plane holds for
  Scalar resolution_ = Scalar(0);  // [m]
  Scalar beyond_ = Scalar(0);  // the time from which no turning plane is known to hold
};

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
  return detail::TrianglePassage<Tool>(moving, triangle, start, end, clearance, work).certify(enough, limit);
}

}  // namespace feeler
