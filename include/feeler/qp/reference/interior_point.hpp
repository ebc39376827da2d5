// A QP solver whose number of iterations hardly depends on the rows: a primal–dual interior point.
#pragma once

#include <limits>

#include "feeler/core/index.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/reference/conflict.hpp"
#include "feeler/qp/reference/ldlt6.hpp"
#include "feeler/qp/reference/optimality.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Predictor and corrector steps along the central path, each with one factor of a 6×6 matrix.
///
/// For problems of very many rows, of which many are active: 10 to 20 iterations whether 4 or 200 rows are
/// tight, where an active set exchanges them one by one. In free space it returns at once. Source: S.
/// Mehrotra, "On the implementation of a primal-dual interior point method", SIAM Journal on Optimization 2
/// (1992), as in J. Nocedal, S. Wright, Numerical Optimization, section 16.6. Slacks s of the rows,
/// multipliers λ, sλ → 0.
///
/// Rows are met to `tolerance` [m] and rounding when the status is `optimal`. The rows are moved out by half
/// of that, so that a slot without clearance has an inside. What has no inside then ends as `infeasible`
/// where the multipliers show a conflict, and else as `iteration_limit`. Cost: 100 multiplications a row and
/// iteration; noexcept, no allocation.
template <RealScalar ScalarType>
class InteriorPoint {
 public:
  using Scalar = ScalarType;
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// Violation of a row that is accepted [m].
  Scalar tolerance = Scalar(1e-9);
  int most_iterations = 60;

  QpStatus solve(const Problem& problem, Solution& solution) noexcept {
    solution = Solution();
    if (!hessian_.factor(problem.hessian)) return QpStatus::not_positive_definite;
    if (!is_finite(problem)) return QpStatus::iteration_limit;
    row_count_ = problem.row_count;
    Vector6<Scalar> x = -hessian_.solve(problem.gradient);
    accuracy_ = tolerance + 32 * std::numeric_limits<Scalar>::epsilon() * x.cwiseAbs().sum();
    if (is_free(problem, x)) {
      multipliers_.fill(Scalar(0));
      return conclude(problem, hessian_, x, multipliers_, accuracy_, solution);
    }
    start(problem, x);
    const Scalar endless = longest_ / std::numeric_limits<Scalar>::epsilon();
    while (solution.iterations < most_iterations) {
      ++solution.iterations;
      residuals(problem, x);
      if (is_converged(problem) || longest_push() > endless) break;
      if (!advance(problem, x)) break;
    }
    const QpStatus status = conclude(problem, hessian_, x, multipliers_, accuracy_, solution);
    if (status == QpStatus::optimal) return status;
    return find_conflict(problem, multipliers_, accuracy_, solution) ? QpStatus::infeasible : status;
  }

 private:
  bool is_free(const Problem& problem, const Vector6<Scalar>& x) const noexcept {
    for (int k = 0; k < row_count_; ++k) {
      if (problem.bounds[as_index(k)] - problem.rows[as_index(k)].dot(x) > accuracy_) return false;
    }
    return true;
  }

  /// Slacks no smaller than the largest violation, and multipliers that a push of that length has.
  void start(const Problem& problem, const Vector6<Scalar>& x) noexcept {
    longest_ = Scalar(0);
    for (int k = 0; k < row_count_; ++k) {
      const Scalar slack = problem.rows[as_index(k)].dot(x) - relaxed_bound(problem, k);
      slacks_[as_index(k)] = slack;
      if (-slack > longest_) longest_ = -slack;
    }
    for (int k = 0; k < row_count_; ++k) {
      const Scalar compliance = problem.rows[as_index(k)].dot(hessian_.solve(problem.rows[as_index(k)]));
      compliance_[as_index(k)] = compliance > Scalar(0) ? compliance : Scalar(1);
      if (slacks_[as_index(k)] < longest_) slacks_[as_index(k)] = longest_;
      multipliers_[as_index(k)] = longest_ * longest_ / (slacks_[as_index(k)] * compliance_[as_index(k)]);
    }
  }

  Scalar relaxed_bound(const Problem& problem, int k) const noexcept { return problem.bounds[as_index(k)] - accuracy_ / 2; }

  void residuals(const Problem& problem, const Vector6<Scalar>& x) noexcept {
    dual_residual_ = problem.hessian * x + problem.gradient;
    for (int k = 0; k < row_count_; ++k) {
      dual_residual_ -= multipliers_[as_index(k)] * problem.rows[as_index(k)];
      primal_residual_[as_index(k)] = problem.rows[as_index(k)].dot(x) - relaxed_bound(problem, k) - slacks_[as_index(k)];
    }
  }

  /// Rows, complementarity and stationarity, all as lengths, to a part of the tolerance.
  bool is_converged(const Problem& problem) const noexcept {
    const Scalar negligible = accuracy_ / 4;
    Vector6<Scalar> residual = dual_residual_;  // without the rows that do not touch
    for (int k = 0; k < row_count_; ++k) {
      if (!(primal_residual_[as_index(k)] > -negligible)) return false;
      if (slacks_[as_index(k)] > negligible) residual += multipliers_[as_index(k)] * problem.rows[as_index(k)];
    }
    const Vector6<Scalar> off = hessian_.solve(residual);
    for (int i = 0; i < 6; ++i) {
      if (!(off[i] < negligible && -off[i] < negligible)) return false;
    }
    return true;
  }

  Scalar longest_push() const noexcept {
    Scalar longest(0);
    for (int k = 0; k < row_count_; ++k) {
      const Scalar push = multipliers_[as_index(k)] * compliance_[as_index(k)];
      if (push > longest) longest = push;
    }
    return longest;
  }

  /// One predictor–corrector step; false where rounding lets it end.
  bool advance(const Problem& problem, Vector6<Scalar>& x) noexcept {
    Matrix6<Scalar> normal = problem.hessian;
    Scalar gap(0);
    for (int k = 0; k < row_count_; ++k) {
      const Vector6<Scalar> a = problem.rows[as_index(k)];
      const Scalar stiffness = multipliers_[as_index(k)] / softened_slack(k);
      for (int j = 0; j < 6; ++j) {
        const Scalar scaled = stiffness * a[j];
        for (int i = j; i < 6; ++i) normal(i, j) += scaled * a[i];
      }
      gap += multipliers_[as_index(k)] * slacks_[as_index(k)];
      products_[as_index(k)] = multipliers_[as_index(k)] * slacks_[as_index(k)];
    }
    if (!newton_.factor(normal)) return false;

    direction(problem);
    const Scalar affine = step_length(Scalar(1));
    Scalar affine_gap(0);
    for (int k = 0; k < row_count_; ++k) {
      affine_gap +=
          (multipliers_[as_index(k)] + affine * multiplier_steps_[as_index(k)]) * (slacks_[as_index(k)] + affine * slack_steps_[as_index(k)]);
    }
    const Scalar ratio = affine_gap / gap;
    const Scalar centre = ratio * ratio * ratio * gap / Scalar(row_count_);
    for (int k = 0; k < row_count_; ++k) products_[as_index(k)] += slack_steps_[as_index(k)] * multiplier_steps_[as_index(k)] - centre;

    const Vector6<Scalar> step = direction(problem);
    const Scalar length = step_length(Scalar(0.995));
    if (!(length > Scalar(1e-10))) return false;
    x += length * step;
    for (int k = 0; k < row_count_; ++k) {
      slacks_[as_index(k)] += length * slack_steps_[as_index(k)];
      multipliers_[as_index(k)] += length * multiplier_steps_[as_index(k)];
      if (!(slacks_[as_index(k)] > Scalar(0)) || !(multipliers_[as_index(k)] > Scalar(0))) return false;
    }
    return true;
  }

  /// Compliance that a row has in the Newton system [m a multiplier]: bounds the condition of the 6×6 matrix.
  /// The steps converge all the same, because residuals are those of the hard row (a proximal step in the
  /// multipliers).
  Scalar softness(int k) const noexcept { return 256 * std::numeric_limits<Scalar>::epsilon() * compliance_[as_index(k)]; }
  Scalar softened_slack(int k) const noexcept { return slacks_[as_index(k)] + softness(k) * multipliers_[as_index(k)]; }

  /// The Newton step that takes the residuals, and the products sλ, to zero.
  Vector6<Scalar> direction(const Problem& problem) noexcept {
    Vector6<Scalar> force = -dual_residual_;
    for (int k = 0; k < row_count_; ++k) {
      force -= ((multipliers_[as_index(k)] * primal_residual_[as_index(k)] + products_[as_index(k)]) / softened_slack(k)) * problem.rows[as_index(k)];
    }
    const Vector6<Scalar> step = newton_.solve(force);
    for (int k = 0; k < row_count_; ++k) {
      const Scalar change = problem.rows[as_index(k)].dot(step) + primal_residual_[as_index(k)];
      multiplier_steps_[as_index(k)] = -(products_[as_index(k)] + multipliers_[as_index(k)] * change) / softened_slack(k);
      slack_steps_[as_index(k)] = change + softness(k) * multiplier_steps_[as_index(k)];
    }
    return step;
  }

  /// How far the step may go, up to 1, with a part of it kept from the boundary.
  Scalar step_length(const Scalar& part) const noexcept {
    Scalar length = Scalar(1) / part;
    for (int k = 0; k < row_count_; ++k) {
      if (slacks_[as_index(k)] + length * slack_steps_[as_index(k)] < Scalar(0)) length = -slacks_[as_index(k)] / slack_steps_[as_index(k)];
      if (multipliers_[as_index(k)] + length * multiplier_steps_[as_index(k)] < Scalar(0))
        length = -multipliers_[as_index(k)] / multiplier_steps_[as_index(k)];
    }
    return part * length < Scalar(1) ? Scalar(part * length) : Scalar(1);
  }

  Ldlt6<Scalar> hessian_, newton_;
  int row_count_ = 0;
  Scalar accuracy_{}, longest_{};  // tolerance and rounding; the largest violation of the start [m]
  Vector6<Scalar> dual_residual_;
  QpMultipliers<Scalar> multipliers_{}, multiplier_steps_{}, slacks_{}, slack_steps_{}, primal_residual_{};
  QpMultipliers<Scalar> compliance_{}, products_{};  // aᵀH⁻¹a; what the Newton step takes to zero: sλ, and its correction
};

static_assert(QpSolver<InteriorPoint<double>>);

}  // namespace feeler
