#include "feeler/qp/dual/solution_pair.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Dense>

#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(solution_pair)

namespace {

using Problem = feeler::QpProblem<double>;
using Six = feeler::detail::Six<double>;
using feeler_test::in_six;
using Vector6 = feeler::Vector6<double>;
constexpr int lanes = 2;
using Pair = feeler::detail::SolutionPair<double, lanes>;

Vector6 at(const Pair& pair) { return Eigen::Map<const Vector6>(pair.x().data()); }

/// A problem, and a pair in it.
struct Held {
  Problem problem;
  feeler_test::Quadratic f;
  Pair pair;

  Held(std::mt19937& bits, int rows, bool is_diagonal, bool is_careful) : problem(feeler_test::general_problem(bits, rows, is_diagonal)), f(problem) {
    f.hessian.invert();
    pair.reset(f.hessian, f.gradient, is_careful);
  }
  /// Holds a row with equality, whatever the sign of its force.
  void hold(int row) {
    const Six a = in_six(problem.rows[std::size_t(row)]);
    pair.operators().apply(a);
    const double slope = pair.slope_along(a), step = (problem.bounds[std::size_t(row)] - feeler::detail::dot(a, pair.x())) / slope;
    pair.move(step);
    pair.add(row, a, step, slope);
  }
  /// The minimum on the active rows and their forces, by an LU factor of all equations.
  Eigen::VectorXd expected() const {
    const int rows = pair.rows().size();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(6 + rows, 6 + rows);
    Eigen::VectorXd right(6 + rows);
    system.topLeftCorner<6, 6>() = problem.hessian;
    right.head<6>() = -problem.gradient;
    for (int i = 0; i < rows; ++i) {
      const auto k = std::size_t(pair.rows()[i]);
      system.block<6, 1>(0, 6 + i) = -Vector6(problem.rows[k]);
      system.block<1, 6>(6 + i, 0) = Vector6(problem.rows[k]).transpose();
      right[6 + i] = problem.bounds[k];
    }
    return system.fullPivLu().solve(right);
  }
  void check() const {
    const Eigen::VectorXd wanted = expected();
    const double tolerance = 1e-8 * (1 + wanted.norm());
    BOOST_TEST((at(pair) - wanted.head<6>()).norm() < tolerance);
    for (int i = 0; i < pair.rows().size(); ++i) BOOST_TEST(std::abs(pair.multipliers()[std::size_t(i)] - wanted[6 + i]) < tolerance);
  }
  double least_force() const { return expected().tail(pair.rows().size()).minCoeff(); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(rows_that_are_held_and_dropped_leave_the_minimum_on_those_that_are_left) {
  constexpr unsigned seed = 110;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int dropped = 0;
  for (int i = 0; i < 600; ++i) {
    Held held(bits, 5, i % 3 == 0, i % 2 == 0);
    held.check();
    for (int k = 0; k < 1 + i % 5; ++k) {
      held.hold(k);
      BOOST_TEST(held.pair.has(k));
      held.check();
    }
    const int before = held.pair.rows().size();
    held.pair.drop_negative();
    dropped += before - held.pair.rows().size();
    held.check();
    for (int k = 0; k < held.pair.rows().size(); ++k) BOOST_TEST(held.pair.multipliers()[std::size_t(k)] >= 0);
  }
  BOOST_TEST(dropped > 300);
}

BOOST_AUTO_TEST_CASE(one_step_of_newton_from_anywhere_ends_at_the_minimum_on_the_rows_and_no_row_pulls) {
  constexpr unsigned seed = 111;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int kept = 0, dropped = 0;
  for (int i = 0; i < 600; ++i) {
    Held held(bits, 5, i % 3 == 0, i % 2 == 0);
    const int rows = 1 + i % 4;
    for (int k = 0; k < rows; ++k) held.hold(k);
    const bool pulls = held.least_force() < 0;
    // Off its place, by a step across some row and a force that is too large.
    held.pair.operators().apply(in_six(feeler_test::random_six(bits)));
    held.pair.move(0.3);
    Six residual, lacking{};
    const Vector6 x = at(held.pair);
    Vector6 off = held.problem.hessian * x + held.problem.gradient;
    for (int k = 0; k < rows; ++k) {
      const auto row = std::size_t(held.pair.rows()[k]);
      off -= held.pair.multipliers()[std::size_t(k)] * Vector6(held.problem.rows[row]);
      held.problem.bounds[row] += 0.01 * feeler_test::unit(bits);
      lacking[std::size_t(k)] = held.problem.bounds[row] - held.problem.rows[row].dot(x);
    }
    residual = in_six(off);
    held.pair.correct(lacking, residual);
    held.check();
    for (int k = 0; k < held.pair.rows().size(); ++k) BOOST_TEST(held.pair.multipliers()[std::size_t(k)] >= 0);
    if (held.pair.rows().size() == rows) ++kept;
    else if (pulls) ++dropped;
  }
  BOOST_TEST(kept > 100);
  BOOST_TEST(dropped > 100);
}

BOOST_AUTO_TEST_CASE(a_row_that_is_a_sum_of_active_ones_is_told_apart_from_one_that_is_not_and_no_share_is_positive) {
  constexpr unsigned seed = 112;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i) {
    Held held(bits, 5, i % 3 == 0, false);
    const int rows = 1 + i % 5;
    Six wanted{};
    Vector6 sum = Vector6::Zero();
    for (int k = 0; k < rows; ++k) {
      held.hold(k);
      wanted[std::size_t(k)] = -feeler_test::fraction(bits);
      sum += wanted[std::size_t(k)] * Vector6(held.problem.rows[std::size_t(k)]);
    }
    const auto expand = [&](const Vector6& row, Six& shares) {
      Six rest;
      held.pair.operators().apply(in_six(row));
      const bool is_sum = held.pair.expand(in_six(row), shares, rest);
      Vector6 left = row;
      for (int k = 0; k < rows; ++k) {
        BOOST_TEST(shares[std::size_t(k)] <= 0);
        left -= shares[std::size_t(k)] * Vector6(held.problem.rows[std::size_t(k)]);
      }
      BOOST_TEST((left - Eigen::Map<const Vector6>(rest.data())).norm() < 1e-12 * (1 + row.norm()));
      return is_sum;
    };
    Six shares{};
    BOOST_TEST(expand(sum, shares));
    for (std::size_t k = 0; k < std::size_t(rows); ++k) BOOST_TEST(std::abs(shares[k] - wanted[k]) < 1e-7);
    shares = {};
    BOOST_TEST(!expand(sum + 1e-6 * feeler_test::random_six(bits), shares));
    shares = {};
    BOOST_TEST(!expand(sum + 2 * Vector6(held.problem.rows[0]), shares));  // of which one share were positive
    BOOST_TEST(shares[0] == 0);
  }
}

// One expansion leaves what the operators are off by, which is far more than rounding where active rows make an angle of 1e-5 rad.
BOOST_AUTO_TEST_CASE(a_sum_of_rows_that_all_but_depend_on_each_other_is_seen_to_be_one) {
  constexpr unsigned seed = 152;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 300; ++i) {
    Held held(bits, 4, i % 3 == 0, false);
    for (std::size_t k = 1; k < 4; ++k) held.problem.rows[k] = Vector6(held.problem.rows[0]) + 1e-5 * feeler_test::random_six(bits);
    Vector6 sum = Vector6::Zero();
    for (int k = 0; k < 4; ++k) {
      held.hold(k);
      sum -= (0.1 + feeler_test::fraction(bits)) * Vector6(held.problem.rows[std::size_t(k)]);
    }
    Six shares{}, rest;
    held.pair.operators().apply(in_six(sum));
    BOOST_TEST(held.pair.expand(in_six(sum), shares, rest));
    BOOST_TEST(feeler::detail::norm1(rest) < 1e-12 * sum.lpNorm<1>());
  }
}

BOOST_AUTO_TEST_CASE(a_coordinate_or_a_force_that_is_no_number_is_seen) {
  std::mt19937 bits(113);
  Held held(bits, 3, true, false);
  for (int k = 0; k < 3; ++k) held.hold(k);
  BOOST_TEST(held.pair.is_finite());
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Pair pushed = held.pair;
    pushed.operators().apply(in_six(Vector6(held.problem.rows[1])));  // which moves no coordinate, and one force
    pushed.move_multipliers(bad);
    BOOST_TEST(!pushed.is_finite());
    Pair moved = held.pair;
    moved.operators().apply(in_six(feeler_test::random_six(bits)));
    moved.move(bad);
    BOOST_TEST(!moved.is_finite());
  }
}

BOOST_AUTO_TEST_CASE(the_first_force_to_end_within_a_step_ends_it_and_none_that_grows_does) {
  constexpr unsigned seed = 114;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int ended = 0;
  for (int i = 0; i < 300; ++i) {
    Held held(bits, 5, i % 3 == 0, false);
    for (int k = 0; k < 1 + i % 5; ++k) held.hold(k);
    held.pair.drop_negative();
    if (held.pair.rows().empty()) continue;
    held.pair.operators().apply(in_six(feeler_test::random_six(bits)));
    const double asked = 3 * feeler_test::fraction(bits);
    double step = asked;
    const int leaving = held.pair.first_to_leave(step);
    // No force is negative after a step that much shorter, and one is zero.
    int expected = -1;
    double shortest = asked;
    for (int k = 0; k < held.pair.rows().size(); ++k) {
      const double share = held.pair.operators().image().share[std::size_t(k)], end = held.pair.multipliers()[std::size_t(k)] / share;
      if (share > 0 && end < shortest) shortest = end, expected = k;
    }
    BOOST_TEST(leaving == expected);
    BOOST_TEST(std::abs(step - shortest) < 1e-12 * (1 + shortest));
    if (leaving >= 0) ++ended;
    held.pair.move_multipliers(step * (1 + 1e-9));
    held.pair.clamp_multipliers();
    for (int k = 0; k < held.pair.rows().size(); ++k) BOOST_TEST(held.pair.multipliers()[std::size_t(k)] >= 0);
  }
  BOOST_TEST(ended > 50);
}

BOOST_AUTO_TEST_SUITE_END()
