// A loop as an engine runs it, at its own rate: the wrench is capped, ramped and stopped, whatever the scene wants.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "feeler/device/wrench_guard.hpp"

BOOST_AUTO_TEST_SUITE(wrench_guard)

using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::ForceFault;
using feeler::ForcePhase;
using feeler::WrenchGuard;

namespace {

double length(const double (&v)[3]) { return std::hypot(v[0], v[1], v[2]); }
bool is_silent(const DeviceWrench& wrench) { return length(wrench.force) == 0 && length(wrench.torque) == 0; }

const double nan_number = std::numeric_limits<double>::quiet_NaN();
constexpr DeviceWrench bullet{{12, 0, -12}, {0, 0, 0}};     // 17 N, as an engine got it
constexpr DeviceWrench spring{{0, 2020, 0}, {0, 0, 1e300}};  // a start inside

/// An engine's loop with a Touch: 3.3 N.
struct Engine {
  explicit Engine(double rate) : period(1 / rate), guard(feeler::touch(), rate) {}

  DeviceWrench frame(const DeviceWrench& wanted, DeviceStatus status = DeviceStatus::ok) {
    now += period;
    state.time += period;
    return guard.allowed(state, wanted, now, status);
  }
  /// Seconds of contact, from a free pose on; the last wrench.
  DeviceWrench touch(const DeviceWrench& wanted, double seconds) {
    frame({});
    DeviceWrench pushed;
    for (double t = 0; t < seconds; t += period) pushed = frame(wanted);
    return pushed;
  }

  double period;
  double now = 1000;  // of the engine's clock, which is not the device's
  DeviceState state;
  WrenchGuard guard;
};

constexpr double rates[] = {25, 60, 90, 250, 1000, 10'000};  // [Hz]

}  // namespace

BOOST_AUTO_TEST_CASE(no_wish_gets_more_than_the_device_may_give_and_the_direction_stays) {
  for (const double rate : rates) {
    for (const DeviceWrench& wish : {bullet, spring}) {
      BOOST_TEST_CONTEXT(rate << " Hz, " << length(wish.force) << " N") {
        Engine engine(rate);
        const DeviceWrench pushed = engine.touch(wish, 0.5);
        BOOST_TEST((engine.guard.phase() == ForcePhase::on));
        BOOST_TEST(length(pushed.force) <= 3.3 * (1 + 1e-12));
        BOOST_TEST(length(pushed.force) > 2);
        BOOST_TEST(length(pushed.torque) == 0);  // the Touch has no motors for it
        for (int i = 0; i < 3; ++i)
          BOOST_TEST(pushed.force[i] / length(pushed.force) == wish.force[i] / length(wish.force), boost::test_tools::tolerance(1e-12));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(in_the_long_run_it_is_what_the_motors_bear_for_ever) {
  for (const double rate : rates) {
    Engine engine(rate);
    const DeviceWrench pushed = engine.touch(bullet, 120);
    BOOST_TEST(length(pushed.force) == 0.88, boost::test_tools::tolerance(0.01));
  }
}

BOOST_AUTO_TEST_CASE(it_begins_with_nothing_in_contact_and_grows_over_the_ramp) {
  for (const double rate : rates) {
    BOOST_TEST_CONTEXT(rate << " Hz") {
      Engine engine(rate);
      for (int i = 0; i < 100; ++i) BOOST_TEST(is_silent(engine.frame(spring)));  // a start inside is never free
      engine.frame({});
      double last = 0;
      for (double t = engine.period; t < 0.29; t += engine.period) {
        const double force = length(engine.frame({{1, 0, 0}, {0, 0, 0}}).force);
        BOOST_TEST(force == t / 0.3, boost::test_tools::tolerance(1e-6));
        BOOST_TEST(force > last);
        last = force;
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_number_that_is_none_stops_it_until_it_is_restarted_in_a_free_pose) {
  for (const double rate : rates) {
    for (int place = 0; place < 4; ++place) {
      BOOST_TEST_CONTEXT(rate << " Hz, in place " << place) {
        Engine engine(rate);
        BOOST_TEST(!is_silent(engine.touch(bullet, 0.5)));
        const DeviceState before = engine.state;
        DeviceWrench wish = bullet;
        if (place == 0) wish.force[1] = nan_number;
        if (place == 1) wish.torque[2] = std::numeric_limits<double>::infinity();
        if (place == 2) engine.state.pose.position[0] = nan_number;
        if (place == 3) engine.state.pose.orientation[3] = nan_number;
        BOOST_TEST(is_silent(engine.frame(wish)));
        BOOST_TEST((engine.guard.fault() == ForceFault::not_finite));
        engine.state.pose = before.pose;
        for (int i = 0; i < 200; ++i) BOOST_TEST(is_silent(engine.frame(i % 2 == 0 ? DeviceWrench{} : bullet)));
        engine.guard.restart();
        BOOST_TEST(is_silent(engine.frame(bullet)));
        BOOST_TEST(!is_silent(engine.touch(bullet, 0.1)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_repeats_an_old_pose_is_silenced_and_comes_back_by_the_ramp) {
  for (const double rate : rates) {
    BOOST_TEST_CONTEXT(rate << " Hz") {
      Engine engine(rate);
      const double before = length(engine.touch({{1, 0, 0}, {0, 0, 0}}, 0.5).force);
      // Three periods, 3 ms at least; then a fade of 2 ms at most, and a frame for the sum's rounding.
      const int frames = int(std::ceil(std::max(3 * engine.period, 0.003) / engine.period)) + int(std::ceil(0.002 / engine.period)) + 1;
      for (int i = 0; i < 50; ++i) {
        engine.now += engine.period;
        const DeviceWrench pushed = engine.guard.allowed(engine.state, {{1, 0, 0}, {0, 0, 0}}, engine.now);
        if (i >= frames) BOOST_TEST(is_silent(pushed));
      }
      BOOST_TEST((engine.guard.fault() == ForceFault::stale_pose));
      BOOST_TEST(length(engine.frame({{1, 0, 0}, {0, 0, 0}}).force) < 0.2 * before);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_frame_that_hangs_takes_the_force_away_even_where_the_device_tells_no_time) {
  for (const double rate : rates) {
    for (const bool tells_time : {false, true}) {
      BOOST_TEST_CONTEXT(rate << " Hz") {
        Engine engine(rate);
        if (!tells_time) engine.state.time = engine.now;
        BOOST_TEST(!is_silent(engine.touch(bullet, 0.5)));
        engine.now += 0.2;
        if (!tells_time) engine.state.time = engine.now;
        DeviceWrench pushed = engine.guard.allowed(engine.state, bullet, engine.now);
        BOOST_TEST((engine.guard.fault() == ForceFault::late_tick));
        for (int i = 0; i < int(std::ceil(0.002 / engine.period)); ++i) pushed = engine.frame(bullet);
        BOOST_TEST(length(pushed.force) < 0.5);  // the ramp at most: at 25 Hz 0.13 of 3.3 N a frame
      }
    }
  }
}

/// Frames in which a force is gone: the fade of 2 ms, the frame in which it was found out, and one for rounding.
int frames_of_a_fade(const Engine& engine) { return int(std::ceil(0.002 / engine.period)) + 2; }

BOOST_AUTO_TEST_CASE(a_clock_that_stands_or_is_none_holds_no_force) {
  for (const double rate : rates) {
    for (const double step : {0.0, nan_number}) {
      BOOST_TEST_CONTEXT(rate << " Hz, by " << step) {
        Engine engine(rate);
        BOOST_TEST(!is_silent(engine.touch(bullet, 0.5)));
        for (int i = 0; i < 50; ++i) {
          engine.state.time += engine.period;
          const DeviceWrench pushed = engine.guard.allowed(engine.state, bullet, engine.now + step);
          if (i >= frames_of_a_fade(engine)) BOOST_TEST(is_silent(pushed));
        }
        BOOST_TEST((engine.guard.fault() == ForceFault::late_tick));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_clock_that_is_set_back_holds_no_force) {
  for (const double rate : rates) {
    for (int frames_of_fade = 0; frames_of_fade < 3; ++frames_of_fade) {
      BOOST_TEST_CONTEXT(rate << " Hz, after " << frames_of_fade << " frames of a fade") {
        Engine engine(rate);
        const double before = length(engine.touch({{1, 0, 0}, {0, 0, 0}}, 0.5).force);
        engine.state.time += frames_of_fade > 0 ? 1 : 0;  // the device was away
        for (int i = 0; i < frames_of_fade; ++i) engine.frame({{1, 0, 0}, {0, 0, 0}});
        engine.now -= 100;
        for (int i = 0; i < frames_of_a_fade(engine); ++i) engine.frame({{1, 0, 0}, {0, 0, 0}});
        BOOST_TEST(length(engine.frame({{1, 0, 0}, {0, 0, 0}}).force) < 0.5 * before);  // the ramp at most
        BOOST_TEST((engine.guard.phase() == ForcePhase::ramping));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_old_pose_does_not_become_young_by_a_clock_that_is_set_back_or_was_none) {
  for (const double rate : rates) {
    for (const double step : {-100.0, nan_number}) {
      BOOST_TEST_CONTEXT(rate << " Hz, by " << step) {
        Engine engine(rate);
        engine.touch(bullet, 0.5);
        engine.state.time += step < 0 ? 0 : engine.period;  // the last new pose
        engine.guard.allowed(engine.state, bullet, engine.now + step);
        engine.now += step < 0 ? step : 0;
        const int frames = int(std::ceil(std::max(3 * engine.period, 0.003) / engine.period)) + frames_of_a_fade(engine);
        for (int i = 0; i < frames + 50; ++i) {
          engine.now += engine.period;
          const DeviceWrench pushed = engine.guard.allowed(engine.state, bullet, engine.now);
          if (i >= frames) BOOST_TEST(is_silent(pushed));
        }
        BOOST_TEST((engine.guard.fault() == ForceFault::stale_pose));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_the_device_says_of_itself_counts) {
  for (const DeviceStatus status : {DeviceStatus::warning, DeviceStatus::not_finite, DeviceStatus::fault, DeviceStatus::not_open}) {
    Engine engine(60);
    BOOST_TEST(!is_silent(engine.touch(bullet, 0.5)));
    BOOST_TEST(is_silent(engine.frame(bullet, status)));
    BOOST_TEST(is_silent(engine.frame(bullet)));  // the pose is not free
    const bool is_lost = status == DeviceStatus::fault || status == DeviceStatus::not_open;
    engine.guard.restart();
    BOOST_TEST(is_silent(engine.touch(bullet, 0.1)) == is_lost);
  }
}

BOOST_AUTO_TEST_CASE(a_stop_by_the_program_is_not_overtaken) {
  Engine engine(60);
  BOOST_TEST(!is_silent(engine.touch(bullet, 0.5)));
  engine.guard.stop();
  engine.guard.restart();
  BOOST_TEST(is_silent(engine.frame(bullet)));
  BOOST_TEST(is_silent(engine.touch(bullet, 0.5)));
  engine.guard.restart();
  BOOST_TEST(!is_silent(engine.touch(bullet, 0.1)));
}

BOOST_AUTO_TEST_CASE(rates_and_limits_that_watch_nothing_are_refused) {
  for (const double rate : {0.0, -60.0, 24.9, 10'001.0, nan_number, std::numeric_limits<double>::infinity()})
    BOOST_CHECK_THROW(WrenchGuard(feeler::touch(), rate), std::invalid_argument);
  BOOST_CHECK_NO_THROW(WrenchGuard(feeler::touch(), 25));
  auto limits = feeler::limits_of(feeler::touch());
  BOOST_CHECK_THROW(WrenchGuard(feeler::touch(), 60, limits), std::invalid_argument);  // 3 ms, in frames of 17
  limits.maximum_force = 5;
  BOOST_CHECK_THROW(WrenchGuard(feeler::touch(), 1000, limits), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_device_that_is_said_to_push_without_end_is_refused) {
  using Figure = double feeler::DeviceSpecification::*;
  const Figure figures[][2] = {{&feeler::DeviceSpecification::maximum_force, &feeler::DeviceSpecification::continuous_force},
                               {&feeler::DeviceSpecification::maximum_torque, &feeler::DeviceSpecification::continuous_torque}};
  for (const auto& [most, for_ever] : figures) {
    for (const double value : {std::numeric_limits<double>::infinity(), 1e300, 10'001.0, nan_number}) {
      auto device = feeler::sigma_7();
      device.*most = value;
      BOOST_CHECK_THROW(WrenchGuard(device, 1000), std::invalid_argument);
      device.*for_ever = value;
      BOOST_CHECK_THROW(WrenchGuard(device, 1000), std::invalid_argument);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
