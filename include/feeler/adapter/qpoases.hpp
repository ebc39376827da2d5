// The QP solver qpOASES as a solver for the renderer.
#pragma once

#include <array>
#include <qpOASES.hpp>

#include "feeler/adapter/dense_problem.hpp"
#include "feeler/qp/qp_solver.hpp"

namespace feeler {

/// qpOASES (github.com/coin-or/qpOASES, tried with 3.2.2): a primal active set that follows a path of
/// parameters.
///
/// Takes memory from the heap in every call. `infeasible` is the library's word: `conflict` is empty.
class QpOasesSolver {
 public:
  using Scalar = double;

  /// Violation of a row that is accepted [m].
  double tolerance = 1e-9;
  int most_iterations = 1000;

  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    QpStatus status;
    if (!dense_.begin(problem, tolerance, solution, status)) return status;
    qpOASES::QProblem qp(6, problem.row_count, qpOASES::HST_POSDEF);
    qpOASES::Options options;
    options.setToReliable();
    options.printLevel = qpOASES::PL_NONE;
    qp.setOptions(options);
    qpOASES::int_t iterations = most_iterations;
    qp.init(dense_.hessian.data(), dense_.gradient.data(), dense_.rows.data(), nullptr, nullptr, dense_.lower.data(), nullptr, iterations);
    solution.iterations = int(iterations);
    if (qp.isInfeasible() == qpOASES::BT_TRUE) return QpStatus::infeasible;
    std::array<double, 6> step{};
    std::array<double, std::size_t(6 + QpProblem<double>::row_capacity)> multipliers{};  // of the variables' bounds, then of the rows
    qp.getPrimalSolution(step.data());
    qp.getDualSolution(multipliers.data());
    return dense_.end(problem, step.data(), multipliers.data() + 6, 1.0, tolerance, solution);
  }

 private:
  DenseProblem dense_;
};

static_assert(QpSolver<QpOasesSolver>);

}  // namespace feeler
