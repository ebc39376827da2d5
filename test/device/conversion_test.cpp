// Device numbers to renderer types and back, in two scalars.
#include <boost/test/unit_test.hpp>

#include "feeler/device/conversion.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/wrench.hpp"

BOOST_AUTO_TEST_SUITE(conversion)

BOOST_AUTO_TEST_CASE(a_quarter_turn_about_z_carries_the_x_axis_to_the_y_axis) {
  const double half = 0.70710678118654752;
  const feeler::DevicePose device{{1, 2, 3}, {half, 0, 0, half}};
  const auto pose = feeler::from_device<feeler::Pose<double>>(device);
  const feeler::Vector3<double> point_world = pose * feeler::Vector3<double>(1, 0, 0);
  BOOST_TEST((point_world - feeler::Vector3<double>(1, 3, 3)).norm() < 1e-15);
  const auto narrow = feeler::from_device<feeler::Pose<float>>(device);
  BOOST_TEST((narrow * feeler::Vector3<float>(1, 0, 0) - feeler::Vector3<float>(1, 3, 3)).norm() < 1e-6f);
}

BOOST_AUTO_TEST_CASE(there_and_back_changes_no_bit) {
  const feeler::DevicePose device{{0.1, -0.2, 0.3}, {0.5, -0.5, 0.5, 0.5}};
  const auto back = feeler::to_device_pose(feeler::from_device<feeler::Pose<double>>(device));
  for (int i = 0; i < 3; ++i) BOOST_TEST(back.position[i] == device.position[i]);
  for (int i = 0; i < 4; ++i) BOOST_TEST(back.orientation[i] == device.orientation[i]);
  const auto wrench = feeler::to_device_wrench(feeler::Wrench<float>{{1, 2, 3}, {4, 5, 6}});
  BOOST_TEST(wrench.force[1] == 2);
  BOOST_TEST(wrench.torque[2] == 6);
}

BOOST_AUTO_TEST_SUITE_END()
