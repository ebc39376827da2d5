// The QP solver DAQP as a solver for the renderer.
#pragma once

#include <daqp/api.h>

#include <array>

#include "feeler/adapter/dense_problem.hpp"
#include "feeler/qp/qp_solver.hpp"

namespace feeler {

/// DAQP (github.com/darnstrom/daqp, tried with 0.9.1): a dual active set on a recursive LDLᵀ factor.
///
/// Takes memory from the heap in every call. `infeasible` is the library's word: `conflict` is empty.
class DaqpSolver {
 public:
  using Scalar = double;

  /// Violation of a row that is accepted [m].
  double tolerance = 1e-11;
  int most_iterations = 1000;

  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    QpStatus status;
    if (!dense_.begin(problem, tolerance, solution, status)) return status;
    std::array<int, std::size_t(QpProblem<double>::row_capacity)> sense{};  // all inequalities
    DAQPProblem qp{};
    qp.n = 6;
    qp.m = problem.row_count;
    qp.H = dense_.hessian.data();
    qp.f = dense_.gradient.data();
    qp.A = dense_.rows.data();
    qp.blower = dense_.lower.data();
    qp.bupper = dense_.upper.data();
    qp.sense = sense.data();
    DAQPSettings settings;
    daqp_default_settings(&settings);
    settings.primal_tol = tolerance / 2;
    settings.iter_limit = most_iterations;
    std::array<double, 6> step{};
    QpMultipliers<double> multipliers{};
    DAQPResult result{};
    result.x = step.data();
    result.lam = multipliers.data();
    daqp_quadprog(&result, &qp, &settings);
    solution.iterations = result.iter;
    if (result.exitflag == DAQP_EXIT_INFEASIBLE) return QpStatus::infeasible;
    return dense_.end(problem, step.data(), multipliers.data(), -1.0, tolerance, solution);
  }

 private:
  DenseProblem dense_;
};

static_assert(QpSolver<DaqpSolver>);

}  // namespace feeler
