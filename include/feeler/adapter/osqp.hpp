// The QP solver OSQP as a solver for the renderer.
#pragma once

#include <osqp/osqp.h>
#include <array>

#include "feeler/adapter/dense_problem.hpp"
#include "feeler/core/index.hpp"
#include "feeler/qp/qp_solver.hpp"

namespace feeler {

/// OSQP (github.com/osqp/osqp, tried with 1.0.0): operator splitting, a first-order method, with a polish at
/// the end.
///
/// Takes memory from the heap in every call. `infeasible` is the library's word: `conflict` is empty.
class OsqpSolver {
 public:
  using Scalar = double;

  /// Violation of a row that is accepted [m].
  double tolerance = 1e-9;
  int most_iterations = 4000;

  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    QpStatus status;
    if (!dense_.begin(problem, tolerance, solution, status)) return status;
    const OSQPInt count = problem.row_count;
    fill_columns(problem);
    OSQPCscMatrix hessian, rows;
    OSQPCscMatrix_set_data(&hessian, 6, 6, 21, upper_triangle_.data(), triangle_rows_.data(), triangle_starts_.data());
    OSQPCscMatrix_set_data(&rows, count, 6, 6 * count, columns_.data(), column_rows_.data(), column_starts_.data());
    OSQPSettings settings;
    osqp_set_default_settings(&settings);
    settings.verbose = 0;
    settings.eps_abs = tolerance / 4;
    settings.eps_rel = 0;
    settings.max_iter = most_iterations;
    settings.polishing = 1;
    OSQPSolver* solver = nullptr;
    if (osqp_setup(&solver, &hessian, dense_.gradient.data(), &rows, dense_.lower.data(), dense_.upper.data(), count, 6, &settings) == 0) {
      osqp_solve(solver);
      solution.iterations = int(solver->info->iter);
      status = solver->info->status_val == OSQP_PRIMAL_INFEASIBLE
                   ? QpStatus::infeasible
                   : dense_.end(problem, solver->solution->x, solver->solution->y, -1.0, tolerance, solution);
    }
    osqp_cleanup(solver);
    return status;
  }

 private:
  /// Both matrices by columns, zeros and all.
  void fill_columns(const QpProblem<double>& problem) noexcept {
    int entry = 0;
    for (int j = 0; j < 6; ++j) {
      triangle_starts_[as_index(j)] = entry;
      for (int i = 0; i <= j; ++i, ++entry) {
        upper_triangle_[as_index(entry)] = problem.hessian(i, j);
        triangle_rows_[as_index(entry)] = i;
      }
    }
    triangle_starts_[6] = entry;
    entry = 0;
    for (int j = 0; j < 6; ++j) {
      column_starts_[as_index(j)] = entry;
      for (int k = 0; k < problem.row_count; ++k, ++entry) {
        columns_[as_index(entry)] = problem.rows[as_index(k)][j];
        column_rows_[as_index(entry)] = k;
      }
    }
    column_starts_[6] = entry;
  }

  DenseProblem dense_;
  std::array<OSQPFloat, 21> upper_triangle_;
  std::array<OSQPInt, 21> triangle_rows_;
  std::array<OSQPInt, 7> triangle_starts_, column_starts_;
  std::array<OSQPFloat, std::size_t(6 * QpProblem<double>::row_capacity)> columns_;
  std::array<OSQPInt, std::size_t(6 * QpProblem<double>::row_capacity)> column_rows_;
};

static_assert(QpSolver<OsqpSolver>);

}  // namespace feeler
