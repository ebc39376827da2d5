#include "feeler/qp/dual/kkt_check.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "feeler/qp/reference/textbook_active_set.hpp"
#include "feeler/qp/warm_start.hpp"
#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(kkt_check)

namespace {

using Problem = feeler::QpProblem<double>;
using Six = feeler::detail::Six<double>;
using Vector6 = feeler::Vector6<double>;
constexpr double accepted = 1e-9;

/// An answer, by another solver, as the check takes it.
struct Answer {
  Six x{}, multipliers{};
  feeler::WarmStart active;

  explicit Answer(const Problem& problem) {
    feeler::QpSolution<double> solution;
    BOOST_TEST_REQUIRE((feeler::TextbookActiveSet<double>().solve(problem, solution) == feeler::QpStatus::optimal));
    std::copy_n(solution.step.data(), 6, x.begin());
    for (const auto& row : solution.active) {
      multipliers[std::size_t(active.rows.size())] = row.multiplier;
      active.rows.push_back(row.row);
    }
  }

  bool fails(const Problem& problem) const {
    const feeler_test::Quadratic f(problem);
    Six force{}, lacking{}, residual;
    double beside = 0;
    for (int i = 0; i < active.rows.size(); ++i) {
      const auto slot = std::size_t(i), row = std::size_t(active.rows[i]);
      const Eigen::Map<const Vector6> at(x.data());
      lacking[slot] = problem.bounds[row] - problem.rows[row].dot(at);
      beside = std::max(beside, std::abs(lacking[slot]));
      for (int j = 0; j < 6; ++j) force[std::size_t(j)] += multipliers[slot] * problem.rows[row][j];
    }
    return feeler::detail::KktCheck<double>(problem, problem.bounds.data(), accepted)
        .fails(f.hessian, f.gradient, x, active.rows, multipliers, force, lacking, beside, residual);
  }
};

/// min ½|x|², from 0, with rows along the first axis that ask for more than each other allow by some distance.
struct Opposed {
  Problem problem;
  feeler::WarmStart active;
  feeler::QpSolution<double> solution;

  explicit Opposed(double by) {
    problem.add_row(Vector6::Unit(0), 1.0);
    problem.add_row(-Vector6::Unit(0), by - 1.0);
    active.rows.push_back(0);
  }

  /// @param share  of row 0 in row 1
  bool is_contradiction(double share, double allowed) {
    solution = {};
    const Six a{-1.0}, x{1.0};
    const Six rest{-1.0 - share};
    return feeler::detail::KktCheck<double>(problem, problem.bounds.data(), accepted)
        .is_contradiction(1, a, rest, rest[0] == 0.0, x, active.rows, Six{share}, allowed, solution);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_answer_of_another_solver_is_right_and_one_that_is_moved_or_pushed_is_off) {
  constexpr unsigned seed = 44;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int held = 0;
  for (int i = 0; i < 500; ++i) {
    const Problem problem = feeler_test::general_problem(bits, 1 + i % 6, i % 3 == 0);
    const Answer answer(problem);
    BOOST_TEST(!answer.fails(problem));
    Answer moved = answer;
    moved.x[std::size_t(i % 6)] += 1e-6;
    BOOST_TEST(moved.fails(problem));
    if (answer.active.rows.empty()) continue;
    ++held;
    Answer pushed = answer;
    pushed.multipliers[0] += 1e-6;
    BOOST_TEST(pushed.fails(problem));
  }
  BOOST_TEST(held > 100);
}

BOOST_AUTO_TEST_CASE(rows_contradict_each_other_by_more_than_they_are_allowed_and_where_they_cancel) {
  BOOST_TEST(Opposed(3.0 * accepted).is_contradiction(-1.0, accepted));
  BOOST_TEST(!Opposed(1.9 * accepted).is_contradiction(-1.0, accepted));
  BOOST_TEST(Opposed(1e-12).is_contradiction(-1.0, -1.0));  // nothing is allowed
  BOOST_TEST(!Opposed(0.0).is_contradiction(-1.0, -1.0));
  BOOST_TEST(!Opposed(3.0 * accepted).is_contradiction(-0.999, accepted));  // a step could use what is left

  Opposed opposed(1.0);
  BOOST_TEST_REQUIRE(opposed.is_contradiction(-1.0, accepted));
  BOOST_TEST(opposed.solution.conflict.size() == 2);
  BOOST_TEST(opposed.solution.conflict[0] == 1);
  BOOST_TEST(opposed.solution.conflict[1] == 0);
  BOOST_TEST(!opposed.is_contradiction(0.0, accepted));
  BOOST_TEST(opposed.solution.conflict.empty());
}

BOOST_AUTO_TEST_SUITE_END()
