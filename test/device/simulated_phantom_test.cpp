// The simulated Phantom: determinism, delay, saturation, encoders, and a closed loop with a virtual wall.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "feeler/device/simulated_phantom.hpp"

BOOST_AUTO_TEST_SUITE(simulated_phantom)

using feeler::DevicePose;
using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::SimulatedPhantom;
using feeler::SimulatedPhantomSettings;

namespace {

DevicePose resting(double) { return {}; }

DevicePose turned_about_x(double angle) { return {{0, 0, 0}, {std::cos(angle / 2), std::sin(angle / 2), 0, 0}}; }

double angle_about_x(const DevicePose& pose) { return 2 * std::atan2(pose.orientation[1], pose.orientation[0]); }

/// Presses to a depth within 50 ms and holds: a hand that hits the wall at up to 0.3 m/s.
double pressed(double time, double start, double depth) { return start + (depth - start) * std::min(time / 0.05, 1.0); }

struct Settling {
  double peak_early = 0;   // of the deviation from the balance, 0.5 s to 1 s
  double span_late = 0;    // highest minus lowest, 4 s to 5 s
  double mean_late = 0;
};

/// Runs read, wall, write for 5 s; a coordinate below 0 is in the wall.
template <class Coordinate, class Push>
Settling run_against_wall(SimulatedPhantom& phantom, double balance, Coordinate coordinate, Push push) {
  Settling settling;
  double lowest = 1e9;
  double highest = -1e9;
  BOOST_REQUIRE(bool(phantom.open()));
  for (int tick = 0; tick < 5000; ++tick) {
    DeviceState state;
    BOOST_REQUIRE(phantom.read(state) == DeviceStatus::ok);
    const double x = coordinate(state.pose);
    if (tick >= 500 && tick < 1000) settling.peak_early = std::max(settling.peak_early, std::abs(x - balance));
    if (tick >= 4000) {
      lowest = std::min(lowest, x);
      highest = std::max(highest, x);
      settling.mean_late += x / 1000;
    }
    BOOST_REQUIRE(phantom.write(push(std::max(0.0, -x))) == DeviceStatus::ok);
  }
  settling.span_late = highest - lowest;
  return settling;
}

std::vector<DeviceState> shaken_run(std::uint32_t seed) {
  SimulatedPhantomSettings settings;
  settings.grip.tremor = 1e-4;
  settings.grip.rotational_tremor = 1e-3;
  settings.grip.seed = seed;
  SimulatedPhantom phantom([](double t) { return turned_about_x(0.3 * std::sin(t)); }, settings);
  BOOST_REQUIRE(bool(phantom.open()));
  std::vector<DeviceState> states(2000);
  for (std::size_t i = 0; i < states.size(); ++i) {
    BOOST_REQUIRE(phantom.read(states[i]) == DeviceStatus::ok);
    phantom.write({{-100 * states[i].pose.position[0], 0.1, 0}, {0, 0, 0.01 * std::cos(double(i))}});
  }
  return states;
}

bool same_bits(const DeviceState& a, const DeviceState& b) {
  return std::memcmp(&a.pose, &b.pose, sizeof a.pose) == 0 && std::memcmp(&a.time, &b.time, sizeof a.time) == 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_same_seed_and_wrenches_give_the_same_poses_bit_for_bit) {
  const auto first = shaken_run(3);
  const auto again = shaken_run(3);
  const auto other = shaken_run(4);
  BOOST_TEST(std::equal(first.begin(), first.end(), again.begin(), same_bits));
  BOOST_TEST(!std::equal(first.begin(), first.end(), other.begin(), same_bits));
}

BOOST_AUTO_TEST_CASE(opening_again_starts_the_same_run_again) {
  SimulatedPhantom phantom([](double t) { return DevicePose{{0.1 * t, 0, 0}, {1, 0, 0, 0}}; });
  std::vector<DeviceState> runs[2];
  for (auto& run : runs) {
    BOOST_REQUIRE(bool(phantom.open()));
    for (int i = 0; i < 50; ++i) {
      DeviceState state;
      phantom.read(state);
      phantom.write({{1, 0, 0}, {0, 0, 0}});
      run.push_back(state);
    }
    phantom.close();
  }
  BOOST_TEST(std::equal(runs[0].begin(), runs[0].end(), runs[1].begin(), same_bits));
  BOOST_TEST(runs[0].front().time == 0);
  BOOST_TEST(runs[0].back().time == 0.049, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_wrench_is_felt_one_tick_after_it_is_written) {
  SimulatedPhantomSettings settings;
  settings.specification.position_resolution = 0;
  SimulatedPhantom phantom(resting, settings);
  phantom.open();
  DeviceState state;
  phantom.read(state);
  phantom.write({{5, 0, 0}, {0, 0, 0}});
  phantom.read(state);
  BOOST_TEST(state.pose.position[0] == 0);
  phantom.read(state);
  BOOST_TEST(state.pose.position[0] > 0);
}

BOOST_AUTO_TEST_CASE(a_wrench_beyond_the_device_pushes_with_its_maximum_in_the_same_direction) {
  SimulatedPhantomSettings settings;
  settings.specification.position_resolution = 0;
  settings.specification.rotation_resolution = 0;
  SimulatedPhantom phantom(resting, settings);
  phantom.open();
  DeviceState state;
  for (int i = 0; i < 1000; ++i) {
    phantom.read(state);
    phantom.write({{300, 0, -400}, {7, 0, 0}});
  }
  // The grip's spring shows the force that is pushed: 22 N along (3, 0, −4)/5, and 0.188 N·m.
  const auto tolerance = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(state.pose.position[0] * 1000 == 22 * 0.6, tolerance);
  BOOST_TEST(state.pose.position[2] * 1000 == -22 * 0.8, tolerance);
  BOOST_TEST(angle_about_x(state.pose) * 0.5 == 0.188, tolerance);
}

BOOST_AUTO_TEST_CASE(the_reported_pose_is_on_the_grid_of_the_encoders_and_close_to_the_exact_one) {
  SimulatedPhantom phantom([](double t) { return DevicePose{{0.1 * t, 0.05 * std::sin(t), 0}, {1, 0, 0, 0}}; });
  const double count = phantom.specification().position_resolution;
  phantom.open();
  for (int i = 0; i < 1000; ++i) {
    DeviceState state;
    phantom.read(state);
    for (int axis = 0; axis < 3; ++axis) {
      const double counts = state.pose.position[axis] / count;
      BOOST_REQUIRE(std::abs(counts - std::round(counts)) < 1e-9);
      BOOST_REQUIRE(std::abs(state.pose.position[axis] - phantom.exact_pose().position[axis]) <= count * 0.5000001);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_closed_device_and_a_wrench_that_is_not_finite_say_so_and_push_nothing) {
  SimulatedPhantomSettings settings;
  settings.specification.position_resolution = 0;
  SimulatedPhantom phantom(resting, settings);
  DeviceState state;
  BOOST_TEST((phantom.read(state) == DeviceStatus::not_open));
  BOOST_TEST((phantom.write({}) == DeviceStatus::not_open));
  phantom.open();
  phantom.read(state);
  phantom.write({{5, 0, 0}, {0, 0, 0}});
  const double bad = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((phantom.write({{0, 0, 0}, {bad, 0, 0}}) == DeviceStatus::not_finite));
  for (int i = 0; i < 10; ++i) phantom.read(state);
  BOOST_TEST(state.pose.position[0] == 0);
  phantom.close();
  BOOST_TEST((phantom.read(state) == DeviceStatus::not_open));
}

BOOST_AUTO_TEST_CASE(a_wall_of_1000_newtons_a_metre_settles_without_growth_or_limit_cycle) {
  for (const double grip_stiffness : {500.0, 1000.0, 1500.0}) {
    BOOST_TEST_CONTEXT("grip " << grip_stiffness << " N/m") {
      SimulatedPhantomSettings settings;
      settings.grip.stiffness = grip_stiffness;
      const double depth = -0.005;
      SimulatedPhantom phantom([depth](double t) { return DevicePose{{0, pressed(t, 0.01, depth), 0}, {1, 0, 0, 0}}; }, settings);
      // Two springs in series: (k_grip + K) x = k_grip · depth.
      const double balance = grip_stiffness * depth / (grip_stiffness + 1000);
      const double count = settings.specification.position_resolution;
      const auto settling = run_against_wall(
          phantom, balance, [](const DevicePose& pose) { return pose.position[1]; },
          [](double into) { return DeviceWrench{{0, 1000 * into, 0}, {0, 0, 0}}; });
      BOOST_TEST_MESSAGE("late span " << settling.span_late / count << " counts, early peak " << settling.peak_early / count << " counts");
      BOOST_TEST(settling.span_late <= 3 * count);
      BOOST_TEST(settling.peak_early <= 3 * count);
      BOOST_TEST(std::abs(settling.mean_late - balance) <= 2 * count);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rotational_wall_of_0_3_newton_metres_a_radian_settles_too) {
  SimulatedPhantomSettings settings;
  const double depth = -0.2;
  SimulatedPhantom phantom([depth](double t) { return turned_about_x(pressed(t, 0.1, depth)); }, settings);
  const double grip_stiffness = settings.grip.rotational_stiffness;
  const double balance = grip_stiffness * depth / (grip_stiffness + 0.3);
  const double count = settings.specification.rotation_resolution;
  const auto settling = run_against_wall(
      phantom, balance, [](const DevicePose& pose) { return angle_about_x(pose); },
      [](double into) { return DeviceWrench{{0, 0, 0}, {0.3 * into, 0, 0}}; });
  BOOST_TEST_MESSAGE("late span " << settling.span_late / count << " counts, early peak " << settling.peak_early / count << " counts");
  BOOST_TEST(settling.span_late <= 3 * count);
  BOOST_TEST(settling.peak_early <= 3 * count);
  BOOST_TEST(std::abs(settling.mean_late - balance) <= 2 * count);
}

BOOST_AUTO_TEST_CASE(a_wall_far_too_stiff_for_the_delay_does_buzz) {
  // The canary of the two tests above: they could see a limit cycle. A tick and a half of delay turns 100 kN/m into power.
  SimulatedPhantom phantom([](double t) { return DevicePose{{0, pressed(t, 0.01, -0.005), 0}, {1, 0, 0, 0}}; });
  const double count = phantom.specification().position_resolution;
  const auto settling = run_against_wall(
      phantom, 0, [](const DevicePose& pose) { return pose.position[1]; }, [](double into) { return DeviceWrench{{0, 1e5 * into, 0}, {0, 0, 0}}; });
  BOOST_TEST(settling.span_late > 10 * count);
}

BOOST_AUTO_TEST_SUITE(device_interface)

BOOST_AUTO_TEST_CASE(a_device_can_be_held_by_its_interface_alone) {
  std::unique_ptr<feeler::Device> device = std::make_unique<SimulatedPhantom>(resting);
  BOOST_TEST(device->specification().name == "Phantom Premium 3.0/6DOF");
  const feeler::OpenResult opened = device->open();
  BOOST_TEST(bool(opened));
  BOOST_TEST(opened.problem.empty());
  BOOST_TEST(!bool(feeler::OpenResult{"No device answers; switch it on."}));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE_END()
