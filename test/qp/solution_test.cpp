#include "feeler/qp/solution.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <random>
#include <set>
#include <tuple>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(solution)

using Solvers = std::tuple<feeler::DualActiveSet<double>, feeler::TextbookActiveSet<double>, feeler::InteriorPoint<double>>;

// A simplex turned inside out: any six of its walls meet in a point, and all seven nowhere.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_conflict_of_seven_rows_is_named_whole, Solver, Solvers) {
  constexpr unsigned seed = 144;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 40; ++i) {
    feeler::QpProblem<double> problem;
    feeler::Vector6<double> sum = feeler::Vector6<double>::Zero();
    double asked = 0;
    for (int k = 0; k < 6; ++k) {
      feeler::Vector6<double> row = feeler::Vector6<double>::Unit(k) + 0.2 * feeler_test::random_six(bits);
      problem.add_row(row, feeler_test::unit(bits));
      const double weight = 0.5 + feeler_test::fraction(bits);
      sum += weight * row;
      asked += weight * problem.bounds[std::size_t(k)];
    }
    problem.add_row(-sum, 1 - asked);
    for (int k = 0; k < (i % 2) * 30; ++k) problem.add_row(feeler_test::random_six(bits), -1e3);  // and walls that are far off
    Solver solver;
    feeler::QpSolution<double> found;
    BOOST_TEST_REQUIRE((solver.solve(problem, found) == feeler::QpStatus::infeasible));
    BOOST_TEST((std::set<int>(found.conflict.begin(), found.conflict.end()) == std::set{0, 1, 2, 3, 4, 5, 6}));
  }
}

BOOST_AUTO_TEST_SUITE_END()
