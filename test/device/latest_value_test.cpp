// The triple buffer under two threads: never torn, never backwards, never losing the last value.
#include <boost/test/unit_test.hpp>

#include <array>
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

BOOST_AUTO_TEST_CASE(a_watcher_never_sees_a_torn_or_an_older_value) {
  using Block = std::array<std::uint64_t, 100>;
  constexpr std::uint64_t last = 200'000;
  feeler::LatestValue<Block> shared;
  std::thread writer([&shared] {
    Block block;
    for (std::uint64_t i = 1; i <= last; ++i) {
      block.fill(i);
      shared.store(block);
      if (i % 1000 == 0) std::this_thread::yield();
    }
  });
  std::uint64_t seen = 0;
  int torn = 0;
  int backwards = 0;
  Block block = {};
  while (seen != last) {
    if (!shared.fetch(block)) continue;
    for (const std::uint64_t number : block) torn += number != block[0];
    backwards += block[0] <= seen;
    seen = block[0];
    if (torn > 0 || backwards > 0) break;
  }
  writer.join();
  BOOST_TEST(torn == 0);
  BOOST_TEST(backwards == 0);
}

BOOST_AUTO_TEST_SUITE_END()
