// Turns that leave a line or a ball as it is: what they are, by where a point of the tool goes.
#include "feeler/render/idle_turns.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(idle_turns)

using namespace feeler_test;

using feeler::IdleTurns;
using feeler::Metric;
using Pose = feeler::Pose<double>;
using Segment = feeler::Segment<double>;
using Twist = feeler::Twist<double>;

namespace {

Pose random_pose(std::mt19937& bits) { return {random_vector(bits), random_rotation(bits)}; }
Vector axis_of(const Segment& segment) { return (segment.vertex(1) - segment.vertex(0)).normalized(); }
/// A point on the axis of a segment.
Vector point_on(std::mt19937& bits, const Segment& segment) { return segment.vertex(0) + unit(bits) * (segment.vertex(1) - segment.vertex(0)); }

}  // namespace

BOOST_AUTO_TEST_CASE(of_a_line_held_on_its_axis_a_turn_counts_by_how_far_it_moves_a_point_of_the_axis) {
  std::mt19937 bits(1);
  for (int round = 0; round < 200; ++round) {
    const Segment line = random_segment(bits);
    const IdleTurns<Segment> turns(line, point_on(bits, line), Metric<double>());
    const Pose pose = random_pose(bits);
    const Vector along = random_direction(bits), place = pose.rotation * axis_of(line);
    const double tiny = 1e-6, angle = 0.1 + fraction(bits);
    const double moved = (Eigen::AngleAxisd(tiny, along) * place - place).norm() / tiny;
    BOOST_TEST(turns.angle_that_matters(angle * along, pose) == angle * moved, boost::test_tools::tolerance(1e-4));
    BOOST_TEST(turns.angle_that_matters(place, pose) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(a_line_that_is_held_beside_its_axis_or_whose_turns_weigh_differently_rolls_for_itself) {
  std::mt19937 bits(2);
  for (int round = 0; round < 100; ++round) {
    const Segment line = random_segment(bits);
    const Vector on_axis = point_on(bits, line), beside = on_axis + magnitude(bits, -6, 0) * axis_of(line).unitOrthogonal();
    Metric<double> uneven;
    uneven.rotational[below(bits, 3)] *= 1 + magnitude(bits, -6, 1);
    const Pose pose = random_pose(bits), device = random_pose(bits);
    for (const IdleTurns<Segment>& turns : {IdleTurns<Segment>(line, on_axis, uneven), IdleTurns<Segment>(line, beside, Metric<double>())}) {
      BOOST_TEST((turns.following(pose, device) == pose));
      BOOST_TEST(turns.angle_that_matters(pose.rotation * axis_of(line), pose) == 1.0, boost::test_tools::tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_rolls_to_where_nothing_turns_it_about_its_axis_and_stays_there_to_the_last_bit) {
  std::mt19937 bits(3);
  for (int round = 0; round < 2000; ++round) {
    const Segment line = random_segment(bits);
    const Vector axis = axis_of(line);
    const IdleTurns<Segment> turns(line, point_on(bits, line), Metric<double>());
    const Pose pose = random_pose(bits);
    Pose device = random_pose(bits);
    if (below(bits, 2) == 0) device.rotation.coeffs() = -device.rotation.coeffs();
    if (round % 4 == 0) {  // the axes all but opposite
      const Vector across = axis.cross(random_vector(bits)).normalized();
      const Eigen::AngleAxisd nearly_half_a_turn(M_PI - magnitude(bits, -2.8, -0.3), across);
      device.rotation = pose.rotation * feeler::Quaternion<double>(nearly_half_a_turn);
    }
    // 2 where the axes are one: the direction of the turn between them is known to a last bit over it.
    const double certainty = (pose.rotation * axis + device.rotation * axis).norm();
    const Pose after = turns.following(pose, device);
    BOOST_TEST(after.translation == pose.translation);
    BOOST_TEST((after.rotation * axis - pose.rotation * axis).norm() < 2e-13 / certainty);
    BOOST_TEST(after.rotation.dot(pose.rotation) >= 0);  // a path is interpolated from one to the other
    const Eigen::AngleAxisd between(after.rotation * device.rotation.conjugate());
    BOOST_TEST(std::abs(std::sin(between.angle()) * between.axis().dot(pose.rotation * axis)) < 2e-12 / certainty);
    BOOST_TEST((turns.following(after, device) == after));
    device.rotation.coeffs() = -device.rotation.coeffs();
    BOOST_TEST((turns.following(after, device) == after));
  }
}

BOOST_AUTO_TEST_CASE(a_ball_has_the_rotation_of_the_device_and_no_motion_turns_it) {
  std::mt19937 bits(4);
  using Sphere = feeler::Sphere<double>;
  for (int round = 0; round < 50; ++round) {
    const Sphere ball = random_sphere(bits);
    const IdleTurns<Sphere> turns(ball, ball.vertex(0), Metric<double>());
    const Pose pose = random_pose(bits), device = random_pose(bits);
    BOOST_TEST((turns.following(pose, device) == Pose{pose.translation, device.rotation}));
    const Twist motion{random_vector(bits), random_vector(bits)};
    BOOST_TEST((turns.moved(pose, motion) == Pose{pose.translation + motion.linear, pose.rotation}));
    BOOST_TEST(turns.motion_between(pose, device).linear == device.translation - pose.translation);
    BOOST_TEST(turns.motion_between(pose, device).angular.isZero(0));
  }
}

BOOST_AUTO_TEST_SUITE_END()
