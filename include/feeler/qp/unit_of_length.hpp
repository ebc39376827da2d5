// A quadratic program and its solution, with lengths in another unit.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// The first three variables are lengths and the others angles, so the rows have arms, bounds and multipliers are lengths, and what is minimised is a
/// square of one.
/// @param unit  the new one, in the old one; where it is a power of two no digit changes
template <class Scalar>
void change_unit_of_length(QpProblem<Scalar>& problem, Scalar unit) noexcept {
  if (unit == Scalar(1)) return;
  const Scalar units = Scalar(1) / unit;
  for (int k = 0; k < problem.row_count; ++k) {
    problem.rows[std::size_t(k)].template tail<3>() *= units;
    problem.bounds[std::size_t(k)] *= units;
  }
  Vector6<Scalar> scale;
  scale << Vector3<Scalar>::Ones(), Vector3<Scalar>::Constant(units);
  problem.hessian = scale.asDiagonal() * problem.hessian * scale.asDiagonal();
  problem.gradient = units * scale.cwiseProduct(problem.gradient);
}
template <class Scalar>
void change_unit_of_length(QpSolution<Scalar>& solution, Scalar unit) noexcept {
  if (unit == Scalar(1)) return;
  const Scalar units = Scalar(1) / unit;
  solution.step.template head<3>() *= units;
  for (auto& active : solution.active) active.multiplier *= units;
}

}  // namespace feeler
