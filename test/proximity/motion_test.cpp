#include "feeler/proximity/motion.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "feeler/proximity/plane_cache.hpp"
#include "support/random_motions.hpp"

BOOST_AUTO_TEST_SUITE(motion)

using feeler::MotionFrame;
using feeler::test::WideReal;
using feeler::test::WideTool;
using feeler::test::WideVector;
using namespace feeler_test;

BOOST_AUTO_TEST_CASE(poses_and_frames_are_those_of_constant_velocities_in_long_double) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 1000; ++i) {
    const RandomMotion<feeler::Box<double>> random(bits, random_box(bits), 1e3);
    const auto moving = random.moving();
    for (const double t : {0.0, fraction(bits), 1.0}) {
      const auto pose = moving.pose_at(t);
      const auto frame = moving.frame_at(t);
      const auto expected = random.wide().pose_at(WideReal(t));
      BOOST_TEST(frame.time == t);
      BOOST_TEST((frame.rotation.cast<WideReal>() - expected.rotation.toRotationMatrix()).norm() < 4e-15L);
      BOOST_TEST((pose.rotation.toRotationMatrix() - frame.rotation).norm() < 4e-15);
      // Far from the origin the pose has the digits of its size, the frame those of the motion.
      BOOST_TEST((pose.translation - moving.origin() - frame.shift).norm() < 1e-12);
      const Vector corner = random.tool.vertex(below(bits, 8));
      const WideVector in_world = expected.translation + expected.rotation * corner.cast<WideReal>() - random.wide().start;
      BOOST_TEST((moving.to_world(corner, frame).cast<WideReal>() - in_world).norm() < 1e-15L);
      // To the tool's frame and back.
      const Eigen::Matrix3d corners = random_triangle(bits, Shape::ordinary);
      const Eigen::Matrix3d in_tool = moving.in_tool(corners, frame);
      for (int k = 0; k < 3; ++k) BOOST_TEST((moving.to_world(in_tool.col(k), frame) - corners.col(k)).norm() < 1e-15);
      const Vector normal = random_direction(bits);
      double lowest = 1e9;
      for (int v = 0; v < 8; ++v) lowest = std::min(lowest, normal.dot(moving.to_world(random.tool.vertex(v), frame)));
      BOOST_TEST(std::abs(moving.lowest(normal, frame) - lowest) < 1e-15);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_tool_point_goes_farther_than_the_length_of_the_motion) {
  constexpr unsigned seed = 2;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 200; ++i) {
    const RandomMotion<feeler::Box<double>> random(bits, random_box(bits));
    const auto moving = random.moving();
    for (int v = 0; v < 8; ++v) {
      double length = 0;
      Vector last = moving.to_world(random.tool.vertex(v), moving.frame_at(0));
      for (int k = 1; k <= 50; ++k) {
        const Vector next = moving.to_world(random.tool.vertex(v), moving.frame_at(k / 50.0));
        length += (next - last).norm();
        last = next;
      }
      BOOST_TEST(length <= moving.length() + 1e-14);
    }
  }
}

namespace {
/// @param used  least part of the bound that some motion uses: no idle bound
template <class MakeTool>
void check_sagittas(unsigned seed, const MakeTool& make_tool, WideReal used) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  WideReal most_used_by_tool = 0, most_used_by_object = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomMotion<decltype(make_tool(bits))> random(bits, make_tool(bits));
    const auto moving = random.moving();
    const auto wide_motion = random.wide();
    const double from = i % 2 == 0 ? 0 : fraction(bits) / 2, to = i % 2 == 0 ? 1 : from + fraction(bits) / 2;
    const Vector normal = i % 3 == 0 ? Vector(random.motion.linear.cross(random.motion.angular).normalized()) : random_direction(bits);
    const Vector object = 0.3 * random_vector(bits);  // relative to the start
    const WideVector n = normal.cast<WideReal>();
    const auto pose_from = wide_motion.pose_at(WideReal(from)), pose_to = wide_motion.pose_at(WideReal(to));
    const WideReal sagitta = WideReal(moving.sagitta(normal, to - from));
    // The object's point as the tool sees it, in the axes that the tool has at `from`.
    const auto seen = [&](WideReal t) {
      const WideVector relative = object.cast<WideReal>() - t * wide_motion.linear;
      const auto turn = wide_motion.rotation_at(WideReal(from)) * wide_motion.rotation_at(t).conjugate();
      return n.dot(turn * relative);
    };
    const double reach = std::max((object - from * random.motion.linear).norm(), (object - to * random.motion.linear).norm());
    const WideReal sagitta_of_object = WideReal(moving.sagitta_of_object(normal, to - from, reach));
    const WideTool tool(random.tool);
    std::vector<WideReal> start_heights, end_heights;
    for (const WideVector& v : tool.vertices) {
      start_heights.push_back(n.dot(pose_from.translation + pose_from.rotation * v));
      end_heights.push_back(n.dot(pose_to.translation + pose_to.rotation * v));
    }
    const WideReal seen_from = seen(WideReal(from)), seen_to = seen(WideReal(to));
    for (int k = 1; k < 1000; ++k) {
      const WideReal u = WideReal(k) / 1000, t = WideReal(from) + u * WideReal(to - from);
      const auto pose = wide_motion.pose_at(t);
      for (std::size_t v = 0; v < tool.vertices.size(); ++v) {
        const WideReal height = n.dot(pose.translation + pose.rotation * tool.vertices[v]);
        const WideReal strays = std::abs(height - (1 - u) * start_heights[v] - u * end_heights[v]);
        // Not the sagitta alone: its parabola.
        if (strays > sagitta * 4 * u * (1 - u) + 1e-16L) BOOST_ERROR("tool point strays by " << strays << " of " << sagitta << " at " << u);
        if (sagitta > 1e-9L) most_used_by_tool = std::max(most_used_by_tool, strays / sagitta);
      }
      const WideReal strays = std::abs(seen(t) - (1 - u) * seen_from - u * seen_to);
      if (strays > sagitta_of_object * 4 * u * (1 - u) + 1e-16L)
        BOOST_ERROR("object point strays by " << strays << " of " << sagitta_of_object << " at " << u);
      if (sagitta_of_object > 1e-9L) most_used_by_object = std::max(most_used_by_object, strays / sagitta_of_object);
    }
  }
  BOOST_TEST_MESSAGE("used of the sagitta: tool " << most_used_by_tool << ", object " << most_used_by_object);
  BOOST_TEST(most_used_by_tool > used);
  BOOST_TEST(most_used_by_object > 0.2L);
}
}  // namespace

BOOST_AUTO_TEST_CASE(no_point_strays_from_its_chord_by_more_than_the_sagitta) {
  check_sagittas(3, random_box, 0.5L);
  check_sagittas(7, random_segment, 0.7L);
  check_sagittas(8, random_sphere, 0.7L);
}

BOOST_AUTO_TEST_CASE(the_lowest_height_of_a_swept_tool_is_that_of_its_core_less_the_radius) {
  std::mt19937 bits(9);
  for (int i = 0; i < 300; ++i) {
    const auto tool = random_rounded_box(bits);
    const RandomMotion random(bits, tool);
    const auto moving = random.moving();
    const auto frame = moving.frame_at(fraction(bits));
    const Vector normal = random_direction(bits);
    const feeler::MovingTool<feeler::Box<double>> core_moving(tool.core(), random.reference, random.radius, random.pose, random.motion);
    BOOST_TEST(moving.lowest(normal, frame) == core_moving.lowest(normal, frame) - tool.swept_radius());
    BOOST_TEST(moving.sagitta(normal, 1) == core_moving.sagitta(normal, 1));
  }
}

BOOST_AUTO_TEST_CASE(first_root_is_where_a_dense_sample_of_the_slack_first_falls_below_zero) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int whole = 0, part = 0;
  for (int i = 0; i < 3000; ++i) {
    const double scale = magnitude(bits, -12, 0);
    const double a = below(bits, 5) == 0 ? 0.0 : scale * fraction(bits);
    const double b = below(bits, 5) == 0 ? 0.0 : scale * unit(bits);
    const double g = below(bits, 5) == 0 ? 0.0 : scale * magnitude(bits, -4, 0.5);
    const auto slack = [&](WideReal u) { return WideReal(a) + u * (WideReal(b) - WideReal(a)) - 4 * WideReal(g) * u * (1 - u); };
    const double root = feeler::first_root(a, b, g);
    BOOST_TEST((root >= 0 && root <= 1));
    (root < 1 ? part : whole)++;
    const WideReal rounding = 1e-15L * WideReal(std::max({a, std::abs(b), g}));
    for (int k = 0; k <= 400; ++k) {
      const WideReal u = WideReal(root) * WideReal(k) / 400;
      if (slack(u) < -rounding) BOOST_ERROR("slack " << slack(u) << " at " << u << " before the root " << root);
    }
    if (root < 1) {  // no earlier than needed: just behind it the slack is gone
      const WideReal behind = WideReal(root) * (1 + 1e-7L) + 1e-12L;
      BOOST_TEST(slack(behind) <= 1e-12L * WideReal(scale) + rounding);
    }
  }
  BOOST_TEST(whole > 300);
  BOOST_TEST(part > 300);
  BOOST_TEST(feeler::first_root(-1.0, 1.0, 0.0) == 0);
  BOOST_TEST(feeler::first_root(std::nan(""), 1.0, 0.0) == 0);
  BOOST_TEST(feeler::first_root(1.0, -1.0, 0.0) == 0.5);
}

namespace {

/// How low a tool comes along a normal up to a time.
template <class Moving>
double least_height(const Vector& normal, const Moving& moving, double time) {
  feeler::PlaneOnMotion<double> plane{normal};
  plane.begin(moving, moving.frame_at(0));
  plane.end(moving, moving.frame_at(time));
  return plane.least;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_cached_plane_keeps_its_distance_over_the_whole_motion_and_gives_little_away) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 400; ++i) {
    const RandomMotion<feeler::Box<double>> random(bits, random_box(bits));
    const auto moving = random.moving();
    const auto start = moving.frame_at(0), end = moving.frame_at(i % 3 == 0 ? 1.0 : fraction(bits));
    const Vector normal = random_direction(bits);
    const double kept = 1e-7;
    feeler::PlaneCache<double> cache;
    const int place = cache.add(normal, moving, start, end, kept);
    BOOST_TEST(cache.size() == 1);
    BOOST_TEST(cache.normal(place) == normal);
    const double limit = cache.limit(place);
    WideReal lowest = std::numeric_limits<WideReal>::infinity();
    const WideTool tool(random.tool);
    for (int k = 0; k <= 300; ++k) {
      const auto pose = random.wide().pose_at(WideReal(end.time) * WideReal(k) / 300);
      for (const WideVector& v : tool.vertices)
        lowest = std::min(lowest, normal.cast<WideReal>().dot(pose.translation + pose.rotation * v - random.wide().start));
    }
    BOOST_TEST(lowest >= WideReal(limit) + WideReal(kept) - 1e-15L);
    BOOST_TEST(lowest <= WideReal(limit + kept + moving.sagitta(normal, end.time)) + 1e-15L + WideReal(moving.length()) / 300);
    // For another motion the limits are found anew.
    const RandomMotion<feeler::Box<double>> next(bits, random.tool);
    const auto next_moving = next.moving();
    cache.begin(next_moving, next_moving.frame_at(0));
    cache.end(next_moving, next_moving.frame_at(1), kept);
    BOOST_TEST(cache.limit(place) == least_height(normal, next_moving, 1) - kept);
    // Nor does a motion that is shortened later need another beginning.
    cache.end(next_moving, next_moving.frame_at(0.5), kept);
    BOOST_TEST(cache.limit(place) == least_height(normal, next_moving, 0.5) - kept);
  }
}

BOOST_AUTO_TEST_CASE(a_motion_that_goes_on_where_the_last_one_ended_has_the_limits_of_any_other) {
  std::mt19937 bits(7);
  for (int i = 0; i < 200; ++i) {
    const RandomMotion<feeler::Box<double>> random(bits, random_box(bits));
    const auto moving = random.moving();
    const double ended = i % 2 == 0 ? 1.0 : fraction(bits);
    const Vector normal = random_direction(bits);
    feeler::PlaneCache<double> cache;
    cache.begin(moving, moving.frame_at(0));
    cache.add(normal, moving, moving.frame_at(0), moving.frame_at(1), 0);
    cache.end(moving, moving.frame_at(ended), 0);
    feeler::Pose<double> pose = moving.pose_at(ended);
    if (i % 5 == 4) pose.rotation = feeler::exp_rotation<double>(0.1 * random_direction(bits)) * pose.rotation;  // there, but turned
    const feeler::MovingTool<feeler::Box<double>> next(random.tool, random.reference, moving.radius(), pose, random.motion);
    cache.begin(next, next.frame_at_start());
    cache.end(next, next.frame_at(1), 0);
    const double size = moving.radius() + moving.length();
    BOOST_TEST(std::abs(cache.limit(0) - least_height(normal, next, 1)) <= 1e-14 * size);
    for (int axis = 0; axis < 3; ++axis) {
      BOOST_TEST(std::abs(cache.box().lower(axis) - least_height(Vector::Unit(axis), next, 1)) <= 1e-14 * size);
      BOOST_TEST(std::abs(cache.box().upper(axis) + least_height(-Vector::Unit(axis), next, 1)) <= 1e-14 * size);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_limit_of_a_plane_is_as_high_as_a_point_that_swings_through_its_lowest_allows) {
  // One point swings about the reference point and moves along the normal meanwhile: all of the sagitta is
  // used.
  const feeler::Segment<double> arm(Vector::Zero(), Vector(0.1, 0, 0));
  for (const double angle : {0.01, 0.1, 0.5}) {
    for (const double rise : {0.0, 0.2, -0.7, 0.95}) {  // of what would leave no lowest point in between
      feeler::Pose<double> pose;
      pose.rotation = Eigen::AngleAxisd(std::acos(0.0) - angle / 2, Vector::UnitY());  // hangs down at half of the time
      feeler::Twist<double> motion{Vector::Zero(), Vector(0, angle, 0)};
      motion.linear.z() = rise * angle * angle * 0.1 / 2;
      const feeler::MovingTool<feeler::Segment<double>> moving(arm, Vector::Zero(), 0.1, pose, motion);
      const double limit = least_height(Vector::UnitZ(), moving, 1);
      WideReal lowest = 0;
      for (int k = 0; k <= 10000; ++k) {
        const WideReal t = WideReal(k) / 10000;
        lowest = std::min(lowest, t * WideReal(motion.linear.z()) - 0.1L * std::cos((t - 0.5L) * WideReal(angle)));
      }
      const WideReal sagitta = WideReal(angle * angle) * 0.1L / 8;
      BOOST_TEST(lowest >= WideReal(limit) - 1e-16L);
      BOOST_TEST(lowest <= WideReal(limit) + 0.03L * sagitta + 1e-16L);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_plane_parts_closely_what_the_motion_leaves_as_much_of_as_the_clearance_requires) {
  const feeler::Clearance<double> clearance;
  feeler::PlaneOnMotion<double> plane;
  const auto parts = [&](double start, double least) {  // above a height of a metre
    plane.start = 1 + start;
    plane.least = 1 + least;
    return plane.parts_closely(1, clearance);
  };
  const double kept = clearance.kept, allowance = clearance.allowance;
  BOOST_TEST(parts(10 * kept, 1.01 * kept));
  BOOST_TEST(!parts(10 * kept, 0.99 * kept));
  BOOST_TEST(parts(0.8 * kept, 0.41 * kept));
  BOOST_TEST(!parts(0.8 * kept, 0.39 * kept));
  BOOST_TEST(parts(-1.5 * allowance, -1.49 * allowance));
  BOOST_TEST(!parts(-1.5 * allowance, -1.51 * allowance));
}

BOOST_AUTO_TEST_CASE(a_full_cache_gives_up_the_plane_with_the_fewest_hits_and_keeps_the_others_in_order_of_use) {
  std::mt19937 bits(6);
  const RandomMotion<feeler::Box<double>> random(bits, random_box(bits));
  const auto moving = random.moving();
  const auto start = moving.frame_at(0), end = moving.frame_at(1);
  feeler::PlaneCache<double> cache;
  constexpr int capacity = feeler::PlaneCache<double>::capacity;
  std::vector<Vector> normals;
  for (int i = 0; i < capacity; ++i) {
    normals.push_back(random_direction(bits));
    BOOST_TEST(cache.add(normals.back(), moving, start, end, 0) == i);
    cache.count_hits(i, i == 5 ? 0 : 3 * (i + 1));
  }
  BOOST_TEST(cache.size() == capacity);
  const Vector late = random_direction(bits);
  BOOST_TEST(cache.add(late, moving, start, end, 0) == 5);
  BOOST_TEST(cache.size() == capacity);
  BOOST_TEST(cache.normal(5) == late);
  cache.age();
  BOOST_TEST(cache.normal(0) == normals[std::size_t(capacity - 1)]);
  BOOST_TEST(cache.normal(1) == normals[std::size_t(capacity - 2)]);
  BOOST_TEST(cache.normal(capacity - 1) == late);
  for (int i = 0; i < capacity; ++i) BOOST_TEST(cache.limit(i) == least_height(cache.normal(i), moving, 1));
  cache.clear();
  BOOST_TEST(cache.size() == 0);
}

BOOST_AUTO_TEST_CASE(a_cleared_cache_knows_nothing_of_the_tool_that_it_was_of) {
  std::mt19937 bits(10);
  for (int i = 0; i < 100; ++i) {
    const RandomMotion<feeler::Box<double>> random(bits, random_box(bits));
    const auto moving = random.moving();
    feeler::PlaneCache<double> cache;
    cache.begin(moving, moving.frame_at_start());
    cache.add(Vector::UnitZ(), moving, moving.frame_at_start(), moving.frame_at(1), 0);
    cache.with_tool().add(Vector::UnitX(), moving, moving.frame_at_start(), moving.frame_at(1), 0);
    feeler::WitnessFeatures features;
    features.size = 1;
    cache.features().remember(3, features);
    cache.end(moving, moving.frame_at(1), 0);
    cache.clear();
    BOOST_TEST(cache.size() == 0);
    BOOST_TEST(cache.with_tool().size() == 0);
    BOOST_TEST(cache.features().recall_or_guess(3).size == 0);
    // Another tool, which begins where that one ended and is turned alike.
    const feeler::Box<double> other = random_box(bits);
    const feeler::MovingTool<feeler::Box<double>> next(other, random.reference, feeler::radius_about(other, random.reference), moving.pose_at(1),
                                                       random.motion);
    cache.begin(next, next.frame_at_start());
    cache.end(next, next.frame_at(1), 0);
    const double size = next.radius() + next.length();
    for (int axis = 0; axis < 3; ++axis) {
      BOOST_TEST(std::abs(cache.box().lower(axis) - least_height(Vector::Unit(axis), next, 1)) <= 1e-14 * size);
      BOOST_TEST(std::abs(cache.box().upper(axis) + least_height(-Vector::Unit(axis), next, 1)) <= 1e-14 * size);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
