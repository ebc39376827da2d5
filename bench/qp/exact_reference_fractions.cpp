// The exact optimum in fractions, where CGAL is not installed.
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "qp/exact_reference.hpp"
#include "support/multiprecision.hpp"

namespace feeler::qp_families {

std::optional<Vector6<double>> exact_optimum(const QpProblem<double>& problem) {
  using Rational = feeler_test::Rational;
  QpProblem<Rational> fractions;
  fractions.hessian = problem.hessian.cast<Rational>();
  fractions.gradient = problem.gradient.cast<Rational>();
  for (int k = 0; k < problem.row_count; ++k) fractions.add_row(problem.rows[std::size_t(k)].cast<Rational>(), problem.bounds[std::size_t(k)]);
  TextbookActiveSet<Rational> solver;
  QpSolution<Rational> solution;
  if (solver.solve(fractions, solution) != QpStatus::optimal) return std::nullopt;
  return Vector6<double>(solution.step.cast<double>());
}

const char* exact_solver_name() { return "TextbookActiveSet in fractions"; }

}  // namespace feeler::qp_families
