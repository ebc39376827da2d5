// When a step is what a status says of it: finite, within the rows, optimal.
#pragma once

#include <array>
#include <limits>

#include "feeler/qp/problem.hpp"
#include "feeler/qp/reference/conic_basis.hpp"
#include "feeler/qp/reference/ldlt6.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Whether a number is neither infinite nor NaN; for every scalar, rational ones included.
template <RealScalar Scalar>
bool is_finite_number(const Scalar& value) noexcept {
  return value - value == Scalar(0);
}

/// Whether there is no infinity and no NaN in a problem.
template <RealScalar Scalar>
bool is_finite(const QpProblem<Scalar>& problem) noexcept {
  Scalar sum = (problem.hessian - problem.hessian).sum() + (problem.gradient - problem.gradient).sum();
  for (int k = 0; k < problem.row_count; ++k) {
    const auto row = std::size_t(k);
    sum += (problem.rows[row] - problem.rows[row]).sum() + (problem.bounds[row] - problem.bounds[row]);
  }
  return sum == Scalar(0);
}

/// Resets a solution that is not finite, as arithmetic that overflowed leaves it; false where it did.
template <RealScalar Scalar>
bool make_finite(QpSolution<Scalar>& solution) noexcept {
  Scalar sum = (solution.step - solution.step).sum();
  for (const auto& active : solution.active) sum += active.multiplier - active.multiplier;
  if (sum == Scalar(0)) return true;
  const int iterations = solution.iterations;
  solution = QpSolution<Scalar>();
  solution.iterations = iterations;
  return false;
}

/// What rounding makes of the value of a row at x [m].
template <RealScalar Scalar>
Scalar rounding_of_row(const Vector6<Scalar>& row, const Vector6<Scalar>& x) noexcept {
  Scalar largest(0), sum(0);
  for (int i = 0; i < 6; ++i) {
    const Scalar size = x[i] < Scalar(0) ? Scalar(-x[i]) : Scalar(x[i]);
    if (size > largest) largest = size;
    sum += row[i] < Scalar(0) ? Scalar(-row[i]) : Scalar(row[i]);
  }
  return 8 * std::numeric_limits<Scalar>::epsilon() * largest * sum;
}

/// Whether the step is H⁻¹(Σ λ a − g) of the active rows, to `tolerance` [m and rad] and up to rounding of
/// the terms.
template <RealScalar Scalar>
bool is_stationary(const QpProblem<Scalar>& problem, const Ldlt6<Scalar>& hessian, const Scalar& tolerance,
                   const QpSolution<Scalar>& solution) noexcept {
  Vector6<Scalar> force = -problem.gradient;
  Scalar size = solution.step.cwiseAbs().sum();
  for (const auto& active : solution.active) {
    const Vector6<Scalar> push = active.multiplier * problem.rows[std::size_t(active.row)];
    force += push;
    size += hessian.solve(push).cwiseAbs().sum();
  }
  const Vector6<Scalar> off = hessian.solve(force) - solution.step;
  const Scalar accepted = tolerance + 64 * std::numeric_limits<Scalar>::epsilon() * size;
  for (int i = 0; i < 6; ++i) {
    if (!(off[i] <= accepted) || !(-off[i] <= accepted)) return false;
  }
  return true;
}

/// One multiplier a row, also of rows that are not active.
template <RealScalar Scalar>
using QpMultipliers = std::array<Scalar, std::size_t(QpProblem<Scalar>::row_capacity)>;

/// Makes a solution of a step and one multiplier a row, and says whether it is optimal.
///
/// For solvers whose multipliers are many, nearly zero or a little negative. A row is taken as active when
/// its multiplier is positive and would remain so in a coordinate step, λ > slack/(aᵀH⁻¹a); of more rows than
/// are independent those are kept that carry the same force. Optimal means: rows are violated by no more than
/// `tolerance`, active rows have no more slack than that, and the step is stationary to it.
/// @param hessian  the factor of the problem's Hessian
/// @return `optimal` or `iteration_limit`
/// Cost: a pass over the rows, and about 500 multiplications a row with a positive multiplier; noexcept, no
/// allocation.
template <RealScalar Scalar>
QpStatus conclude(const QpProblem<Scalar>& problem, const Ldlt6<Scalar>& hessian, const Vector6<Scalar>& step,
                  const QpMultipliers<Scalar>& multipliers, const Scalar& tolerance, QpSolution<Scalar>& solution) noexcept {
  solution.step = step;
  bool is_optimal = true;
  ConicBasis<Scalar> carrying;
  for (int k = 0; k < problem.row_count; ++k) {
    const Vector6<Scalar> row = problem.rows[std::size_t(k)];
    const Scalar slack = row.dot(step) - problem.bounds[std::size_t(k)];
    if (!(slack >= -tolerance - rounding_of_row(row, step))) is_optimal = false;
    const Scalar& multiplier = multipliers[std::size_t(k)];
    if (multiplier > Scalar(0) && multiplier * row.dot(hessian.solve(row)) > slack) carrying.add(k, row, multiplier);
  }
  for (int i = 0; i < carrying.size(); ++i) {
    const int k = carrying.number(i);
    const Vector6<Scalar> row = problem.rows[std::size_t(k)];
    const Scalar slack = row.dot(step) - problem.bounds[std::size_t(k)];
    if (!(slack <= tolerance + rounding_of_row(row, step))) is_optimal = false;
    solution.active.push_back({k, carrying.weight(i)});
  }
  if (!make_finite(solution)) return QpStatus::iteration_limit;
  return is_optimal && is_stationary(problem, hessian, tolerance, solution) ? QpStatus::optimal : QpStatus::iteration_limit;
}

}  // namespace feeler
