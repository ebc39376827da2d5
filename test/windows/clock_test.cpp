// The clock of Windows: it goes forward, and waits at least as long as it is told to.
#include <boost/test/unit_test.hpp>

#include <cstdint>

#include "feeler/device/clock.hpp"

BOOST_AUTO_TEST_SUITE(windows_clock)

BOOST_AUTO_TEST_CASE(it_goes_forward_and_a_wait_ends_no_sooner_than_its_moment) {
  feeler::MonotonicClock clock;
  std::int64_t last = clock.now();
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now = clock.now();
    BOOST_REQUIRE(now >= last);
    last = now;
  }
  for (const std::int64_t wait : {0, 1, 100'000, 1'000'000, 20'000'000}) {
    const std::int64_t moment = clock.now() + wait;
    clock.sleep_until(moment);
    const std::int64_t now = clock.now();
    BOOST_TEST(now >= moment);
    BOOST_TEST(now < moment + 5'000'000'000);
  }
  clock.sleep_until(clock.now() - 1'000'000'000);  // has passed
}

BOOST_AUTO_TEST_SUITE_END()
