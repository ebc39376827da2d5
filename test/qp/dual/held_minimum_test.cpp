#include "feeler/qp/dual/held_minimum.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "feeler/qp/dual_active_set.hpp"
#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(held_minimum)

namespace {

using Problem = feeler::QpProblem<double>;
using feeler::WarmStart;
using feeler_test::general_problem;
using feeler_test::random_six;
using Vector6 = feeler::Vector6<double>;

WarmStart first_rows(int count) {
  WarmStart start;
  for (int k = 0; k < count; ++k) start.rows.push_back(k);
  return start;
}

/// A minimum, and whether it was found.
template <int lanes>
struct AttemptInLanes {
  feeler::detail::HeldMinimum<double, lanes> minimum, placed;  // the second by the multipliers of the first
  bool is_found = false;

  AttemptInLanes(const Problem& problem, const WarmStart& start) {
    const feeler_test::Quadratic f(problem);
    const double* bounds = problem.bounds.data();
    is_found = minimum.find(problem, bounds, start, f.hessian, f.gradient);
    const auto no_change = [](const auto&) { return feeler::detail::Six<double>{}; };
    if (is_found) placed.place(problem, bounds, start, minimum.multipliers(), f.hessian, f.gradient, no_change, 0.0);
  }
};
using Attempt = AttemptInLanes<4>;

void check_same_bits(const auto& minimum, const auto& other, int rows) {
  BOOST_TEST((minimum.x() == other.x()));
  BOOST_TEST((minimum.force() == other.force()));
  for (std::size_t k = 0; k < std::size_t(rows); ++k) {
    BOOST_TEST(minimum.multipliers()[k] == other.multipliers()[k]);
    BOOST_TEST(minimum.lacking()[k] == other.lacking()[k]);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_minimum_and_its_multipliers_solve_the_whole_system_of_equations) {
  constexpr unsigned seed = 41;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int found = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const int rows = 1 + i % 6;
    const Problem problem = general_problem(bits, rows, i % 4 == 0);
    // [H −Nᵀ; N 0] [x; λ] = [−g; b], by an LU factor with full pivoting.
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(6 + rows, 6 + rows);
    Eigen::VectorXd right(6 + rows);
    system.topLeftCorner<6, 6>() = problem.hessian;
    right.head<6>() = -problem.gradient;
    for (int k = 0; k < rows; ++k) {
      const Vector6 row = problem.rows[std::size_t(k)];
      system.block<6, 1>(0, 6 + k) = -row;
      system.block<1, 6>(6 + k, 0) = row.transpose();
      right[6 + k] = problem.bounds[std::size_t(k)];
    }
    const Eigen::VectorXd expected = system.fullPivLu().solve(right);
    const Attempt attempt(problem, first_rows(rows));
    const double least = expected.tail(rows).minCoeff();
    if (!attempt.is_found) {
      // Rows of chance are sometimes nearly dependent.
      if (least > 1e-9) ++refused;
      continue;
    }
    ++found;
    BOOST_TEST(least > -1e-9 * expected.norm());
    const double tolerance = 1e-9 * (1 + expected.norm());
    for (std::size_t j = 0; j < 6; ++j) {
      BOOST_TEST(std::abs(attempt.minimum.x()[j] - expected[Eigen::Index(j)]) < tolerance);
      BOOST_TEST(std::abs(attempt.placed.x()[j] - expected[Eigen::Index(j)]) < tolerance);
      double force = 0;
      for (int k = 0; k < rows; ++k) force += attempt.minimum.multipliers()[std::size_t(k)] * problem.rows[std::size_t(k)][Eigen::Index(j)];
      BOOST_TEST(std::abs(attempt.minimum.force()[j] - force) < 1e-12 * (1 + std::abs(force)) + 1e-14 * expected.norm());
    }
    for (int k = 0; k < rows; ++k) {
      BOOST_TEST(std::abs(attempt.minimum.multipliers()[std::size_t(k)] - expected[6 + k]) < tolerance);
      BOOST_TEST(attempt.placed.multipliers()[std::size_t(k)] == attempt.minimum.multipliers()[std::size_t(k)]);
      BOOST_TEST(std::abs(attempt.placed.lacking()[std::size_t(k)]) < tolerance);
    }
  }
  BOOST_TEST(found > 500);
  BOOST_TEST(refused < found / 10);
}

BOOST_AUTO_TEST_CASE(rows_are_met_to_nine_digits_also_where_large_forces_cancel) {
  constexpr unsigned seed = 42;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    const int rows = 1 + i % 6;
    Problem problem = general_problem(bits, rows, i % 4 == 0);
    // As large as the forces, or smaller by up to eighteen digits: then rounding of the forces is larger than x.
    const double size = std::pow(10.0, -(i % 19));
    problem.gradient.setZero();
    for (int k = 0; k < rows; ++k) {
      problem.bounds[std::size_t(k)] *= size;
      problem.gradient += (0.1 + feeler_test::fraction(bits)) * Vector6(problem.rows[std::size_t(k)]);
    }
    problem.gradient += size * random_six(bits);
    const Attempt attempt(problem, first_rows(rows));
    if (!attempt.is_found) continue;
    ++found;
    const Eigen::Map<const Vector6> x(attempt.minimum.x().data());
    for (int k = 0; k < rows; ++k) {
      const double lacking = problem.bounds[std::size_t(k)] - problem.rows[std::size_t(k)].dot(x);
      const double rounding = 1e-15 * (std::abs(problem.bounds[std::size_t(k)]) + problem.rows[std::size_t(k)].norm() * x.norm());
      BOOST_TEST(std::abs(lacking) <= 1e-9 * x.lpNorm<Eigen::Infinity>());
      BOOST_TEST(std::abs(lacking - attempt.minimum.lacking()[std::size_t(k)]) <= rounding);
    }
  }
  BOOST_TEST(found > 10'000);
}

BOOST_AUTO_TEST_CASE(every_number_of_lanes_finds_the_same_bits) {
  constexpr unsigned seed = 43;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    const int rows = i % 7;
    const Problem problem = general_problem(bits, rows, i % 4 == 0);
    const AttemptInLanes<1> one(problem, first_rows(rows));
    const AttemptInLanes<2> two(problem, first_rows(rows));
    const AttemptInLanes<4> four(problem, first_rows(rows));
    BOOST_TEST_REQUIRE(one.is_found == two.is_found);
    BOOST_TEST_REQUIRE(one.is_found == four.is_found);
    if (!one.is_found) continue;
    ++found;
    check_same_bits(one.minimum, two.minimum, rows);
    check_same_bits(one.minimum, four.minimum, rows);
    check_same_bits(one.placed, two.placed, rows);
    check_same_bits(one.placed, four.placed, rows);
  }
  BOOST_TEST(found > 500);
}

BOOST_AUTO_TEST_CASE(a_row_that_pulls_depends_on_others_or_does_not_exist_is_refused) {
  Problem problem;  // min ½|x|², from 0
  problem.add_row(Vector6::Unit(0), 1.0);
  problem.add_row(Vector6::Unit(0) + 1e-3 * Vector6::Unit(1), 1.0);
  problem.add_row(Vector6::Unit(2), -1.0);
  const auto finds = [&](const std::vector<int>& rows) {
    WarmStart start;
    for (const int row : rows) start.rows.push_back(row);
    return Attempt(problem, start).is_found;
  };
  BOOST_TEST(finds({0}));
  BOOST_TEST(!finds({0, 1}));
  BOOST_TEST(!finds({0, 0}));
  BOOST_TEST(!finds({2}));
  BOOST_TEST(!finds({0, 2}));
  BOOST_TEST(!finds({3}));
  BOOST_TEST(!finds({-1}));
  problem.bounds[2] = 0.0;  // holds it with no force
  BOOST_TEST(finds({2, 0}));
}

BOOST_AUTO_TEST_CASE(a_guess_that_overflows_is_no_answer) {
  constexpr double huge = std::numeric_limits<double>::max();
  feeler::DualActiveSet<double> solver;
  for (const double size : {huge, huge / 4, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (const bool is_in_bound : {false, true}) {
      Problem problem;
      problem.hessian *= 0.25;
      if (is_in_bound) problem.add_row(Vector6::Unit(0) * 1e-3, size);
      else problem.add_row(Vector6::Unit(0), 1.0);
      if (!is_in_bound) problem.gradient = Vector6::Constant(size);
      feeler::QpSolution<double> solution;
      const auto status = solver.solve(problem, first_rows(1), solution);
      BOOST_TEST(solution.step.allFinite());
      for (const auto& active : solution.active) BOOST_TEST(std::isfinite(active.multiplier));
      if (!std::isfinite(size)) BOOST_TEST((status != feeler::QpStatus::optimal));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
