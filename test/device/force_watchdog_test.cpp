// A renderer that hangs, on the real clock: a second thread takes the force away on every maker's device.
#include <boost/test/unit_test.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "feeler/device/force_dimension_device.hpp"
#include "feeler/device/open_haptics_device.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/virtuose_device.hpp"
#include "stand_in/force_dimension_stand_in.hpp"
#include "stand_in/open_haptics_stand_in.hpp"
#include "stand_in/stand_in.hpp"
#include "stand_in/virtuose_stand_in.hpp"

BOOST_AUTO_TEST_SUITE(force_watchdog)

using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;

namespace {

using Moment = feeler_test::MotorLog::Moment;

/// A maker's device over its stand-in.
struct Maker {
  const char* name;
  std::unique_ptr<feeler::Device> device;
  feeler_test::MotorLog* motors;
};

Maker open_haptics() {
  auto& hd = feeler_test::stand_in<feeler_test::OpenHapticsStandIn>(FEELER_OPEN_HAPTICS_STAND_IN);
  hd.own_thread = true;
  feeler::OpenHapticsSettings settings;
  settings.libraries = {FEELER_OPEN_HAPTICS_STAND_IN};
  return {"OpenHaptics", std::make_unique<feeler::OpenHapticsDevice>(settings), hd.motors};
}

Maker force_dimension() {
  auto& dhd = feeler_test::stand_in<feeler_test::ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN);
  feeler::ForceDimensionSettings settings;
  settings.libraries = {FEELER_FORCE_DIMENSION_STAND_IN};
  return {"Force Dimension", std::make_unique<feeler::ForceDimensionDevice>(settings), dhd.motors};
}

Maker virtuose() {
  auto& controller = feeler_test::stand_in<feeler_test::VirtuoseStandIn>(FEELER_VIRTUOSE_STAND_IN);
  feeler::VirtuoseSettings settings;
  settings.libraries = {FEELER_VIRTUOSE_STAND_IN};
  return {"Virtuose", std::make_unique<feeler::VirtuoseDevice>(settings), controller.motors};
}

feeler::ServoLoop* loop_of_test = nullptr;
constexpr DeviceWrench some_push{{1, 2, -1}, {0.01, 0, 0.02}};

}  // namespace

BOOST_AUTO_TEST_CASE(a_renderer_that_hangs_is_let_go_of_on_every_device_and_comes_back_by_the_ramp) {
  for (const auto& [make, rate] :
       {std::pair(&open_haptics, 1000.0), std::pair(&force_dimension, 1000.0), std::pair(&force_dimension, 4000.0), std::pair(&virtuose, 1000.0)}) {
    Maker maker = make();
    BOOST_TEST_CONTEXT(maker.name << " at " << rate << " Hz") {
      BOOST_REQUIRE(bool(maker.device->open()));
      feeler::ServoSettings settings;
      settings.rate = rate;
      settings.real_time.lock_memory = false;  // of this whole test program
      settings.force_limits = feeler::limits_of(maker.device->specification());
      settings.force_limits->ramp_time = 0.05;  // the least
      auto& motors = *maker.motors;
      Moment last_push, silent_since;
      bool was_silent = false;
      int ticks_back = -1;  // since it hung
      double pushed_first = 0;
      feeler::ServoLoop loop(settings, *maker.device, [&](const feeler::ServoTick& tick, const DeviceState&) {
        if (ticks_back < 0 && motors.size() > 0.3) {
          std::this_thread::sleep_for(std::chrono::milliseconds(100));
          was_silent = motors.is_silent();
          last_push = motors.last_push();
          silent_since = motors.silent_since();
          motors.take_largest();
          ticks_back = 0;
        } else if (ticks_back >= 0 && ++ticks_back == 3) {
          pushed_first = motors.take_largest();
        }
        if (ticks_back == 20) loop_of_test->stop();
        return tick.index == 0 ? DeviceWrench{} : some_push;
      });
      loop_of_test = &loop;
      loop.start();
      const auto& report = loop.wait();
      BOOST_TEST(was_silent);  // after 100 ms; to be expected are 2 ms after the tick was due
      const std::chrono::duration<double, std::milli> gap = silent_since - last_push;
      BOOST_TEST_MESSAGE(maker.name << " at " << rate << " Hz: from the last push to silence " << gap.count() << " ms, with " << report.setup.policy);
      BOOST_TEST(pushed_first < 0.1);  // not what was on when it hung; the ramp begins with 0.05
      BOOST_TEST(report.let_go > 0);
      BOOST_TEST(to_string(report).find("watchdog: the renderer or the system held the loop up") != std::string::npos);
      BOOST_TEST(report.force.ticks_with[std::size_t(feeler::ForceFault::late_tick)] > 0);
      maker.device->close();
    }
  }
}

BOOST_AUTO_TEST_CASE(after_it_is_let_go_a_device_pushes_only_for_a_pose_that_was_read_later) {
  for (const auto make : {&force_dimension, &virtuose}) {
    Maker maker = make();
    BOOST_TEST_CONTEXT(maker.name) {
      maker.device->let_go();  // nothing is open
      BOOST_REQUIRE(bool(maker.device->open()));
      DeviceState state;
      maker.device->read(state);
      maker.device->write(some_push);
      BOOST_TEST(!maker.motors->is_silent());
      maker.device->let_go();
      BOOST_TEST(maker.motors->is_silent());
      BOOST_TEST((maker.device->write(some_push) == DeviceStatus::ok));
      BOOST_TEST(maker.motors->is_silent());
      BOOST_TEST((maker.device->read(state) == DeviceStatus::ok));
      maker.device->write(some_push);
      BOOST_TEST(!maker.motors->is_silent());
    }
  }
}

BOOST_AUTO_TEST_CASE(two_threads_that_read_write_and_let_go_get_along_and_the_last_word_is_silence) {
  for (const auto make : {&force_dimension, &virtuose}) {
    Maker maker = make();
    BOOST_TEST_CONTEXT(maker.name) {
      BOOST_REQUIRE(bool(maker.device->open()));
      std::thread watchdog([&maker] {
        for (int i = 0; i < 20'000; ++i) maker.device->let_go();
      });
      DeviceState state;
      for (int i = 0; i < 20'000; ++i) {
        BOOST_REQUIRE((maker.device->read(state) == DeviceStatus::ok));
        BOOST_REQUIRE((maker.device->write(some_push) == DeviceStatus::ok));
      }
      watchdog.join();
      maker.device->let_go();
      BOOST_TEST(maker.motors->is_silent());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
