// Solvers with 50 decimal digits keep the laws, and one with fractions is exact.
#include "support/multiprecision.hpp"

#include <boost/test/unit_test.hpp>

#include <tuple>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "support/qp_laws.hpp"
#include "support/qp_promises.hpp"

BOOST_AUTO_TEST_SUITE(qp_multiprecision)

using feeler_test::Float50;
using feeler_test::Rational;

namespace {

using Solvers = std::tuple<feeler::DualActiveSet<Float50>, feeler::TextbookActiveSet<Float50>, feeler::InteriorPoint<Float50>,
                           feeler::ProjectedGaussSeidel<Float50>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(every_answer_in_50_digits_obeys_the_laws_of_a_qp_solver, Solver, Solvers) {
  feeler_test::check_qp_laws<Solver>(14, 20, feeler_test::promise_of<Solver>());
}

BOOST_AUTO_TEST_CASE(fractions_give_an_answer_that_is_exactly_optimal_or_exactly_in_conflict) {
  constexpr unsigned seed = 15;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::TextbookActiveSet<Rational> solver;
  feeler::QpSolution<Rational> solution;
  int optimal = 0, infeasible = 0;
  for (int i = 0; i < 60; ++i) {
    const auto rounded = feeler_test::random_problem<double>(bits, i % feeler_test::random_problem_families, 1);
    feeler::QpProblem<Rational> problem;
    problem.hessian = rounded.hessian.cast<Rational>();
    problem.gradient = rounded.gradient.cast<Rational>();
    for (int k = 0; k < rounded.row_count; ++k) problem.add_row(rounded.rows[std::size_t(k)].cast<Rational>(), rounded.bounds[std::size_t(k)]);
    const feeler::QpStatus status = solver.solve(problem, solution);
    if (status == feeler::QpStatus::infeasible) {
      ++infeasible;
      BOOST_TEST(solution.conflict.size() >= 2);
      continue;
    }
    BOOST_TEST_REQUIRE((status == feeler::QpStatus::optimal));
    ++optimal;
    feeler::Vector6<Rational> force = -(problem.hessian * solution.step + problem.gradient);
    for (const auto& active : solution.active) {
      const auto row = std::size_t(active.row);
      BOOST_TEST((active.multiplier >= 0));
      BOOST_TEST((problem.rows[row].dot(solution.step) == problem.bounds[row]));
      force += active.multiplier * problem.rows[row];
    }
    BOOST_TEST((force == feeler::Vector6<Rational>::Zero()));
    for (int k = 0; k < problem.row_count; ++k) BOOST_TEST((problem.rows[std::size_t(k)].dot(solution.step) >= problem.bounds[std::size_t(k)]));
  }
  BOOST_TEST(optimal > 30);
  BOOST_TEST(infeasible > 0);
}

BOOST_AUTO_TEST_SUITE_END()
