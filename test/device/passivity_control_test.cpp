// The passivity observer against the energy of a mass, and its damper against a wall that is too stiff.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "feeler/device/passivity_control.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"

BOOST_AUTO_TEST_SUITE(passivity_control)

using feeler::DeviceState;
using feeler::DeviceWrench;
using feeler::EnergySum;
using feeler::PassivityControl;
using feeler::PassivitySettings;

namespace {

constexpr double period = 1e-3;

/// A mass that nothing damps, pushed by wrenches that are constant between ticks: solved exactly.
struct FreeMass {
  double mass = 0.1;
  double position = 0;  // [m]
  double velocity = 0;  // [m/s]
  double time = 0;

  void advance(double force) {
    const double acceleration = force / mass;
    position += velocity * period + acceleration * period * period / 2;
    velocity += acceleration * period;
    time += period;
  }
  double energy() const { return mass * velocity * velocity / 2; }
  DeviceState state() const {
    DeviceState state;
    state.pose.position[1] = position;
    state.time = time;
    return state;
  }
};

/// What a mass does that falls onto a stiff wall with nothing to damp it, at the end of a second.
struct Bounce {
  double energy_out = 0;  // of the mass, after it left the wall [J]
  double energy_in = 0;
  feeler::PassivityReport report;
};

Bounce bounce_off(double stiffness, const PassivitySettings* settings) {
  FreeMass mass;
  mass.position = 0.001;
  mass.velocity = -0.2;
  Bounce bounce;
  bounce.energy_in = mass.energy();
  PassivityControl control(settings != nullptr ? *settings : PassivitySettings{});
  double force = 0;
  for (int i = 0; i < 1000; ++i) {
    mass.advance(force);
    DeviceWrench wrench{{0, std::max(0.0, -stiffness * mass.position), 0}, {0, 0, 0}};
    wrench = control.damped(mass.state(), wrench);
    control.pushed(wrench);
    force = wrench.force[1];
    if (mass.position > 0 && mass.velocity > 0) break;
  }
  bounce.energy_out = mass.energy();
  bounce.report = control.report();
  return bounce;
}

double length(const double (&v)[3]) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

BOOST_AUTO_TEST_CASE(the_observer_sees_the_energy_that_the_mass_gains_or_loses) {
  for (const int delay : {0, 1}) {
    PassivitySettings settings;  // damps nothing
    settings.delay = delay;
    PassivityControl control(settings);
    FreeMass mass;
    mass.velocity = 0.1;
    double waiting = 0, pushing = 0;
    double start = 0;
    for (int i = 0; i < 200; ++i) {
      mass.advance(pushing);
      const DeviceWrench wanted{{0, 3 * std::sin(0.1 * i) + 0.5, 0}, {0, 0, 0}};
      control.damped(mass.state(), wanted);
      if (i == 0) start = mass.energy();
      control.pushed(wanted);
      pushing = delay == 0 ? wanted.force[1] : waiting;
      waiting = wanted.force[1];
      BOOST_TEST_REQUIRE(std::abs(control.report().energy + mass.energy() - start) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(turning_counts_as_work_too) {
  PassivityControl control(PassivitySettings{});
  const auto turned = [](double angle, double time) {
    DeviceState state;
    state.pose.orientation[0] = std::cos(angle / 2);
    state.pose.orientation[3] = std::sin(angle / 2);
    state.time = time;
    return state;
  };
  const DeviceWrench wrench{{0, 0, 0}, {0.3, 0, 0.2}};
  control.damped(turned(1.0, 0), wrench);
  control.pushed(wrench);
  control.damped(turned(1.05, period), wrench);
  BOOST_TEST(control.report().energy == -0.05 * 0.2, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_wall_that_gives_energy_is_damped_until_it_gives_none) {
  constexpr double stiffness = 5000;
  PassivitySettings settings;
  settings.damping = 0.1 / (2 * period);
  const Bounce wild = bounce_off(stiffness, nullptr);
  BOOST_TEST(wild.energy_out > 1.3 * wild.energy_in);  // a sampled wall is a source
  for (const auto sum : {EnergySum::total, EnergySum::each_axis}) {
    settings.sum = sum;
    const Bounce tame = bounce_off(stiffness, &settings);
    BOOST_TEST(tame.energy_out < 1.05 * tame.energy_in);
    BOOST_TEST(tame.report.ticks_damped > 0);
    BOOST_TEST(tame.report.dissipated > 0);
  }
}

BOOST_AUTO_TEST_CASE(a_wall_that_gives_nothing_is_left_alone) {
  PassivitySettings settings;
  settings.damping = 10;
  settings.rotational_damping = 10;
  PassivityControl control(settings);
  DeviceState state;
  for (int i = 0; i < 100; ++i) {  // pressed in ever deeper, turned, and pushed back against both
    state.time = i * period;
    state.pose.position[0] = 1e-5 * i;
    state.pose.orientation[0] = std::cos(5e-4 * i);
    state.pose.orientation[1] = std::sin(5e-4 * i);
    const DeviceWrench wanted{{-0.01 * i - 0.1, 0, 0}, {-1e-3 * i, 0, 0}};
    const DeviceWrench same = control.damped(state, wanted);
    BOOST_TEST(same.force[0] == wanted.force[0]);
    BOOST_TEST(same.torque[0] == wanted.torque[0]);
    control.pushed(wanted);
  }
  BOOST_TEST(control.report().ticks_damped == 0);
  BOOST_TEST(control.report().energy > 0);
}

BOOST_AUTO_TEST_CASE(one_axis_may_give_what_another_took_only_where_energies_are_one_sum) {
  for (const auto sum : {EnergySum::total, EnergySum::each_axis}) {
    PassivitySettings settings;
    settings.sum = sum;
    settings.damping = 1;
    PassivityControl control(settings);
    DeviceState state;
    const DeviceWrench wrench{{-2, 1, 0}, {0, 0, 0}};
    control.damped(state, wrench);
    control.pushed(wrench);
    state.time = period;
    state.pose.position[0] = state.pose.position[1] = 1e-4;  // x takes twice what y gives
    const DeviceWrench damped = control.damped(state, wrench);
    BOOST_TEST(damped.force[0] == wrench.force[0]);
    if (sum == EnergySum::total) {
      BOOST_TEST(damped.force[1] == wrench.force[1]);
    } else {
      // Pays 1e-4 J in a tick at 0.1 m/s: a damper of 1 N s/m is not enough, so the whole of it.
      BOOST_TEST(damped.force[1] == wrench.force[1] - 0.1, boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(free_space_stays_free_and_forgets) {
  PassivitySettings settings;
  settings.damping = 10;
  PassivityControl control(settings);
  DeviceState state;
  const DeviceWrench push{{1, 0, 0}, {0, 0, 0}};
  control.damped(state, push);
  control.pushed(push);
  state.time = period;
  state.pose.position[0] = 1e-3;
  BOOST_TEST(control.damped(state, push).force[0] < 1);  // in debt
  control.pushed({});
  for (int i = 2; i < 10; ++i) {
    state.time = i * period;
    state.pose.position[0] = 1e-3 * i;
    const DeviceWrench nothing = control.damped(state, {});
    BOOST_TEST(length(nothing.force) == 0);
    BOOST_TEST(control.report().energy == 0);
    control.pushed({});
  }
  state.time = 10 * period;
  state.pose.position[0] = 1e-2;
  BOOST_TEST(control.damped(state, push).force[0] == 1);  // the debt is forgotten
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_passes_and_spoils_nothing) {
  PassivitySettings settings;
  settings.damping = 10;
  PassivityControl control(settings);
  DeviceState state;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  control.damped(state, {{1, 0, 0}, {0, 0, 0}});
  control.pushed({{1, 0, 0}, {0, 0, 0}});
  BOOST_TEST(std::isnan(control.damped(state, {{nan, 0, 0}, {0, 0, 0}}).force[0]));
  DeviceState bad = state;
  bad.pose.position[1] = nan;
  BOOST_TEST(control.damped(bad, {{1, 0, 0}, {0, 0, 0}}).force[0] == 1);
  state.time = period;
  BOOST_TEST(std::isfinite(control.damped(state, {{1, 0, 0}, {0, 0, 0}}).force[0]));
  BOOST_TEST(std::isfinite(control.report().energy));
}

BOOST_AUTO_TEST_CASE(settings_that_make_no_sense_are_refused) {
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    PassivitySettings settings;
    settings.damping = bad;
    BOOST_CHECK_THROW(PassivityControl{settings}, std::invalid_argument);
  }
  PassivitySettings late;
  late.delay = 2;
  BOOST_CHECK_THROW(PassivityControl{late}, std::invalid_argument);
  BOOST_CHECK_NO_THROW(PassivityControl(feeler::passivity_of(feeler::sigma_7(), period)));
}

BOOST_AUTO_TEST_CASE(a_servo_loop_damps_before_its_safety_and_reports_it) {
  // A wall of three times what the loop can render for a hand this light.
  constexpr double stiffness = 6000;
  double calm[2] = {0, 0};
  for (const bool is_passive : {false, true}) {
    feeler::SimulatedPhantomSettings phantom_settings;
    phantom_settings.grip = {.stiffness = 50, .rotational_stiffness = 0.05, .damping_ratio = 0.1};
    feeler::SimulatedPhantom phantom([](double time) { return feeler::DevicePose{{0, std::max(0.005 - 0.05 * time, -0.01), 0}, {1, 0, 0, 0}}; },
                                     phantom_settings);
    BOOST_REQUIRE(bool(phantom.open()));
    feeler::ServoSettings settings;
    settings.rate = 0;
    settings.tick_limit = 3000;
    settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
    if (is_passive) {
      settings.passivity = feeler::passivity_of(phantom.specification(), period);
      settings.passivity->delay = 1;
    }
    double& most = calm[is_passive ? 1 : 0];
    feeler::ServoLoop loop(settings, phantom, [&](const feeler::ServoTick& tick, const DeviceState& state) {
      if (tick.index > 2000) most = std::max(most, std::abs(state.pose.position[1]));
      return DeviceWrench{{0, std::max(0.0, -stiffness * state.pose.position[1]), 0}, {0, 0, 0}};
    });
    loop.start();
    const auto& report = loop.wait();
    BOOST_TEST((report.passivity.ticks_damped > 0) == is_passive);
    BOOST_TEST((to_string(report).find("passivity") != std::string::npos) == is_passive);
    BOOST_TEST(report.force.peak_force <= phantom.specification().maximum_force * (1 + 1e-12));
  }
  BOOST_TEST_MESSAGE("farthest from the wall in the last second: " << calm[0] << " m, with passivity control " << calm[1] << " m");
  BOOST_TEST(calm[1] < calm[0] / 3);
}

BOOST_AUTO_TEST_SUITE_END()
