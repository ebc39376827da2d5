#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "feeler/contact/vertex_set.hpp"

BOOST_AUTO_TEST_SUITE(vertex_set)

BOOST_AUTO_TEST_CASE(members_are_those_added_each_once_in_the_order_in_which_they_came) {
  std::mt19937 bits(1);
  feeler::VertexSet set(300);
  for (int round = 0; round < 20; ++round) {
    set.clear();
    BOOST_TEST(set.empty());
    std::vector<int> order;
    std::set<int> members;
    for (int i = 0; i < 40 * round; ++i) {
      const int vertex = int(bits() % 300);
      set.add(vertex);
      if (members.insert(vertex).second) order.push_back(vertex);
    }
    BOOST_TEST(std::vector<int>(set.begin(), set.end()) == order, boost::test_tools::per_element());
    for (int vertex = 0; vertex < 300; ++vertex) BOOST_TEST(set.contains(vertex) == members.contains(vertex));
  }
}

BOOST_AUTO_TEST_SUITE_END()
