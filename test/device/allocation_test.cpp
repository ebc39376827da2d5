// Nothing in a tick of the servo loop allocates, and the count would show it.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>

#include "feeler/device/latest_value.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "support/allocation_count.hpp"

BOOST_AUTO_TEST_SUITE(allocation)

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_of_loop_device_and_hand_off_allocates_nothing_and_the_count_would_show_it) {
  for (const bool allocates : {false, true}) {
    feeler::SimulatedPhantomSettings phantom_settings;
    phantom_settings.grip.tremor = 1e-4;
    feeler::SimulatedPhantom phantom(
        [](double t) { return feeler::DevicePose{{0.01 * std::sin(t), 0, 0}, {1, 0, 0, 0}}; }, phantom_settings);
    BOOST_REQUIRE(bool(phantom.open()));
    feeler::LatestValue<feeler::DeviceState> latest;

    feeler::ServoSettings settings;
    settings.rate = 10'000;
    settings.tick_limit = 100;
    settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
    std::int64_t before = 0;
    std::int64_t after = 0;
    feeler::ServoLoop loop(settings, [&](const feeler::ServoTick& tick) {
      if (tick.index == 0) before = feeler_test::allocations;
      feeler::DeviceState state;
      phantom.read(state);
      phantom.write({{100, 0, 0}, {0, 0, 0}});
      latest.store(state);
      if (tick.index == 50 && allocates) {
        int* volatile canary = new int(1);
        delete canary;
      }
      if (tick.index == 99) after = feeler_test::allocations;
      return true;
    });
    loop.start();
    BOOST_TEST(loop.wait().ticks == 100);
    BOOST_TEST(after - before == (allocates ? 1 : 0));
  }
}
#else
BOOST_AUTO_TEST_CASE(allocations_are_not_counted_with_a_sanitizer) {
  BOOST_TEST_MESSAGE("skipped: the sanitizer has a malloc of its own");
}
#endif

BOOST_AUTO_TEST_SUITE_END()
