// A problem as QP libraries take it: matrices as plain arrays.
#pragma once

#include <array>

#include "feeler/core/index.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/reference/ldlt6.hpp"
#include "feeler/qp/reference/optimality.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// A problem in arrays, and the ends of a solution that all bridges to QP libraries share.
///
/// What a library calls optimal is checked here, by the conditions of optimality to the bridge's tolerance;
/// an answer that does not meet them ends as `iteration_limit`.
class DenseProblem {
 public:
  using Problem = QpProblem<double>;
  using Solution = QpSolution<double>;
  static constexpr double infinity = 1e30;

  std::array<double, 36> hessian;  ///< symmetric, so row major is column major
  std::array<double, 6> gradient;
  std::array<double, std::size_t(6 * Problem::row_capacity)> rows;  ///< row major
  std::array<double, std::size_t(Problem::row_capacity)> lower, upper;

  /// Copies a problem; false where it needs no library: no row is violated at the free minimum, a number is
  /// not finite, or the Hessian is refused.
  /// @param status  then its status, with `solution` complete
  bool begin(const Problem& problem, double tolerance, Solution& solution, QpStatus& status) noexcept {
    solution = Solution();
    status = QpStatus::not_positive_definite;
    if (!factor_.factor(problem.hessian)) return false;
    status = QpStatus::iteration_limit;
    if (!is_finite(problem)) return false;
    status = conclude(problem, factor_, Vector6<double>(-factor_.solve(problem.gradient)), {}, tolerance, solution);
    if (status == QpStatus::optimal || problem.row_count == 0) return false;
    for (int i = 0; i < 6; ++i) {
      gradient[as_index(i)] = problem.gradient[i];
      for (int j = 0; j < 6; ++j) hessian[as_index(6 * i + j)] = problem.hessian(i, j);
    }
    for (int k = 0; k < problem.row_count; ++k) {
      for (int i = 0; i < 6; ++i) rows[as_index(6 * k + i)] = problem.rows[as_index(k)][i];
      lower[as_index(k)] = problem.bounds[as_index(k)];
      upper[as_index(k)] = infinity;
    }
    return true;
  }

  /// @param step         six numbers
  /// @param multipliers  one a row
  /// @param sign         of the library's multipliers of lower bounds: 1 or −1
  QpStatus end(const Problem& problem, const double* step, const double* multipliers, double sign, double tolerance,
               Solution& solution) const noexcept {
    const int iterations = solution.iterations;
    QpMultipliers<double> ours{};
    for (int k = 0; k < problem.row_count; ++k) ours[as_index(k)] = sign * multipliers[k];
    const Vector6<double> x(step);
    const QpStatus status = conclude(problem, factor_, x, ours, tolerance, solution);
    solution.iterations = iterations;
    return status;
  }

 private:
  Ldlt6<double> factor_;
};

}  // namespace feeler
