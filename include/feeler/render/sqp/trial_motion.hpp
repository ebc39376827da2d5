// The motion that is tried next: steps of a few linearisations, each where the last one ended.
#pragma once

#include <algorithm>

#include "feeler/qp/qp_solver.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/sqp/linearisation.hpp"
#include "feeler/render/sqp/sqp_step.hpp"
#include "feeler/render/sqp/step_limits.hpp"
#include "feeler/render/sqp/work_budget.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// A motion to be certified.
template <class Scalar>
struct TrialMotion {
  Twist<Scalar> motion;        ///< from the certified pose
  bool is_settled = false;     ///< another linearisation would not change it
  bool is_capped = false;      ///< the trust region cut it
  bool is_free = false;        ///< no contact holds the tool
  bool is_home = false;        ///< and it ends at the haptic pose
  bool is_at_rest = false;     ///< measured where it starts, the tool would stay
  bool is_taken_back = false;  ///< its second step took back the first, and what stopped the two holds the tool
  bool goes_back = false;      ///< with contacts kept from where it starts, its later steps took back most of the first
  Scalar restoration = 0;      ///< energy that it may cost to win the margin back [m²]
};

/// Finds trial motions: a step from the certified pose, and, as that ends where other features are closest, further ones from there (second-order
/// correction). Where the work runs out in a linearisation, it goes on there when it is called again.
template <RigidTool ToolType, QpSolver Solver>
class TrialMotionSearch {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Rows = Linearisation<ToolType, Solver>;

  static constexpr int most_rounds = 4;  // linearisations for one motion

  /// What is farther away cannot stop the next step [m].
  static Scalar reach_of_step(const Scene& scene, const StepLimits<Scalar>& limits) noexcept { return limits.trust() + scene.margin(); }

  explicit TrialMotionSearch(const Scene& scene) : linearisation_(scene) {}

  Rows& linearisation() noexcept { return linearisation_; }
  const Rows& linearisation() const noexcept { return linearisation_; }
  /// Where the motion leads.
  const Pose<Scalar>& aim() const noexcept { return aim_; }
  TrialMotion<Scalar>& motion() noexcept { return motion_; }
  /// Whether the work ran out amid a linearisation, which can go on.
  bool is_measuring() const noexcept { return is_measuring_; }
  /// What is no motion [m]. Where some of the margin is left out the optimiser finds to a thousandth how much, and a tool at rest trembles by as much.
  Scalar no_motion(const Scene& scene) const noexcept {
    return motion_.is_settled && linearisation_.problem().is_relaxed() ? 10 * scene.no_motion() : scene.no_motion();
  }
  /// A triangle can hold the tool at the end of the motion only if it is nearer than this: the margin, less what the last step left out of it. One at
  /// exactly that distance asks for nothing [m].
  Scalar holding_distance(const Scene& scene) const noexcept {
    return (std::max)(scene.noticed() - linearisation_.problem().relaxation(), scene.clearance().none());
  }

  /// @param start  certified
  void begin(const Pose<Scalar>& start, const Pose<Scalar>& aim) noexcept {
    start_ = start;
    aim_ = aim;
    rounds_ = {.pose = start};
    motion_ = {};
    is_measuring_ = false;
  }

  /// False where the work runs out: called again it goes on, where it was measuring.
  /// @param most  linearisations
  bool find(const Scene& scene, int most, const StepLimits<Scalar>& limits, WorkBudget& budget, Tick<MeshScalar>& tick) noexcept {
    for (; rounds_.count < most; ++rounds_.count) {
      if (!linearise(scene, most > 1, reach_of_step(scene, limits), budget, tick)) return false;
      const Twist<Scalar> off = scene.idle_turns().motion_between(aim_, rounds_.pose);
      const StepTask<Scalar> task{start_, rounds_.pose, off, limits.trust(), motion_.is_capped, scene.margin() - rounds_.left_out};
      if (take_step(scene, task, limits, budget, tick)) break;
    }
    return true;
  }

 private:
  /// The linearisations so far.
  struct Rounds {
    Pose<Scalar> pose;  // where the next one is
    int count = 0;
    bool is_measured = false;  // the last one was: not carried
    bool may_assume = true;
    bool is_taken_back = false;  // the second step took back the first
    Scalar first = 0, previous = 0;  // lengths of steps [m]
    Scalar left_out = 0;  // of the margin, by the step that the trust region cut: what comes free after it leaves out as much [m]
  };

  /// Rows where the motion starts, or where its last step ended; false where there is no work left to measure all pairs, and then to solve for a
  /// step.
  bool linearise(const Scene& scene, bool may_carry, Scalar reach, const WorkBudget& budget, Tick<MeshScalar>& tick) noexcept {
    const bool is_resumed = is_measuring_;
    const bool has_worked = tick.work > 0;
    bool is_done;
    if (is_resumed) {
      is_done = linearisation_.go_on(scene, tick, budget.limit());
    } else if (rounds_.count == 0) {
      const auto is_too_late = [&] { return has_worked && !budget.allows_step(tick.work); };  // the next tick has work for it
      if (is_too_late()) return false;
      rounds_.is_measured = !(may_carry && linearisation_.start_carried(scene, start_, reach, tick, budget.limit()));
      if (is_too_late()) return false;
      is_done = !rounds_.is_measured || linearisation_.start_measured(scene, start_, reach, tick, budget.limit());
    } else {
      rounds_.is_measured = !(motion_.is_capped && linearisation_.carry_to(scene, rounds_.pose, tick));
      is_done = !rounds_.is_measured || linearisation_.move_to(scene, rounds_.pose, rounds_.may_assume, tick, budget.limit());
    }
    const bool may_solve = !rounds_.is_measured || budget.allows_step(tick.work) || (is_resumed && tick.work == 0);
    is_measuring_ = !(is_done && may_solve);
    return !is_measuring_;
  }

  /// Solves for a step, and goes to where it ends; whether it is the last one.
  bool take_step(const Scene& scene, const StepTask<Scalar>& task, const StepLimits<Scalar>& limits, WorkBudget& budget,
                 Tick<MeshScalar>& tick) noexcept {
    const int begun = tick.work;
    SqpStep<ToolType, Solver> step(scene, linearisation_, budget, task, tick);
    Leg<Scalar> leg = solve(scene, step);
    linearisation_.learn_passed(scene, tick, budget.limit());
    budget.note_step(tick.work - begun);
    const Scalar last = scene.length_of(leg.step, task.linearised);
    if (rounds_.count == 0) {
      rounds_.first = last;
      motion_.is_at_rest = rounds_.is_measured && last < scene.at_rest();
    }
    const Scalar longest = limits.longest(linearisation_.is_empty());
    // Where the optimum is flat a step may be of more than a turn, of which a pose would not know the direction.
    if (!motion_.is_capped && last > 2 * longest) leg = step.leg_of(leg.step * (2 * longest / last));
    linearisation_.stops().remember(leg.step, linearisation_.problem());
    rounds_.pose = leg.end;
    motion_.motion = leg.motion;
    if (!motion_.is_capped) motion_.is_free = linearisation_.problem().is_free();
    const Scalar length = scene.length_of(motion_.motion, start_);
    if (length > longest && !motion_.is_capped) {
      motion_.is_capped = true;
      rounds_.left_out = linearisation_.problem().relaxation();
      motion_.motion = motion_.motion * (longest / length);
      rounds_.pose = scene.idle_turns().moved(start_, motion_.motion);
      return motion_.is_free ||
             linearisation_.problem().leaves_gaps(scene.idle_turns().motion_between(task.linearised, rounds_.pose), scene.margin() / 2);
    }
    if (motion_.is_capped && length > 2 * longest) {  // rows that all but contradict each other are met only far away
      motion_.motion = motion_.motion * (longest / length);
      return true;
    }
    return finish_round(scene, last, length, tick);
  }

  /// With the contacts that the motion would break, and what stopped the last step where this one goes back.
  Leg<Scalar> solve(const Scene& scene, SqpStep<ToolType, Solver>& step) noexcept {
    const bool is_first = rounds_.count == 0;
    step.solve();
    if (is_first) motion_.restoration = (std::max)(linearisation_.problem().worth_of_margin(), Scalar(0));
    Leg<Scalar> leg = is_first ? step.leg() : step.with_kept_contacts(step.leg());
    if (rounds_.previous > scene.very_short() && !motion_.is_capped && step.reconcile()) {
      leg = step.leg();
      rounds_.is_taken_back = rounds_.is_taken_back || rounds_.count == 1;
    }
    return leg;
  }

  /// Notes what is so of the motion after a step; whether that is the last one.
  /// @param last    length of the step [m]
  /// @param length  of the motion so far [m]
  bool finish_round(const Scene& scene, Scalar last, Scalar length, Tick<MeshScalar>& tick) noexcept {
    const auto& problem = linearisation_.problem();
    const bool rests_on_assumption = problem.rests_on_assumption();
    rounds_.may_assume = rounds_.may_assume && !rests_on_assumption;  // with it again, two linearisations would take turns
    // A short step is the last one where it is very short, or where steps shrink so fast, and go on to, that the next one would be.
    const bool shrinks_fast = problem.is_newton() && last < rounds_.previous / 10 && last * last < rounds_.previous * scene.very_short() / 2;
    const bool is_short = last < scene.step_tolerance() && (shrinks_fast || last < scene.very_short());
    rounds_.previous = last;
    const bool rests_on_kept = problem.rests_on_kept();
    motion_.is_home = motion_.is_free && !motion_.is_capped && !problem.is_cut_short() && scene.has_led_to(aim_, rounds_.pose, length) &&
                      (rounds_.count > 0 || linearisation_.keeps(scene, holding_distance(scene), rounds_.pose, tick.work));
    motion_.is_taken_back = rounds_.is_taken_back && rests_on_kept && last < scene.very_short() && !motion_.is_capped;
    motion_.goes_back = rests_on_kept && length < rounds_.first / 4 && !motion_.is_capped;
    const bool holds = is_short && rounds_.is_measured && !rests_on_assumption && !rests_on_kept && problem.keeps_features() &&
                       !problem.rests_on_the_way(scene.clearance().kept + scene.clearance().none());
    motion_.is_settled = (holds && !problem.is_cut_short()) || motion_.is_home;
    return motion_.is_settled || motion_.is_capped || (is_short && rests_on_kept);
  }

  Rows linearisation_;
  Pose<Scalar> start_;  // certified
  Pose<Scalar> aim_;  // where the hand was when the search began
  Rounds rounds_;
  TrialMotion<Scalar> motion_;
  bool is_measuring_ = false;
};

}  // namespace feeler
