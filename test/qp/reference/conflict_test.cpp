#include "feeler/qp/reference/conflict.hpp"

#include <boost/test/unit_test.hpp>

#include <random>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(conflict)

namespace {

using Problem = feeler::QpProblem<double>;
using Solution = feeler::QpSolution<double>;
using Vector6 = feeler::Vector6<double>;
constexpr double tolerance = 1e-9;

/// Rows along axes, with weights.
struct Weighed {
  Problem problem;
  feeler::QpMultipliers<double> weights{};
  Solution solution;

  void add(const Vector6& row, double bound, double weight) {
    weights[std::size_t(problem.row_count)] = weight;
    problem.add_row(row, bound);
  }
  bool is_found() {
    solution = {};
    return feeler::find_conflict(problem, weights, tolerance, solution);
  }
  std::set<int> named() const { return {solution.conflict.begin(), solution.conflict.end()}; }
};

/// Rows in a space of some dimensions that weights cancel, and whose bounds ask for something all the same.
Weighed random_conflict(std::mt19937& bits, int rank, int rows) {
  Weighed weighed;
  std::vector<Vector6> directions;
  for (int j = 0; j < rank; ++j) directions.push_back(feeler_test::random_six(bits));
  Vector6 force = Vector6::Zero();
  double asked = 0;
  for (int k = 0; k + 1 < rows; ++k) {
    Vector6 row = Vector6::Zero();
    for (const Vector6& direction : directions) row += feeler_test::unit(bits) * direction;
    const double weight = feeler_test::magnitude(bits, -2, 0), bound = feeler_test::unit(bits);
    weighed.add(row, bound, weight);
    force += weight * row;
    asked += weight * bound;
  }
  weighed.add(-force, 0.1 - asked, 1.0);
  return weighed;
}

}  // namespace

BOOST_AUTO_TEST_CASE(weights_that_cancel_rows_but_not_their_bounds_are_always_turned_into_a_proof) {
  constexpr unsigned seed = 124;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 240; ++i) {
    const int rank = 1 + i % 6;
    Weighed weighed = random_conflict(bits, rank, rank + 1 + i % 20);
    BOOST_TEST_REQUIRE(weighed.is_found());
    BOOST_TEST(weighed.solution.active.empty());
    const auto& named = weighed.solution.conflict;
    BOOST_TEST(named.size() <= rank + 1);
    // The weights that cancel the rows named, by a singular value of zero.
    Eigen::MatrixXd rows(6, named.size());
    Eigen::VectorXd bounds(named.size());
    for (int k = 0; k < named.size(); ++k) {
      rows.col(k) = weighed.problem.rows[std::size_t(named[k])];
      bounds[k] = weighed.problem.bounds[std::size_t(named[k])];
    }
    Eigen::VectorXd y = Eigen::JacobiSVD<Eigen::MatrixXd>(rows, Eigen::ComputeFullV).matrixV().rightCols<1>();
    if (y.sum() < 0) y = -y;
    BOOST_TEST((rows * y).norm() < 1e-7);
    BOOST_TEST(y.minCoeff() > 0);
    BOOST_TEST(bounds.dot(y) > 0);
  }
}

BOOST_AUTO_TEST_CASE(weights_that_cancel_rows_and_their_bounds_prove_nothing) {
  constexpr unsigned seed = 125;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 240; ++i) {
    const int rank = 1 + i % 6;
    Weighed weighed = random_conflict(bits, rank, rank + 1 + i % 20);
    const Vector6 inside = feeler_test::random_six(bits);  // which meets every row
    for (int k = 0; k < weighed.problem.row_count; ++k) {
      const auto row = std::size_t(k);
      weighed.problem.bounds[row] = weighed.problem.rows[row].dot(inside) - 0.1 * feeler_test::fraction(bits) * (i % 2);
    }
    BOOST_TEST(!weighed.is_found());
    BOOST_TEST(weighed.solution.conflict.empty());
  }
}

BOOST_AUTO_TEST_CASE(walls_may_overlap_by_what_each_of_them_is_allowed) {
  for (const auto& [by, is_conflict] : {std::pair(1.9, false), std::pair(2.1, true)}) {
    Weighed slot;
    slot.add(Vector6::Unit(0), 0.0, 1.0);
    slot.add(-Vector6::Unit(0), by * tolerance, 1.0);
    BOOST_TEST(slot.is_found() == is_conflict);
    Weighed corner;  // three rows, of which one counts twice
    corner.add(Vector6::Unit(0), 0.0, 2.0);
    corner.add(Vector6::Unit(1), 0.0, 1.0);
    corner.add(-2 * Vector6::Unit(0) - Vector6::Unit(1), 2 * by * tolerance, 1.0);
    BOOST_TEST(corner.is_found() == is_conflict);
  }
}

BOOST_AUTO_TEST_CASE(a_row_that_has_no_part_in_a_conflict_is_not_named) {
  Weighed slots;  // both have weights, one is too narrow
  slots.add(Vector6::Unit(0), 1.0, 1.0);
  slots.add(Vector6::Unit(2), 0.0, 0.5);
  slots.add(-Vector6::Unit(2), -1.0, 0.5);
  slots.add(Vector6::Unit(4), 0.0, 1.0);
  slots.add(-Vector6::Unit(0), 0.0, 1.0);
  BOOST_TEST_REQUIRE(slots.is_found());
  BOOST_TEST((slots.named() == std::set{0, 4}));
}

BOOST_AUTO_TEST_CASE(rows_of_a_millionth_of_the_largest_weight_are_left_out) {
  for (const auto& [weight, is_found] : {std::pair(1e-7, false), std::pair(1e-5, true)}) {
    Weighed slot;
    slot.add(Vector6::Unit(1), 0.0, 1.0);
    slot.add(Vector6::Unit(0), 1.0, weight);
    slot.add(-Vector6::Unit(0), 0.0, weight);
    BOOST_TEST(slot.is_found() == is_found);
  }
}

BOOST_AUTO_TEST_SUITE_END()
