// A line, a hull and a box on edges, in grooves and in corners: poses and force splits in closed form.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "scenes/motions.hpp"
#include "support/rendering.hpp"
#include "support/valleys.hpp"

BOOST_AUTO_TEST_SUITE(groove)

using namespace feeler;
using namespace feeler::test;
using namespace feeler::test::valleys;

namespace {

double total_force(const Tick<double>& tick) {
  double force = 0;
  for (const auto& contact : tick.contacts) force += contact.force;
  return force;
}

/// The tip of a line pressed into a groove, below its bottom and to one side.
void check_tip_in_groove(double slope) {
  // About the tip no contact force has a torque: the tip alone is projected, the rotation follows the device.
  const Vector3<double> tip(0, 0, -0.015);
  const Segment<double> line(tip, {0.001, 0.0005, 0.015});
  {
    const auto mesh = valley(slope);
    const Vector3<double> left(std::sin(slope), 0, std::cos(slope)), right(-std::sin(slope), 0, std::cos(slope));
    for (const double side : {0.0, 0.0002, -0.0002}) {
      BOOST_TEST_CONTEXT("slope " << slope << ", side " << side) {
        HapticRenderer renderer(mesh, line, settings_about(tip));
        const Vector3<double> tip_device(side, 0.001, -0.002);
        const Pose<double> haptic{tip_device - tip, Quaternion<double>::Identity()};
        const auto& tick = come_down(renderer, haptic, {0, 0, 0.05});
        const Vector3<double> tip_expected(0, 0.001, margin / std::cos(slope));
        BOOST_TEST((tick.graphic_pose * tip - tip_expected).norm() <= 1e-9);
        BOOST_TEST(log_rotation(tick.graphic_pose.rotation).norm() <= 1e-9);
        const Vector3<double> force = 1000 * (tip_expected - tip_device);
        BOOST_TEST((tick.wrench.force - force).norm() <= 1e-6);
        BOOST_TEST(tick.wrench.torque.norm() <= 1e-9);
        const double sum = force.z() / std::cos(slope), difference = force.x() / std::sin(slope);
        BOOST_TEST(std::abs(force_along(tick, left) - (sum + difference) / 2) <= 1e-6);
        BOOST_TEST(std::abs(force_along(tick, right) - (sum - difference) / 2) <= 1e-6);
      }
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_over_a_convex_edge_turns_until_its_torque_balances) {
  for (const double roof : {-0.5, -1.0, -1.5}) {
    const auto mesh = valley(roof);
    const Segment<double> line({-0.015, 0, 0}, {0.015, 0, 0});
    for (const double offset : {0.0, 0.002, -0.005, 0.008}) {
      for (const double depth : {0.0005, 0.002}) {
        BOOST_TEST_CONTEXT("roof " << roof << ", offset " << offset << ", depth " << depth) {
          HapticRenderer renderer(mesh, line, settings_about({0, 0, 0}));
          const Pose<double> haptic{{offset, 0.003, -depth}, Quaternion<double>::Identity()};
          const auto& tick = come_down(renderer, haptic, {0, 0, 0.02});
          // The line at angle φ has the normal n = (−sin φ, 0, cos φ) and keeps n·p = margin: p = p_h + (margin − n·p_h) n.
          const auto rise = [&](WideReal phi) { return margin - (-std::sin(phi) * WideReal(offset) - std::cos(phi) * WideReal(depth)); };
          WideReal low = -0.4L, high = 0.4L;  // d/dφ of ½ rise² + ½ L² φ² grows through zero
          for (int i = 0; i < 200; ++i) {
            const WideReal phi = (low + high) / 2;
            const WideReal slope = rise(phi) * (std::cos(phi) * offset - std::sin(phi) * depth) + WideReal(length) * length * phi;
            (slope < 0 ? low : high) = phi;
          }
          const WideReal phi = low;
          const CheckedPose expected(WideVector(WideVector(offset, 0.003, -depth) + rise(phi) * WideVector(-std::sin(phi), 0, std::cos(phi))),
                                     rotation_by(WideVector(0, -phi, 0)));
          BOOST_TEST(pose_error(expected, tick.graphic_pose).at(0.015) <= 2e-8);
          BOOST_TEST(std::abs(total_force(tick) - 1000 * static_cast<double>(rise(phi))) <= 1e-4);
          for (const auto& contact : tick.contacts) BOOST_TEST(std::hypot(contact.point_world.x(), contact.point_world.z()) <= 3 * margin);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_over_a_crossing_edge_of_a_slope_still_slides_along_it) {
  const auto mesh = valley(-0.7);
  const Segment<double> line({-0.015, 0, 0}, {0.015, 0, 0});
  HapticRenderer renderer(mesh, line, settings_about({0, 0, 0}));
  come_down(renderer, {{0, -0.02, -0.001}, Quaternion<double>::Identity()}, {0, 0, 0.02});
  for (int i = 0; i <= 200; ++i) {
    const auto& tick = renderer.update({{0, -0.02 + 0.0002 * i, -0.001}, Quaternion<double>::Identity()});
    BOOST_TEST(std::abs(tick.graphic_pose.translation.y() - (-0.02 + 0.0002 * i)) <= 1e-9);
    BOOST_TEST(std::abs(tick.wrench.force.y()) <= 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(a_vertex_in_a_groove_feels_each_wall_with_its_share) {
  for (const double slope : {0.7, 1.0, 1.3}) check_tip_in_groove(slope);
}

BOOST_AUTO_TEST_CASE(a_vertex_in_a_shallow_groove_feels_each_wall_with_its_share) {
  for (const double slope : {0.2, 0.4}) check_tip_in_groove(slope);
}

BOOST_AUTO_TEST_CASE(a_line_along_a_groove_rests_on_both_walls) {
  const auto mesh = valley(0.6);
  const Segment<double> line({0, -0.015, 0}, {0, 0.015, 0});
  HapticRenderer renderer(mesh, line, settings_about({0, 0, 0}));
  const Pose<double> haptic{{0, 0.004, -0.002}, Quaternion<double>::Identity()};
  const auto& tick = come_down(renderer, haptic, {0, 0, 0.03});
  const Pose<double> expected{{0, 0.004, margin / std::cos(0.6)}, Quaternion<double>::Identity()};
  BOOST_TEST(pose_error(expected, tick.graphic_pose).at(0.015) <= 1e-8);
  const double share = 1000 * (0.002 + margin / std::cos(0.6)) / (2 * std::cos(0.6));
  BOOST_TEST(std::abs(force_along(tick, {std::sin(0.6), 0, std::cos(0.6)}) - share) <= 1e-5);
  BOOST_TEST(std::abs(force_along(tick, {-std::sin(0.6), 0, std::cos(0.6)}) - share) <= 1e-5);
}

BOOST_AUTO_TEST_CASE(a_box_in_a_concave_corner_feels_three_faces) {
  const auto mesh = corner();
  const Vector3<double> half(0.010, 0.006, 0.003);
  const Box<double> box(half);
  HapticRenderer renderer(mesh, box, settings_about({0, 0, 0}));
  const Pose<double> haptic{half - Vector3<double>(0.001, 0.002, 0.003), Quaternion<double>::Identity()};
  const auto& tick = come_down(renderer, haptic, {0.03, 0.03, 0.03});
  const Pose<double> expected{half + Vector3<double>::Constant(margin), Quaternion<double>::Identity()};
  BOOST_TEST(pose_error(expected, tick.graphic_pose).at(half.norm()) <= 1e-8);
  BOOST_TEST((tick.wrench.force - Vector3<double>(1, 2, 3)).norm() <= 2e-3);  // the margin is 1 mN
  BOOST_TEST(tick.wrench.torque.norm() <= 1e-7);
}

BOOST_AUTO_TEST_CASE(a_vertex_in_a_concave_corner_feels_each_wall_with_its_share) {
  const auto mesh = corner();
  const Vector3<double> tip(-0.010, -0.010, -0.010);
  const auto tool = ConvexPolytope<double>::hull_of(Points<double>{{-0.010, -0.010, -0.010}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}});
  HapticRenderer renderer(mesh, tool, settings_about(tip));
  const Vector3<double> tip_device(-0.001, -0.002, -0.0005);
  const auto& tick = come_down(renderer, {tip_device - tip, Quaternion<double>::Identity()}, {0.02, 0.02, 0.02});
  const Vector3<double> expected = Vector3<double>::Constant(margin);
  BOOST_TEST((tick.graphic_pose * tip - expected).norm() <= 1e-9);
  const Vector3<double> force = 1000 * (expected - tip_device);
  BOOST_TEST((tick.wrench.force - force).norm() <= 1e-6);
  for (int k = 0; k < 3; ++k) BOOST_TEST(std::abs(force_along(tick, Vector3<double>::Unit(k)) - force[k]) <= 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
