// The step of one linearisation: its QPs, and the rows that these turn out to need.
#pragma once

#include "feeler/qp/qp_solver.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/sqp/linearisation.hpp"
#include "feeler/render/sqp/work_budget.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/turned_metric.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// Where a step is solved for, and how much of it is trusted.
template <class Scalar>
struct StepTask {
  Pose<Scalar> certified;   ///< where the motion starts
  Pose<Scalar> linearised;  ///< where the rows are
  Twist<Scalar> off;        ///< from where the motion aims, of the linearised pose
  Scalar trust;             ///< the trust region [m]
  bool is_capped;           ///< it cut an earlier step: the tool is only to come free
  Scalar margin;            ///< that rows are to have [m]
};

/// A step from the pose of linearisation.
template <class Scalar>
struct Leg {
  Twist<Scalar> step;
  Pose<Scalar> end;
  Twist<Scalar> motion;  ///< to the end, from the certified pose
};

/// Solves for the step of a task: a Gauss-Newton step, the rows of what that would cross, and a Newton step with the Hessian of the Lagrangian.
///
/// @cost  noexcept, no allocation; where the work of the tick runs out, it is with fewer rows
template <RigidTool ToolType, QpSolver Solver>
class SqpStep {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Rows = Linearisation<ToolType, Solver>;

  /// All are kept by reference.
  /// @param rows  at the linearised pose
  SqpStep(const Scene& scene, Rows& rows, const WorkBudget& budget, const StepTask<Scalar>& task, Tick<MeshScalar>& tick) noexcept
      : scene_(scene), rows_(rows), budget_(budget), task_(task), tick_(tick) {}

  /// Solves with the rows of what the step would cross; where the work runs out with less than that.
  void solve() noexcept {
    constexpr int most_additions = 3;
    if (!task_.is_capped && solve_newton_by_guess()) return;
    solve_gauss_newton();
    for (int i = 0; i < most_additions && budget_.allows_solve(tick_.work) && rows_.add_crossed(scene_, trusted_step(), tick_, budget_.limit()); ++i)
      solve_gauss_newton();
    if (!task_.is_capped) solve_newton();
  }

  /// Solves again with the contacts of the certified pose that the motion would break (cuts); here and below, if there is work left.
  /// @param so_far  the leg that was solved for
  Leg<Scalar> with_kept_contacts(Leg<Scalar> so_far) noexcept {
    rows_.release_kept();
    for (int round = 0; round < 2 && budget_.allows_solve(tick_.work) && rows_.keep_broken(scene_, so_far.motion); ++round) {
      solve_again();
      so_far = leg();
    }
    return so_far;
  }

  /// Where the step goes back on the last one, each linearisation lacks what stopped the other: solves again with what stopped the last.
  bool reconcile() noexcept {
    const Twist<Scalar>& last_step = rows_.stops().step();
    const TurnedMetric<Scalar>& metric = scene_.metric();
    if (!(metric.product(solved_step(), last_step) < -metric.energy(last_step) / 2)) return false;
    if (!budget_.allows_solve(tick_.work) || !rows_.keep_stops(scene_)) return false;
    solve_again();
    return true;
  }

  /// The step solved for.
  Leg<Scalar> leg() const noexcept { return leg_of(solved_step()); }
  Leg<Scalar> leg_of(const Twist<Scalar>& step) const noexcept {
    const auto& turns = scene_.idle_turns();
    const Pose<Scalar> end = turns.moved(task_.linearised, step);
    return {step, end, turns.motion_between(task_.certified, end)};
  }

 private:
  auto& problem() noexcept { return rows_.problem(); }
  Twist<Scalar> solved_step() const noexcept { return Twist<Scalar>::from_vector(rows_.problem().solution().step); }

  /// As much of that as is trusted.
  Twist<Scalar> trusted_step() const noexcept {
    const Twist<Scalar> step = solved_step();
    const Scalar length = scene_.length_of(step, task_.linearised);
    return length > task_.trust ? step * (task_.trust / length) : step;
  }

  /// Leaves half of the work to what follows.
  void limit_solves() noexcept { problem().limit_solves((budget_.limit() - tick_.work) / 2); }

  void solve_gauss_newton() noexcept {
    limit_solves();
    if (task_.is_capped) {
      problem().restore(scene_.metric(), task_.margin);
    } else {
      problem().solve_gauss_newton(scene_.metric(), task_.off, task_.margin);
    }
    tick_.work += problem().solves();
  }

  void solve_newton() noexcept {
    if (problem().is_free()) return;
    limit_solves();
    problem().solve_newton(scene_.metric(), task_.off);
    tick_.work += problem().solves();
  }

  /// Solves with the forces of the last step; false where a Gauss-Newton step is to find others.
  bool solve_newton_by_guess() noexcept {
    using Guess = typename Rows::Problem::Guess;
    limit_solves();
    const Guess guess = problem().solve_newton_by_guess(scene_.metric(), task_.off, task_.margin);
    if (guess == Guess::none) return false;
    tick_.work += problem().solves();
    if (guess == Guess::wrong || rows_.add_crossed(scene_, trusted_step(), tick_, budget_.limit())) return false;
    if (guess == Guess::close) solve_newton();
    return true;
  }

  /// Solves again with rows that came late.
  void solve_again() noexcept {
    solve_gauss_newton();
    if (!task_.is_capped) solve_newton();
  }

  const Scene& scene_;
  Rows& rows_;
  const WorkBudget& budget_;
  const StepTask<Scalar>& task_;
  Tick<MeshScalar>& tick_;
};

}  // namespace feeler
