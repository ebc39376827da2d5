#include "feeler/core/fixed_vector.hpp"

#include <boost/test/unit_test.hpp>

#include <memory>
#include <random>
#include <type_traits>
#include <vector>

BOOST_AUTO_TEST_SUITE(fixed_vector)

using feeler::FixedVector;

namespace {

/// Counts how often one is made, and how often one is written from another.
struct Counted {
  Counted() { ++made; }
  explicit Counted(int v) : value(v) { ++made; }
  Counted(const Counted& other) : value(other.value) { ++copied; }
  Counted& operator=(const Counted& other) {
    value = other.value;
    ++copied;
    return *this;
  }
  int value = 0;
  static int made, copied;
};
int Counted::made = 0;
int Counted::copied = 0;

template <class List>
bool holds(const List& list, const std::vector<int>& expected) {
  return std::vector<int>(list.begin(), list.end()) == expected;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_new_list_is_empty_and_a_full_one_drops_what_is_pushed) {
  FixedVector<int, 3> list;
  static_assert(FixedVector<int, 3>::capacity() == 3);
  BOOST_TEST(list.empty());
  BOOST_TEST(!list.full());
  for (int i = 0; i < 3; ++i) BOOST_TEST(list.push_back(10 + i));
  BOOST_TEST(list.full());
  BOOST_TEST(!list.push_back(99));
  BOOST_TEST(holds(list, {10, 11, 12}));
  BOOST_TEST(list.back() == 12);
  list.pop_back();
  BOOST_TEST(list.push_back(13));
  BOOST_TEST(holds(list, {10, 11, 13}));
  list.clear();
  BOOST_TEST(list.empty());
  BOOST_TEST((list.begin() == list.end()));
}

BOOST_AUTO_TEST_CASE(swap_remove_puts_the_last_element_in_the_gap) {
  FixedVector<int, 8> list;
  for (int i = 0; i < 5; ++i) list.push_back(i);
  list.swap_remove(1);
  BOOST_TEST(holds(list, {0, 4, 2, 3}));
  list.swap_remove(3);  // the last one
  BOOST_TEST(holds(list, {0, 4, 2}));
  list.swap_remove(0);
  BOOST_TEST(holds(list, {2, 4}));
  list.swap_remove(0);
  list.swap_remove(0);
  BOOST_TEST(list.empty());
}

BOOST_AUTO_TEST_CASE(a_list_makes_no_element_and_a_copy_those_in_use) {
  Counted::made = 0;
  FixedVector<Counted, 100> list;
  BOOST_TEST(Counted::made == 0);
  for (int i = 0; i < 4; ++i) list.push_back(Counted(i));
  BOOST_TEST(Counted::made == 4);
  Counted::copied = 0;
  FixedVector<Counted, 100> copy(list);
  BOOST_TEST(Counted::copied == 4);
  BOOST_TEST(Counted::made == 4);
  BOOST_TEST(copy.size() == 4);
  for (int i = 0; i < 4; ++i) BOOST_TEST(copy[i].value == i);
  copy[0].value = 7;
  BOOST_TEST(list[0].value == 0);

  FixedVector<Counted, 100> shorter;
  shorter.push_back(Counted(5));
  list = shorter;
  BOOST_TEST(list.size() == 1);
  BOOST_TEST(list[0].value == 5);
  const auto& same = list;
  list = same;
  BOOST_TEST(list.size() == 1);
  BOOST_TEST(list[0].value == 5);
}

BOOST_AUTO_TEST_CASE(elements_that_must_be_destroyed_are) {
  const auto shared = std::make_shared<int>(3);
  {
    FixedVector<std::shared_ptr<int>, 4> list;
    list.push_back(shared);
    list.push_back(shared);
    const FixedVector<std::shared_ptr<int>, 4> copy(list);
    BOOST_TEST(shared.use_count() == 5);
    BOOST_TEST(*copy[1] == 3);
  }
  BOOST_TEST(shared.use_count() == 1);
}

BOOST_AUTO_TEST_CASE(any_sequence_of_calls_does_what_it_does_to_a_standard_vector) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  FixedVector<int, 5> list;
  std::vector<int> model;
  for (int i = 0; i < 2000; ++i) {
    const auto choice = bits() % 4;
    if (choice < 2) {
      const int value = int(bits() % 1000);
      const bool has_room = model.size() < 5;
      BOOST_TEST(list.push_back(value) == has_room);
      if (has_room) model.push_back(value);
    } else if (choice == 2 && !model.empty()) {
      const auto at = bits() % model.size();
      list.swap_remove(int(at));
      model[at] = model.back();
      model.pop_back();
    } else if (!model.empty()) {
      list.pop_back();
      model.pop_back();
    }
    BOOST_TEST(holds(list, model));
    BOOST_TEST(list.full() == (model.size() == 5));
    BOOST_TEST(list.empty() == model.empty());
  }
}

BOOST_AUTO_TEST_SUITE_END()
