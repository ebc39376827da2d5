#include "feeler/qp/held_minimum.hpp"

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
struct Attempt {
  feeler::detail::HeldMinimum<double> minimum, placed;  // the second by the multipliers of the first
  bool is_found = false;

  Attempt(const Problem& problem, const WarmStart& start) {
    const feeler_test::Quadratic f(problem);
    is_found = minimum.find(problem, problem.bounds.data(), start, f.hessian, f.gradient);
    if (is_found) placed.place(problem, problem.bounds.data(), start, minimum.multipliers(), f.hessian, f.gradient);
  }
};

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
    }
    for (int k = 0; k < rows; ++k) {
      BOOST_TEST(std::abs(attempt.minimum.multipliers()[std::size_t(k)] - expected[6 + k]) < tolerance);
      for (int j = 0; j < 6; ++j) BOOST_TEST(attempt.minimum.normal(k)[std::size_t(j)] == problem.rows[std::size_t(k)][j]);
      BOOST_TEST(attempt.placed.multipliers()[std::size_t(k)] == attempt.minimum.multipliers()[std::size_t(k)]);
      BOOST_TEST((attempt.placed.normal(k) == attempt.minimum.normal(k)));
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
  for (int i = 0; i < 2000; ++i) {
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
  BOOST_TEST(found > 1000);
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
