// The derivative of the wrench, against differences of wrenches of the renderer itself, settled a little to
// each side.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "feeler/render/wrench_derivative.hpp"
#include "scenes/cavity.hpp"
#include "scenes/plate.hpp"
#include "scenes/steps.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(wrench_derivative_test)

using namespace feeler;
using namespace feeler::test;

namespace {

using Vector6d = Vector6<double>;
using Matrix6d = Matrix6<double>;

/// The haptic tool moved by the step (dp, w) about the reference point.
Pose<double> stepped(const Pose<double>& pose, const Vector6d& step, const Vector3<double>& reference) {
  Pose<double> at_reference{pose * reference, pose.rotation};
  at_reference = moved(at_reference, Twist<double>::from_vector(step));
  return {at_reference.translation - at_reference.rotation * reference, at_reference.rotation};
}

template <class Renderer>
Vector6d settled_wrench(Renderer& renderer, const Pose<double>& haptic) {
  for (int i = 0; i < 100; ++i) {
    if (renderer.update(haptic).converged() && renderer.tick().path.empty()) break;
  }
  Vector6d wrench;
  wrench << renderer.tick().wrench.force, renderer.tick().wrench.torque;
  return wrench;
}

/// Central differences, from copies of a settled renderer.
template <class Renderer>
Matrix6d differences(const Renderer& settled, const Pose<double>& haptic, double length) {
  constexpr double size = 2e-6;  // [m]; the square of it must be far below the curvature of what is felt
  Matrix6d result;
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d step = Vector6d::Zero();
    step[axis] = axis < 3 ? size : size / length;
    Vector6d wrench[2];
    for (const int side : {0, 1}) {
      Renderer copy = settled;
      wrench[side] = settled_wrench(copy, stepped(haptic, side == 0 ? Vector6d(-step) : step, settled.settings().reference_point));
    }
    result.col(axis) = (wrench[1] - wrench[0]) / (2 * step[axis]);
  }
  return result;
}

/// In units of the translational stiffness: torques and turns by the length of the scene.
Matrix6d plain(const Matrix6d& matrix, double stiffness, double length) {
  Vector6d unit;
  unit << 1, 1, 1, length, length, length;
  return unit.cwiseInverse().asDiagonal() * matrix * unit.cwiseInverse().asDiagonal() / stiffness;
}

struct Probe {
  std::string name;
  Vector3<double> turn;      // of the hand [rad]
  Vector3<double> position;  // [m]
  int contacts = -1;         // that must hold the tool; −1 for any
};

void check_probes(scenes::Scene scene, const std::vector<Probe>& probes, Settings<double> settings, double tolerance = 2e-3) {
  settings.step_tolerance = 1e-10;
  settings.maximum_iterations = 32;
  settings.work_budget = 100'000;
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  with_tool_of(scene, [&](const auto& tool) {
    for (const Probe& probe : probes) {
      BOOST_TEST_CONTEXT(scene.name << ", " << probe.name) {
        HapticRenderer renderer(object, tool, settings);
        BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
        const Pose<double> haptic = scenes::pose_of(probe.turn, probe.position);
        settled_wrench(renderer, haptic);
        BOOST_TEST_REQUIRE(renderer.tick().converged());
        if (probe.contacts >= 0) BOOST_TEST(renderer.tick().contacts.size() == probe.contacts);
        const auto derivative = wrench_derivative(renderer);
        BOOST_TEST(derivative.is_smooth);
        const double stiffness = settings.stiffness.translational.maxCoeff();
        const Matrix6d expected = plain(differences(renderer, haptic, scene.length), stiffness, scene.length);
        const Matrix6d found = plain(derivative.matrix, stiffness, scene.length);
        const double error = (found - expected).cwiseAbs().maxCoeff();
        BOOST_TEST(error <= tolerance);
        if (error > tolerance) BOOST_TEST_MESSAGE("expected\n" << expected << "\nfound\n" << found);
      }
    }
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(free_space_answers_nothing) {
  const auto scene = scenes::plate();
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer renderer(object, Box<double>(Vector3<double>(0.010, 0.006, 0.003)), scene.settings());
  BOOST_TEST(!wrench_derivative(renderer).is_smooth);
  BOOST_TEST(wrench_derivative(renderer).matrix.isZero());
  renderer.reset(scene.start);
  renderer.update(scene.start);
  const auto derivative = wrench_derivative(renderer);
  BOOST_TEST(derivative.is_smooth);
  BOOST_TEST(derivative.matrix.cwiseAbs().maxCoeff() < 1e-9);
}

BOOST_AUTO_TEST_CASE(a_box_flat_on_a_plate_answers_along_its_normal_and_about_the_plate) {
  const auto scene = scenes::plate();
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const auto settings = scene.settings();
  HapticRenderer renderer(object, Box<double>(Vector3<double>(0.010, 0.006, 0.003)), settings);
  renderer.reset(scene.start);
  settled_wrench(renderer, scenes::pose_of({0, 0, 0.2}, {0.001, 0.002, 0.002}));
  const auto derivative = wrench_derivative(renderer);
  BOOST_TEST(derivative.is_smooth);
  Matrix6d expected = Matrix6d::Zero();
  expected(2, 2) = -1;
  expected(3, 3) = expected(4, 4) = -1;
  BOOST_TEST((plain(derivative.matrix, 1000, scene.length) - expected).cwiseAbs().maxCoeff() < 1e-4);
}

BOOST_AUTO_TEST_CASE(it_is_what_the_renderer_does_on_faces_edges_and_corners) {
  const auto plate = scenes::plate();
  check_probes(plate,
               {{"face", {0.01, -0.005, 0.2}, {0.001, 0.002, 0.002}, 3},
                {"vertex on face", {0.5, 0.4, 0.2}, {0.001, 0.002, 0.003}},
                {"edge on face", {0.5, 0.003, 0.2}, {0.001, 0.002, 0.002}},
                {"over the rim of the plate", {0.3, 0.6, 0.1}, {0.051, 0.002, -0.001}}},
               plate.settings());
  const auto steps = scenes::steps();
  check_probes(steps,
               {{"tip on a face", {0.1, 0.1, 0}, {-0.045, 0.002, 0.012}, 1}, {"line over an edge", {0.1, 0.9, 0.1}, {-0.031, 0.003, 0.010}, 1}},
               steps.settings());
  const auto cavity = scenes::cavity(1e-3);
  check_probes(cavity,
               {{"turned between two walls", {0.02, 0.01, 0.15}, {0.001, 0.0002, 0.0005}},
                {"slid into a corner", {0.05, 0.1, 0.08}, {0.013, 0.0015, 0.007}},
                {"square in a corner", {0.001, 0.002, 0.0015}, {0.012, 0.002, 0.007}}},
               cavity.settings());
  const auto terrain = scenes::terrain(22);
  check_probes(terrain, {{"in a hollow", {0.1, 0.2, 0.3}, {0.013, 0.004, 0.004}}, {"beside it", {0.3, -0.2, 0.15}, {-0.031, 0.012, 0.006}}},
               terrain.settings());
}

BOOST_AUTO_TEST_CASE(it_is_so_for_large_turns_other_stiffness_and_other_metrics) {
  const auto plate = scenes::plate();
  auto settings = plate.settings();
  const std::vector<Probe> probes{{"vertex on face", {0.5, 0.4, 0.2}, {0.001, 0.002, 0.003}}, {"turned far", {0.5, 0.7, 0.4}, {0.003, 0.002, 0.001}}};
  settings.reference_point = {0.002, -0.001, 0.004};
  check_probes(plate, probes, settings);
  settings.stiffness = {{900, 1000, 700}, {0.08, 0.05, 0.06}};
  settings.metric = Metric<double>{{1, 1, 1}, {6e-5, 6e-5, 6e-5}};
  check_probes(plate, probes, settings);
  settings.metric = Metric<double>{{1, 0.8, 0.9}, {6e-5, 7e-5, 5e-5}};
  check_probes(plate, probes, settings);
}

BOOST_AUTO_TEST_CASE(the_coefficient_of_the_jacobian_is_one_function) {
  using Coefficient = feeler::detail::JacobianCoefficient<double>;
  const double below = 0.25 - 1e-9, above = 0.25 + 1e-9;
  BOOST_TEST(Coefficient(below).value == Coefficient(above).value, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(Coefficient(below).derivative == Coefficient(above).derivative, boost::test_tools::tolerance(1e-8));
  for (const double u : {0.01, 0.2, 0.5, 2.0, 7.0}) {
    constexpr double step = 1e-5;
    BOOST_TEST(Coefficient(u).derivative == (Coefficient(u + step).value - Coefficient(u - step).value) / (2 * step),
               boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(the_derivative_of_a_pull_is_its_slope_for_large_turns_too) {
  const Vector3<double> weights(1, 0.3, 2.1);
  for (const Vector3<double>& phi : {Vector3<double>(0.1, -0.2, 0.1), Vector3<double>(1.1, -0.7, 1.9)}) {
    for (const int side : {1, -1}) {
      const auto pull = [&](const Vector3<double>& turn) {
        return Vector3<double>(inverse_left_jacobian<double>(side * turn).transpose() * weights.cwiseProduct(turn));
      };
      constexpr double step = 1e-5;
      Matrix3<double> slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3<double> small = step * Vector3<double>::Unit(axis);
        slope.col(axis) = (pull(phi + small) - pull(phi - small)) / (2 * step);
      }
      BOOST_TEST((feeler::detail::derivative_of_pull<double>(weights, phi, side) - slope).cwiseAbs().maxCoeff() < 1e-7);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
