// Metrics with weights of their own for each axis, and along axes that are turned, against their energies by differences.
#include "feeler/spatial/turned_metric.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(metric)

using namespace feeler;
using namespace feeler_test;
using Vector = Vector3<double>;
using Twist6 = Twist<double>;

namespace {

const Metric<double> unlike{{3, 0.5, 1}, {2e-3, 7e-3, 1e-3}};
const Metric<double> alike{{3, 0.5, 1}, {2e-3, 2e-3, 2e-3}};

Twist6 random_twist(std::mt19937& bits, double turn) {
  const Vector linear = random_vector(bits);
  return {linear, turn * random_direction(bits)};
}
/// e after the step (dp, w) of the pose that it leads to.
Twist6 stepped(const Twist6& e, const Vector6<double>& step) {
  const Vector turn = step.tail<3>();
  return {e.linear + step.head<3>(), log_rotation(exp_rotation(turn) * exp_rotation(e.angular))};
}
/// The derivative of the energy by the step.
template <class AnyMetric>
Vector6<double> slopes_of(const AnyMetric& metric, const Twist6& e) {
  const double h = 1e-5;
  Vector6<double> slopes;
  for (int i = 0; i < 6; ++i) {
    const Vector6<double> step = h * Vector6<double>::Unit(i);
    slopes[i] = (metric.energy(stepped(e, step)) - metric.energy(stepped(e, -step))) / (2 * h);
  }
  return slopes;
}
/// Gauss and Newton's: JᵀMJ, with J the derivative of e by the step.
Matrix6<double> gauss_newton_of(const Matrix6<double>& metric, const Twist6& e) {
  const double h = 1e-5;
  Matrix6<double> jacobian;
  for (int i = 0; i < 6; ++i) {
    const Vector6<double> step = h * Vector6<double>::Unit(i);
    jacobian.col(i) = (stepped(e, step).vector() - stepped(e, -step).vector()) / (2 * h);
  }
  return jacobian.transpose() * metric * jacobian;
}
/// A M Aᵀ, axis by axis.
Matrix6<double> along_axes(const Metric<double>& metric, const Quaternion<double>& axes) {
  Matrix6<double> sum = Matrix6<double>::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vector axis = axes * Vector(Vector::Unit(k));
    sum.topLeftCorner<3, 3>() += metric.translational[k] * axis * axis.transpose();
    sum.bottomRightCorner<3, 3>() += metric.rotational[k] * axis * axis.transpose();
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(of_unlike_weights_the_gradient_is_that_of_the_energy_and_the_hessian_is_gauss_and_newtons) {
  std::mt19937 bits(1);
  for (const double turn : {0.0, 1e-3, 0.4, 1.4, 2.8}) {
    const Twist6 e = random_twist(bits, turn);
    BOOST_TEST((unlike.gradient(e) - slopes_of(unlike, e)).norm() < 1e-8);
    BOOST_TEST((unlike.hessian(e) - gauss_newton_of(unlike.diagonal().asDiagonal(), e)).norm() < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(the_quadratic_with_the_homing_hessian_has_its_minimum_at_home) {
  std::mt19937 bits(2);
  for (const Metric<double>& metric : {unlike, alike}) {
    for (const double turn : {0.0, 0.4, 2.8}) {
      const Twist6 e = random_twist(bits, turn);
      BOOST_TEST((metric.homing_hessian(e) * e.vector() - metric.gradient(e)).norm() < 1e-14);
      TurnedMetric<double> turned(metric);
      turned.turn(random_rotation(bits));
      BOOST_TEST((turned.homing_hessian(e) * e.vector() - turned.gradient(e)).norm() < 1e-14);
    }
  }
  const Matrix6<double> itself = alike.diagonal().asDiagonal();
  BOOST_TEST((alike.homing_hessian(random_twist(bits, 2.8)) - itself).norm() < 1e-16);
}

BOOST_AUTO_TEST_CASE(a_length_weighs_a_turn_as_the_way_of_a_point_so_far_off_and_only_ratios_are_left_of_a_stiffness) {
  const double length = 0.2;
  const auto metric = Metric<double>::with_length(length);
  const double angle = 1e-3;
  BOOST_TEST(metric.energy({Vector::Zero(), Vector(0, angle, 0)}) == metric.energy({Vector(length * angle, 0, 0), Vector::Zero()}),
             boost::test_tools::tolerance(1e-12));
  const Stiffness<double> stiffness{{1000, 200, 30}, {0.3, 2, 0.1}};
  const auto like = Metric<double>::proportional_to(stiffness);
  BOOST_TEST(like.translational.maxCoeff() == 1);
  for (int k = 0; k < 3; ++k) {
    BOOST_TEST(like.translational[k] * 1000 == stiffness.translational[k], boost::test_tools::tolerance(1e-12));
    BOOST_TEST(like.rotational[k] * 1000 == stiffness.rotational[k], boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(along_turned_axes_a_metric_is_the_sum_over_its_axes) {
  std::mt19937 bits(3);
  for (int i = 0; i < 50; ++i) {
    const Quaternion<double> axes = random_rotation(bits);
    for (const Metric<double>& along : {unlike, alike}) {
      TurnedMetric<double> metric(along);
      metric.turn(axes);
      BOOST_TEST(metric.is_turned());
      const Matrix6<double> expected = along_axes(along, axes);
      BOOST_TEST((metric.matrix() - expected).norm() < 1e-14);
      const Twist6 a = random_twist(bits, 2.5 * fraction(bits)), b = random_twist(bits, 0.5);
      BOOST_TEST(std::abs(metric.product(a, b) - a.vector().dot(expected * b.vector())) < 1e-14);
      BOOST_TEST(std::abs(metric.energy(a) - a.vector().dot(expected * a.vector()) / 2) < 1e-14);
      BOOST_TEST((metric.gradient(a) - slopes_of(metric, a)).norm() < 1e-8);
      if (along.is_isotropic()) continue;
      const Matrix6<double> newton = gauss_newton_of(expected, a);
      BOOST_TEST((metric.homing_hessian(a) - newton).norm() < 1e-8);
      BOOST_TEST((metric.hessian_of_turns(a) - newton.bottomRightCorner<3, 3>()).norm() < 1e-8);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_brought_into_the_axes_and_back_is_as_it_was_and_its_parts_are_along_them) {
  std::mt19937 bits(4);
  TurnedMetric<double> metric(unlike);
  const Quaternion<double> axes = random_rotation(bits);
  metric.turn(axes);
  const Vector6<double> v = random_six(bits);
  const Vector6<double> seen = metric.in_axes(v);
  for (int k = 0; k < 3; ++k) {
    const Vector axis = axes * Vector(Vector::Unit(k));
    BOOST_TEST(std::abs(seen[k] - axis.dot(v.head<3>())) < 1e-15);
    BOOST_TEST(std::abs(seen[3 + k] - axis.dot(v.tail<3>())) < 1e-15);
  }
  BOOST_TEST((metric.in_axes(Twist6::from_vector(v)).vector() - seen).norm() < 1e-15);
  BOOST_TEST((metric.in_world(seen) - v).norm() < 1e-15);
  const Matrix6<double> square = v * v.transpose();
  BOOST_TEST((metric.in_axes(square) - seen * seen.transpose()).norm() < 1e-14);
  BOOST_TEST((metric.in_world(metric.in_axes(square)) - square).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(along_the_axes_of_the_poses_it_is_the_metric_to_the_last_bit) {
  std::mt19937 bits(5);
  TurnedMetric<double> metric(unlike);
  metric.turn(random_rotation(bits));
  metric.turn(Quaternion<double>::Identity());
  BOOST_TEST(!metric.is_turned());
  for (const double turn : {0.0, 0.4, 2.8}) {
    const Twist6 e = random_twist(bits, turn);
    BOOST_TEST(metric.energy(e) == unlike.energy(e));
    BOOST_TEST((metric.gradient(e) == unlike.gradient(e)));
    BOOST_TEST((metric.hessian_of_turns(e) == unlike.hessian_of_turns(e)));
    BOOST_TEST((metric.homing_hessian(e) == unlike.homing_hessian(e)));
  }
}

BOOST_AUTO_TEST_SUITE_END()
