// The simulated hand against closed forms of the damped oscillator.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "feeler/device/simulated_hand.hpp"

BOOST_AUTO_TEST_SUITE(simulated_hand)

using feeler::DevicePose;
using feeler::DeviceWrench;
using feeler::Grip;
using feeler::Handle;
using feeler::SimulatedHand;

namespace {

constexpr Handle frictionless_handle = {0.159, 2e-4, 0, 0};

DevicePose resting(double) { return {}; }

DevicePose turned_about_y(double angle) { return {{0, 0, 0}, {std::cos(angle / 2), 0, std::sin(angle / 2), 0}}; }

double angle_about_y(const DevicePose& pose) { return 2 * std::atan2(pose.orientation[2], pose.orientation[0]); }

/// x(t) of m a = −k x − c v from x(0) = 1, v(0) = 0.
double free_response(double mass, double stiffness, double damping, double time) {
  const double rate = std::sqrt(stiffness / mass);
  const double ratio = damping / (2 * std::sqrt(stiffness * mass));
  const double decay = ratio * rate;
  if (std::abs(ratio - 1) < 1e-9) return (1 + rate * time) * std::exp(-rate * time);
  if (ratio < 1) {
    const double damped = rate * std::sqrt(1 - ratio * ratio);
    return std::exp(-decay * time) * (std::cos(damped * time) + decay / damped * std::sin(damped * time));
  }
  const double spread = rate * std::sqrt(ratio * ratio - 1);
  return std::exp(-decay * time) * (std::cosh(spread * time) + decay / spread * std::sinh(spread * time));
}

/// Largest difference from the closed form over 0.3 s, relative to the displacement at the start.
double step_response_error(double damping_ratio, int substeps, bool rotates) {
  Grip grip;
  grip.damping_ratio = damping_ratio;
  const double stiffness = rotates ? grip.rotational_stiffness : grip.stiffness;
  const double inertia = rotates ? frictionless_handle.inertia : frictionless_handle.mass;
  const double damping = 2 * damping_ratio * std::sqrt(stiffness * inertia);
  const double start = rotates ? 0.3 : 0.01;
  SimulatedHand hand(resting, frictionless_handle, grip, 1e-3, substeps);
  hand.place(rotates ? turned_about_y(start) : DevicePose{{0, start, 0}, {1, 0, 0, 0}});
  double worst = 0;
  for (int tick = 1; tick <= 300; ++tick) {
    hand.advance({});
    const double now = rotates ? angle_about_y(hand.pose()) : hand.pose().position[1];
    const double expected = start * free_response(inertia, stiffness, damping, tick * 1e-3);
    worst = std::max(worst, std::abs(now - expected) / start);
  }
  return worst;
}

void run(SimulatedHand& hand, const DeviceWrench& wrench, double seconds) {
  const int ticks = int(std::lround(seconds * 1000));
  for (int i = 0; i < ticks; ++i) hand.advance(wrench);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_released_handle_follows_the_closed_form_to_first_order_in_the_substep) {
  for (const bool rotates : {false, true}) {
    for (const double ratio : {0.2, 1.0, 1.5}) {
      BOOST_TEST_CONTEXT("damping ratio " << ratio << (rotates ? ", rotation" : ", translation")) {
        const double coarse = step_response_error(ratio, 10, rotates);
        const double fine = step_response_error(ratio, 20, rotates);
        // ω h is 0.008: the error of a first-order method is of that order, and halves with the substep.
        BOOST_TEST(coarse < 0.01);
        BOOST_TEST(fine / coarse > 0.4);
        BOOST_TEST(fine / coarse < 0.6);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_steady_wrench_is_balanced_by_the_spring_of_the_grip) {
  SimulatedHand hand(resting);
  run(hand, {{2, -1, 0.5}, {0, 0.05, 0}}, 1.0);
  const auto tolerance = boost::test_tools::tolerance(1e-9);
  BOOST_TEST(hand.pose().position[0] == 2.0 / 1000, tolerance);
  BOOST_TEST(hand.pose().position[1] == -1.0 / 1000, tolerance);
  BOOST_TEST(hand.pose().position[2] == 0.5 / 1000, tolerance);
  BOOST_TEST(angle_about_y(hand.pose()) == 0.05 / 0.5, tolerance);
}

BOOST_AUTO_TEST_CASE(a_steady_hand_drags_the_handle_behind_by_the_damping_of_the_device_alone) {
  const double speed = 0.2;
  const Handle handle = {0.159, 2e-4, 0.5, 2e-4};
  SimulatedHand hand([speed](double t) { return DevicePose{{speed * t, 0, 0}, {1, 0, 0, 0}}; }, handle);
  run(hand, {}, 1.0);
  // k (x_path − x) = b v
  BOOST_TEST(speed * hand.time() - hand.pose().position[0] == 0.5 * speed / 1000, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(friction_takes_its_part_of_a_push_and_holds_a_weaker_one) {
  constexpr Handle handle = {.mass = 0.159, .inertia = 2e-4, .damping = 0, .rotational_damping = 0, .friction = 0.2, .rotational_friction = 0.01};
  constexpr Grip no_grip = {.stiffness = 0, .rotational_stiffness = 0};
  const auto tolerance = boost::test_tools::tolerance(0.01);  // first order in a substep of 1e-4 s
  SimulatedHand pushed(resting, handle, no_grip);
  run(pushed, {{0.6, 0, 0.8}, {0, 0.012, 0}}, 0.1);
  // a = (F − f)/m along the push
  BOOST_TEST(pushed.pose().position[0] == 0.6 * (0.8 / 0.159) * 0.01 / 2, tolerance);
  BOOST_TEST(pushed.pose().position[2] == 0.8 * (0.8 / 0.159) * 0.01 / 2, tolerance);
  BOOST_TEST(angle_about_y(pushed.pose()) == (0.002 / 2e-4) * 0.01 / 2, tolerance);
  run(pushed, {}, 5.0);  // comes to rest: v²/2 = f/m x
  const double speed = 0.8 / 0.159 * 0.1;
  BOOST_TEST(pushed.pose().position[0] == 0.6 * ((0.8 / 0.159) * 0.01 / 2 + speed * speed / 2 * 0.159 / 0.2), tolerance);

  SimulatedHand held(resting, handle, no_grip);
  run(held, {{0.19, 0, 0}, {0, 0.0099, 0}}, 1.0);
  BOOST_TEST(held.pose().position[0] == 0);
  BOOST_TEST(angle_about_y(held.pose()) == 0);
}

BOOST_AUTO_TEST_CASE(a_steady_turn_keeps_the_quaternion_a_unit_one) {
  SimulatedHand hand([](double t) { return turned_about_y(2 * t); });
  for (int i = 0; i < 20'000; ++i) {
    hand.advance({});
    const double* q = hand.pose().orientation;
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    BOOST_REQUIRE(std::abs(length - 1) < 4 * std::numeric_limits<double>::epsilon());
  }
  // 20 s at 2 rad/s is six turns and more; the handle is still with the hand.
  const double behind = std::remainder(2 * hand.time() - angle_about_y(hand.pose()), 2 * std::acos(-1.0));
  BOOST_TEST(behind == 2e-4 * 2 / 0.5, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(a_path_that_is_not_finite_leaves_the_hand_where_it_last_wanted_to_be) {
  const double bad = std::nan("");
  for (const DevicePose& nonsense : {DevicePose{{bad, 0, 0}, {1, 0, 0, 0}}, DevicePose{{9, 9, 9}, {0, 0, 0, 0}}}) {
    SimulatedHand hand([&](double t) { return t > 0.1 ? nonsense : DevicePose{{0.02, 0, 0}, {1, 0, 0, 0}}; });
    run(hand, {}, 1.0);
    BOOST_TEST(hand.pose().position[0] == 0.02, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(hand.pose().orientation[0] == 1.0, boost::test_tools::tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_integrated_is_refused) {
  Grip stiff;
  stiff.stiffness = 1e8;
  BOOST_CHECK_THROW(SimulatedHand(resting, {}, stiff), std::invalid_argument);
  Grip damped;
  damped.damping_ratio = 200;
  BOOST_CHECK_THROW(SimulatedHand(resting, {}, damped), std::invalid_argument);
  BOOST_CHECK_NO_THROW(SimulatedHand(resting, {}, damped, 1e-3, 10'000));
  BOOST_CHECK_THROW(SimulatedHand(nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(SimulatedHand(resting, {0, 1, 0, 0}), std::invalid_argument);
  BOOST_CHECK_THROW(SimulatedHand(resting, {}, {}, std::nan("")), std::invalid_argument);
  BOOST_CHECK_THROW(SimulatedHand(resting, {}, {}, 1e-3, 0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(tremor)

BOOST_AUTO_TEST_CASE(has_the_root_mean_square_asked_for_and_is_decided_by_its_seed) {
  const feeler::Tremor shaking(1e-4, 1e-3, 5);
  const feeler::Tremor same(1e-4, 1e-3, 5);
  const feeler::Tremor other(1e-4, 1e-3, 6);
  double squares[6] = {};
  bool differs = false;
  const int samples = 200'000;
  for (int i = 0; i < samples; ++i) {
    const double time = i * 1e-3;
    const auto motion = shaking.at(time);
    BOOST_REQUIRE(motion == same.at(time));
    differs = differs || motion != other.at(time);
    for (std::size_t axis = 0; axis < 6; ++axis) squares[axis] += motion[axis] * motion[axis];
  }
  BOOST_TEST(differs);
  for (int axis = 0; axis < 6; ++axis) {
    const double expected = axis < 3 ? 1e-4 : 1e-3;
    BOOST_TEST(std::sqrt(squares[axis] / samples) == expected, boost::test_tools::tolerance(0.05));
  }
}

BOOST_AUTO_TEST_SUITE_END()
