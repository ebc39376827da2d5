// A QP solver to check others by: an active set that is factored anew in every iteration.
#pragma once

#include <array>
#include <limits>

#include "feeler/core/index.hpp"
#include "feeler/qp/gram_schmidt.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/reference/ldlt6.hpp"
#include "feeler/qp/reference/optimality.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Dual active set with nothing carried from one iteration to the next but the list of active rows and their
/// multipliers.
///
/// For new scalars and for checking: no updates that drift, no tuning, no square roots. With a rational
/// scalar and a `tolerance` of zero its answers are exact, and so is "infeasible". Source: D. Goldfarb, A.
/// Idnani, Mathematical Programming 27 (1983), algorithm of section 3; the row to add is the most violated
/// one.
///
/// Rows are met to `tolerance` [m]. Rows at an angle below about 1e-8 rad to the span of the active ones
/// count as dependent. Cost: per iteration one pass over the rows and at most six Gram–Schmidt projections;
/// six to fourteen times as long as `DualActiveSet`; noexcept, no allocation.
template <RealScalar ScalarType>
class TextbookActiveSet {
 public:
  using Scalar = ScalarType;
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// Violation of a row that is accepted [m].
  Scalar tolerance = std::numeric_limits<Scalar>::is_exact ? Scalar(0) : Scalar(2e-13);

  QpStatus solve(const Problem& problem, Solution& solution) noexcept {
    solution = Solution();
    count_ = 0;
    if (!hessian_.factor(problem.hessian)) return QpStatus::not_positive_definite;
    if (!is_finite(problem)) return QpStatus::iteration_limit;
    const QpStatus status = iterate(problem, solution);
    for (int i = 0; i < count_; ++i) solution.active.push_back({active_[as_index(i)], multipliers_[as_index(i)]});
    if (!make_finite(solution)) return QpStatus::iteration_limit;
    if (status == QpStatus::optimal && !is_stationary(problem, hessian_, tolerance, solution)) return QpStatus::iteration_limit;
    return status;
  }

 private:
  using Numbers = std::array<Scalar, 6>;

  QpStatus iterate(const Problem& problem, Solution& solution) noexcept {
    Vector6<Scalar>& x = solution.step;
    x = -hessian_.solve(problem.gradient);
    const int limit = 8 * (problem.row_count + 8);
    while (solution.iterations < limit) {
      const int entering = most_violated(problem, x);
      if (entering < 0) return active_rows_are_met(problem, x) ? QpStatus::optimal : QpStatus::iteration_limit;
      const QpStatus status = enter(problem, entering, limit, solution);
      if (status != QpStatus::optimal) return status;
    }
    return QpStatus::iteration_limit;
  }

  int most_violated(const Problem& problem, const Vector6<Scalar>& x) const noexcept {
    Scalar worst(0);
    int entering = -1;
    for (int k = 0; k < problem.row_count; ++k) {
      const Scalar violation = problem.bounds[as_index(k)] - problem.rows[as_index(k)].dot(x);
      if (violation > worst && violation > tolerance + rounding_of_row(Vector6<Scalar>(problem.rows[as_index(k)]), x) && !is_active(k)) {
        worst = violation;
        entering = k;
      }
    }
    return entering;
  }

  bool is_active(int row) const noexcept {
    for (int i = 0; i < count_; ++i) {
      if (active_[as_index(i)] == row) return true;
    }
    return false;
  }

  bool active_rows_are_met(const Problem& problem, const Vector6<Scalar>& x) const noexcept {
    for (int i = 0; i < count_; ++i) {
      const Vector6<Scalar> a = problem.rows[as_index(active_[as_index(i)])];
      if (problem.bounds[as_index(active_[as_index(i)])] - a.dot(x) > tolerance + rounding_of_row(a, x)) return false;
    }
    return true;
  }

  /// Makes row p active, dropping rows whose multiplier would turn negative; says `optimal` when it is.
  QpStatus enter(const Problem& problem, int p, int limit, Solution& solution) noexcept {
    const Vector6<Scalar> a = problem.rows[as_index(p)];
    const Vector6<Scalar> image = hessian_.solve(a);
    while (++solution.iterations <= limit) {
      factor(problem);
      const auto e = basis_.expand(a, image);
      const bool is_dependent = count_ == 6 || !(e.free_squared > dependence() * e.squared);
      const Scalar violation = problem.bounds[as_index(p)] - a.dot(solution.step);

      int leaving = -1;  // the first row whose multiplier meets zero
      Scalar dual_step(0);
      for (int i = 0; i < count_; ++i) {
        const Scalar& r = e.coefficients[as_index(i)];
        if (r > Scalar(0) && (leaving < 0 || multipliers_[as_index(i)] < dual_step * r)) {
          dual_step = multipliers_[as_index(i)] / r;
          leaving = i;
        }
      }
      if (is_dependent && leaving < 0) {
        if (!is_certain_conflict(problem, p, e.coefficients)) return QpStatus::iteration_limit;
        solution.conflict.push_back(p);
        for (int i = 0; i < count_; ++i) {
          if (e.coefficients[as_index(i)] < -negligible()) solution.conflict.push_back(active_[as_index(i)]);
        }
        return QpStatus::infeasible;
      }
      if (!is_dependent && (leaving < 0 || violation <= dual_step * e.free_squared)) {
        active_[as_index(count_++)] = p;
        solution.step = stand_on_active_rows(problem);
        return QpStatus::optimal;
      }
      if (!is_dependent) solution.step += dual_step * e.free_image;
      for (int i = 0; i < count_; ++i) {
        const Scalar u = multipliers_[as_index(i)] - dual_step * e.coefficients[as_index(i)];
        multipliers_[as_index(i)] = u > Scalar(0) ? u : Scalar(0);
      }
      --count_;
      for (int i = leaving; i < count_; ++i) {
        active_[as_index(i)] = active_[as_index(i + 1)];
        multipliers_[as_index(i)] = multipliers_[as_index(i + 1)];
      }
    }
    return QpStatus::iteration_limit;
  }

  /// Whether row p less its shares of the active ones asks for more than rounding and tolerances can explain.
  template <class Shares>
  bool is_certain_conflict(const Problem& problem, int p, const Shares& shares) const noexcept {
    Scalar gain = problem.bounds[as_index(p)], weights(1), sizes = gain < Scalar(0) ? Scalar(-gain) : gain;
    for (int i = 0; i < count_; ++i) {
      const Scalar part = shares[as_index(i)] * problem.bounds[as_index(active_[as_index(i)])];
      gain -= part;
      weights += shares[as_index(i)] < Scalar(0) ? Scalar(-shares[as_index(i)]) : shares[as_index(i)];
      sizes += part < Scalar(0) ? Scalar(-part) : part;
    }
    const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
    return gain > tolerance * weights + rounding * sizes;
  }

  /// Squared sine under which a row is dependent: of 1e-8 rad, or of what rounding leaves of a row projected
  /// twice.
  static Scalar dependence() noexcept {
    if (std::numeric_limits<Scalar>::is_exact) return Scalar(0);
    const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
    const Scalar angle = rounding > Scalar(1e-8) ? rounding : Scalar(1e-8);
    return angle * angle;
  }
  /// A share in a conflict that is rounding.
  static Scalar negligible() noexcept { return std::numeric_limits<Scalar>::is_exact ? Scalar(0) : Scalar(1e-9); }

  void factor(const Problem& problem) noexcept {
    basis_.clear();
    for (int i = 0; i < count_; ++i) {
      const Vector6<Scalar> a = problem.rows[as_index(active_[as_index(i)])];
      basis_.add(basis_.expand(a, hessian_.solve(a)));
    }
  }

  /// The minimum with the active rows as equations, and their multipliers; refined twice, because multipliers
  /// can be large.
  Vector6<Scalar> stand_on_active_rows(const Problem& problem) noexcept {
    factor(problem);
    Vector6<Scalar> x = -hessian_.solve(problem.gradient);
    multipliers_.fill(Scalar(0));
    for (int pass = 0; pass < 3; ++pass) {
      Numbers lacking;
      lacking.fill(Scalar(0));
      for (int i = 0; i < count_; ++i) {
        const auto k = as_index(active_[as_index(i)]);
        lacking[as_index(i)] = problem.bounds[k] - problem.rows[k].dot(x);
      }
      const Numbers u = basis_.solve(lacking);
      Vector6<Scalar> force = Vector6<Scalar>::Zero();
      for (int i = 0; i < count_; ++i) {
        force += u[as_index(i)] * problem.rows[as_index(active_[as_index(i)])];
        multipliers_[as_index(i)] += u[as_index(i)];
      }
      x += hessian_.solve(force);
    }
    for (int i = 0; i < count_; ++i) {
      if (!(multipliers_[as_index(i)] > Scalar(0))) multipliers_[as_index(i)] = Scalar(0);
    }
    return x;
  }

  Ldlt6<Scalar> hessian_;
  GramSchmidt<Scalar> basis_;
  int count_ = 0;
  std::array<int, 6> active_{};
  Numbers multipliers_{};
};

static_assert(QpSolver<TextbookActiveSet<double>>);

}  // namespace feeler
