// Extrapolated wrenches: what a linear wall gives, and that no wall pulls.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

#include "feeler/device/conversion.hpp"
#include "feeler/device/wrench_extrapolator.hpp"
#include "scenes/plate.hpp"
#include "scenes/renderers.hpp"

BOOST_AUTO_TEST_SUITE(wrench_extrapolator)

using feeler::DevicePose;
using feeler::WrenchModel;

namespace {

/// A wall y ≥ 0 of 1000 N/m, entered by a millimetre.
WrenchModel wall() {
  WrenchModel model;
  model.pose.position[1] = -1e-3;
  model.wrench.force[1] = 1;
  model.derivative[6 * 1 + 1] = -1000;
  return model;
}

DevicePose at(double y) {
  DevicePose pose;
  pose.position[1] = y;
  return pose;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_linear_wall_is_continued_and_never_pulls) {
  for (const double y : {-1.9e-3, -1.5e-3, -1e-3, -0.2e-3}) {
    BOOST_TEST(feeler::extrapolated(wall(), at(y)).force[1] == -1000 * y, boost::test_tools::tolerance(1e-12));
  }
  for (const double y : {0.0, 1e-4, 1e-2}) BOOST_TEST(std::abs(feeler::extrapolated(wall(), at(y), {1.0, 1.0}).force[1]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_model_is_trusted_only_so_far) {
  BOOST_TEST(feeler::extrapolated(wall(), at(-1)).force[1] == 2, boost::test_tools::tolerance(1e-12));
  WrenchModel turn;
  turn.derivative[6 * 3 + 3] = -0.3;
  DevicePose turned;
  turned.orientation[0] = std::cos(0.5);
  turned.orientation[1] = std::sin(0.5);
  BOOST_TEST(feeler::extrapolated(turn, turned, {1e-3, 0.1}).torque[0] == -0.03, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_a_derivative_the_wrench_is_held) {
  WrenchModel model = wall();
  model.derivative = {};
  model.wrench.torque[2] = 0.1;
  const auto held = feeler::extrapolated(model, at(0.1));
  BOOST_TEST(held.force[1] == 1);
  BOOST_TEST(held.torque[2] == 0.1);
}

BOOST_AUTO_TEST_CASE(rows_and_columns_are_those_of_the_renderer) {
  // A box tilted on a plate: what the model says is what the renderer says there, to second order.
  const auto scene = feeler::scenes::plate();
  const feeler::TriangleMesh<double> object(scene.vertices, scene.triangles);
  feeler::HapticRenderer renderer(object, std::get<feeler::Box<double>>(scene.tool), scene.settings());
  renderer.reset(scene.start);
  const auto haptic = feeler::scenes::pose_of({0.3, 0.2, 0.4}, {0.001, 0.002, 0.003});
  for (int i = 0; i < 100; ++i) renderer.update(haptic);
  WrenchModel model;
  model.pose = feeler::to_device_pose(haptic);
  model.wrench = feeler::to_device_wrench(renderer.tick().wrench);
  feeler::store_derivative(feeler::wrench_derivative(renderer).matrix, model.derivative);

  const auto near = feeler::moved(haptic, feeler::Twist<double>{{2e-5, -3e-5, -5e-5}, {2e-3, 3e-3, -1e-3}});
  for (int i = 0; i < 100; ++i) renderer.update(near);
  const auto expected = feeler::to_device_wrench(renderer.tick().wrench);
  const auto found = feeler::extrapolated(model, feeler::to_device_pose(near));
  double change = 0, error = 0, torque_change = 0, torque_error = 0;
  for (int i = 0; i < 3; ++i) {
    change = std::max(change, std::abs(expected.force[i] - model.wrench.force[i]));
    error = std::max(error, std::abs(expected.force[i] - found.force[i]));
    torque_change = std::max(torque_change, std::abs(expected.torque[i] - model.wrench.torque[i]));
    torque_error = std::max(torque_error, std::abs(expected.torque[i] - found.torque[i]));
  }
  BOOST_TEST(error < 0.02 * change);
  BOOST_TEST(torque_error < 0.02 * torque_change);
}

BOOST_AUTO_TEST_SUITE_END()
