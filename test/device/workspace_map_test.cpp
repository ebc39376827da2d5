// Scale, rotation and clutch: the tool never jumps, and the hand's work is the scene's.
#include <boost/test/unit_test.hpp>

#include <Eigen/Geometry>

#include <limits>
#include <random>
#include <stdexcept>

#include "feeler/device/workspace_map.hpp"

BOOST_AUTO_TEST_SUITE(workspace_map)

using Eigen::Quaterniond;
using Eigen::Vector3d;
using feeler::DevicePose;
using feeler::DeviceState;
using feeler::DeviceWrench;
using feeler::WorkspaceMap;
using feeler::WorkspaceSettings;

namespace {

Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
Quaterniond rotation(const double (&q)[4]) { return {q[0], q[1], q[2], q[3]}; }

DeviceState at(const Vector3d& p, const Quaterniond& q, std::uint32_t buttons = 0) {
  DeviceState state;
  state.pose = {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
  state.buttons = buttons;
  return state;
}

struct Random {
  std::mt19937 bits{5};
  double unit() { return double(bits()) / 2147483648.0 - 1; }
  Vector3d point() { return {unit(), unit(), unit()}; }
  Quaterniond turn() { return Quaterniond(unit(), unit(), unit(), unit()).normalized(); }
};

WorkspaceSettings turned(double scale, const Quaterniond& q) { return {scale, {q.w(), q.x(), q.y(), q.z()}, 1, false}; }

double distance(const DevicePose& a, const DevicePose& b) {
  return (vector(a.position) - vector(b.position)).norm() + rotation(a.orientation).angularDistance(rotation(b.orientation));
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_settings_it_changes_nothing) {
  WorkspaceMap map;
  Random random;
  const DeviceState state = at(random.point(), random.turn());
  const DevicePose pose = map.to_scene(state);
  for (int i = 0; i < 3; ++i) BOOST_TEST(pose.position[i] == state.pose.position[i]);
  for (int i = 0; i < 4; ++i) BOOST_TEST(pose.orientation[i] == state.pose.orientation[i]);
  const DeviceWrench wrench = map.to_device({{1, 2, 3}, {4, 5, 6}});
  for (int i = 0; i < 3; ++i) {
    BOOST_TEST(wrench.force[i] == i + 1);
    BOOST_TEST(wrench.torque[i] == i + 4);
  }
}

BOOST_AUTO_TEST_CASE(positions_are_scaled_and_turned_as_the_formula_says) {
  Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const Quaterniond frame = random.turn();
    const double scale = std::exp(2 * random.unit());
    WorkspaceMap map(turned(scale, frame));
    const DeviceState state = at(random.point(), random.turn());
    const DevicePose pose = map.to_scene(state);
    BOOST_TEST((vector(pose.position) - scale * (frame * vector(state.pose.position))).norm() < 1e-13);
    BOOST_TEST(rotation(pose.orientation).angularDistance(frame * rotation(state.pose.orientation)) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(placing_puts_the_tool_exactly_there) {
  Random random;
  for (int trial = 0; trial < 100; ++trial) {
    WorkspaceMap map(turned(0.3, random.turn()));
    const DeviceState state = at(random.point(), random.turn());
    const DeviceState goal = at(random.point(), random.turn());
    map.place(state.pose, goal.pose);
    BOOST_TEST(distance(map.to_scene(state), goal.pose) < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(the_work_of_the_hand_is_that_of_the_scene_divided_by_the_scale_in_every_motion) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const double scale = std::exp(2 * random.unit());
    WorkspaceMap map(turned(scale, random.turn()));
    DeviceState state = at(random.point(), random.turn());
    const DeviceState goal = at(random.point(), random.turn());
    map.place(state.pose, goal.pose);
    const DevicePose before = map.to_scene(state);

    const Vector3d step = 1e-6 * random.point();
    const Vector3d turn = 1e-6 * random.point();
    const Quaterniond after_turn = Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * rotation(state.pose.orientation);
    state = at(vector(state.pose.position) + step, after_turn);
    const DevicePose after = map.to_scene(state);
    const Vector3d scene_step = vector(after.position) - vector(before.position);
    const Quaterniond scene_turn = rotation(after.orientation) * rotation(before.orientation).conjugate();
    const Vector3d scene_angle = 2 * scene_turn.vec() * (scene_turn.w() < 0 ? -1 : 1);

    const Vector3d force = random.point();
    const Vector3d torque = random.point();
    const DeviceWrench felt = map.to_device({{force.x(), force.y(), force.z()}, {torque.x(), torque.y(), torque.z()}});
    const double scene_work = force.dot(scene_step) + torque.dot(scene_angle);
    const double hand_work = vector(felt.force).dot(step) + vector(felt.torque).dot(turn);
    BOOST_TEST(std::abs(scene_work - scale * hand_work) < 1e-14 * (1 + scale) * 100);
  }
}

BOOST_AUTO_TEST_CASE(the_stiffness_that_is_corrected_by_the_scale_is_the_one_that_is_felt) {
  for (const double scale : {0.1, 1.0, 5.0}) {
    WorkspaceMap map(turned(scale, Quaterniond::Identity()));
    const double k = map.scene_stiffness(800);
    const double kr = map.scene_rotational_stiffness(0.3);
    const double displacement = 1e-3;  // of the hand [m]
    const DevicePose pose = map.to_scene(at({displacement, 0, 0}, Quaterniond::Identity()));
    BOOST_TEST(map.to_device({{k * pose.position[0], 0, 0}, {0, 0, 0}}).force[0] == 800 * displacement, boost::test_tools::tolerance(1e-12));
    const double angle = 0.01;  // the same in the scene
    BOOST_TEST(map.to_device({{0, 0, 0}, {kr * angle, 0, 0}}).torque[0] == 0.3 * angle, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(the_clutch_holds_the_tool_pushes_nothing_and_never_lets_it_jump) {
  Random random;
  for (const bool rotates : {false, true}) {
    WorkspaceSettings settings = turned(2, random.turn());
    settings.clutches_rotation = rotates;
    WorkspaceMap map(settings);
    Vector3d hand = random.point();
    Quaterniond handle = random.turn();
    for (int use = 0; use < 1000; ++use) {
      const DevicePose before = map.to_scene(at(hand, handle));
      BOOST_TEST(!map.is_clutched());
      DevicePose held = map.to_scene(at(hand, handle, 1));
      BOOST_TEST(map.is_clutched());
      BOOST_REQUIRE(distance(before, held) < 1e-7);
      hand = random.point();
      if (rotates) handle = random.turn();
      held = map.to_scene(at(hand, handle, 1));
      BOOST_REQUIRE(distance(before, held) < 1e-7);
      BOOST_TEST(vector(map.to_device({{1, 1, 1}, {1, 1, 1}}).force).norm() == 0);
      const DevicePose after = map.to_scene(at(hand, handle));
      BOOST_REQUIRE(distance(before, after) < 1e-7);
      BOOST_REQUIRE(std::abs(rotation(after.orientation).norm() - 1) < 1e-12);
      BOOST_TEST(vector(map.to_device({{1, 1, 1}, {1, 1, 1}}).force).norm() > 1);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_clutch_of_positions_lets_the_tool_go_on_turning) {
  WorkspaceMap map(turned(1, Quaterniond::Identity()));
  map.to_scene(at({0, 0, 0}, Quaterniond::Identity()));
  const Quaterniond turn(Eigen::AngleAxisd(0.5, Vector3d::UnitY()));
  map.to_scene(at({0.1, 0, 0}, turn, 1));
  const DevicePose pose = map.to_scene(at({0.2, 0, 0}, turn));
  BOOST_TEST(vector(pose.position).norm() < 1e-15);
  BOOST_TEST(rotation(pose.orientation).angularDistance(turn) < 1e-7);
}

BOOST_AUTO_TEST_CASE(maps_that_are_none_are_refused) {
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    BOOST_CHECK_THROW(WorkspaceMap(turned(scale, Quaterniond::Identity())), std::invalid_argument);
  }
  BOOST_CHECK_THROW(WorkspaceMap(turned(1, Quaterniond(2, 0, 0, 0))), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
