// What stands between renderer and motors, driven tick by tick: every limit, and every fault at once and in
// its own time.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "feeler/device/force_safety.hpp"

BOOST_AUTO_TEST_SUITE(force_safety)

using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::ForceFault;
using feeler::ForceLimits;
using feeler::ForcePhase;
using feeler::ForceRequest;
using feeler::ForceSafety;

namespace {

const feeler::DeviceSpecification premium = feeler::phantom_premium_3_0_6dof();  // 22 N, 3 N for ever

double length(const double (&v)[3]) { return std::hypot(v[0], v[1], v[2]); }
bool is_silent(const DeviceWrench& wrench) { return length(wrench.force) == 0 && length(wrench.torque) == 0; }
DeviceWrench force(double x, double y = 0, double z = 0) { return {{x, y, z}, {0, 0, 0}}; }

/// A session at 1 kHz, a tick at a time.
struct Session {
  explicit Session(const feeler::DeviceSpecification& device = premium) : safety(feeler::limits_of(device), device) {}
  explicit Session(const ForceLimits& limits) : safety(limits, premium) {}

  /// One tick that is on time, with a pose that is new.
  DeviceWrench push(const DeviceWrench& wanted) {
    tick.now += 1e-3;
    tick.state.time += 1e-3;
    tick.wanted = wanted;
    const DeviceWrench pushed = safety.step(tick);
    tick.request = ForceRequest::none;
    return pushed;
  }

  /// Through the ramp: afterwards the force is on, at this wrench.
  DeviceWrench start(const DeviceWrench& wanted) {
    push({});
    DeviceWrench pushed;
    for (int i = 0; i < 400; ++i) pushed = push(wanted);
    BOOST_REQUIRE((safety.phase() == ForcePhase::on));
    return pushed;
  }

  ForceSafety safety;
  ForceSafety::Tick tick;
};

}  // namespace

BOOST_AUTO_TEST_CASE(it_starts_with_nothing_until_the_pose_is_free) {
  Session session;
  for (int i = 0; i < 1000; ++i) BOOST_TEST(is_silent(session.push(force(2))));
  BOOST_TEST((session.safety.phase() == ForcePhase::waiting));
  session.push({});
  BOOST_TEST((session.safety.phase() == ForcePhase::ramping));
}

BOOST_AUTO_TEST_CASE(the_ramp_grows_in_a_straight_line_over_its_time) {
  Session session;
  session.push({});
  for (int i = 1; i < 300; ++i) BOOST_TEST(session.push(force(2)).force[0] == 2 * i / 300.0, boost::test_tools::tolerance(1e-9));
  session.push(force(2));
  session.push(force(2));
  BOOST_TEST((session.safety.phase() == ForcePhase::on));
  BOOST_TEST(session.push(force(2)).force[0] == 2);
}

BOOST_AUTO_TEST_CASE(a_wrench_within_every_limit_passes_bit_for_bit) {
  Session session;
  session.start(force(1));
  for (int i = 0; i < 100; ++i) {
    const DeviceWrench wanted{{0.9, 0.001 * i, -0.3}, {0.001, -0.002, 0.0001 * i}};
    const DeviceWrench pushed = session.push(wanted);
    if (i == 0) continue;  // the turn of the first is slowed
    for (int k = 0; k < 3; ++k) {
      BOOST_TEST(pushed.force[k] == wanted.force[k]);
      BOOST_TEST(pushed.torque[k] == wanted.torque[k]);
    }
  }
}

BOOST_AUTO_TEST_CASE(free_space_is_free_at_once) {
  Session session;
  BOOST_TEST(session.start(force(10)).force[0] == 10);
  BOOST_TEST(is_silent(session.push({})));
}

BOOST_AUTO_TEST_CASE(whatever_is_wanted_it_is_never_lengthened_never_turned_and_never_grows_too_fast) {
  std::mt19937 bits(3);
  const auto unit = [&bits] { return double(bits()) / 2147483648.0 - 1; };
  Session session;
  session.start(force(1));
  const ForceLimits limits = feeler::limits_of(premium);
  double last_force = 1;
  double last_torque = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double scale = std::pow(10, 3 * unit());
    const DeviceWrench wanted{{scale * unit(), scale * unit(), scale * unit()}, {unit(), unit(), unit()}};
    const DeviceWrench pushed = session.push(wanted);
    const double f = length(pushed.force);
    const double t = length(pushed.torque);
    BOOST_REQUIRE(f <= std::min(limits.maximum_force, length(wanted.force)) * (1 + 1e-12));
    BOOST_REQUIRE(t <= std::min(limits.maximum_torque, length(wanted.torque)) * (1 + 1e-12));
    BOOST_REQUIRE(f <= last_force + limits.force_slew * 1e-3 + 1e-12);
    BOOST_REQUIRE(t <= last_torque + limits.torque_slew * 1e-3 + 1e-12);
    for (int k = 0; k < 3; ++k) BOOST_REQUIRE(std::abs(pushed.force[k] * length(wanted.force) - wanted.force[k] * f) < 1e-9 * scale * 22);
    last_force = f;
    last_torque = t;
  }
  BOOST_TEST(session.safety.report().ticks_shortened > 0);
  BOOST_TEST(session.safety.report().ticks_slowed > 0);
}

BOOST_AUTO_TEST_CASE(a_force_that_reverses_begins_anew_from_nothing) {
  Session session;
  session.start(force(5));
  const double step = feeler::limits_of(premium).force_slew * 1e-3;
  BOOST_TEST(session.push(force(-5)).force[0] == -step, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_motors_are_never_heated_beyond_what_the_continuous_force_heats_them_to) {
  Session session;
  session.start(force(1));
  double pushed = 0;
  double energy = 0;
  const int ticks = 100'000;  // 100 s of asking for all the device has
  bool gave_all = false;
  for (int i = 0; i < ticks; ++i) {
    pushed = length(session.push(force(100)).force);
    energy += pushed * pushed * 1e-3;
    gave_all = gave_all || pushed > 21.99;
    BOOST_REQUIRE(session.safety.report().peak_force_heat <= 1 + 1e-9);
  }
  BOOST_TEST(gave_all);
  BOOST_TEST(pushed < 3.1);  // the continuous force is 3 N
  BOOST_TEST(pushed >= 3);
  // Every joule over the continuous power was in the budget: the integral of F² is at most F_c² (t + τ).
  BOOST_TEST(energy <= 9 * (100 + 10) * 1.001);
}

BOOST_AUTO_TEST_CASE(warm_motors_take_from_the_force_and_hot_ones_all_of_it_until_the_pose_is_free) {
  Session session;
  session.start(force(20));
  session.tick.state.motor_temperature = 0.9;  // half way from 0.8 to 1
  BOOST_TEST(length(session.push(force(20)).force) <= 11 + 1e-9);
  session.tick.state.motor_temperature = 1;
  session.push(force(20));
  BOOST_TEST(is_silent(session.push(force(20))));
  BOOST_TEST((session.safety.fault() == ForceFault::hot_motors));
  session.tick.state.motor_temperature = 0.5;
  for (int i = 0; i < 100; ++i) BOOST_TEST(is_silent(session.push(force(20))));
  session.push({});
  BOOST_TEST((session.safety.phase() == ForcePhase::ramping));
}

BOOST_AUTO_TEST_CASE(what_stops_the_force_stops_it_in_the_same_tick_and_for_as_long_as_it_says) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Stop {
    void (*cause)(Session&);
    DeviceWrench wanted;
    ForceFault fault;
    bool can_restart;
  };
  const Stop stops[] = {
      {[](Session& s) { s.tick.request = ForceRequest::stop; }, force(2), ForceFault::emergency_stop, true},
      {[](Session&) {}, force(nan), ForceFault::not_finite, true},
      {[](Session&) {}, {{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}}, ForceFault::not_finite, true},
      {[](Session& s) { s.tick.state.pose.orientation[2] = std::numeric_limits<double>::quiet_NaN(); }, force(2), ForceFault::not_finite, true},
      {[](Session& s) { s.tick.status = DeviceStatus::fault; }, force(2), ForceFault::device_lost, false},
      {[](Session& s) { s.tick.status = DeviceStatus::not_open; }, force(2), ForceFault::device_lost, false},
  };
  for (const Stop& stop : stops) {
    Session session;
    session.start(force(2));
    stop.cause(session);
    BOOST_TEST(is_silent(session.push(stop.wanted)));
    BOOST_TEST((session.safety.fault() == stop.fault));
    BOOST_TEST((session.safety.report().first_fault == stop.fault));
    session.tick.status = DeviceStatus::ok;
    session.tick.state.pose = {};
    for (int i = 0; i < 1000; ++i) BOOST_REQUIRE(is_silent(session.push(force(i % 2))));
    BOOST_TEST((session.safety.phase() == ForcePhase::stopped));

    session.tick.request = ForceRequest::restart;
    session.push(force(2));
    if (!stop.can_restart) {
      BOOST_TEST((session.safety.phase() == ForcePhase::stopped));
      continue;
    }
    BOOST_TEST((session.safety.phase() == ForcePhase::waiting));  // in contact
    for (int i = 0; i < 100; ++i) BOOST_TEST(is_silent(session.push(force(2))));
    BOOST_TEST(session.start(force(2)).force[0] == 2);
  }
}

BOOST_AUTO_TEST_CASE(a_late_tick_fades_the_force_within_two_milliseconds_and_it_comes_back_by_the_ramp) {
  Session session;
  session.start(force(4));
  session.tick.state.time += 0.0025;
  BOOST_TEST(session.push(force(4)).force[0] == 2,
             boost::test_tools::tolerance(1e-6));  // at 0 ms: what holds until 1 ms
  BOOST_TEST((session.safety.fault() == ForceFault::late_tick));
  BOOST_TEST(is_silent(session.push(force(4))));  // from 1 ms on
  BOOST_TEST((session.safety.phase() == ForcePhase::ramping));
  BOOST_TEST(session.push(force(4)).force[0] == 4 / 300.0, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_wrench_that_took_too_long_is_late_though_its_pose_was_not) {
  Session session;
  session.start(force(4));
  session.tick.age = 0.0031;
  BOOST_TEST(session.push(force(9)).force[0] == 2, boost::test_tools::tolerance(1e-6));
  BOOST_TEST((session.safety.fault() == ForceFault::late_tick));
  session.tick.age = 0;
  BOOST_TEST(is_silent(session.push(force(9))));
}

BOOST_AUTO_TEST_CASE(a_device_that_complains_is_let_go_at_once_until_the_pose_is_free) {
  struct Complaint {
    void (*cause)(Session&);
    ForceFault fault;
  };
  for (const Complaint& complaint :
       {Complaint{[](Session& s) { s.tick.status = DeviceStatus::warning; }, ForceFault::device_warning},
        Complaint{[](Session& s) { s.tick.state.motor_temperature = std::numeric_limits<double>::quiet_NaN(); }, ForceFault::hot_motors}}) {
    Session session;
    session.start(force(4));
    complaint.cause(session);
    BOOST_TEST(is_silent(session.push(force(4))));
    BOOST_TEST((session.safety.fault() == complaint.fault));
    BOOST_TEST(is_silent(session.push({})));  // free, but it still complains
    session.tick.status = DeviceStatus::ok;
    session.tick.state.motor_temperature = 0;
    for (int i = 0; i < 100; ++i) BOOST_TEST(is_silent(session.push(force(4))));
    BOOST_TEST((session.safety.phase() == ForcePhase::waiting));
    BOOST_TEST(session.start(force(4)).force[0] == 4);
  }
}

BOOST_AUTO_TEST_CASE(a_fade_at_four_kilohertz_takes_no_longer) {
  Session session;
  session.start(force(4));
  session.tick.state.time += 0.003;
  session.tick.period = 0.25e-3;
  double last = 4;
  for (int i = 0; i < 8; ++i) {
    session.tick.now += 0.25e-3;
    session.tick.state.time += 0.25e-3;
    const double pushed = session.safety.step(session.tick).force[0];
    BOOST_TEST(pushed < last);
    last = pushed;
  }
  BOOST_TEST(last == 0);  // written 1.75 ms after the first
}

BOOST_AUTO_TEST_CASE(a_fade_goes_by_its_ticks_where_the_clock_does_not) {
  for (const double step : {0.0, -1e-3, -100.0}) {
    Session session;
    session.start(force(4));
    session.tick.period = 0.25e-3;
    session.tick.state.time += 0.003;  // late
    double last = 4;
    for (int i = 0; i < 8; ++i) {
      session.tick.now += step;
      session.tick.state.time += 0.25e-3;
      const double pushed = session.safety.step(session.tick).force[0];
      BOOST_TEST(pushed == 4 * (7 - i) / 8.0, boost::test_tools::tolerance(1e-9));
      BOOST_TEST(pushed < last);
      last = pushed;
    }
    BOOST_TEST(last == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_repeats_a_pose_is_let_go_and_comes_back_by_the_ramp) {
  Session session;
  session.start(force(4));
  const double standing = session.tick.state.time;
  int ticks = 0;
  while (session.safety.fault() == ForceFault::none && ticks < 100) {
    session.tick.now += 1e-3;
    session.safety.step(session.tick);
    ++ticks;
  }
  BOOST_TEST((session.safety.fault() == ForceFault::stale_pose));
  BOOST_TEST((ticks == 3 || ticks == 4));  // 3 ms, and a rounding, after the pose came
  session.tick.now += 1e-3;
  BOOST_TEST(is_silent(session.safety.step(session.tick)));
  for (int i = 0; i < 100; ++i) {
    session.tick.now += 1e-3;
    BOOST_TEST(is_silent(session.safety.step(session.tick)));
  }
  session.tick.state.time = standing;
  session.push(force(4));
  BOOST_TEST(session.push(force(4)).force[0] < 0.1);
  for (int i = 0; i < 400; ++i) session.push(force(4));
  BOOST_TEST((session.safety.phase() == ForcePhase::on));
}

BOOST_AUTO_TEST_CASE(a_force_only_device_drops_the_torque_and_says_how_much) {
  Session session(feeler::touch());
  session.push({});
  for (int i = 0; i < 400; ++i) {
    const auto pushed = session.push({{0.5, 0, 0}, {0, 0.03, 0.04}});
    BOOST_REQUIRE(length(pushed.torque) == 0);
  }
  BOOST_TEST(session.push({{0.5, 0, 0}, {0, 0.03, 0.04}}).force[0] == 0.5);
  BOOST_TEST(session.safety.report().ticks_without_torque == 401);
  BOOST_TEST(session.safety.report().peak_lost_torque == 0.05, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(limits_that_are_none_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto refuses = [](double ForceLimits::* limit, std::vector<double> values) {
    for (const double value : values) {
      ForceLimits limits = feeler::limits_of(premium);
      limits.*limit = value;
      BOOST_CHECK_THROW(Session{limits}, std::invalid_argument);
    }
  };
  BOOST_CHECK_NO_THROW(Session{feeler::limits_of(premium)});
  refuses(&ForceLimits::maximum_force, {0, -1, 22.1, infinity, nan});
  refuses(&ForceLimits::continuous_force, {0, -1, 23, infinity, nan});
  refuses(&ForceLimits::maximum_torque, {-1, 0, 1, infinity, nan});  // 0 contradicts the continuous torque
  refuses(&ForceLimits::continuous_torque, {0, 1, nan});
  refuses(&ForceLimits::force_slew, {0, 22'001, infinity, nan});
  refuses(&ForceLimits::torque_slew, {0, 189, infinity, nan});
  refuses(&ForceLimits::free_force, {-1, 3, nan});
  refuses(&ForceLimits::free_torque, {-1, 1, nan});
  refuses(&ForceLimits::ramp_time, {0, 0.01, nan});
  refuses(&ForceLimits::fade_time, {-1, 0.003, infinity, nan});
  refuses(&ForceLimits::latest_tick, {0, 0.1, infinity, nan});
  refuses(&ForceLimits::heating_time, {0, 1000, nan});
  refuses(&ForceLimits::warm_temperature, {-1, 1, nan});
}

BOOST_AUTO_TEST_CASE(every_fault_and_phase_has_words) {
  for (int fault = 0; fault < feeler::force_faults; ++fault) BOOST_TEST(feeler::to_string(ForceFault(fault)) != "unknown fault");
  for (int phase = 0; phase < 5; ++phase) BOOST_TEST(feeler::to_string(ForcePhase(phase)) != "unknown phase");
}

BOOST_AUTO_TEST_SUITE_END()
