// The QP solver ProxQP of ProxSuite as a solver for the renderer.
#pragma once

#include <proxsuite/proxqp/dense/dense.hpp>

#include "feeler/adapter/dense_problem.hpp"
#include "feeler/qp/qp_solver.hpp"

namespace feeler {

/// ProxQP (github.com/Simple-Robotics/proxsuite, tried with 0.7.2): a primal–dual augmented Lagrangian
/// method.
///
/// Takes memory from the heap in every call. `infeasible` is the library's word: `conflict` is empty.
class ProxQpSolver {
 public:
  using Scalar = double;

  /// Violation of a row that is accepted [m].
  double tolerance = 1e-9;
  int most_iterations = 100;  ///< outer ones, and inner ones of each

  QpStatus solve(const QpProblem<double>& problem, QpSolution<double>& solution) noexcept {
    QpStatus status;
    if (!dense_.begin(problem, tolerance, solution, status)) return status;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const int count = problem.row_count;
    proxsuite::proxqp::dense::QP<double> qp(6, 0, count);
    qp.settings.eps_abs = tolerance / 4;
    qp.settings.eps_rel = 0;
    qp.settings.eps_primal_inf = 1e-12;  // the default of 1e-4 takes flat wedges for infeasible
    qp.settings.max_iter = most_iterations;
    qp.settings.max_iter_in = most_iterations;
    qp.init(Eigen::Map<const RowMajor>(dense_.hessian.data(), 6, 6), Eigen::Map<const Eigen::VectorXd>(dense_.gradient.data(), 6), proxsuite::nullopt,
            proxsuite::nullopt, Eigen::Map<const RowMajor>(dense_.rows.data(), count, 6),
            Eigen::Map<const Eigen::VectorXd>(dense_.lower.data(), count), Eigen::Map<const Eigen::VectorXd>(dense_.upper.data(), count));
    qp.solve();
    solution.iterations = int(qp.results.info.iter);
    if (qp.results.info.status == proxsuite::proxqp::QPSolverOutput::PROXQP_PRIMAL_INFEASIBLE) return QpStatus::infeasible;
    return dense_.end(problem, qp.results.x.data(), qp.results.z.data(), -1.0, tolerance, solution);
  }

 private:
  DenseProblem dense_;
};

static_assert(QpSolver<ProxQpSolver>);

}  // namespace feeler
