#include <boost/test/unit_test.hpp>

#include <string>
#include <utility>
#include <vector>

#include "feeler/core/on_heap.hpp"

BOOST_AUTO_TEST_SUITE(on_heap)

BOOST_AUTO_TEST_CASE(it_is_copied_with_its_value_and_moved_without) {
  using Words = feeler::OnHeap<std::vector<std::string>>;
  Words words(std::in_place, std::size_t(2), "a");
  const Words copy = words;
  words->push_back("b");
  BOOST_TEST(copy->size() == 2U);
  BOOST_TEST(words->size() == 3U);
  const std::string* const place = words->data();
  Words moved = std::move(words);
  BOOST_TEST(moved->data() == place);
  words = copy;  // what was moved from can be assigned to
  BOOST_TEST(*words == *copy);
  BOOST_TEST(words->data() != copy->data());
  moved = words;
  BOOST_TEST(moved->data() != words->data());
}

BOOST_AUTO_TEST_SUITE_END()
