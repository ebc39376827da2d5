// A problem in another unit of length is the same problem.
#include "feeler/qp/unit_of_length.hpp"

#include <boost/test/unit_test.hpp>

#include "feeler/qp/dual_active_set.hpp"

BOOST_AUTO_TEST_SUITE(unit_of_length)

using namespace feeler;

namespace {

/// A tool on a slope, held a lever's length beside its reference point; lengths in metres.
QpProblem<double> slope() {
  QpProblem<double> problem;
  problem.hessian.bottomRightCorner<3, 3>() *= 3e-4;
  problem.hessian(4, 0) = problem.hessian(0, 4) = 1e-3;
  problem.gradient << 1e-3, 2e-3, -3e-3, 1e-6, 2e-6, -1e-6;
  Vector6<double> row;
  row << 0.6, 0, 0.8, 0.01, -0.02, 0.03;
  problem.add_row(row, 5e-3);
  row << 0, 1, 0, 0.04, 0, -0.01;
  problem.add_row(row, -1e-4);
  return problem;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_problem_in_millimetres_has_the_solution_of_that_in_metres) {
  DualActiveSet<double> solver;
  QpSolution<double> in_metres, in_millimetres;
  QpProblem<double> problem = slope();
  BOOST_TEST((solver.solve(problem, in_metres) == QpStatus::optimal));
  change_unit_of_length(problem, 1e-3);
  BOOST_TEST((solver.solve(problem, in_millimetres) == QpStatus::optimal));
  BOOST_TEST_REQUIRE(in_metres.active.size() == 2);
  BOOST_TEST_REQUIRE(in_millimetres.active.size() == 2);
  BOOST_TEST((in_millimetres.step.head<3>() - 1e3 * in_metres.step.head<3>()).norm() < 1e-12);
  BOOST_TEST((in_millimetres.step.tail<3>() - in_metres.step.tail<3>()).norm() < 1e-12);
  change_unit_of_length(in_millimetres, 1e3);
  BOOST_TEST((in_millimetres.step - in_metres.step).norm() < 1e-15);
  for (int i = 0; i < 2; ++i) BOOST_TEST(std::abs(in_millimetres.active[i].multiplier - in_metres.active[i].multiplier) < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_power_of_two_there_and_back_changes_no_bit) {
  const QpProblem<double> problem = slope();
  QpProblem<double> changed = problem;
  change_unit_of_length(changed, 0x1p-14);
  BOOST_TEST(changed.bounds[0] == 0x1p14 * problem.bounds[0]);
  change_unit_of_length(changed, 0x1p14);
  BOOST_TEST((changed.hessian == problem.hessian && changed.gradient == problem.gradient));
  for (std::size_t k = 0; k < 2; ++k) BOOST_TEST((changed.rows[k] == problem.rows[k] && changed.bounds[k] == problem.bounds[k]));
}

BOOST_AUTO_TEST_SUITE_END()
