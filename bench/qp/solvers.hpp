// The QP solvers that the study and the benchmark compare, and those of other libraries where the build found
// them.
#pragma once

#include <memory>
#include <string>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "feeler/qp/warm_start.hpp"
#ifdef FEELER_HAS_DAQP
#include "feeler/adapter/daqp.hpp"
#endif
#ifdef FEELER_HAS_OSQP
#include "feeler/adapter/osqp.hpp"
#endif
#ifdef FEELER_HAS_PROXSUITE
#include "feeler/adapter/proxsuite.hpp"
#endif
#ifdef FEELER_HAS_QPOASES
#include "feeler/adapter/qpoases.hpp"
#endif

namespace feeler::qp_families {

/// A name, and a solver that is made anew for every family, because units differ.
template <class Solver>
struct NamedSolver {
  std::string name;

  /// With its tolerance in units of a family.
  std::unique_ptr<Solver> make(double metres_per_unit) const {
    auto solver = std::make_unique<Solver>();
    solver->tolerance /= metres_per_unit;
    return solver;
  }
  /// What the solver states for its rows [m].
  double tolerance() const { return make(1.0)->tolerance; }
};

template <class Visit>
void for_every_solver(const Visit& visit) {
  visit(NamedSolver<DualActiveSet<double>>{"DualActiveSet"});
  visit(NamedSolver<TextbookActiveSet<double>>{"TextbookActiveSet"});
  visit(NamedSolver<InteriorPoint<double>>{"InteriorPoint"});
  visit(NamedSolver<ProjectedGaussSeidel<double>>{"ProjectedGaussSeidel"});
#ifdef FEELER_HAS_DAQP
  visit(NamedSolver<DaqpSolver>{"DAQP"});
#endif
#ifdef FEELER_HAS_QPOASES
  visit(NamedSolver<QpOasesSolver>{"qpOASES"});
#endif
#ifdef FEELER_HAS_PROXSUITE
  visit(NamedSolver<ProxQpSolver>{"ProxQP"});
#endif
#ifdef FEELER_HAS_OSQP
  visit(NamedSolver<OsqpSolver>{"OSQP"});
#endif
}

/// Gauss–Seidel with another bound on its time.
template <int Sweeps>
struct GaussSeidelOfSweeps : ProjectedGaussSeidel<double> {
  GaussSeidelOfSweeps() { sweeps = Sweeps; }
};

/// Solvers with other settings than their own, which show what accuracy costs.
template <class Visit>
void for_every_variant(const Visit& visit) {
  visit(NamedSolver<GaussSeidelOfSweeps<10>>{"ProjectedGaussSeidel of 10 sweeps"});
  visit(NamedSolver<GaussSeidelOfSweeps<250>>{"ProjectedGaussSeidel of 250 sweeps"});
}

/// Forgets what a solver kept for a warm start, where it has one: a member `reset()`.
template <class Solver>
void make_cold(Solver& solver) {
  if constexpr (requires { solver.reset(); }) solver.reset();
}
/// Whether a solver is told where to begin.
template <class Solver>
constexpr bool takes_warm_start = requires(Solver& solver, const QpProblem<double>& problem, QpSolution<double>& solution) {
  solver.solve(problem, WarmStart(solution), solution);
};
/// Whether it is, or begins where it ended.
template <class Solver>
constexpr bool has_warm_start = takes_warm_start<Solver> || requires(Solver& solver) { solver.reset(); };

}  // namespace feeler::qp_families
