// What stopped a step, as the problem where the step ended takes it.
#include "feeler/render/sqp/active_rows.hpp"

#include <boost/test/unit_test.hpp>

#include "feeler/qp/dual_active_set.hpp"
#include "feeler/render/sqp/step_problem.hpp"

BOOST_AUTO_TEST_SUITE(active_rows)

using namespace feeler;

namespace {
using Row = ContactRow<double>;
using Problem = StepProblem<DualActiveSet<double>, 8>;

Row wall(const Vector3<double>& normal, double gap, bool is_assumed = false) {
  Row row;
  row.normal = normal;
  row.gap = gap;
  row.is_assumed = is_assumed;
  return row;
}
}  // namespace

BOOST_AUTO_TEST_CASE(what_stopped_a_step_is_kept_where_that_ended_but_for_what_was_assumed_or_is_there) {
  // The hand is beyond three walls at right angles, 1, 2 and 3 µm off.
  const Vector3<double> x = Vector3<double>::UnitX(), y = Vector3<double>::UnitY(), z = Vector3<double>::UnitZ();
  const Twist<double> off{{1e-3, 1e-3, 1e-3}, Vector3<double>::Zero()};
  Problem problem;
  problem.add(wall(x, 1e-6), {0.0});
  problem.add(wall(y, 2e-6, true), {0.0});
  problem.add(wall(z, 3e-6), {0.0});
  problem.solve_gauss_newton(Metric<double>(), off, 0.0);
  const auto step = Twist<double>::from_vector(problem.solution().step);
  ActiveRows<Row, 6> stops;
  stops.remember(step, problem);
  BOOST_TEST((step.linear + Vector3<double>(1e-6, 2e-6, 3e-6)).norm() < 1e-12);
  int count = 0;
  for (const auto& stop : stops) {
    BOOST_TEST(std::abs(stop.gap) < 1e-12);
    BOOST_TEST(stop.multiplier == 1e-3, boost::test_tools::tolerance(0.01));
    ++count;
  }
  BOOST_TEST(count == 3);

  const auto required_gap_of = [](const Row& row) { return 1e-7 * row.normal.z(); };
  problem.clear();
  BOOST_TEST(stops.keep_in(problem, required_gap_of));
  BOOST_TEST(problem.row_count() == 2);
  for (int k = 0; k < problem.row_count(); ++k) BOOST_TEST(std::abs(problem.row(k).gap) < 1e-12);
  BOOST_TEST(!stops.keep_in(problem, required_gap_of));
  BOOST_TEST(problem.row_count() == 2);
}

BOOST_AUTO_TEST_CASE(a_row_was_added_also_where_there_is_no_room_for_the_next_one) {
  const Vector3<double> x = Vector3<double>::UnitX(), z = Vector3<double>::UnitZ();
  const Twist<double> off{{1e-3, 0, 1e-3}, Vector3<double>::Zero()};
  Problem problem;
  problem.add(wall(x, 1e-6), {0.0});
  problem.add(wall(z, 3e-6), {0.0});
  problem.solve_gauss_newton(Metric<double>(), off, 0.0);
  ActiveRows<Row, 6> stops;
  stops.remember(Twist<double>::from_vector(problem.solution().step), problem);
  for (const int room : {0, 1, 2}) {
    problem.clear();
    for (int k = 0; k < Problem::row_capacity - room; ++k) problem.add(wall(-x, 1e-3 * k), {0.0});
    BOOST_TEST(stops.keep_in(problem, [](const Row&) { return 0.0; }) == (room > 0));
    BOOST_TEST(problem.row_count() == Problem::row_capacity);
  }
}

BOOST_AUTO_TEST_SUITE_END()
