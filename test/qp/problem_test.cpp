#include "feeler/qp/problem.hpp"

#include <boost/test/unit_test.hpp>

#include <cstddef>

BOOST_AUTO_TEST_SUITE(problem)

BOOST_AUTO_TEST_CASE(a_row_for_which_there_is_no_room_changes_nothing) {
  using Vector6 = feeler::Vector6<double>;
  feeler::QpProblem<double> full;
  constexpr int capacity = feeler::QpProblem<double>::row_capacity;
  for (int k = 0; k < capacity; ++k) BOOST_TEST(full.add_row(Vector6::Constant(k), -k));
  BOOST_TEST(full.row_count == capacity);
  BOOST_TEST(!full.add_row(Vector6::Constant(0.5), 0.5));
  BOOST_TEST(full.row_count == capacity);
  for (int k = 0; k < capacity; ++k) {
    BOOST_TEST((full.rows[std::size_t(k)] == Vector6::Constant(k)));
    BOOST_TEST(full.bounds[std::size_t(k)] == -k);
  }
  full.clear_rows();
  BOOST_TEST(full.row_count == 0);
  BOOST_TEST(full.add_row(Vector6::Constant(0.5), 0.25));
  BOOST_TEST((full.rows[0] == Vector6::Constant(0.5)));
  BOOST_TEST(full.bounds[0] == 0.25);
}

BOOST_AUTO_TEST_SUITE_END()
