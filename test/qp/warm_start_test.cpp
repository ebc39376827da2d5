#include "feeler/qp/warm_start.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(warm_start)

BOOST_AUTO_TEST_CASE(it_has_all_active_rows_of_a_solution_in_their_order_also_those_without_a_force) {
  for (int count = 0; count <= feeler::QpSolution<double>::active_capacity; ++count) {
    feeler::QpSolution<double> solution;
    solution.conflict.push_back(99);
    for (int i = 0; i < count; ++i) solution.active.push_back({40 - 7 * i, double(i % 2)});
    const feeler::WarmStart start(solution);
    BOOST_TEST_REQUIRE(start.rows.size() == count);
    for (int i = 0; i < count; ++i) BOOST_TEST(start.rows[i] == 40 - 7 * i);
  }
  BOOST_TEST(feeler::WarmStart().rows.empty());
}

BOOST_AUTO_TEST_SUITE_END()
