#include "feeler/qp/dual/operator_method.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>

#include "support/general_problem.hpp"
#include "support/qp_laws.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(operator_method)

namespace {

using Problem = feeler::QpProblem<double>;
using Solution = feeler::QpSolution<double>;
using Vector6 = feeler::Vector6<double>;
using feeler::QpStatus;
using feeler::WarmStart;

/// What the method alone makes of a problem, which the solver leaves to it only when all else fails.
template <int lanes>
struct Attempt {
  Solution solution;
  QpStatus status;

  explicit Attempt(const Problem& problem, const WarmStart& known = {}, double tolerance = 2e-13) {
    feeler_test::Quadratic f(problem);
    f.hessian.invert();
    feeler::detail::OperatorMethod<double, lanes> method;
    status = method.solve(problem, known, f.hessian, f.gradient, tolerance, solution);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(its_answers_from_any_known_rows_are_the_best_of_all_subsets) {
  constexpr unsigned seed = 145;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int optimal = 0;
  for (int i = 0; i < 500; ++i) {
    const double scale = feeler_test::magnitude(bits, -6, 3);
    const Problem problem = feeler_test::random_problem<double>(bits, i % feeler_test::random_problem_families, scale);
    WarmStart known;  // repeated rows and rows that do not exist among them
    for (int k = feeler_test::below(bits, 7); k > 0; --k) known.rows.push_back(feeler_test::below(bits, 12) - 2);
    const Attempt<2> attempt(problem, known);
    feeler_test::check_answer(problem, attempt.status, attempt.solution, scale, "problem " + std::to_string(i));
    optimal += attempt.status == QpStatus::optimal ? 1 : 0;
  }
  BOOST_TEST(optimal > 250);
}

// Two looks at all rows, one step at whose end the first wall leaves, and one to the second: its force has both steps, and is right at once.
BOOST_AUTO_TEST_CASE(a_wall_that_takes_over_from_a_known_one_takes_its_force_over) {
  for (const double size : {1.0, 0.25, 4.0}) {
    Problem problem;
    problem.add_row(Vector6::Unit(0), 1.0);
    problem.add_row(size * Vector6::Unit(0), 2 * size);
    WarmStart known;
    known.rows.push_back(0);
    const Attempt<2> attempt(problem, known);
    BOOST_TEST((attempt.status == QpStatus::optimal));
    BOOST_TEST(attempt.solution.step[0] == 2);
    BOOST_TEST_REQUIRE(attempt.solution.active.size() == 1);
    BOOST_TEST(attempt.solution.active[0].row == 1);
    BOOST_TEST(attempt.solution.active[0].multiplier == 2 / size);
    BOOST_TEST(attempt.solution.iterations == 4);
  }
}

BOOST_AUTO_TEST_CASE(walls_may_overlap_by_some_of_what_each_is_allowed_and_not_by_more_than_all_of_it) {
  constexpr double tolerance = 1e-6;
  for (const double by : {0.5, 1.1, 1.7, 2.1, 10.0}) {
    Problem problem;
    problem.add_row(Vector6::Unit(0), 1.0);
    problem.add_row(-Vector6::Unit(0), -1.0 + by * tolerance);
    const Attempt<2> attempt(problem, {}, tolerance);
    BOOST_TEST((attempt.status == (by < 2 ? QpStatus::optimal : QpStatus::infeasible)));
    if (by > 2) continue;
    for (std::size_t k = 0; k < 2; ++k) BOOST_TEST(problem.bounds[k] - problem.rows[k].dot(attempt.solution.step) <= tolerance);
  }
}

// The last row is the sum of two others, turned round, and all bounds are those of one point, to rounding. So rows that are some thousand long
// agree to some thousand roundings of a unit, far more than the tolerance.
BOOST_AUTO_TEST_CASE(long_rows_that_meet_in_a_point_to_rounding_alone_hold_there) {
  constexpr unsigned seed = 146;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 500; ++i) {
    Problem problem;
    const Vector6 point = feeler_test::random_six(bits), first = 5e3 * feeler_test::random_six(bits), second = 5e3 * feeler_test::random_six(bits);
    problem.gradient = -point + 1e-3 * (first + 0.5 * second);
    for (const Vector6& row : {first, second, Vector6(-first - second)}) problem.add_row(row, row.dot(point));
    const Attempt<2> attempt(problem, {}, 1e-13);
    BOOST_TEST((attempt.status == QpStatus::optimal));
    const feeler_test::WideProblem wide(problem);
    const auto kkt = feeler_test::kkt_residuals(wide, attempt.solution);
    BOOST_TEST(std::max(kkt.violation, kkt.slackness) < 1e-9L);
    BOOST_TEST(wide.value(attempt.solution.step.cast<long double>()) < wide.value(point.cast<long double>()) + 1e-7L);
  }
}

BOOST_AUTO_TEST_SUITE_END()
