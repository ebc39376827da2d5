#include "feeler/qp/reference/projected_gauss_seidel.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(projected_gauss_seidel)

namespace {

using Solver = feeler::ProjectedGaussSeidel<double>;
using Solution = feeler::QpSolution<double>;
using Vector6 = feeler::Vector6<double>;
using feeler::QpStatus;

/// min ½|x|² with a wall at x₀ = 1: the step is the multiplier.
feeler::QpProblem<double> wall() {
  feeler::QpProblem<double> problem;
  problem.add_row(Vector6::Unit(0), 1.0);
  return problem;
}

}  // namespace

// A sweep over one row leaves 1 − r of what is lacking, with the other sign where r is above 1.
BOOST_AUTO_TEST_CASE(after_some_sweeps_over_one_row_the_step_is_a_power_of_the_relaxation_short_of_it) {
  for (const double relaxation : {0.25, 0.5, 1.3, 1.75}) {
    for (int sweeps = 1; sweeps <= 8; ++sweeps) {
      Solver solver;
      solver.relaxation = relaxation;
      solver.sweeps = sweeps;
      Solution solution;
      BOOST_TEST((solver.solve(wall(), solution) == QpStatus::iteration_limit));
      BOOST_TEST(solution.iterations == sweeps);
      BOOST_TEST(std::abs(solution.step[0] - (1 - std::pow(1 - relaxation, sweeps))) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(sweeps_go_on_until_none_moves_a_row_by_an_eighth_of_the_tolerance_to_either_side) {
  for (const double relaxation : {0.5, 0.9, 1.1, 1.3, 1.5}) {
    Solver solver;
    solver.relaxation = relaxation;
    Solution solution;
    BOOST_TEST((solver.solve(wall(), solution) == QpStatus::optimal));
    int moves = 1;  // of which the last one is short enough
    for (double way = relaxation; way > solver.tolerance / 8; way *= std::abs(1 - relaxation)) ++moves;
    BOOST_TEST(solution.iterations == moves);
    BOOST_TEST(std::abs(solution.step[0] - 1) < solver.tolerance);
  }
}

BOOST_AUTO_TEST_CASE(a_row_of_zeros_may_ask_for_the_tolerance_and_no_more) {
  for (const double share : {-1.0, 0.0, 0.5, 2.0}) {
    Solver solver;
    feeler::QpProblem<double> problem = wall();
    problem.add_row(Vector6::Zero(), share * solver.tolerance);
    Solution solution;
    const QpStatus status = solver.solve(problem, solution);
    BOOST_TEST((status == (share > 1 ? QpStatus::infeasible : QpStatus::optimal)));
    BOOST_TEST(solution.conflict.size() == (share > 1 ? 1 : 0));
    if (share > 1) BOOST_TEST(solution.conflict[0] == 1);
  }
}

BOOST_AUTO_TEST_SUITE_END()
