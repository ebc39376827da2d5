// The triple buffer under two threads: never torn, never backwards, never losing the last value.
#include <boost/test/unit_test.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "feeler/device/latest_value.hpp"

BOOST_AUTO_TEST_SUITE(latest_value)

BOOST_AUTO_TEST_CASE(there_is_nothing_to_fetch_before_a_store_and_nothing_twice) {
  feeler::LatestValue<int> shared;
  int value = -1;
  BOOST_TEST(!shared.fetch(value));
  BOOST_TEST(value == -1);
  shared.store(1);
  shared.store(2);
  BOOST_TEST(shared.fetch(value));
  BOOST_TEST(value == 2);
  BOOST_TEST(!shared.fetch(value));
  BOOST_TEST(value == 2);
}

BOOST_AUTO_TEST_CASE(a_watcher_never_sees_a_torn_or_an_older_value_and_always_the_last) {
  using Block = std::array<std::uint64_t, 500>;  // a copy long enough to be caught in the middle
  feeler::LatestValue<Block> shared;
  std::atomic<bool> is_enough = false;
  std::uint64_t last = 0;
  std::thread writer([&] {
    Block block;
    while (!is_enough) {
      block.fill(++last);
      shared.store(block);
      if (last % 8 == 0) std::this_thread::yield();  // where both share a processor
    }
  });
  std::uint64_t seen = 0;
  int torn = 0;
  int backwards = 0;
  Block block = {};
  const auto check = [&] {
    for (const std::uint64_t number : block) torn += number != block[0];
    backwards += block[0] <= seen;
    seen = block[0];
  };
  for (int fetched = 0; fetched < 10000;) {
    if (shared.fetch(block)) {
      check();
      ++fetched;
    } else {
      std::this_thread::yield();
    }
  }
  is_enough = true;
  writer.join();
  if (shared.fetch(block)) check();
  BOOST_TEST(torn == 0);
  BOOST_TEST(backwards == 0);
  BOOST_TEST(seen == last);
}

BOOST_AUTO_TEST_SUITE_END()
