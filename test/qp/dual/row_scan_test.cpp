#include "feeler/qp/dual/row_scan.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Dense>

#include "feeler/qp/dual/best_row.hpp"
#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(row_scan)

namespace {

using Problem = feeler::QpProblem<double>;
using Six = feeler::detail::Six<double>;
using feeler_test::in_six;
using Vector6 = feeler::Vector6<double>;
using Matrix6 = feeler::Matrix6<double>;
template <int lanes>
using Scan = feeler::detail::RowScan<double, lanes>;
constexpr double tolerance = 1e-6;

/// Some rows, of which many are violated at 0; behind them are what is left of others that ask for far more.
Problem problem_with_leftovers(std::mt19937& bits, int rows, bool is_diagonal) {
  Problem problem = feeler_test::general_problem(bits, 0, is_diagonal);
  while (problem.row_count < Problem::row_capacity) problem.add_row(feeler_test::random_six(bits), 1e3);
  problem.clear_rows();
  for (int k = 0; k < rows; ++k) problem.add_row(feeler_test::random_six(bits), feeler_test::unit(bits));
  return problem;
}

/// What a scan is to know, by dense matrices.
struct Known {
  const Problem& problem;
  Matrix6 inverse, projector;
  Vector6 x;
  std::set<int> active;

  double violation(int k) const { return problem.bounds[std::size_t(k)] - problem.rows[std::size_t(k)].dot(x); }
  double weight(int k) const {
    const Vector6 a = problem.rows[std::size_t(k)];
    return std::max(a.dot(projector * a), feeler::detail::least_share * a.dot(inverse * a));
  }
  double score(int k) const { return violation(k) * violation(k) / weight(k); }
  void check(int row) const {
    double best = 0, most = 0;
    for (int k = 0; k < problem.row_count; ++k) {
      if (active.count(k) || violation(k) < 1e-4) continue;
      best = std::max(best, score(k));
      most = std::max(most, violation(k));
    }
    if (row < 0) {
      BOOST_TEST(most < 1e-4);
      return;
    }
    BOOST_TEST_REQUIRE(row < problem.row_count);
    BOOST_TEST(!active.count(row));
    BOOST_TEST(violation(row) > 0);
    BOOST_TEST(1.13 * score(row) >= best);  // an eighth, and rounding of float
  }
};

/// A scan that is told of rows that come and go.
template <int lanes>
struct Walk {
  const Problem& problem;
  Scan<lanes>& scan;
  feeler_test::Quadratic f;
  Known known;
  std::vector<int> order;  // of the active rows

  /// @param of  at its unconstrained minimum
  /// @param by  which may have been of another problem
  Walk(const Problem& of, Scan<lanes>& by)
      : problem(of), scan(by), f(of), known{of, of.hessian.inverse(), of.hessian.inverse(), Vector6(-of.hessian.ldlt().solve(of.gradient)), {}} {
    f.hessian.invert();
  }

  void check_weights() const {
    for (int k = 0; k < problem.row_count; ++k) {
      const Vector6 a = problem.rows[std::size_t(k)];
      BOOST_TEST(std::abs(scan.rough_unconstrained_weight(k) / a.dot(known.inverse * a) - 1) < 1e-3);
    }
  }
  void project() {
    known.active = {order.begin(), order.end()};
    known.projector = known.inverse;
    if (order.empty()) return;
    Eigen::MatrixXd n(6, order.size());
    for (std::size_t k = 0; k < order.size(); ++k) n.col(Eigen::Index(k)) = problem.rows[std::size_t(order[k])];
    known.projector -= known.inverse * n * (n.transpose() * known.inverse * n).inverse() * n.transpose() * known.inverse;
  }
  int start() {
    const int row = scan.start(problem, problem.bounds.data(), f.hessian, in_six(known.x), tolerance);
    known.check(row);
    BOOST_TEST(scan.select(problem, tolerance) == row);
    check_weights();
    return row;
  }
  /// Makes a row active, and returns the next one; −1 also where float has few digits of what is left of it.
  int add(int row) {
    const Vector6 a = problem.rows[std::size_t(row)], z = known.projector * a;
    const double slope = a.dot(z), length = known.violation(row) / slope;
    if (slope < 0.05 * a.dot(known.inverse * a)) return -1;
    const int next = scan.add(problem, in_six(z), length, slope, tolerance);
    scan.set_active(row);
    known.x += length * z;
    order.push_back(row);
    project();
    if (next != row) known.check(next);
    const int selected = scan.select(problem, tolerance);
    known.check(selected);
    return selected;
  }
  /// Frees the first active row, after a step.
  void drop(const Vector6& step) {
    const Matrix6 before = known.projector;
    const Vector6 z = before * step;
    const int row = order.front();
    order.erase(order.begin());
    project();
    const Matrix6 gained = known.projector - before;  // u·uᵀ/curvature
    Eigen::Index largest = 0;
    gained.diagonal().maxCoeff(&largest);
    const Vector6 u = gained.col(largest) / std::sqrt(gained(largest, largest));
    known.x += 0.1 * z;
    scan.drop(problem, in_six(z), 0.1, in_six(3 * u), 9.0);
    scan.set_violation(row, known.violation(row));
    known.check(scan.select(problem, tolerance));
  }
  /// As after a start with known rows.
  void begin_anew() {
    scan.measure(problem, problem.bounds.data(), in_six(known.x), 0.0);
    for (const int k : order) scan.set_active(k);
    feeler::detail::SixBySix<double> projector;
    for (int j = 0; j < 6; ++j) projector[std::size_t(j)] = in_six(known.projector.col(j));
    scan.weigh(problem, f.hessian, projector);
    known.check(scan.select(problem, tolerance));
    check_weights();
  }
};

template <int lanes>
void check_scores(unsigned seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Scan<lanes> scan;
  for (int i = 0; i < 120; ++i) {
    const Problem problem = problem_with_leftovers(bits, 1 + feeler_test::below(bits, 60), i % 3 == 0);
    Walk<lanes> walk(problem, scan);
    int row = walk.start();
    for (int change = 0; change < 4 && row >= 0; ++change) row = walk.add(row);
    if (!walk.order.empty()) walk.drop(feeler_test::random_six(bits));
    walk.begin_anew();
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_row_it_names_scores_within_an_eighth_of_any_other_as_rows_come_and_go) {
  check_scores<1>(115);
  check_scores<2>(116);
  check_scores<4>(117);
}

BOOST_AUTO_TEST_CASE(a_row_that_is_left_hardly_any_room_weighs_a_two_hundredth) {
  Problem problem;  // the first row has none, the second all of it
  problem.add_row(Vector6::Unit(0), 0.05);
  problem.add_row(Vector6::Unit(1), 0.5);
  feeler_test::Quadratic f(problem);
  f.hessian.invert();
  feeler::detail::SixBySix<double> projector{};
  for (std::size_t j = 1; j < 6; ++j) projector[j][j] = 1;
  for (const double left : {0.0, 1e-6, -1e-9}) {  // as rounding may have it
    projector[0][0] = left;
    for (const double violation : {0.03, 0.04}) {  // a score of 200 × 0.0009, or 200 × 0.0016, beside one of 0.25
      problem.bounds[0] = violation;
      Scan<2> scan;
      scan.start(problem, problem.bounds.data(), f.hessian, Six{}, tolerance);
      scan.weigh(problem, f.hessian, projector);
      BOOST_TEST(scan.select(problem, tolerance) == (violation > 0.035 ? 0 : 1));
    }
  }
}

BOOST_AUTO_TEST_CASE(what_lies_behind_the_last_row_is_never_violated) {
  constexpr unsigned seed = 118;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int rows = 0; rows < 40; ++rows) {
    Problem problem = problem_with_leftovers(bits, rows, rows % 2 == 0);
    feeler_test::Quadratic f(problem);
    f.hessian.invert();
    const Vector6 x = feeler_test::random_six(bits);
    for (int k = 0; k < rows; ++k) problem.bounds[std::size_t(k)] = problem.rows[std::size_t(k)].dot(x) - 0.5;
    const double* bounds = problem.bounds.data();
    BOOST_TEST(!Scan<2>::is_violated(problem, bounds, in_six(x), tolerance));
    BOOST_TEST(!Scan<4>::is_violated(problem, bounds, in_six(x), tolerance));
    BOOST_TEST(!Scan<4>::is_violated(problem, bounds, in_six(x), tolerance, 1e-9));
    Scan<4> scan;
    BOOST_TEST(scan.start(problem, bounds, f.hessian, in_six(x), tolerance) == -1);
    // Nor after a step that turns towards all of them.
    scan.measure(problem, bounds, in_six(x), 0.0);
    for (int k = 0; k < rows; ++k) scan.set_active(k);
    BOOST_TEST(scan.add(problem, in_six(-Vector6::Ones()), 1e4, 1e9, tolerance) == -1);
    BOOST_TEST(scan.add(problem, in_six(Vector6::Ones()), 1e4, 1e9, tolerance) == -1);
    BOOST_TEST(scan.select(problem, tolerance) == -1);
  }
}

BOOST_AUTO_TEST_CASE(rounding_excuses_a_row_by_the_sum_of_its_sizes) {
  Vector6 row;
  row << 1, -2, 4, -8, 16, -32;  // of size 63
  for (const double sign : {-1.0, 1.0}) {
    Problem problem;
    problem.add_row(sign * row, 1.0);
    for (const double rounding : {0.0, 1.0 / 128, 1.0 / 64, 1.0 / 32}) {
      const double left = 1 - 63 * rounding;
      Scan<2> scan;
      feeler_test::Quadratic f(problem);
      f.hessian.invert();
      scan.start(problem, problem.bounds.data(), f.hessian, Six{}, 0.0);
      scan.measure(problem, problem.bounds.data(), Six{}, rounding);
      for (const double beside : {-1e-3, 1e-3}) {
        BOOST_TEST(Scan<2>::is_violated(problem, problem.bounds.data(), Six{}, left + beside, rounding) == (beside < 0));
        if (left + beside > 0) BOOST_TEST(scan.select(problem, left + beside) == (beside < 0 ? 0 : -1));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_violation_that_is_no_number_is_one) {
  for (int bad = 0; bad < 9; ++bad) {
    Problem problem;
    for (int k = 0; k < 9; ++k) problem.add_row(Vector6::Unit(k % 6), -1.0);
    BOOST_TEST(!Scan<4>::is_violated(problem, problem.bounds.data(), Six{}, 1e300));
    problem.rows[std::size_t(bad)][3] = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(Scan<4>::is_violated(problem, problem.bounds.data(), Six{}, 1e300));
    BOOST_TEST(Scan<1>::is_violated(problem, problem.bounds.data(), Six{}, 1e300));
  }
}

BOOST_AUTO_TEST_SUITE_END()
