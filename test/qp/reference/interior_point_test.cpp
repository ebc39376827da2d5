#include "feeler/qp/reference/interior_point.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(interior_point)

namespace {

using Problem = feeler::QpProblem<double>;
using Solver = feeler::InteriorPoint<double>;
using Solution = feeler::QpSolution<double>;
using Vector6 = feeler::Vector6<double>;
using feeler::QpStatus;

/// A plate that is pushed onto a floor, at points of chance.
Problem plate(std::mt19937& bits, int points) {
  Problem problem;
  problem.hessian.diagonal() << 1, 1, 1, 1e-3, 1e-3, 1e-3;
  problem.gradient << 0.1, -0.2, 1, 0, 0, 0;
  for (int k = 0; k < points; ++k) {
    const Eigen::Vector3d arm(0.1 * feeler_test::unit(bits), 0.1 * feeler_test::unit(bits), 0);
    Vector6 row;
    row << Eigen::Vector3d::UnitZ(), arm.cross(Eigen::Vector3d::UnitZ());
    problem.add_row(row, 0.0);
  }
  return problem;
}

}  // namespace

BOOST_AUTO_TEST_CASE(some_twelve_iterations_are_enough_whether_4_or_250_rows_are_tight) {
  constexpr unsigned seed = 130;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int most = 0;
  for (int i = 0; i < 60; ++i) {
    const int points = 4 + 41 * (i % 7);
    Solution solution;
    BOOST_TEST((Solver().solve(plate(bits, points), solution) == QpStatus::optimal));
    most = std::max(most, solution.iterations);
  }
  BOOST_TEST_MESSAGE("at most " << most << " iterations");
  BOOST_TEST(most <= 20);
}

BOOST_AUTO_TEST_CASE(a_slot_without_clearance_has_a_step_along_it) {
  constexpr unsigned seed = 131;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 100; ++i) {
    const Vector6 normal = feeler_test::random_six(bits).normalized(), target = feeler_test::random_six(bits);
    const double at = feeler_test::unit(bits);
    Problem problem;
    problem.gradient = -target;
    problem.add_row(normal, at);
    problem.add_row(-normal, -at);
    Solver solver;
    Solution solution;
    BOOST_TEST((solver.solve(problem, solution) == QpStatus::optimal));
    BOOST_TEST((solution.step - (target + (at - normal.dot(target)) * normal)).norm() < 2 * solver.tolerance);
  }
}

BOOST_AUTO_TEST_CASE(a_wall_ten_thousand_kilometres_off_is_met_to_rounding_of_that) {
  for (const double at : {1.0, 1e3, 1e7, 1e10}) {
    Problem problem;
    problem.gradient << -at, 0.3 * at, 0, 0, 0, 0;
    problem.add_row(-Vector6::Unit(0), -0.5 * at);
    problem.add_row((Vector6::Unit(0) + Vector6::Unit(1)).normalized(), 0.0);
    Solution solution;
    BOOST_TEST((Solver().solve(problem, solution) == QpStatus::optimal));
    BOOST_TEST(std::abs(solution.step[0] - 0.5 * at) <= 1e-9 + 1e-13 * at);
    BOOST_TEST(std::abs(solution.step[1] + 0.3 * at) <= 1e-9 + 1e-13 * at);
  }
}

BOOST_AUTO_TEST_CASE(it_ends_after_the_iterations_that_it_may_take_and_says_so) {
  std::mt19937 bits(132);
  const Problem problem = plate(bits, 20);
  for (int most = 0; most < 4; ++most) {
    Solver solver;
    solver.most_iterations = most;
    Solution solution;
    BOOST_TEST((solver.solve(problem, solution) == QpStatus::iteration_limit));
    BOOST_TEST(solution.iterations == most);
    BOOST_TEST(solution.step.allFinite());
  }
}

BOOST_AUTO_TEST_SUITE_END()
