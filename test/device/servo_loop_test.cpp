// The servo loop: its counting on a scripted clock, its manners on the real one.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"

BOOST_AUTO_TEST_SUITE(servo_loop)

using feeler::ServoLoop;
using feeler::ServoSettings;
using feeler::ServoTick;

namespace {

constexpr std::int64_t millisecond = 1'000'000;

/// Stands still, but for what the script spends: waits end late by the lateness set, and work takes what the callback says.
class ScriptedClock final : public feeler::Clock {
 public:
  std::int64_t now() noexcept override { return now_; }
  void sleep_until(std::int64_t moment) noexcept override {
    if (moment > now_) now_ = moment;
    now_ += lateness;
  }
  void spend(std::int64_t nanoseconds) noexcept { now_ += nanoseconds; }

  std::int64_t lateness = 0;

 private:
  std::int64_t now_ = 5'000 * millisecond;
};

ServoSettings quiet(double rate, std::int64_t ticks) {
  ServoSettings settings;
  settings.rate = rate;
  settings.tick_limit = ticks;
  settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
  return settings;
}

/// Runs ticks that take these times at 1 kHz, and returns what each callback was told.
std::vector<ServoTick> run_script(const std::vector<std::int64_t>& work, feeler::ServoReport& report, std::int64_t lateness = 0) {
  ScriptedClock clock;
  clock.lateness = lateness;
  std::vector<ServoTick> told;
  ServoLoop loop(
      quiet(1000, std::int64_t(work.size())),
      [&](const ServoTick& tick) {
        told.push_back(tick);
        clock.spend(work[std::size_t(tick.index)]);
        return true;
      },
      &clock);
  loop.start();
  report = loop.wait();
  BOOST_TEST(loop.ticks() == report.ticks);
  BOOST_TEST(loop.missed() == report.missed);
  return told;
}

}  // namespace

BOOST_AUTO_TEST_CASE(ticks_that_end_by_the_next_deadline_miss_nothing) {
  feeler::ServoReport report;
  const auto told = run_script({0, millisecond / 2, millisecond - 1, millisecond, 0}, report);
  BOOST_TEST(report.ticks == 5);
  BOOST_TEST(report.missed == 0);
  BOOST_TEST(report.compute_time.maximum() == millisecond);
  BOOST_TEST(report.wake_up_latency.maximum() == 0);
  for (std::size_t i = 0; i < told.size(); ++i) {
    BOOST_TEST(told[i].index == std::int64_t(i));
    BOOST_TEST(told[i].time == double(i) * 1e-3, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(told[i].missed == 0);
  }
}

BOOST_AUTO_TEST_CASE(every_deadline_that_passes_during_a_tick_is_skipped_and_counted_once) {
  feeler::ServoReport report;
  // Deadlines at 0, 1, 2 … ms. Tick 1 works from 1 to 2.000001 ms and misses 2; tick 2 from 3 to 6.5 ms and misses 4, 5, 6.
  const auto told = run_script({0, millisecond + 1, 7 * millisecond / 2, 0}, report);
  BOOST_TEST(report.ticks == 4);
  BOOST_TEST(report.missed == 4);
  const double times[] = {0, 1e-3, 3e-3, 7e-3};
  const std::int64_t missed[] = {0, 0, 1, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(told[i].time == times[i], boost::test_tools::tolerance(1e-12));
    BOOST_TEST(told[i].missed == missed[i]);
  }
  BOOST_TEST(report.wake_up_latency.maximum() == 0);  // never caught up: each tick waited for its own deadline
}

BOOST_AUTO_TEST_CASE(a_tick_that_ends_on_a_later_deadline_is_on_time_for_that_one) {
  feeler::ServoReport report;
  const auto told = run_script({3 * millisecond, 0}, report);
  BOOST_TEST(report.missed == 2);
  BOOST_TEST(told[1].time == 3e-3, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(late_wake_ups_are_latency_and_miss_only_the_deadlines_they_pass) {
  feeler::ServoReport report;
  const auto told = run_script({0, 0, 0}, report, 300'000);
  BOOST_TEST(report.missed == 0);
  BOOST_TEST(report.wake_up_latency.minimum() == 300'000);
  for (const ServoTick& tick : told) BOOST_TEST(tick.late == 300'000);
  BOOST_TEST(report.wake_up_latency.maximum() == 300'000);
  run_script({0, 0, 0}, report, 5 * millisecond / 2);
  BOOST_TEST(report.missed == 6);  // two a tick
  BOOST_TEST(report.wake_up_latency.maximum() == 5 * millisecond / 2);
}

BOOST_AUTO_TEST_CASE(without_a_rate_it_does_not_wait) {
  ScriptedClock clock;
  clock.lateness = 1'000 * millisecond;  // would show
  ServoLoop loop(quiet(0, 1000), [&](const ServoTick&) { return clock.spend(10), true; }, &clock);
  loop.start();
  const auto& report = loop.wait();
  BOOST_TEST(report.ticks == 1000);
  BOOST_TEST(report.missed == 0);
  BOOST_TEST(report.wake_up_latency.count() == 0);
  BOOST_TEST(report.compute_time.maximum() == 10);
}

BOOST_AUTO_TEST_CASE(the_callback_ends_it_by_its_answer_and_by_stop) {
  ScriptedClock clock;
  ServoLoop answering(quiet(1000, 0), [](const ServoTick& tick) { return tick.index < 9; }, &clock);
  answering.start();
  BOOST_TEST(answering.wait().ticks == 10);
  BOOST_TEST(!answering.is_running());

  ServoLoop* self = nullptr;
  ServoLoop stopping(
      quiet(1000, 0),
      [&self](const ServoTick& tick) {
        if (tick.index == 4) self->stop();
        return true;
      },
      &clock);
  self = &stopping;
  stopping.start();
  BOOST_TEST(stopping.wait().ticks == 5);
}

BOOST_AUTO_TEST_CASE(a_callback_that_throws_ends_it_with_a_sentence) {
  ScriptedClock clock;
  ServoLoop loop(quiet(1000, 0), [](const ServoTick&) -> bool { throw std::runtime_error("the cable came off"); }, &clock);
  loop.start();
  BOOST_TEST(loop.wait().problem == "The callback threw, so the loop ended: the cable came off");
  BOOST_TEST(feeler::to_string(loop.wait()).find("the cable came off") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_it_cannot_run_is_refused) {
  const auto nothing = [](const ServoTick&) { return true; };
  BOOST_CHECK_THROW(ServoLoop({}, nullptr), std::invalid_argument);
  for (const double rate : {-1.0, 1e-12, 2e9, std::numeric_limits<double>::quiet_NaN()}) {
    BOOST_CHECK_THROW(ServoLoop(quiet(rate, 1), nothing), std::invalid_argument);
  }
  ServoLoop loop(quiet(0, 1), nothing);
  loop.start();
  loop.wait();
  BOOST_CHECK_THROW(loop.start(), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_loop_with_a_device_refuses_what_would_be_unsafe) {
  feeler::SimulatedPhantom device([](double) { return feeler::DevicePose{}; });
  BOOST_REQUIRE(bool(device.open()));
  const auto render = [](const ServoTick&, const feeler::DeviceState&) { return feeler::DeviceWrench{}; };
  BOOST_CHECK_THROW(ServoLoop(quiet(1000, 1), device, nullptr), std::invalid_argument);
  ServoLoop slow(quiet(400, 1), device, render);  // the device needs 500 Hz
  BOOST_CHECK_THROW(slow.start(), std::invalid_argument);
  ServoSettings strong = quiet(1000, 1);
  strong.force_limits = feeler::limits_of(device.specification());
  strong.force_limits->maximum_force *= 2;
  ServoLoop too_strong(strong, device, render);
  BOOST_CHECK_THROW(too_strong.start(), std::invalid_argument);
  ServoSettings hasty = quiet(1000, 1);
  hasty.force_limits = feeler::limits_of(device.specification());
  hasty.force_limits->latest_tick = 0.0009;
  ServoLoop too_hasty(hasty, device, render);
  BOOST_CHECK_THROW(too_hasty.start(), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_loop_with_a_device_that_is_not_open_ends_with_a_sentence) {
  feeler::SimulatedPhantom device([](double) { return feeler::DevicePose{}; });
  int rendered = 0;
  ServoLoop loop(quiet(0, 10), device, [&rendered](const ServoTick&, const feeler::DeviceState&) {
    ++rendered;
    return feeler::DeviceWrench{};
  });
  loop.start();
  BOOST_TEST(loop.wait().problem.find("The device was lost") == 0u);
  BOOST_TEST(loop.wait().ticks == 1);
  BOOST_TEST(rendered == 0);
}

BOOST_AUTO_TEST_CASE(the_last_thing_that_a_loop_writes_is_nothing) {
  feeler::SimulatedPhantom device([](double) { return feeler::DevicePose{}; });
  BOOST_REQUIRE(bool(device.open()));
  ServoLoop loop(quiet(0, 1000), device, [](const ServoTick& tick, const feeler::DeviceState&) {
    return feeler::DeviceWrench{{tick.index == 0 ? 0.0 : 5.0, 0, 0}, {0, 0, 0}};
  });
  loop.start();
  const auto& report = loop.wait();
  BOOST_TEST(report.force.peak_force > 3);  // 5 N, less what the heat of the motors takes
  BOOST_TEST((loop.force_phase() == feeler::ForcePhase::on));
  // The hand is at rest on its path again once nothing has pushed it for long.
  feeler::DeviceState state;
  for (int i = 0; i < 2000; ++i) device.read(state);
  BOOST_TEST(std::abs(state.pose.position[0]) < 1e-4);
}

BOOST_AUTO_TEST_CASE(on_the_real_clock_it_runs_records_and_counts) {
  ServoSettings settings;
  settings.rate = 2000;
  settings.tick_limit = 100;
  settings.real_time.lock_memory = false;  // of this whole test program
  std::atomic<int> calls = 0;
  ServoLoop loop(settings, [&calls](const ServoTick&) { return ++calls, true; });
  const auto setup = loop.start();
  BOOST_TEST(!setup.kernel.empty());
  BOOST_TEST(!setup.processors.empty());
  BOOST_TEST((setup.policy == "SCHED_FIFO") == setup.refused.empty());
  const auto& report = loop.wait();
  BOOST_TEST(calls == 100);
  BOOST_TEST(report.ticks == 100);
  BOOST_TEST(report.period == 500'000);
  BOOST_TEST(report.wake_up_latency.count() == 100);
  BOOST_TEST(report.compute_time.count() == 100);
  BOOST_TEST(report.problem == "");
  BOOST_TEST_MESSAGE(feeler::to_string(report));
}

BOOST_AUTO_TEST_CASE(stop_from_another_thread_ends_an_unbounded_loop) {
  ServoLoop loop(quiet(1000, 0), [](const ServoTick&) { return true; });
  loop.start();
  while (loop.ticks() < 5) std::this_thread::yield();
  BOOST_TEST(loop.is_running());
  loop.stop();
  BOOST_TEST(loop.wait().ticks >= 5);
}

BOOST_AUTO_TEST_SUITE(real_time)

BOOST_AUTO_TEST_CASE(what_is_refused_is_said_with_what_to_do) {
  ServoSettings settings = quiet(1000, 1);
  settings.real_time = {.fifo = true, .priority = 1000, .lock_memory = false, .processor = 1'000'000};
  ServoLoop loop(settings, [](const ServoTick&) { return true; });
  const auto setup = loop.start();
  BOOST_REQUIRE(setup.refused.size() == 2u);
  BOOST_TEST(setup.refused[0].find("processor 1000000") != std::string::npos);
  BOOST_TEST(setup.refused[0].find("taskset") != std::string::npos);
  BOOST_TEST(setup.refused[1].find("SCHED_FIFO at priority 1000") != std::string::npos);
  BOOST_TEST(setup.refused[1].find("chrt") != std::string::npos);
  BOOST_TEST(setup.policy == "SCHED_OTHER");
  const std::string text = feeler::to_string(setup);
  for (const auto& sentence : setup.refused) BOOST_TEST(text.find(sentence) != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_loop_that_never_waits_is_not_given_the_processor) {
  ServoSettings settings = quiet(0, 1);
  settings.real_time.fifo = true;
  ServoLoop loop(settings, [](const ServoTick&) { return true; });
  const auto setup = loop.start();
  BOOST_TEST(setup.policy == "SCHED_OTHER");
  BOOST_TEST(setup.refused.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_loop_runs_on_the_processor_asked_for) {
  ServoSettings settings = quiet(1000, 1);
  settings.real_time.processor = 0;
  ServoLoop loop(settings, [](const ServoTick&) { return true; });
  const auto setup = loop.start();
  if (setup.refused.empty()) {
    BOOST_TEST(setup.processors == std::vector<int>{0});
  } else {
    BOOST_TEST_MESSAGE(setup.refused[0]);
  }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE_END()
