#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/rotation.hpp"

BOOST_AUTO_TEST_SUITE(rotation)

using feeler::Vector3;
using Vector = Vector3<double>;

namespace {
Vector random_vector(std::mt19937& bits, double length) {
  const auto unit = [&] { return double(bits()) / 2147483648.0 - 1.0; };
  return Vector(unit(), unit(), unit()) * length;
}
}  // namespace

BOOST_AUTO_TEST_CASE(exponential_agrees_with_the_rotation_about_an_axis) {
  std::mt19937 bits(1);
  for (double length : {1e-12, 1e-6, 1e-3, 0.1, 1.0, 3.0}) {
    const Vector v = random_vector(bits, length);
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
    BOOST_TEST((feeler::exp_rotation(v).toRotationMatrix() - expected).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(logarithm_inverts_the_exponential_and_ignores_the_sign_of_the_quaternion) {
  std::mt19937 bits(2);
  for (double length : {0.0, 1e-300, 1e-12, 1e-4, 0.5, 1.7}) {
    const Vector v = random_vector(bits, length);
    const auto q = feeler::exp_rotation(v);
    BOOST_TEST((feeler::log_rotation(q) - v).norm() <= 4e-16 * (1 + v.norm()) * 2);
    const Eigen::Quaterniond negated(-q.coeffs());
    BOOST_TEST((feeler::log_rotation(negated) - v).norm() <= 4e-16 * (1 + v.norm()) * 2);
  }
}

BOOST_AUTO_TEST_CASE(series_agree_with_closed_forms_at_every_angle) {
  std::mt19937 bits(7);
  for (int i = 0; i < 4000; ++i) {
    const Vector v = random_vector(bits, std::pow(10.0, -6 + 6 * i / 4000.0));
    const Vector3<long double> wide = v.cast<long double>();
    const long double angle = wide.norm();
    const auto q = feeler::exp_rotation(v);
    Eigen::Vector4d expected;
    expected << (std::sin(angle / 2) / angle * wide).cast<double>(), double(std::cos(angle / 2));
    BOOST_TEST((q.coeffs() - expected).norm() <= 4e-16);
    BOOST_TEST((q.vec() - expected.head<3>()).norm() <= 4e-16 * expected.head<3>().norm());
    // Of a quaternion whose norm is off by what a product of two rounds.
    const Eigen::Quaterniond off(q.coeffs() * (1 + 2e-16));
    BOOST_TEST((feeler::log_rotation(off) - v).norm() <= 1.2e-15 * v.norm());
    const long double bend = (1 - angle / 2 / std::tan(angle / 2)) / (angle * angle);
    // The closed form loses digits where the angle is small: this one in long double, and beyond the series that of the function.
    const double own = angle < 0.15L ? 0.0 : 4e-16, lost = (own + 2 * double(std::numeric_limits<long double>::epsilon())) / double(angle * angle);
    BOOST_TEST(std::abs(feeler::logarithm_bend(v.squaredNorm()) - double(bend)) <= 1e-16 + lost);
  }
}

BOOST_AUTO_TEST_CASE(inverse_left_jacobian_is_the_derivative_of_the_logarithm) {
  std::mt19937 bits(3);
  for (double length : {0.0, 1e-3, 0.3, 1.5}) {
    const Vector phi = random_vector(bits, length);
    const auto jacobian = feeler::inverse_left_jacobian(phi);
    const double h = 1e-6;
    for (int i = 0; i < 3; ++i) {
      const Vector step = Vector::Unit(i) * h;
      const Vector plus = feeler::log_rotation(feeler::exp_rotation(step) * feeler::exp_rotation(phi));
      const Vector minus = feeler::log_rotation(feeler::exp_rotation(Vector(-step)) * feeler::exp_rotation(phi));
      BOOST_TEST(((plus - minus) / (2 * h) - jacobian.col(i)).norm() < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(metric_gradient_and_hessian_are_derivatives_of_the_energy) {
  std::mt19937 bits(4);
  const auto metric = feeler::Metric<double>::with_length(0.7);
  for (double length : {0.0, 1e-3, 0.4, 1.4}) {
    feeler::Twist<double> e{random_vector(bits, 1.0), random_vector(bits, length)};
    const auto moved_energy = [&](const feeler::Vector6<double>& d) {
      const feeler::Twist<double> moved{e.linear + d.head<3>(),
                                        feeler::log_rotation(feeler::exp_rotation(Vector(d.tail<3>())) * feeler::exp_rotation(e.angular))};
      return metric.energy(moved);
    };
    const double h = 1e-4;
    using V6 = feeler::Vector6<double>;
    for (int i = 0; i < 6; ++i) {
      const V6 di = V6::Unit(i) * h;
      BOOST_TEST(std::abs((moved_energy(di) - moved_energy(-di)) / (2 * h) - metric.gradient(e)[i]) < 1e-7);
      for (int j = 0; j < 6; ++j) {
        const V6 dj = V6::Unit(j) * h;
        const double second = (moved_energy(di + dj) - moved_energy(di - dj) - moved_energy(-di + dj) + moved_energy(-di - dj)) / (4 * h * h);
        BOOST_TEST(std::abs(second - metric.hessian(e)(i, j)) < 1e-6);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(wrench_is_the_negative_gradient_of_the_potential_by_the_haptic_pose) {
  std::mt19937 bits(5);
  feeler::Stiffness<double> stiffness;
  stiffness.rotational = Vector(0.3, 0.5, 0.1);
  const Vector phi = random_vector(bits, 1.0);
  const auto potential = [&](const Vector& w) {  // the haptic tool turns by w
    const Vector e = feeler::log_rotation(feeler::exp_rotation(phi) * feeler::exp_rotation(w).conjugate());
    return 0.5 * e.dot(stiffness.rotational.cwiseProduct(e));
  };
  const double h = 1e-5;
  for (int i = 0; i < 3; ++i) {
    const Vector step = Vector::Unit(i) * h;
    const double expected = -(potential(step) - potential(Vector(-step))) / (2 * h);
    BOOST_TEST(std::abs(stiffness.wrench({Vector::Zero(), phi}).torque[i] - expected) < 1e-9);
  }
}

BOOST_AUTO_TEST_SUITE_END()
