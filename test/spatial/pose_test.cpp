// Poses as maps of points, wrenches as what they work on points, and stiffnesses as gradients of their energies.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "feeler/core/status.hpp"
#include "feeler/spatial/turned_stiffness.hpp"
#include "support/random_geometry.hpp"
#include "support/refusal.hpp"

BOOST_AUTO_TEST_SUITE(poses)

using namespace feeler;
using namespace feeler_test;

namespace {

Pose<double> random_pose(std::mt19937& bits) {
  const Vector3<double> translation = random_vector(bits);
  return {translation, random_rotation(bits)};
}

/// −∂U/∂(haptic pose), by differences: the origin moves along an axis, or the axes turn about it.
template <class Energy>
Wrench<double> pull_of(const Energy& energy, const Pose<double>& haptic) {
  const double h = 1e-6;
  Vector6<double> pull;
  for (int i = 0; i < 6; ++i) {
    const auto by = [&](double step) { return energy(moved(haptic, Twist<double>::from_vector(step * Vector6<double>::Unit(i)))); };
    pull[i] = (by(-h) - by(h)) / (2 * h);
  }
  return {pull.head<3>(), pull.tail<3>()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_product_of_poses_maps_points_as_one_after_the_other_and_the_inverse_maps_them_back) {
  std::mt19937 bits(11);
  for (int i = 0; i < 100; ++i) {
    const Pose<double> outer = random_pose(bits), inner = random_pose(bits);
    const Vector3<double> point = random_vector(bits);
    BOOST_TEST(((outer * inner) * point - outer * (inner * point)).norm() < 1e-14);
    BOOST_TEST((outer.inverse() * (outer * point) - point).norm() < 1e-14);
    BOOST_TEST((outer * outer.inverse() * point - point).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(poses_are_equal_where_all_their_numbers_are) {
  std::mt19937 bits(14);
  const Pose<double> pose = random_pose(bits);
  BOOST_TEST((pose == Pose<double>(pose)));
  for (int i = 0; i < 7; ++i) {
    Pose<double> other = pose;
    (i < 3 ? other.translation[i] : other.rotation.coeffs()[i - 3]) += 1e-15;
    BOOST_TEST(!(pose == other));
  }
  Pose<double> opposite = pose;
  opposite.rotation.coeffs() *= -1;
  BOOST_TEST(!(pose == opposite));  // the same rotation, of other numbers
}

BOOST_AUTO_TEST_CASE(a_motion_and_its_opposite_lead_back_and_a_motion_between_two_poses_from_one_to_the_other) {
  std::mt19937 bits(15);
  for (int i = 0; i < 100; ++i) {
    const Pose<double> from = random_pose(bits), to = random_pose(bits);
    const Twist<double> motion = motion_between(from, to);
    const Pose<double> there = moved(from, motion), back = moved(to, -motion);
    BOOST_TEST((there.translation - to.translation).norm() < 1e-15);
    BOOST_TEST((there.rotation.toRotationMatrix() - to.rotation.toRotationMatrix()).norm() < 1e-14);
    BOOST_TEST((back.translation - from.translation).norm() < 1e-15);
    BOOST_TEST((back.rotation.toRotationMatrix() - from.rotation.toRotationMatrix()).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(the_sentence_about_a_pose_that_is_not_finite_is_true_of_all_that_are_not) {
  for (const double huge : {1e155, 1e300}) {
    BOOST_TEST((!Pose<double>{{0, huge, 0}, Quaternion<double>::Identity()}.is_finite()));
    BOOST_TEST((!Pose<double>{{0, 0, 0}, Quaternion<double>(huge, 0, 0, 0)}.is_finite()));
  }
  BOOST_TEST((!Pose<double>{{0, 0, 0}, Quaternion<double>(1e-9, 0, 0, 0)}.is_finite()));
  BOOST_TEST(contains(to_string(Status::not_finite), "a number too large to be squared, or a quaternion near zero"));
}

BOOST_AUTO_TEST_CASE(a_wrench_that_is_moved_works_as_much_on_every_motion) {
  std::mt19937 bits(12);
  for (int i = 0; i < 100; ++i) {
    const Wrench<double> wrench{random_vector(bits), random_vector(bits)};
    const Vector3<double> from = random_vector(bits), to = random_vector(bits), turn = random_vector(bits), velocity_from = random_vector(bits);
    const Vector3<double> velocity_to = velocity_from + turn.cross(to - from);
    const Wrench<double> there = wrench.moved(from, to);
    const double power = wrench.force.dot(velocity_from) + wrench.torque.dot(turn);
    BOOST_TEST(std::abs(there.force.dot(velocity_to) + there.torque.dot(turn) - power) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(a_stiffness_in_any_axes_pulls_down_its_energy) {
  std::mt19937 bits(13);
  const Stiffness<double> stiffness{{1000, 200, 30}, {0.3, 2, 0.1}};
  for (int i = 0; i < 100; ++i) {
    const Pose<double> haptic = random_pose(bits);
    const Pose<double> graphic = moved<double>(haptic, {0.1 * random_vector(bits), random_vector(bits)});
    const Quaternion<double> axes = random_rotation(bits);
    const auto energy_in = [&](const Vector3<double>& off, const Vector3<double>& turn) {
      return (stiffness.translational.cwiseProduct(off).dot(off) + stiffness.rotational.cwiseProduct(turn).dot(turn)) / 2;
    };
    const auto along_axes = pull_of(
        [&](const Pose<double>& hand) {
          const Twist<double> e = motion_between(hand, graphic);
          return energy_in(axes.conjugate() * e.linear, axes.conjugate() * e.angular);
        },
        haptic);
    const auto along_tool = pull_of(
        [&](const Pose<double>& hand) {
          const Twist<double> e = motion_between(hand, graphic);
          return energy_in(hand.rotation.conjugate() * e.linear, hand.rotation.conjugate() * e.angular);
        },
        haptic);
    const auto difference = [](const Wrench<double>& a, const Wrench<double>& b) {
      return (a.force - b.force).norm() + (a.torque - b.torque).norm();
    };
    BOOST_TEST(difference(wrench_along(axes, stiffness, motion_between(haptic, graphic)), along_axes) < 1e-6);
    BOOST_TEST(difference(wrench_along_tool(stiffness, haptic, graphic), along_tool) < 1e-6);
  }
}

BOOST_AUTO_TEST_SUITE_END()
