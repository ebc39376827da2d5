// The exact optimum by CGAL, where it is installed.
#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include "qp/exact_reference.hpp"

namespace feeler::qp_families {

std::optional<Vector6<double>> exact_optimum(const QpProblem<double>& problem) {
  CGAL::Quadratic_program<double> program(CGAL::LARGER, false, 0, false,
                                          0);  // rows ≥, variables without bounds
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) program.set_d(i, j, problem.hessian(i, j));  // twice the matrix of the quadratic form
    program.set_c(i, problem.gradient[i]);
  }
  for (int k = 0; k < problem.row_count; ++k) {
    for (int i = 0; i < 6; ++i) program.set_a(i, k, problem.rows[std::size_t(k)][i]);
    program.set_b(k, problem.bounds[std::size_t(k)]);
  }
  CGAL::Quadratic_program_options options;
  options.set_pricing_strategy(CGAL::QP_BLAND);  // others can cycle where rows are degenerate
  const auto solution = CGAL::solve_quadratic_program(program, CGAL::Gmpzf(), options);
  if (!solution.is_optimal()) return std::nullopt;
  Vector6<double> step;
  int i = 0;
  for (auto value = solution.variable_values_begin(); value != solution.variable_values_end(); ++value) step[i++] = CGAL::to_double(*value);
  return step;
}

const char* exact_solver_name() { return "CGAL " CGAL_VERSION_STR ", exact rational arithmetic"; }

}  // namespace feeler::qp_families
