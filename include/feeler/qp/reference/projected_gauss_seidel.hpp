// A QP solver whose time is known in advance: projected Gauss–Seidel on the multipliers.
#pragma once

#include <array>

#include "feeler/core/index.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/reference/ldlt6.hpp"
#include "feeler/qp/reference/optimality.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Coordinate ascent on the dual: each row in turn pushes the step until it is met, or pulls back what it
/// pushed too much.
///
/// For a hard bound on time at low accuracy, and for steps that improve whenever they are interrupted. The
/// contact solver of most physics engines; also Hildreth's method. After `sweeps` passes the step is the
/// minimum for the multipliers found, which are feasible for the dual; rows may be violated still, and then
/// the status is `iteration_limit`. Slow to converge where rows are nearly parallel or opposite. Source: C.
/// Hildreth, "A quadratic programming procedure", Naval Research Logistics Quarterly 4 (1957); over-relaxed
/// after O. Mangasarian, Journal of Optimization Theory and Applications 22 (1977).
///
/// Rows are met to `tolerance` [m] when the status is `optimal`. Says `infeasible` of a row of zeros only.
/// Cost: 60 multiplications a row, and 12 a row and sweep; noexcept, no allocation.
template <RealScalar ScalarType>
class ProjectedGaussSeidel {
 public:
  using Scalar = ScalarType;
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// Violation of a row that is accepted [m].
  Scalar tolerance = Scalar(1e-9);
  /// Passes over all rows, at most: fewer when nothing moves any more.
  int sweeps = 50;
  /// Between 0 and 2; above 1 a row pushes farther than it needs.
  Scalar relaxation = Scalar(1.3);

  QpStatus solve(const Problem& problem, Solution& solution) noexcept {
    solution = Solution();
    if (!hessian_.factor(problem.hessian)) return QpStatus::not_positive_definite;
    if (!is_finite(problem)) return QpStatus::iteration_limit;
    Vector6<Scalar> x = -hessian_.solve(problem.gradient);
    for (int k = 0; k < problem.row_count; ++k) {
      images_[as_index(k)] = hessian_.solve(problem.rows[as_index(k)]);
      const Scalar square = problem.rows[as_index(k)].dot(images_[as_index(k)]);
      multipliers_[as_index(k)] = Scalar(0);
      if (square > Scalar(0)) {
        compliance_[as_index(k)] = square;
      } else {  // a row of zeros says nothing, or can not be met
        compliance_[as_index(k)] = Scalar(1);
        if (problem.bounds[as_index(k)] > tolerance) {
          solution.conflict.push_back(k);
          solution.step = x;
          return make_finite(solution) ? QpStatus::infeasible : QpStatus::iteration_limit;
        }
      }
    }
    while (solution.iterations < sweeps) {
      ++solution.iterations;
      if (!(sweep(problem, x) > tolerance / 8)) break;
    }
    return conclude(problem, hessian_, x, multipliers_, tolerance, solution);
  }

 private:
  /// Passes over the rows once, and returns the longest way that one moved [m].
  Scalar sweep(const Problem& problem, Vector6<Scalar>& x) noexcept {
    Scalar longest(0);
    for (int k = 0; k < problem.row_count; ++k) {
      const Scalar lacking = problem.bounds[as_index(k)] - problem.rows[as_index(k)].dot(x);
      Scalar change = relaxation * lacking / compliance_[as_index(k)];
      if (!(multipliers_[as_index(k)] + change > Scalar(0))) change = -multipliers_[as_index(k)];
      if (change == Scalar(0)) continue;
      multipliers_[as_index(k)] += change;
      x += change * images_[as_index(k)];
      const Scalar way = (change > Scalar(0) ? change : Scalar(-change)) * compliance_[as_index(k)];
      if (way > longest) longest = way;
    }
    return longest;
  }

  Ldlt6<Scalar> hessian_;
  std::array<Vector6<Scalar>, std::size_t(Problem::row_capacity)> images_;  // H⁻¹a
  QpMultipliers<Scalar> multipliers_{}, compliance_{};                      // compliance is aᵀH⁻¹a
};

static_assert(QpSolver<ProjectedGaussSeidel<double>>);

}  // namespace feeler
