// The default QP solver: the dual active-set method of Goldfarb and Idnani.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "feeler/core/lanes.hpp"
#include "feeler/qp/dual/dual_tableau.hpp"
#include "feeler/qp/dual/held_minimum.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/kkt_check.hpp"
#include "feeler/qp/dual/operator_method.hpp"
#include "feeler/qp/dual/problem_rows.hpp"
#include "feeler/qp/dual/row_scan.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/dual/table_by_columns.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/solution.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler {

/// Dual active set: the minimum on some rows, whose forces do not pull, is followed to that of the problem.
///
/// There are three ways, tried in this order. The minimum on the rows to start from, or on the only row there is (`detail::HeldMinimum`). A table
/// that tells of up to 24 rows which are active, or which contradict each other (`detail::DualTableau`). Operators in six dimensions, for any number
/// of rows (`detail::OperatorMethod`). What the first two find counts only where it meets the conditions of an optimum (`detail::KktCheck`); else the
/// third begins with the rows that they found.
///
/// Source: D. Goldfarb, A. Idnani, "A numerically stable dual method for solving strictly convex quadratic programs", Mathematical Programming 27
/// (1983), with dual steepest-edge pricing (`detail::BestRow`).
///
/// Rows are met to `tolerance` [m]. Rows that make an angle below about 1e-8 rad with the span of the active
/// ones count as dependent. The same input gives the same bits, with every number of lanes and,
/// on x86, with all flags of the compiler. Cost: two products with every row, and one more for each row
/// added; noexcept, no allocation.
/// @tparam lanes  rows computed side by side; by default what the compiler may use
template <RealScalar ScalarType, int lanes = detail::lanes_of<ScalarType>>
class DualActiveSet {
 public:
  using Scalar = ScalarType;
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// Violation of a row that is accepted [m].
  Scalar tolerance = Scalar(2e-13);

  QpStatus solve(const Problem& problem, Solution& solution) noexcept { return solve(problem, WarmStart{}, solution); }

  /// Starts from rows that are likely to be active.
  [[gnu::noinline]]
  QpStatus solve(const Problem& problem, const WarmStart& start, Solution& solution) noexcept {
    solution.active.clear();
    solution.conflict.clear();
    solution.iterations = 0;
    solution.step.setZero();
    if (!inverse_.factor(problem.hessian)) return QpStatus::not_positive_definite;
    detail::copy_six(problem.gradient.data(), gradient_.data());

    WarmStart alone;  // a row alone is most likely active
    if (problem.row_count == 1) alone.rows.push_back(0);
    const WarmStart* known = start.rows.empty() ? &alone : &start;
    if ((!known->rows.empty() || problem.row_count == 0) && guess_.find(problem, problem.bounds.data(), *known, inverse_, gradient_) &&
        is_right(problem, *known, 1, solution))
      return QpStatus::optimal;
    if (problem.row_count <= Tableau::row_capacity) {
      const QpStatus status = solve_by_table(problem, solution);
      if (status != in_doubt) return status;
      known = &tableau_.active();
    }
    inverse_.invert();
    return operators_.solve(problem, *known, inverse_, gradient_, tolerance, solution);
  }

 private:
  using Six = detail::Six<Scalar>;
  using Scan = detail::RowScan<Scalar, lanes>;
  static constexpr int table_lanes = (std::min)(lanes, 4);  // more make a few rows no quicker
  using Tableau = detail::DualTableau<Scalar, table_lanes>;

  static constexpr QpStatus in_doubt = QpStatus::iteration_limit;  // of a way that is not the last one

  /// Whether the minimum on known rows is that of the problem: then that is all there is to do.
  [[gnu::always_inline]] inline bool is_right(const Problem& problem, const WarmStart& known, int iterations, Solution& solution) noexcept {
    using std::isfinite;
    const Six& x = guess_.x();
    if (!is_met(problem, known)) return false;
    Six residual;  // is finite where x is
    if (kkt_check(problem).fails(inverse_, gradient_, x, known.rows, guess_.multipliers(), guess_.force(), guess_.lacking(), guess_.beside(),
                                 residual) ||
        !isfinite(detail::norm1(residual)))
      return false;
    hand_over(known, iterations, solution);
    return true;
  }
  /// Whether x meets all rows; that it meets the only one which there is is known already.
  [[gnu::always_inline]] inline bool is_met(const Problem& problem, const WarmStart& known) const noexcept {
    if (problem.row_count == 1 && known.rows.size() == 1) return guess_.lacking()[0] <= tolerance;
    return !Scan::is_violated(problem, problem.bounds.data(), guess_.x(), tolerance);
  }
  /// @param rows  that hold at the guess
  [[gnu::always_inline]] inline void hand_over(const WarmStart& rows, int iterations, Solution& solution) const noexcept {
    detail::copy_six(guess_.x().data(), solution.step.data());
    for (int i = 0; i < rows.rows.size(); ++i) solution.active.push_back({rows.rows[i], guess_.multipliers()[std::size_t(i)]});
    solution.iterations = iterations;
  }

  /// Has a table find the active rows of a problem of some rows, or rows that contradict each other, and checks them.
  [[gnu::noinline]]
  QpStatus solve_by_table(const Problem& problem, Solution& solution) noexcept {
    const bool is_found = tableau_.find(problem, problem.bounds.data(), inverse_, gradient_, tolerance);
    if (!is_found && tableau_.refused() < 0) return in_doubt;
    const WarmStart& active = tableau_.active();
    const auto change_for = [this](const auto& distances) { return this->tableau_.change_for(distances); };
    guess_.place(problem, problem.bounds.data(), active, tableau_.multipliers(), inverse_, gradient_, change_for, tolerance / 2);
    if (is_found) return is_right(problem, active, 1 + tableau_.steps(), solution) ? QpStatus::optimal : in_doubt;
    return is_contradicted(problem, solution) ? QpStatus::infeasible : in_doubt;
  }

  /// Whether the row that a table refuses contradicts the active ones.
  [[gnu::noinline]]
  bool is_contradicted(const Problem& problem, Solution& solution) noexcept {
    using std::isfinite;
    const Six a = detail::row_of(problem, tableau_.refused());
    const auto& rows = tableau_.active().rows;
    Six rest = a;
    for (int i = 0; i < rows.size(); ++i) detail::subtract(detail::row_of(problem, rows[i]), tableau_.shares()[std::size_t(i)], rest);
    if (!isfinite(detail::norm1(guess_.x())) || detail::norm1(rest) > detail::allowed_rest(a)) return false;
    if (!kkt_check(problem).is_contradiction(tableau_.refused(), a, rest, true, guess_.x(), rows, tableau_.shares(), tolerance, solution))
      return false;
    hand_over(tableau_.active(), tableau_.steps(), solution);
    return true;
  }

  detail::KktCheck<Scalar> kkt_check(const Problem& problem) const noexcept {
    return detail::KktCheck<Scalar>(problem, problem.bounds.data(), tolerance);
  }

  detail::InverseHessian<Scalar> inverse_;
  Six gradient_{};
  detail::HeldMinimum<Scalar, table_lanes> guess_;
  Tableau tableau_;
  detail::OperatorMethod<Scalar, lanes> operators_;
};

static_assert(QpSolver<DualActiveSet<double>>);

}  // namespace feeler
