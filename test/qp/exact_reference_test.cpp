// Fresh problems of every family, judged by an exact solver.
#include <boost/test/unit_test.hpp>

#include <cstdlib>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "qp/judge.hpp"
#include "qp/problem_families.hpp"

BOOST_AUTO_TEST_SUITE(qp_exact_reference)

using feeler::qp_families::Judge;
using feeler::qp_families::Verdict;

namespace {

/// A new one each run; FEELER_QP_SEED repeats a run.
unsigned seed_of_this_run() {
  if (const char* wanted = std::getenv("FEELER_QP_SEED")) return unsigned(std::stoul(wanted));
  return std::random_device()();
}

/// Whether a solver decides every problem of the families.
template <class Solver>
constexpr bool decides_all = true;
template <>
constexpr bool decides_all<feeler::ProjectedGaussSeidel<double>> = false;
template <>
constexpr bool decides_all<feeler::InteriorPoint<double>> = false;

template <class Solver>
void check(const feeler::qp_families::Family& family, const feeler::qp_families::Problem& problem, Judge& judge) {
  Solver solver;
  solver.tolerance /= family.metres_per_unit;
  feeler::QpSolution<double> solution;
  const feeler::QpStatus status = solver.solve(problem, solution);
  const Verdict verdict = judge.judge(status, solution, Solver().tolerance);
  BOOST_TEST_CONTEXT(family.name << ", status " << int(status) << ", off by " << judge.distance() << " m") {
    const bool may_be_undecided = !decides_all<Solver>;
    BOOST_TEST((verdict == Verdict::right || (may_be_undecided && verdict == Verdict::undecided)));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(fresh_problems_of_every_family_are_solved_right_by_every_solver) {
  const unsigned seed = seed_of_this_run();
  BOOST_TEST_MESSAGE("by " << feeler::qp_families::exact_solver_name() << ", seed " << seed);
  std::mt19937 bits(seed);
  for (const auto& family : feeler::qp_families::all_families()) {
    std::vector<feeler::qp_families::Problem> problems;
    while (problems.size() < 10) family.append(bits, problems);
    for (const auto& problem : problems) {
      Judge judge(problem, family.metres_per_unit);
      check<feeler::DualActiveSet<double>>(family, problem, judge);
      check<feeler::TextbookActiveSet<double>>(family, problem, judge);
      check<feeler::InteriorPoint<double>>(family, problem, judge);
      check<feeler::ProjectedGaussSeidel<double>>(family, problem, judge);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_judge_tells_wrong_answers_from_right_ones) {
  std::mt19937 bits(1);
  std::vector<feeler::qp_families::Problem> problems;
  for (const auto& family : feeler::qp_families::all_families())
    if (family.name == "slot-0" || family.name == "infeasible") family.append(bits, problems);
  BOOST_TEST_REQUIRE(problems.size() == 2);
  feeler::DualActiveSet<double> solver;
  feeler::QpSolution<double> solution;
  Judge slot(problems[0], 1.0), closed(problems[1], 1.0);
  const feeler::QpStatus status = solver.solve(problems[0], solution);
  BOOST_TEST((slot.judge(status, solution, 2e-13) == Verdict::right));
  BOOST_TEST((slot.judge(feeler::QpStatus::infeasible, solution, 2e-13) == Verdict::falsely_infeasible));
  BOOST_TEST((closed.judge(feeler::QpStatus::infeasible, solution, 2e-13) == Verdict::right));
  BOOST_TEST((closed.judge(feeler::QpStatus::optimal, solution, 2e-13) == Verdict::wrong));
  solution.step[0] += 1e-9;
  BOOST_TEST((slot.judge(status, solution, 2e-13) == Verdict::wrong));
}

// Two rows at an angle of 1e-5: one that gives way by 10 fm moves the optimum by a nanometre.
BOOST_AUTO_TEST_CASE(the_judge_accepts_the_optimum_of_a_problem_that_is_as_near_as_the_tolerance) {
  feeler::QpProblem<double> problem;
  feeler::Vector6<double> flat = feeler::Vector6<double>::Unit(1), tilted = flat;
  tilted[0] = 1e-5;
  problem.gradient = flat + tilted;  // both rows push, the optimum is 0
  problem.add_row(flat, 0.0);
  problem.add_row(tilted, 0.0);
  Judge judge(problem, 1.0);
  const auto verdict_on = [&](double along, double across) {
    feeler::QpSolution<double> solution;
    solution.step << along, across, 0, 0, 0, 0;
    return judge.judge(feeler::QpStatus::optimal, solution, 2e-13);
  };
  BOOST_TEST((verdict_on(0, 0) == Verdict::right));
  BOOST_TEST((verdict_on(-1e-9, 0) == Verdict::right));  // 10 fm are missing
  BOOST_TEST((verdict_on(1e-9, 0) == Verdict::right));   // 10 fm more than asked
  BOOST_TEST(judge.distance() == 1e-9, boost::test_tools::tolerance(1e-12));
  BOOST_TEST((verdict_on(-1e-7, 0) == Verdict::wrong));  // 1 pm is missing
  BOOST_TEST((verdict_on(1e-7, 0) == Verdict::wrong));   // 1 pm more than asked
  BOOST_TEST((verdict_on(0, 1e-9) == Verdict::wrong));   // off both rows
}

BOOST_AUTO_TEST_SUITE_END()
