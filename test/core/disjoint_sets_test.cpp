#include "feeler/core/disjoint_sets.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

BOOST_AUTO_TEST_SUITE(disjoint_sets)

BOOST_AUTO_TEST_CASE(numbers_have_one_root_where_a_list_of_labels_says_that_they_were_joined) {
  constexpr int count = 40;
  std::mt19937 bits(1);
  feeler::detail::DisjointSets sets(count - 1);
  sets.add();
  std::vector<int> label(count);
  std::iota(label.begin(), label.end(), 0);
  for (int joined = 0; joined < 50; ++joined) {
    const int from = int(bits() % count), to = int(bits() % count), root = sets.root(to);
    sets.join(from, to);
    const int old_label = label[std::size_t(from)], new_label = label[std::size_t(to)];
    std::replace(label.begin(), label.end(), old_label, new_label);
    BOOST_TEST(sets.root(from) == root);
    BOOST_TEST(sets.is_root(root));
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i; ++j) BOOST_TEST((sets.root(i) == sets.root(j)) == (label[std::size_t(i)] == label[std::size_t(j)]));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
