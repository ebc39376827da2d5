// The rivals that are installed, where a body on a spring has a closed form: they must not lose for how we
// set them.
#include "rivals/engines.hpp"

#include <algorithm>

#include <boost/test/unit_test.hpp>

#include "scenes/motions.hpp"

BOOST_AUTO_TEST_SUITE(engines)

namespace {

using feeler::Pose;
using feeler::rivals::CoupledTool;
using Vector = Eigen::Vector3d;

constexpr double half = 0.01;  // of the cube [m]

/// A cube of 20 mm above a floor at z = 0.
feeler::scenes::Scene cube_on_floor() {
  feeler::scenes::Scene scene;
  scene.vertices = feeler::scenes::points_from({{-0.1, -0.1, 0.0}, {0.1, -0.1, 0.0}, {0.1, 0.1, 0.0}, {-0.1, 0.1, 0.0}});
  scene.triangles = feeler::scenes::triangles_from({{0, 1, 2}, {0, 2, 3}});
  scene.start = {Vector(0.0, 0.0, 0.05), Eigen::Quaterniond::Identity()};
  return scene;
}

template <class Test>
void for_every_engine(const Test& test) {
  const auto scene = cube_on_floor();
  const auto coupled = feeler::rivals::coupled_scene(scene, feeler::Box<double>(Vector::Constant(half)));
  for (const auto& tool : feeler::rivals::make_engines(coupled, 1e-3)) {
    BOOST_TEST_CONTEXT(tool->name()) { test(*tool, scene); }
  }
}

bool is_chai3d(const CoupledTool& tool) { return tool.name() == "Bullet as CHAI3D"; }

Pose<double> at_height(double z) { return {Vector(0.0, 0.0, z), Eigen::Quaterniond::Identity()}; }

}  // namespace

BOOST_AUTO_TEST_CASE(a_tuned_tool_has_no_lag_behind_a_device_at_constant_velocity) {
  for_every_engine([](CoupledTool& tool, const auto& scene) {
    if (is_chai3d(tool)) return;  // its damper holds it back
    Pose<double> device = scene.start, tool_pose;
    for (int i = 0; i < 200; ++i) {
      device.translation += Vector(1e-4, 0.5e-4, 0.0);
      device.rotation = (feeler::exp_rotation(Vector(0.0, 1e-3, 0.0)) * device.rotation).normalized();
      tool_pose = tool.update(device).graphic_pose;
    }
    const auto lag = feeler::motion_between(tool_pose, device);
    BOOST_TEST(lag.linear.norm() < 1e-7);
    BOOST_TEST(lag.angular.norm() < 1e-5);
  });
}

BOOST_AUTO_TEST_CASE(a_pressed_tool_rests_on_the_floor_and_pushes_back_with_the_spring) {
  for_every_engine([](CoupledTool& tool, const auto&) {
    const double stiffness = is_chai3d(tool) ? 4000.0 : 1000.0;  // [N/m]
    const double depth = 0.002;
    feeler::rivals::CoupledTick tick;
    for (int i = 0; i < 2000; ++i) tick = tool.update(at_height(std::max(half - depth, 0.03 - 1e-4 * double(i))));
    // Margins of up to 0.1 mm and what the solvers leave of penetration.
    BOOST_TEST(std::abs(tick.graphic_pose.translation.z() - half) < 3e-4);
    const double force = stiffness * (tick.graphic_pose.translation.z() - (half - depth));
    BOOST_TEST((tick.wrench.force - Vector(0.0, 0.0, force)).norm() < 1e-6 * stiffness);
    BOOST_TEST(tick.damping.force.norm() < 0.05 * force);
  });
}

BOOST_AUTO_TEST_CASE(a_reset_gives_the_same_run_to_the_last_bit) {
  for_every_engine([](CoupledTool& tool, const auto& scene) {
    const auto run = [&] {
      tool.reset(scene.start);
      Eigen::Matrix<double, 7, 1> sum = Eigen::Matrix<double, 7, 1>::Zero();
      for (int i = 0; i < 600; ++i) {
        const double t = double(i) / 1000.0;
        const auto pose =
            tool.update(feeler::scenes::pose_of({0.3 * std::sin(9.0 * t), 0.2 * std::sin(7.0 * t), 0.1 * t}, {0.02 * t, 0.0, 0.03 - 0.06 * t}))
                .graphic_pose;
        sum.head<3>() += pose.translation;
        sum.tail<4>() += pose.rotation.coeffs();
      }
      return sum;
    };
    BOOST_TEST((run() == run()));
  });
}

BOOST_AUTO_TEST_SUITE_END()
