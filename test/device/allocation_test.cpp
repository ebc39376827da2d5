// Nothing in a tick of the servo loop allocates, and the count would show it.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>

#include "feeler/device/force_dimension_device.hpp"
#include "feeler/device/latest_value.hpp"
#include "feeler/device/open_haptics_device.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/session_recorder.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "feeler/device/virtuose_device.hpp"
#include "stand_in/force_dimension_stand_in.hpp"
#include "stand_in/open_haptics_stand_in.hpp"
#include "stand_in/stand_in.hpp"
#include "stand_in/virtuose_stand_in.hpp"
#include "support/allocation_count.hpp"

BOOST_AUTO_TEST_SUITE(allocation)

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_of_loop_device_and_hand_off_allocates_nothing_and_the_count_would_show_it) {
  for (const bool allocates : {false, true}) {
    feeler::SimulatedPhantomSettings phantom_settings;
    phantom_settings.grip.tremor = 1e-4;
    feeler::SimulatedPhantom phantom([](double t) { return feeler::DevicePose{{0.01 * std::sin(t), 0, 0}, {1, 0, 0, 0}}; }, phantom_settings);
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

BOOST_AUTO_TEST_CASE(a_tick_of_every_driver_with_passivity_control_safety_and_recorder_allocates_nothing) {
  auto& hd = feeler_test::stand_in<feeler_test::OpenHapticsStandIn>(FEELER_OPEN_HAPTICS_STAND_IN);
  feeler_test::stand_in<feeler_test::ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN);
  feeler_test::stand_in<feeler_test::VirtuoseStandIn>(FEELER_VIRTUOSE_STAND_IN);
  feeler::VirtuoseSettings virtuose_settings;
  virtuose_settings.libraries = {FEELER_VIRTUOSE_STAND_IN};
  feeler::OpenHapticsDevice open_haptics(feeler::OpenHapticsSettings{{FEELER_OPEN_HAPTICS_STAND_IN}, ""});
  feeler::ForceDimensionDevice force_dimension(feeler::ForceDimensionSettings{{FEELER_FORCE_DIMENSION_STAND_IN}});
  feeler::VirtuoseDevice virtuose(virtuose_settings);
  for (feeler::Device* device :
       {static_cast<feeler::Device*>(&open_haptics), static_cast<feeler::Device*>(&force_dimension), static_cast<feeler::Device*>(&virtuose)}) {
    BOOST_REQUIRE(bool(device->open()));
    feeler::SessionRecorder recorder(200);
    feeler::ServoSettings settings;
    settings.rate = 0;
    settings.tick_limit = 200;
    settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
    settings.recorder = &recorder;
    settings.passivity = feeler::passivity_of(device->specification(), 1e-3);
    std::int64_t before = 0;
    std::int64_t after = 0;
    feeler::ServoLoop* self = nullptr;
    feeler::ServoLoop loop(settings, *device, [&](const feeler::ServoTick& tick, const feeler::DeviceState&) {
      if (device == &open_haptics) hd.tick();  // its frame, on this thread to be counted too
      if (tick.index == 1) before = feeler_test::allocations;
      if (tick.index == 150) self->stop_force();
      if (tick.index == 170) self->restart_force();
      if (tick.index == 199) after = feeler_test::allocations;
      return feeler::DeviceWrench{{tick.index < 100 ? 0.0 : 100.0, 0, 0}, {0, 0, 0}};
    });
    self = &loop;
    loop.start();
    BOOST_TEST(loop.wait().ticks == 200);
    BOOST_TEST(after == before);
    device->close();
  }
}
#else
BOOST_AUTO_TEST_CASE(allocations_are_not_counted_with_a_sanitizer) { BOOST_TEST_MESSAGE("skipped: the sanitizer has a malloc of its own"); }
#endif

BOOST_AUTO_TEST_SUITE_END()
