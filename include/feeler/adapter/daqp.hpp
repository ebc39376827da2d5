// The QP solver DAQP as a solver for the renderer.
#pragma once

#include <daqp/api.h>
#include <daqp/constants.h>
#include <daqp/utils.h>

#include <array>
#include <memory>

#include "feeler/adapter/dense_problem.hpp"
#include "feeler/qp/qp_solver.hpp"

namespace feeler {

/// DAQP (github.com/darnstrom/daqp, tried with 0.9.1): a dual active set on a recursive LDLᵀ factor.
///
/// The library's memory is taken once, by the constructor. `infeasible` is the library's word: `conflict` is empty.
class DaqpSolver {
 public:
  using Scalar = double;

  /// Violation of a row that is accepted [m].
  double tolerance = 1e-11;
  int most_iterations = 1000;

  DaqpSolver() : workspace_(new DAQPWorkspace{}) {
    allocate_daqp_workspace(workspace_.get(), 6, 0);
    allocate_daqp_ldp(workspace_.get(), 6, QpProblem<double>::row_capacity, 0, 1, 1);
  }

  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    QpStatus status;
    if (!dense_.begin(problem, tolerance, solution, status)) return status;
    DAQPProblem qp{};
    qp.n = 6;
    qp.m = problem.row_count;
    qp.H = dense_.hessian.data();
    qp.f = dense_.gradient.data();
    qp.A = dense_.rows.data();
    qp.blower = dense_.lower.data();
    qp.bupper = dense_.upper.data();
    DAQPSettings settings;
    daqp_default_settings(&settings);
    settings.primal_tol = tolerance / 2;
    settings.iter_limit = most_iterations;
    workspace_->settings = &settings;
    std::array<double, 6> step{};
    QpMultipliers<double> multipliers{};
    DAQPResult result{};
    result.x = step.data();
    result.lam = multipliers.data();
    reset_daqp_workspace(workspace_.get());  // of the problem before
    constexpr int everything = DAQP_UPDATE_Rinv | DAQP_UPDATE_M | DAQP_UPDATE_v | DAQP_UPDATE_d | DAQP_UPDATE_sense;
    result.exitflag = daqp_update_ldp(everything, workspace_.get(), &qp);
    if (result.exitflag >= 0) daqp_solve(&result, workspace_.get());
    solution.iterations = result.iter;
    if (result.exitflag == DAQP_EXIT_INFEASIBLE) return QpStatus::infeasible;
    return dense_.end(problem, step.data(), multipliers.data(), -1.0, tolerance, solution);
  }

 private:
  struct Release {
    void operator()(DAQPWorkspace* workspace) const noexcept {
      workspace->settings = nullptr;  // not the library's
      free_daqp_workspace(workspace);
      free_daqp_ldp(workspace);
      delete workspace;
    }
  };

  DenseProblem dense_;
  std::unique_ptr<DAQPWorkspace, Release> workspace_;
};

static_assert(QpSolver<DaqpSolver>);

}  // namespace feeler
