// Stiffness and metric along axes that turn from tick to tick, against closed forms, scenes that are turned instead, and the work of the hand.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "feeler/object/triangle_mesh.hpp"
#include "feeler/render/haptic_renderer.hpp"
#include "feeler/render/wrench_derivative.hpp"
#include "feeler/spatial/turned_stiffness.hpp"
#include "feeler/tool/box.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/closed_meshes.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(turned_metric)

using namespace feeler;
using namespace feeler_test;

namespace {

constexpr int plenty = 100'000;  // of work

TriangleMesh<double> ground() {
  Points<double> corners(4, 3);
  corners << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Triangles halves(2, 3);
  halves << 0, 1, 2, 0, 2, 3;
  return {corners, halves};
}

/// A block of two centimetres, as it stands along other axes.
TriangleMesh<double> block_in(const Quaternion<double>& axes) {
  const ClosedMesh mesh = block({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}).moved(axes, {0, 0, 0});
  return {mesh.vertices, mesh.triangles};
}

Settings<double> unequal() {
  Settings<double> settings;
  settings.stiffness = {{1000, 250, 400}, {0.3, 0.1, 0.6}};
  settings.step_tolerance = 1e-9;
  return settings;
}

double apart(const Pose<double>& a, const Pose<double>& b) {
  const Twist<double> motion = motion_between(a, b);
  return motion.linear.norm() + 0.01 * motion.angular.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_ball_on_a_plane_rests_where_the_formula_of_each_tick_says_and_is_pushed_along_the_normal) {
  const auto object = ground();
  const auto settings = unequal();
  const double radius = 0.005, depth = 0.003;
  HapticRenderer renderer(object, Sphere<double>(radius), settings);
  renderer.reset({.translation = {0, 0, 0.01}});
  const Pose<double> hand{.translation = {0.01, -0.02, radius - depth}};
  std::mt19937 bits(21);
  for (int i = 0; i < 50; ++i) {  // the hand is held, and the axes turn
    const Quaternion<double> axes = random_rotation(bits);
    const Matrix3<double> turn = axes.toRotationMatrix();
    const Matrix3<double> compliance = turn * settings.stiffness.translational.cwiseInverse().asDiagonal() * turn.transpose();
    const auto& tick = renderer.update_until_converged(hand, axes, plenty);
    BOOST_TEST_REQUIRE(tick.converged());
    const double height = depth + settings.margin;
    const Vector3<double> expected = hand.translation + compliance.col(2) * (height / compliance(2, 2));
    BOOST_TEST((tick.graphic_pose.translation - expected).norm() < 1e-8);
    const Vector3<double> push(0, 0, height / compliance(2, 2));
    BOOST_TEST((tick.wrench.force - push).norm() < 1e-5);
    BOOST_TEST_REQUIRE(tick.contacts.size() == 1);
    BOOST_TEST(std::abs(tick.contacts[0].force - push.z()) < 1e-5);
  }
  renderer.update_until_converged(hand, plenty);  // and back along the axes of the poses
  BOOST_TEST((renderer.tick().graphic_pose.translation - Vector3<double>(0.01, -0.02, radius + settings.margin)).norm() < 1e-8);
}

BOOST_AUTO_TEST_CASE(turned_axes_do_what_a_scene_that_is_turned_the_other_way_does) {
  std::mt19937 bits(22);
  const auto settings = unequal();
  const Box<double> tool({0.006, 0.004, 0.002});
  const auto object = block_in(Quaternion<double>::Identity());
  int touching = 0;
  for (int i = 0; i < 20; ++i) {
    const Quaternion<double> axes = random_rotation(bits), back = axes.conjugate();
    const auto other_object = block_in(back);
    HapticRenderer renderer(object, tool, settings);
    HapticRenderer other(other_object, tool, settings);
    const auto there = [&](const Pose<double>& pose) { return Pose<double>{back * pose.translation, back * pose.rotation}; };
    const Pose<double> start{0.03 * random_vector(bits).normalized(), random_rotation(bits)};
    renderer.reset(start);
    other.reset(there(start));
    for (int step = 1; step <= 5; ++step) {
      const Pose<double> hand{start.translation * (1 - 0.14 * step), start.rotation};
      const auto& tick = renderer.update_until_converged(hand, axes, plenty);
      const auto& expected = other.update_until_converged(there(hand), plenty);
      BOOST_TEST_REQUIRE((tick.converged() && expected.converged()));
      BOOST_TEST(apart(there(tick.graphic_pose), expected.graphic_pose) < 1e-7);
      BOOST_TEST((back * tick.wrench.force - expected.wrench.force).norm() < 1e-3);
      BOOST_TEST((back * tick.wrench.torque - expected.wrench.torque).norm() < 1e-5);
      if (!tick.contacts.empty()) ++touching;
      const auto slope = wrench_derivative(renderer), other_slope = wrench_derivative(other);
      Matrix6<double> both = Matrix6<double>::Zero();
      both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = back.toRotationMatrix();
      if (slope.is_smooth && other_slope.is_smooth) BOOST_TEST((both * slope.matrix * both.transpose() - other_slope.matrix).norm() < 0.1);
    }
  }
  BOOST_TEST(touching > 50);
}

BOOST_AUTO_TEST_CASE(what_was_settled_along_other_axes_is_not_called_converged) {
  const auto object = block_in(Quaternion<double>::Identity());
  auto settings = unequal();
  const Box<double> tool({0.006, 0.004, 0.002});
  HapticRenderer patient(object, tool, settings);
  const Quaternion<double> both_axes[] = {exp_rotation<double>({0.5, 0, 0.3}), exp_rotation<double>({-0.7, 0.6, 0})};
  std::mt19937 bits(24);
  int converged = 0;
  for (const int budget : {1, 2, 4, 8, 16}) {  // a tick does a part of an iteration
    settings.work_budget = budget;
    HapticRenderer renderer(object, tool, settings);
    for (int run = 0; run < 60; ++run) {
      const Pose<double> start{{0.001 * unit(bits), 0.001 * unit(bits), 0.02}, exp_rotation<double>(0.3 * random_vector(bits))};
      const Pose<double> hand{{start.translation.x(), start.translation.y(), 0.009}, start.rotation};
      renderer.reset(start);
      const int period = 1 + below(bits, 12);
      for (int i = 0; i < 200; ++i) {
        const Quaternion<double>& axes = both_axes[i / period % 2];
        const auto& tick = renderer.update(hand, axes);
        if (!tick.converged()) continue;
        ++converged;
        patient.reset(tick.graphic_pose);
        BOOST_TEST(apart(patient.update_until_converged(hand, axes, plenty).graphic_pose, tick.graphic_pose) < 1e-7);
      }
    }
  }
  BOOST_TEST(converged > 1000);
}

BOOST_AUTO_TEST_CASE(the_axes_of_the_poses_change_no_bit) {
  const auto object = block_in(Quaternion<double>::Identity());
  HapticRenderer renderer(object, Box<double>({0.006, 0.004, 0.002}), unequal());
  renderer.reset({.translation = {0, 0, 0.02}});
  auto other = renderer;
  std::mt19937 bits(23);
  for (int i = 0; i < 200; ++i) {
    const Pose<double> hand{{0.001 * std::sin(0.1 * i), 0, 0.02 - 5e-5 * i}, exp_rotation<double>(0.2 * random_vector(bits))};
    const auto& tick = renderer.update(hand);
    const auto& same = other.update(hand, Quaternion<double>(2, 0, 0, 0));
    BOOST_TEST_REQUIRE(tick.graphic_pose.translation == same.graphic_pose.translation);
    BOOST_TEST_REQUIRE(tick.graphic_pose.rotation.coeffs() == same.graphic_pose.rotation.coeffs());
    BOOST_TEST_REQUIRE(tick.wrench.torque == same.wrench.torque);
    BOOST_TEST_REQUIRE(tick.work == same.work);
  }
}

BOOST_AUTO_TEST_CASE(a_hand_that_goes_round_gains_no_work_from_weights_along_the_tool) {
  const auto object = block_in(Quaternion<double>::Identity());
  const auto settings = unequal();
  HapticRenderer renderer(object, Box<double>({0.006, 0.004, 0.002}), settings);
  const auto hand_at = [](double round) {
    const double a = 2 * M_PI * round;
    return Pose<double>{{0.002 * std::sin(a), 0.001 * std::cos(2 * a + 1), 0.0105 + 0.0005 * std::cos(a)},
                        exp_rotation<double>({0.2 * std::sin(a + 2), 0.3 + 0.2 * std::cos(2 * a), 0.4 * std::sin(a - 1)})};
  };
  renderer.reset({.translation = {0, 0, 0.03}, .rotation = hand_at(0).rotation});
  const auto wrench_at = [&](const Pose<double>& hand) {
    const auto& tick = renderer.update_until_converged(hand, hand.rotation, plenty);
    BOOST_TEST_REQUIRE(tick.converged());
    return wrench_along_tool(settings.stiffness, hand, tick.graphic_pose);
  };
  constexpr int steps = 4000;
  double work = 0, without_axes = 0, path = 0;
  Wrench<double> last = wrench_at(hand_at(0));
  Wrench<double> last_along = renderer.tick().wrench;
  for (int i = 1; i <= steps; ++i) {
    const Pose<double> hand = hand_at(double(i) / steps);
    const Twist<double> motion = motion_between(hand_at(double(i - 1) / steps), hand);
    const Wrench<double> wrench = wrench_at(hand), along = renderer.tick().wrench;
    const auto done = [&](const Wrench<double>& a, const Wrench<double>& b) {
      return (a.force + b.force).dot(motion.linear) / 2 + (a.torque + b.torque).dot(motion.angular) / 2;
    };
    work += done(last, wrench);
    without_axes += done(last_along, along);
    path += std::abs(done(last, wrench));
    last = wrench;
    last_along = along;
  }
  BOOST_TEST_MESSAGE("work " << work << " of " << path << " J; of standing axes " << without_axes);
  BOOST_TEST(std::abs(work) < 1e-4 * path);
  BOOST_TEST(std::abs(without_axes) > 10 * std::abs(work));  // what turning axes do is worth asking for
}

BOOST_AUTO_TEST_CASE(axes_that_are_none_keep_the_last_pose_and_wrench) {
  const auto object = ground();
  HapticRenderer renderer(object, Sphere<double>(0.005), unequal());
  renderer.reset({.translation = {0, 0, 0.01}});
  const Pose<double> hand{.translation = {0, 0, 0.003}};
  const Tick<double> last = renderer.update_until_converged(hand, plenty);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Quaternion<double>& axes : {Quaternion<double>(nan, 0, 0, 0), Quaternion<double>(0, 0, 0, 0), Quaternion<double>(1e200, 0, 0, 0)}) {
    const auto& tick = renderer.update(hand, axes);
    BOOST_TEST((tick.status == TickStatus::not_finite));
    BOOST_TEST(tick.graphic_pose.translation == last.graphic_pose.translation);
    BOOST_TEST(tick.wrench.force == last.wrench.force);
  }
  BOOST_TEST(renderer.update(hand).converged());
}

BOOST_AUTO_TEST_CASE(axes_of_any_length_are_those_of_their_unit_quaternion) {
  const auto object = ground();
  std::mt19937 bits(7);
  for (const double length : {0.25, 0.5, 2.0, 64.0}) {  // powers of two: not a bit differs
    HapticRenderer one(object, Box<double>({0.01, 0.01, 0.01}), unequal()), other(object, Box<double>({0.01, 0.01, 0.01}), unequal());
    one.reset({.translation = {0, 0, 0.02}});
    other.reset({.translation = {0, 0, 0.02}});
    for (int i = 0; i < 10; ++i) {
      const Pose<double> hand{{0, 0, 0.02 - 0.002 * i}, Quaternion<double>(Eigen::AngleAxisd(0.1 * i, Vector3<double>::UnitX()))};
      const Quaternion<double> axes = random_rotation(bits);
      const auto& a = one.update(hand, axes);
      const auto& b = other.update(hand, Quaternion<double>(length * axes.coeffs()));
      BOOST_TEST((a.graphic_pose == b.graphic_pose));
      BOOST_TEST(a.wrench.force == b.wrench.force);
      BOOST_TEST(a.wrench.torque == b.wrench.torque);
    }
  }
}

BOOST_AUTO_TEST_CASE(after_a_reset_stiffness_and_metric_are_along_the_axes_of_the_poses) {
  const auto object = ground();
  HapticRenderer renderer(object, Sphere<double>(0.005), unequal());
  std::mt19937 bits(8);
  const Pose<double> start{.translation = {0, 0, 0.01}};
  renderer.reset(start);
  renderer.update({.translation = {0.001, 0, 0.003}}, random_rotation(bits));
  BOOST_TEST(renderer.scene().metric().is_turned());
  renderer.reset(start);
  BOOST_TEST(!renderer.scene().metric().is_turned());
  // Also one that is refused.
  renderer.update({.translation = {0.001, 0, 0.003}}, random_rotation(bits));
  renderer.reset({.translation = {std::numeric_limits<double>::quiet_NaN(), 0, 0}});
  BOOST_TEST(!renderer.scene().metric().is_turned());
}

BOOST_AUTO_TEST_SUITE_END()
