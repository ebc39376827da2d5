// No QP solver takes memory from the heap, and the count would show it.
#include <boost/test/unit_test.hpp>

#include <random>
#include <tuple>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/qp/reference/interior_point.hpp"
#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "feeler/qp/reference/textbook_active_set.hpp"
#include "support/allocation_count.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(qp_allocation)

#if FEELER_TEST_COUNTS_ALLOCATIONS
using Solvers =
    std::tuple<feeler::DualActiveSet<double>, feeler::InteriorPoint<double>, feeler::ProjectedGaussSeidel<double>, feeler::TextbookActiveSet<double>>;

BOOST_AUTO_TEST_CASE_TEMPLATE(solving_allocates_nothing_and_the_count_would_show_it, Solver, Solvers) {
  BOOST_TEST(feeler_test::count_works());
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Solver solver;
  feeler::QpSolution<double> solution;
  feeler::QpProblem<double> problem;
  for (int i = 0; i < 300; ++i) {
    problem.clear_rows();
    for (int k = 0; k < 6; ++k) problem.gradient[k] = feeler_test::unit(bits);
    for (int k = 0; k < 1 + i % 40; ++k) {  // the tighter ones are infeasible
      feeler::Vector6<double> row;
      const Eigen::Vector3d normal = feeler_test::random_direction(bits);
      row << normal, feeler_test::random_vector(bits).cross(normal);
      problem.add_row(row, feeler_test::unit(bits) - 0.9 + i / 300.0);
    }
    BOOST_TEST(feeler_test::allocations_during([&] { solver.solve(problem, solution); }) == 0);
  }
}
#else
BOOST_AUTO_TEST_CASE(allocations_are_not_counted_with_a_sanitizer) { BOOST_TEST_MESSAGE("skipped: the sanitizer has a malloc of its own"); }
#endif

BOOST_AUTO_TEST_SUITE_END()
