#include "feeler/paper/step_coordinates.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(step_coordinates)

using feeler::Increments;
using feeler::Pose;
using feeler::StepCoordinates;
using feeler::Vector6;
using namespace feeler_test;

namespace {

Pose<double> random_pose(std::mt19937& bits) {
  Pose<double> pose{0.1 * random_vector(bits), random_rotation(bits)};
  // Where β = ±π/2 two of the angles turn about the same axis.
  while (std::abs(pose.rotation.toRotationMatrix()(2, 0)) > 0.97) pose.rotation = random_rotation(bits);
  return pose;
}

Vector6<double> random_step(std::mt19937& bits, double size) {
  Vector6<double> step;
  for (int k = 0; k < 6; ++k) step[k] = size * unit(bits);
  return step;
}

template <Increments increments>
void check(unsigned seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 2000; ++i) {
    const StepCoordinates<double, increments> coordinates(random_pose(bits));
    const Vector6<double> step = random_step(bits, magnitude(bits, -6, -1));
    BOOST_TEST((coordinates.of(coordinates.pose_at(step)) - step).norm() < 1e-13);

    // The height of a tool point over a plane, and its derivative by central differences.
    const Eigen::Vector3d normal = random_direction(bits), point = 0.1 * random_vector(bits);
    const auto height = [&](const Vector6<double>& d) { return normal.dot(coordinates.pose_at(d) * point); };
    const Pose<double> base = coordinates.pose_at(Vector6<double>::Zero());
    Vector6<double> gradient;
    const Eigen::Vector3d arm = base.rotation * point;
    gradient << normal, arm.cross(normal);
    const Vector6<double> row = coordinates.row(gradient);
    for (int k = 0; k < 6; ++k) {
      const Vector6<double> h = 1e-5 * Vector6<double>::Unit(k);
      BOOST_TEST(std::abs((height(h) - height(-h)) / 2e-5 - row[k]) < 1e-9);
    }

    // The gradient of the energy vanishes at the target and there only, and Newton's step leads there.
    const Pose<double> target = coordinates.pose_at(step);
    for (const Eigen::Vector3d& weights : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 3, 10)}) {
      const feeler::Metric<double> metric{Eigen::Vector3d(1, 1, 1), 1e-4 * weights};
      BOOST_TEST(coordinates.gradient(metric, base).norm() < 1e-15);
      const Vector6<double> newton = -coordinates.hessian(metric, target).ldlt().solve(coordinates.gradient(metric, target));
      BOOST_TEST((newton - step).norm() < 1e-12);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(rotation_vectors_are_their_own_inverse_and_have_the_rows_of_a_twist) { check<Increments::rotation_vector>(1); }
BOOST_AUTO_TEST_CASE(euler_angles_are_their_own_inverse_and_their_rows_are_derivatives) { check<Increments::euler_angles>(2); }

BOOST_AUTO_TEST_CASE(euler_angles_go_the_short_way_past_half_a_turn) {
  const auto turned = [](double angle) { return Pose<double>{{}, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()))}; };
  const double pi = std::numbers::pi;
  const StepCoordinates<double, Increments::euler_angles> coordinates(turned(pi - 0.01));
  BOOST_TEST(std::abs(coordinates.of(turned(-pi + 0.01))[5] - 0.02) < 1e-12);
}

BOOST_AUTO_TEST_CASE(euler_angles_go_on_past_a_quarter_turn_of_the_second) {
  // There the same rotation has other angles, all three far away.
  for (const double tilt : {1.5, -1.5}) {
    const Pose<double> base{{},
                            Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()) *
                                               Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX()))};
    const StepCoordinates<double, Increments::euler_angles> coordinates(base);
    Vector6<double> step;
    step << 0, 0, 0, 0.1, tilt > 0 ? 0.2 : -0.2, -0.05;
    BOOST_TEST((coordinates.of(coordinates.pose_at(step)) - step).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_SUITE_END()
