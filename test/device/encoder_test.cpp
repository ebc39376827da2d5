// Encoders: the grid, its error, and unit quaternions.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include <Eigen/Geometry>

#include "feeler/device/encoder.hpp"

BOOST_AUTO_TEST_SUITE(encoder)

namespace {

Eigen::Quaterniond orientation(const feeler::DevicePose& pose) {
  const double* q = pose.orientation;
  return {q[0], q[1], q[2], q[3]};
}

feeler::DevicePose random_pose(std::mt19937& bits) {
  const auto unit = [&bits] { return double(bits()) / 2147483648.0 - 1; };
  const Eigen::Quaterniond q = Eigen::Quaterniond(unit(), unit(), unit(), unit()).normalized();
  return {{0.4 * unit(), 0.4 * unit(), 0.4 * unit()}, {q.w(), q.x(), q.y(), q.z()}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(positions_and_rotation_vectors_are_whole_counts_within_half_a_count_of_the_truth) {
  const double count = 2e-5;
  const double angular_count = 1.4e-4;
  std::mt19937 bits(11);
  for (int i = 0; i < 1000; ++i) {
    const auto exact = random_pose(bits);
    const auto reported = feeler::quantised(exact, count, angular_count);
    for (int axis = 0; axis < 3; ++axis) {
      const double counts = reported.position[axis] / count;
      BOOST_REQUIRE(std::abs(counts - std::round(counts)) < 1e-9);
      BOOST_REQUIRE(std::abs(reported.position[axis] - exact.position[axis]) <= count / 2 * (1 + 1e-9));
    }
    // Eigen's angle-axis is the second opinion on the rotation vector; beyond π it takes the other way round.
    const Eigen::AngleAxisd turn(orientation(reported));
    const Eigen::Vector3d vector = turn.angle() * turn.axis();
    if (turn.angle() < 3.14) {
      for (int axis = 0; axis < 3; ++axis) {
        const double counts = vector[axis] / angular_count;
        BOOST_REQUIRE(std::abs(counts - std::round(counts)) < 1e-8);
      }
    }
    BOOST_REQUIRE(std::abs(orientation(reported).norm() - 1) < 4e-16);
    const double error = orientation(reported).angularDistance(orientation(exact));
    BOOST_REQUIRE(error <= std::sqrt(3.0) * angular_count / 2 + 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(an_opposite_quaternion_is_the_same_rotation_and_reads_the_same) {
  std::mt19937 bits(12);
  for (int i = 0; i < 100; ++i) {
    auto pose = random_pose(bits);
    const auto first = orientation(feeler::quantised(pose, 1e-5, 1e-4));
    for (double& component : pose.orientation) component = -component;
    const auto second = orientation(feeler::quantised(pose, 1e-5, 1e-4));
    BOOST_REQUIRE(first.angularDistance(second) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_resolution_of_zero_passes_the_pose_through) {
  std::mt19937 bits(13);
  const auto exact = random_pose(bits);
  const auto reported = feeler::quantised(exact, 0, 0);
  for (int i = 0; i < 3; ++i) BOOST_TEST(reported.position[i] == exact.position[i]);
  for (int i = 0; i < 4; ++i) BOOST_TEST(reported.orientation[i] == exact.orientation[i]);
}

BOOST_AUTO_TEST_SUITE_END()
