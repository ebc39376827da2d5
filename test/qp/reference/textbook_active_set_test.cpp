#include "feeler/qp/reference/textbook_active_set.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstddef>
#include <random>
#include <set>

#include <Eigen/Dense>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(textbook_active_set)

namespace {

using Problem = feeler::QpProblem<double>;
using Solver = feeler::TextbookActiveSet<double>;
using Solution = feeler::QpSolution<double>;
using Vector6 = feeler::Vector6<double>;
using feeler::QpStatus;

feeler::Matrix6<double> random_axes(std::mt19937& bits) {
  feeler::Matrix6<double> columns;
  for (int j = 0; j < 6; ++j) columns.col(j) = feeler_test::random_six(bits);
  return columns.householderQr().householderQ();
}

}  // namespace

BOOST_AUTO_TEST_CASE(of_parallel_walls_the_farthest_is_the_only_one_to_enter) {
  for (int farthest = 0; farthest < 20; ++farthest) {
    Problem problem;
    for (int k = 0; k < 20; ++k) problem.add_row(Vector6::Unit(0), k == farthest ? 2.0 : 1.0 + 0.01 * k);
    Solution solution;
    BOOST_TEST((Solver().solve(problem, solution) == QpStatus::optimal));
    BOOST_TEST(solution.iterations == 1);
    BOOST_TEST_REQUIRE(solution.active.size() == 1);
    BOOST_TEST(solution.active[0].row == farthest);
    BOOST_TEST(solution.active[0].multiplier == 2.0);
  }
}

BOOST_AUTO_TEST_CASE(an_active_row_that_has_no_part_in_a_conflict_is_not_named) {
  constexpr unsigned seed = 128;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 200; ++i) {
    const auto axes = random_axes(bits);
    Problem problem;
    for (int j = 0; j < 5; ++j) problem.add_row(axes.col(j), 1.0 + 0.1 * j);  // all of them are active
    problem.add_row(-(axes.col(1) + 0.5 * axes.col(3)), -1.0);
    Solution solution;
    BOOST_TEST_REQUIRE((Solver().solve(problem, solution) == QpStatus::infeasible));
    BOOST_TEST((std::set<int>(solution.conflict.begin(), solution.conflict.end()) == std::set{1, 3, 5}));
  }
}

BOOST_AUTO_TEST_CASE(walls_that_overlap_by_what_each_of_them_is_allowed_are_in_doubt_and_not_in_conflict) {
  Solver solver;
  solver.tolerance = 1e-6;
  for (const double by : {0.9, 1.1, 1.9, 2.1}) {
    Problem problem;
    problem.add_row(Vector6::Unit(0), 1.0);
    problem.add_row(-Vector6::Unit(0), -1.0 + by * solver.tolerance);
    Solution solution;
    const QpStatus status = solver.solve(problem, solution);
    BOOST_TEST((status == (by < 1 ? QpStatus::optimal : by < 2 ? QpStatus::iteration_limit : QpStatus::infeasible)));
    BOOST_TEST(solution.conflict.size() == (by < 2 ? 0 : 2));
  }
}

// Rows at 1e-6 rad whose forces are 1e6 times their sum: one solution of their equations is off by a million roundings.
BOOST_AUTO_TEST_CASE(rows_of_a_flat_wedge_are_met_to_rounding) {
  constexpr unsigned seed = 129;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 200; ++i) {
    const auto axes = random_axes(bits);
    Problem problem;
    problem.gradient = -axes.col(0);
    problem.add_row(axes.col(1) - 1e-6 * axes.col(0), -5e-7);
    problem.add_row(-axes.col(1) - 1e-6 * axes.col(0), -5e-7);
    Solution solution;
    BOOST_TEST_REQUIRE((Solver().solve(problem, solution) == QpStatus::optimal));
    BOOST_TEST(solution.active.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) BOOST_TEST(std::abs(problem.rows[k].dot(solution.step) - problem.bounds[k]) < 1e-15);
    BOOST_TEST((solution.step - 0.5 * axes.col(0)).norm() < 1e-8);
  }
}

BOOST_AUTO_TEST_SUITE_END()
