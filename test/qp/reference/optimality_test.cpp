#include "feeler/qp/reference/optimality.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>
#include <limits>
#include <random>

#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(optimality)

namespace {

using Problem = feeler::QpProblem<double>;
using Solution = feeler::QpSolution<double>;
using Vector6 = feeler::Vector6<double>;
using feeler::QpStatus;
constexpr double tolerance = 1e-9;

/// What is said of a step with a multiplier for each row.
struct Conclusion {
  Solution solution;
  QpStatus status;

  Conclusion(const Problem& problem, const Vector6& step, const feeler::QpMultipliers<double>& multipliers) {
    feeler::Ldlt6<double> hessian;
    BOOST_TEST_REQUIRE(hessian.factor(problem.hessian));
    status = feeler::conclude(problem, hessian, step, multipliers, tolerance, solution);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_off_its_stationary_point_along_any_axis_to_either_side_is_not_stationary) {
  constexpr unsigned seed = 126;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 50; ++i) {
    const Problem problem = feeler_test::general_problem(bits, 3, i % 3 == 0);
    feeler::Ldlt6<double> hessian;
    BOOST_TEST_REQUIRE(hessian.factor(problem.hessian));
    Solution solution;
    Vector6 force = -problem.gradient;
    for (int k = 0; k < 3; ++k) {
      const double multiplier = feeler_test::fraction(bits);
      solution.active.push_back({k, multiplier});
      force += multiplier * Vector6(problem.rows[std::size_t(k)]);
    }
    const Vector6 stationary = problem.hessian.ldlt().solve(force);
    solution.step = stationary;
    BOOST_TEST(feeler::is_stationary(problem, hessian, tolerance, solution));
    for (int j = 0; j < 6; ++j) {
      for (const double side : {-1.0, 1.0}) {
        solution.step = stationary + 0.5 * side * tolerance * Vector6::Unit(j);
        BOOST_TEST(feeler::is_stationary(problem, hessian, tolerance, solution));
        solution.step = stationary + 2 * side * tolerance * Vector6::Unit(j);
        BOOST_TEST(!feeler::is_stationary(problem, hessian, tolerance, solution));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(rounding_of_a_row_is_that_of_the_largest_coordinate_whichever_it_is) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  Vector6 row;
  row << 1, -2, 4, -8, 16, -32;  // of size 63
  for (int j = 0; j < 6; ++j) {
    for (const double largest : {-4.0, 4.0}) {
      Vector6 x = Vector6::Constant(-0.5);
      x[j] = largest;
      BOOST_TEST(feeler::rounding_of_row(row, x) == 8 * epsilon * 4 * 63);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_number_that_is_none_is_found_wherever_it_is_and_the_count_of_iterations_stays) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (int place = 0; place <= 8; ++place) {
      Solution solution;
      solution.iterations = 7;
      solution.step.setOnes();
      solution.active.push_back({1, 0.5});
      solution.active.push_back({2, 0.5});
      if (place < 6) solution.step[place] = bad;
      else if (place < 8) solution.active[place - 6].multiplier = bad;
      BOOST_TEST(feeler::make_finite(solution) == (place == 8));
      BOOST_TEST(solution.iterations == 7);
      if (place == 8) continue;
      BOOST_TEST(solution.step.isZero(0));
      BOOST_TEST(solution.active.empty());
    }
    std::mt19937 bits(127);
    const Problem fine = feeler_test::general_problem(bits, 2, false);
    BOOST_TEST(feeler::is_finite(fine));
    for (int place = 0; place < 56; ++place) {
      Problem problem = fine;
      if (place < 36) problem.hessian(place / 6, place % 6) = bad;
      else if (place < 42) problem.gradient[place - 36] = bad;
      else if (place < 54) problem.rows[std::size_t((place - 42) / 6)][place % 6] = bad;
      else problem.bounds[std::size_t(place - 54)] = bad;
      BOOST_TEST(!feeler::is_finite(problem));
    }
    Problem behind = fine;  // what lies behind the last row is no part of it
    behind.rows[2][0] = behind.bounds[2] = bad;
    BOOST_TEST(feeler::is_finite(behind));
  }
}

// min ½|x|² + g·x at a wall x₀ ≥ 0, which pushes with λ: stationary where x = λ − g.
BOOST_AUTO_TEST_CASE(a_step_is_optimal_on_its_wall_and_neither_off_it_nor_through_it_nor_with_another_force) {
  const auto status_at = [](double x, double multiplier, double gradient) {
    Problem problem;
    problem.add_row(Vector6::Unit(0), 0.0);
    problem.gradient = gradient * Vector6::Unit(0);
    feeler::QpMultipliers<double> multipliers{};
    multipliers[0] = multiplier;
    return Conclusion(problem, x * Vector6::Unit(0), multipliers).status;
  };
  BOOST_TEST((status_at(0, 1, 1) == QpStatus::optimal));
  BOOST_TEST((status_at(0.5 * tolerance, 1, 1 - 0.5 * tolerance) == QpStatus::optimal));
  BOOST_TEST((status_at(-0.5 * tolerance, 1, 1 + 0.5 * tolerance) == QpStatus::optimal));
  BOOST_TEST((status_at(2 * tolerance, 1, 1 - 2 * tolerance) == QpStatus::iteration_limit));  // it pushes from afar
  BOOST_TEST((status_at(-2 * tolerance, 1, 1 + 2 * tolerance) == QpStatus::iteration_limit));
  BOOST_TEST((status_at(0, 1, 1 + 2 * tolerance) == QpStatus::iteration_limit));
  BOOST_TEST((status_at(0, 1, 1 - 2 * tolerance) == QpStatus::iteration_limit));
  BOOST_TEST((status_at(3, 0, -3) == QpStatus::optimal));
}

BOOST_AUTO_TEST_CASE(a_row_is_active_where_its_multiplier_would_last_for_longer_than_its_slack) {
  Problem problem;
  problem.hessian *= 4;  // so a row's compliance is ¼
  problem.gradient = -4 * Vector6::Unit(0);
  problem.add_row(Vector6::Unit(0), 0.0);  // a slack of 1
  feeler::QpMultipliers<double> multipliers{};
  for (const double multiplier : {-8.0, 0.0, 3.9, 4.1}) {
    multipliers[0] = multiplier;
    const Conclusion conclusion(problem, Vector6::Unit(0), multipliers);
    BOOST_TEST(conclusion.solution.active.size() == (multiplier > 4 ? 1 : 0));
    BOOST_TEST((conclusion.status == QpStatus::optimal) == (multiplier < 4));
  }
}

BOOST_AUTO_TEST_SUITE_END()
