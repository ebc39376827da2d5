#include "feeler/proximity/passage.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include "feeler/tool/point.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/random_motions.hpp"
#include "support/sanitized.hpp"

BOOST_AUTO_TEST_SUITE(passage)

using feeler::Clearance;
using feeler::PassedTriangle;
using feeler::test::CheckedTool;
using feeler::test::trials_to_run;
using feeler::test::WideReal;
using feeler::test::WideTool;
using feeler::test::WideTriangle;
using feeler::test::WideVector;
using namespace feeler_test;

namespace {

/// A motion past one triangle, whose corners are relative to the start of the reference point.
template <class Tool>
struct Scene {
  RandomMotion<Tool> random;
  Eigen::Matrix3d corners;

  /// A triangle at `gap` from the tool at its start.
  Scene(std::mt19937& bits, const Tool& tool, Shape shape, double gap) : random(bits, tool) {
    const Eigen::Matrix3d in_tool = triangle_near(tool, bits, shape, gap);
    corners = random.pose.rotation.toRotationMatrix() * (in_tool.colwise() - random.reference);
  }

  WideTriangle triangle() const { return wide(corners); }
  feeler::test::WideMotion relative() const {
    auto motion = random.wide();
    motion.start.setZero();
    return motion;
  }
  /// The deepest penetration on [0, time] at `samples` times.
  WideReal depth(double time, int samples, WideReal enough) const {
    const CheckedTool checked = feeler::test::checked_tool(random.tool);
    WideReal deepest = 0;
    for (int i = 0; i <= samples; ++i) {
      const auto pose = relative().pose_at(WideReal(time) * WideReal(i) / WideReal(samples));
      std::array<WideVector, 3> in_tool;
      for (std::size_t k = 0; k < 3; ++k) in_tool[k] = pose.rotation.conjugate() * (triangle()[k] - pose.translation);
      const WideReal limit = std::max(deepest, enough);
      const WideReal here = feeler::test::detail::depth_in_triangle(checked, in_tool, limit);
      if (here > limit) deepest = here;
    }
    return deepest;
  }
  /// Whether the distance exceeds `clearance` at `samples` times of the motion.
  bool keeps(WideReal clearance, int samples) const {
    const WideTool tool(random.tool);
    for (int i = 0; i <= samples; ++i) {
      const WideTool here = relative().tool_at(tool, WideReal(i) / WideReal(samples));
      if (feeler::test::intersect(here, triangle())) return false;
      if (!(feeler::test::closest_features(here, triangle()).distance > tool.radius + clearance)) return false;
    }
    return true;
  }
};

struct Tally {
  int blocked = 0, free = 0;
  WideReal deepest = 0;
  double certified = 0;
  long work = 0, work_for_late = 0;
};

template <class Tool>
void check_passage(const Scene<Tool>& scene, bool is_exact, bool knows_normal, Tally& tally) {
  const Clearance<double> clearance;
  const auto moving = scene.random.moving();
  const auto start = moving.frame_at(0), end = moving.frame_at(1);
  PassedTriangle<double> triangle{scene.corners, Vector::Zero(), {}, is_exact};
  if (knows_normal) {
    const auto closest = feeler::separation(scene.random.tool, moving.in_tool(scene.corners, start), {}, clearance.touching);
    triangle.normal = start.rotation * closest.normal;
    triangle.features = closest.features;
  }
  int work = 0;
  const auto passage = feeler::pass(moving, triangle, start, end, clearance, work);
  BOOST_TEST((passage.time >= 0 && passage.time <= 1));
  BOOST_TEST((passage.is_blocked || passage.time == 1));
  BOOST_TEST(work <= 30);
  (passage.is_blocked ? tally.blocked : tally.free)++;
  tally.certified += passage.time;
  if (passage.time > 0) {
    const WideReal allowance = WideReal(clearance.allowance) * 1.01L;
    const WideReal depth = scene.depth(passage.time, 150, allowance);
    tally.deepest = std::max(tally.deepest, depth);
    if (depth > allowance) BOOST_ERROR("certified up to " << passage.time << ", yet " << depth << " m deep");
  }
  if (!passage.is_blocked) return;
  // That it does not block before a given time takes no more work to know than when it does.
  const double resolution = is_exact ? clearance.resolution : std::max(clearance.resolution, moving.length() / 16);
  for (const double enough : {passage.time / 2, passage.time, std::numeric_limits<double>::infinity()}) {
    int less = 0;
    const auto late = feeler::pass(moving, triangle, start, end, clearance, less, enough);
    BOOST_TEST(late.is_blocked);
    BOOST_TEST(less <= work);
    BOOST_TEST(late.time <= passage.time);
    BOOST_TEST(late.time * moving.length() >= std::min(enough, passage.time) * moving.length() - resolution / 4 * (1 + 1e-9));
    tally.work += work;
    tally.work_for_late += less;
  }
}

/// Motions that end or start near contact, which long and free ones seldom do.
enum class Kind { any, tick, rolling, spin, along_the_face };

template <class Tool>
Scene<Tool> random_scene(std::mt19937& bits, const Tool& tool, Kind kind) {
  const double gap = below(bits, 6) == 0 ? 0.0 : magnitude(bits, -9, kind == Kind::any ? -0.5 : -4);
  Scene<Tool> scene(bits, tool, random_shape(bits), gap);
  auto& motion = scene.random.motion;
  const auto closest = feeler::test::closest_features(scene.relative().tool_at(WideTool(tool), 0), scene.triangle());
  const Vector point = closest.on_first.template cast<double>();
  const WideVector between = closest.on_first - closest.on_second;
  const Vector normal = closest.distance > 0 ? Vector((between / closest.distance).template cast<double>()) : random_direction(bits);
  switch (kind) {
    case Kind::any: break;
    case Kind::tick:
      motion.linear = magnitude(bits, -6, -3) * random_direction(bits);
      motion.angular = magnitude(bits, -5, -2) * random_direction(bits);
      break;
    case Kind::rolling: {  // about the contact point, as edges roll over each other
      motion.angular = magnitude(bits, -4, 0) * random_direction(bits);
      motion.linear = (-motion.angular).cross(point) + magnitude(bits, -9, -6) * random_direction(bits);
      break;
    }
    case Kind::spin:
      motion.linear.setZero();
      motion.angular = 3.14159 * fraction(bits) * random_direction(bits);
      break;
    case Kind::along_the_face: {
      const Vector along = random_direction(bits).cross(normal);
      motion.linear = magnitude(bits, -5, -1) * along;
      motion.angular = below(bits, 2) == 0 ? Vector(Vector::Zero()) : Vector(magnitude(bits, -4, 0.4) * normal);
      break;
    }
  }
  return scene;
}

template <class MakeTool>
void check_kind(unsigned seed, int full_count, Kind kind, const MakeTool& make_tool) {
  const int count = trials_to_run(full_count);
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const auto scene = random_scene(bits, make_tool(bits), kind);
    const bool is_exact = below(bits, 2) == 0, knows_normal = below(bits, 2) == 0;
    BOOST_TEST_CONTEXT("scene " << i << " kind " << int(kind)) { check_passage(scene, is_exact, knows_normal, tally); }
  }
  BOOST_TEST_MESSAGE("kind " << int(kind) << ": " << tally.free << " free, " << tally.blocked << " blocked, " << tally.certified / count
                             << " certified on average, deepest " << tally.deepest << "; " << tally.work_for_late
                             << " queries to know that it is late, " << tally.work << " to know the time");
  BOOST_TEST(tally.free > count / 50);
  // Along the face nothing is in the way of a tool that meets it; a sharp one at no distance rounding may stop.
  if (!feeler::SweptTool<decltype(make_tool(bits))> || kind != Kind::along_the_face) BOOST_TEST(tally.blocked > count / 50);
}

const auto make_hull = [](std::mt19937& bits) { return random_hull(bits, 4 + below(bits, 12)); };
constexpr std::array<Kind, 5> kinds{Kind::any, Kind::tick, Kind::rolling, Kind::spin, Kind::along_the_face};

}  // namespace

BOOST_AUTO_TEST_CASE(no_sample_of_a_box_on_a_certified_way_is_deeper_than_the_allowance) {
  for (const Kind kind : kinds) check_kind(10 + unsigned(kind), 700, kind, random_box);
}
BOOST_AUTO_TEST_CASE(no_sample_of_a_segment_on_a_certified_way_is_deeper_than_the_allowance) {
  for (const Kind kind : kinds) check_kind(20 + unsigned(kind), 700, kind, random_segment);
}
BOOST_AUTO_TEST_CASE(no_sample_of_a_hull_on_a_certified_way_is_deeper_than_the_allowance) {
  for (const Kind kind : kinds) check_kind(30 + unsigned(kind), 150, kind, make_hull);
}

BOOST_AUTO_TEST_CASE(no_sample_of_a_round_tool_on_a_certified_way_is_deeper_than_the_allowance) {
  for (const Kind kind : kinds) {
    check_kind(50 + unsigned(kind), 700, kind, random_sphere);
    check_kind(60 + unsigned(kind), 700, kind, random_capsule);
    check_kind(70 + unsigned(kind), 200, kind, random_rounded_box);
  }
}

BOOST_AUTO_TEST_CASE(a_sphere_that_spins_about_its_centre_and_a_capsule_that_spins_about_its_axis_pass_at_no_cost) {
  const Clearance<double> clearance;
  Eigen::Matrix3d corners;
  corners << -9, 9, 0.1, -9, -9, 9, 0, 0, 0;
  const auto check = [&](const auto& tool, double height, const Vector& spin) {
    const feeler::Pose<double> pose{Vector(0, 0, height), feeler::Quaternion<double>::Identity()};
    const feeler::MovingTool<std::remove_cvref_t<decltype(tool)>> moving(tool, Vector::Zero(), feeler::radius_about(tool, Vector::Zero()), pose,
                                                                         {Vector(0.01, 0, 0), spin});
    int work = 0;
    const PassedTriangle<double> triangle{corners.colwise() - pose.translation, Vector::UnitZ(), {}, true};
    BOOST_TEST(!pass(moving, triangle, moving.frame_at(0), moving.frame_at(1), clearance, work).is_blocked);
    BOOST_TEST(work == 0);
  };
  for (const double gap : {0.0, 1e-9, 1e-6}) {
    check(feeler::Sphere<double>(0.01), 0.01 + gap, Vector(1, -2, 0.5));
    check(feeler::Capsule<double>({{-0.02, 0, 0}, {0.03, 0, 0}}, 0.01), 0.01 + gap, Vector(3, 0, 0));
    check(feeler::Segment<double>({-0.02, 0, 0}, {0.03, 0, 0}), gap, Vector(3, 0, 0));
  }
}

BOOST_AUTO_TEST_CASE(a_plane_guessed_for_the_end_saves_queries_and_a_wrong_one_certifies_nothing) {
  constexpr unsigned seed = 90;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const Clearance<double> clearance;
  int queries = 0, queries_with_guess = 0, too_deep = 0;
  for (int i = 0; i < 600; ++i) {
    const auto scene = random_scene(bits, random_box(bits), Kind::rolling);
    const auto moving = scene.random.moving();
    const auto start = moving.frame_at(0), end = moving.frame_at(1);
    const auto closest_at = [&](const auto& frame) {
      return feeler::separation(scene.random.tool, moving.in_tool(scene.corners, frame), {}, clearance.touching);
    };
    const auto closest = closest_at(start);
    PassedTriangle<double> triangle{scene.corners, start.rotation * closest.normal, closest.features, true};
    int work = 0, work_with_guess = 0;
    const bool is_free = !pass(moving, triangle, start, end, clearance, work).is_blocked;
    triangle.last_normal = end.rotation * closest_at(end).normal;
    const bool is_passed = !pass(moving, triangle, start, end, clearance, work_with_guess).is_blocked;
    if (is_free) queries += work, queries_with_guess += work_with_guess;
    const WideReal allowance = WideReal(clearance.allowance) * 1.01L;
    too_deep += is_passed && scene.depth(1, 150, allowance) > allowance ? 1 : 0;
    triangle.last_normal = random_direction(bits);
    const auto passage = pass(moving, triangle, start, end, clearance, work);
    too_deep += passage.time > 0 && scene.depth(passage.time, 150, allowance) > allowance ? 1 : 0;
  }
  BOOST_TEST_MESSAGE(queries << " queries, " << queries_with_guess << " with a guess");
  BOOST_TEST(too_deep == 0);
  BOOST_TEST(queries_with_guess < queries);
}

BOOST_AUTO_TEST_CASE(a_motion_with_clearance_is_free) {
  constexpr unsigned seed = 40;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (const Kind kind : {Kind::tick, Kind::spin, Kind::any}) {
    int free = 0, clear = 0;
    while (clear < 200) {
      const auto scene = random_scene(bits, random_box(bits), kind);
      if (!scene.keeps(1e-5L, 40)) continue;
      ++clear;
      const auto moving = scene.random.moving();
      int work = 0;
      const PassedTriangle<double> triangle{scene.corners, Vector::Zero(), {}, true};
      free += pass(moving, triangle, moving.frame_at(0), moving.frame_at(1), Clearance<double>{}, work).is_blocked ? 0 : 1;
    }
    BOOST_TEST_MESSAGE("kind " << int(kind) << ": " << free << " of " << clear << " free");
    // A spin of up to π sweeps so much that steps run out sooner.
    BOOST_TEST(free * 100 >= clear * (kind == Kind::spin ? 95 : 99));
  }
}

BOOST_AUTO_TEST_CASE(a_blocked_motion_is_certified_up_to_just_before_the_contact) {
  // A box falls on a floor 3 mm below, without turning: contact is at a known time.
  const feeler::Box<double> box(Vector(0.03, 0.02, 0.01));
  const Clearance<double> clearance;
  for (const double fall : {4e-3, 1e-2, 0.3}) {
    const feeler::MovingTool<feeler::Box<double>> moving(box, Vector::Zero(), 0.04, {}, {Vector(0, 0, -fall), Vector::Zero()});
    Eigen::Matrix3d corners;
    corners << -9, 9, 0.1, -9, -9, 9, -0.013, -0.013, -0.013;
    int work = 0;
    const auto passage = pass(moving, {corners, Vector::Zero(), {}, true}, moving.frame_at(0), moving.frame_at(1), clearance, work);
    BOOST_TEST(passage.is_blocked);
    BOOST_TEST(passage.time * fall <= 3e-3 - clearance.kept / 2);
    BOOST_TEST(passage.time * fall >= 3e-3 - 2 * clearance.kept - clearance.resolution);
    BOOST_TEST((passage.normal - Vector::UnitZ()).norm() < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(an_overlap_may_stay_but_not_grow) {
  const feeler::Box<double> box(Vector(0.03, 0.02, 0.01));
  const Clearance<double> clearance;
  Eigen::Matrix3d corners;
  corners << -9, 9, 0.1, -9, -9, 9, -0.01 + 4e-12, -0.01 + 4e-12, -0.01 + 4e-12;
  for (const double fall : {-1e-3, 0.0, 1e-6}) {
    const feeler::MovingTool<feeler::Box<double>> moving(box, Vector::Zero(), 0.04, {}, {Vector(0.1, 0, -fall), Vector::Zero()});
    int work = 0;
    const auto passage = pass(moving, {corners, Vector::UnitZ(), {}, true}, moving.frame_at(0), moving.frame_at(1), clearance, work);
    BOOST_TEST(passage.is_blocked == (fall > 0));
    BOOST_TEST(passage.time * fall <= 2 * clearance.allowance);
  }
}

namespace {
template <class MakeTool>
void check_turning_planes(unsigned seed, int count, const MakeTool& make_tool) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int held = 0, meeting = 0;
  for (int i = 0; i < count; ++i) {
    const auto scene = random_scene(bits, make_tool(bits), kinds[std::size_t(below(bits, 5))]);
    const auto moving = scene.random.moving();
    const auto start = moving.frame_at(0), end = moving.frame_at(1);
    const auto first = feeler::separation(scene.random.tool, moving.in_tool(scene.corners, start), {}, 1e-8);
    const auto last = feeler::separation(scene.random.tool, moving.in_tool(scene.corners, end), {}, 1e-8);
    const bool holds = feeler::detail::turning_plane_holds<decltype(make_tool(bits))>(
        moving, scene.corners, {start.rotation * first.normal, first.distance}, start, {end.rotation * last.normal, last.distance}, end, 0.0);
    const WideReal depth = scene.depth(1, 60, 1e-15L);
    held += holds ? 1 : 0;
    meeting += depth > 1e-15L ? 1 : 0;
    BOOST_TEST((!holds || depth <= 1e-15L));
  }
  BOOST_TEST_MESSAGE(held << " held, " << meeting << " met");
  BOOST_TEST(held > count / 6);
  BOOST_TEST(meeting > count / 12);
}
}  // namespace

BOOST_AUTO_TEST_CASE(a_plane_that_turns_holds_only_where_the_samples_are_apart) {
  check_turning_planes(41, 6000, random_box);
  check_turning_planes(42, 6000, random_sphere);
  check_turning_planes(43, 4000, random_capsule);
}

BOOST_AUTO_TEST_CASE(a_plane_that_turns_follows_a_sphere_that_rolls_over_an_edge_where_no_fixed_plane_does) {
  // About a corner: the centre goes from one side to the other on a chord, which dips by r (1 − cos α) = 0.32 um, and a little more room.
  const double radius = 0.01, half_angle = 8e-3;
  const feeler::Sphere<double> ball(radius);
  Eigen::Matrix3d corners;
  corners << 0, -0.01, 0.01, 0, 0, 0, 0, -0.2, -0.2;
  const auto check = [&](double room) {
    const double distance = radius * (1 + (1 - std::cos(half_angle))) + room;
    const Vector first_normal(-std::sin(half_angle), 0, std::cos(half_angle)), last_normal(std::sin(half_angle), 0, std::cos(half_angle));
    const Vector from = distance * first_normal, to = distance * last_normal;
    const feeler::MovingTool<feeler::Sphere<double>> moving(ball, Vector::Zero(), 0, {from, feeler::Quaternion<double>::Identity()},
                                                            {to - from, Vector::Zero()});
    const auto start = moving.frame_at(0), end = moving.frame_at(1);
    const Eigen::Matrix3d seen = corners.colwise() - from;
    return feeler::detail::turning_plane_holds(moving, seen, {first_normal, distance - radius}, start, {last_normal, distance - radius}, end, 0.0);
  };
  BOOST_TEST(check(1e-8));
  BOOST_TEST(!check(-1e-8));
}

BOOST_AUTO_TEST_CASE(a_plane_that_turns_follows_edges_that_roll_where_no_fixed_plane_does) {
  // Two edges that cross at right angles, 1 µm apart; the tool's rolls over the other by 8 mrad.
  const feeler::Segment<double> line(Vector(-0.1, 0, 0), Vector(0.1, 0, 0));
  Eigen::Matrix3d corners;
  corners << 0, 0, 0, -0.1, 0.1, 0, -1e-6, -1e-6, -0.2;
  const feeler::MovingTool<feeler::Segment<double>> moving(line, Vector::Zero(), 0.1, {}, {Vector::Zero(), Vector(0, 8e-3, 0)});
  const auto start = moving.frame_at(0), end = moving.frame_at(1);
  const feeler::detail::HeldPlane<double> first{Vector::UnitZ(), 1e-6}, last{Vector(std::sin(8e-3), 0, std::cos(8e-3)), 1e-6 * std::cos(8e-3)};
  BOOST_TEST(feeler::detail::held_fraction(moving, corners, first, start, end, 1e-7, true).fraction < 1);
  BOOST_TEST(feeler::detail::held_fraction(moving, corners, last, end, start, 1e-7, false).fraction < 1);
  BOOST_TEST(feeler::detail::turning_plane_holds(moving, corners, first, start, last, end, 1e-7));
  int work = 0;
  BOOST_TEST(!pass(moving, {corners, Vector::Zero(), {}, true}, start, end, Clearance<double>{}, work).is_blocked);
  BOOST_TEST(work == 2);
}

BOOST_AUTO_TEST_CASE(a_line_that_rolls_over_an_edge_is_followed_to_where_it_lies_flat) {
  // The line crosses the edge askew and slopes over the triangle by 8 mrad; it turns by 10 mrad until its end comes down on the face. The
  // common normal turns along the edge as well, so a plane fixed to the line is soon in the ends of the edge.
  const double half_length = 0.015, slope = 8e-3, turn = 1e-2, gap = 1e-6;
  const Vector along(std::sqrt(0.5), std::sqrt(0.5), 0), across(-std::sqrt(0.5), std::sqrt(0.5), 0);
  const feeler::Segment<double> line(-half_length * (along + slope * Vector::UnitZ()), half_length * (along + slope * Vector::UnitZ()));
  Eigen::Matrix3d corners;
  corners << 0, 0, 0.03, -0.03, 0.03, 0, -gap, -gap, -gap;
  const feeler::MovingTool<feeler::Segment<double>> moving(line, Vector::Zero(), half_length, {}, {Vector::Zero(), turn * across});
  const Clearance<double> clearance;
  int work = 0;
  const auto passage = pass(moving, {corners, Vector::Zero(), {}, true}, moving.frame_at(0), moving.frame_at(1), clearance, work);
  const double meets = (slope + (gap - clearance.kept) / half_length) / turn;
  BOOST_TEST(passage.is_blocked);
  BOOST_TEST(passage.time <= meets);
  BOOST_TEST(passage.time >= meets - 2 * clearance.resolution / moving.length());
  BOOST_TEST(work <= 20);
}

BOOST_AUTO_TEST_CASE(what_a_known_plane_parts_by_far_at_the_start_is_kept_off_in_whole_at_the_end) {
  // A point comes over a triangle from beside it, sinking from 1.1 to 0.6 of what is kept above its plane.
  const feeler::Point<double> tool;
  const Clearance<double> clearance;
  const double kept = clearance.kept;
  const feeler::Pose<double> pose{Vector(1e-3, 0, 1.1 * kept), feeler::Quaternion<double>::Identity()};
  const feeler::MovingTool<feeler::Point<double>> moving(tool, Vector::Zero(), 0, pose, {Vector(-2e-3, 0, -0.5 * kept), Vector::Zero()});
  Eigen::Matrix3d corners;
  corners << 0, 0, -0.1, -0.1, 0.1, 0, 0, 0, 0;
  corners.colwise() -= pose.translation;
  int work = 0;
  const auto passage = pass(moving, {corners, Vector::UnitX(), {}, true}, moving.frame_at(0), moving.frame_at(1), clearance, work);
  BOOST_TEST(passage.is_blocked);
  BOOST_TEST(passage.time < 0.5 - 0.5 * kept / 2e-3);  // there it is beside the edge, 0.85 of what is kept above it
}

BOOST_AUTO_TEST_CASE(required_separation_never_exceeds_what_there_is_and_falls_no_further_than_twice_the_allowance) {
  for (const double rounding : {0.0, 1e-8, 1e-7}) {
    Clearance<double> clearance;
    clearance.rounding = rounding;
    double last = -std::numeric_limits<double>::infinity();
    for (double start = -1e-9; start < 1e-6; start += 1.1e-11) {
      const double required = clearance.required(start);
      BOOST_TEST((required <= clearance.kept && required >= -2 * clearance.allowance));
      if (start > -clearance.allowance) BOOST_TEST(required <= start);
      if (rounding > 0 && start > rounding) BOOST_TEST(required >= std::min(rounding, clearance.kept));
      BOOST_TEST(required >= last);
      last = required;
    }
    BOOST_TEST(clearance.required(1) == clearance.kept);
    BOOST_TEST(clearance.required(2 * clearance.allowance) == -clearance.allowance);  // what rounding leaves in a perfect fit is not halved
  }
}

BOOST_AUTO_TEST_CASE(a_motion_may_halve_what_is_less_than_twice_what_is_kept_and_a_step_leaves_that_half_or_what_is_kept) {
  const Clearance<double> clearance;
  const double kept = clearance.kept;
  for (const double share : {0.1, 0.9, 1.1, 1.9}) BOOST_TEST(clearance.required(share * kept) == share * kept / 2);
  for (const double share : {2.0, 2.1, 50.0}) BOOST_TEST(clearance.required(share * kept) == kept);
  for (const double share : {0.1, 0.9}) BOOST_TEST(clearance.to_leave(share * kept) == share * kept);
  for (const double share : {1.1, 1.9}) BOOST_TEST(clearance.to_leave(share * kept) == kept);
  for (const double share : {2.1, 50.0}) BOOST_TEST(clearance.to_leave(share * kept) == share * kept / 2);
  BOOST_TEST(clearance.to_leave(clearance.negligible()) == 0);
}

BOOST_AUTO_TEST_CASE(what_rounding_of_poses_takes_is_not_halved_by_a_motion_that_begins_a_bit_below_it) {
  for (const double rounding : {1e-8, 1e-7, 6e-6}) {
    Clearance<double> clearance;
    clearance.rounding = clearance.kept = rounding;
    for (const double bit : {-1e-16, 0.0, 1e-16}) {
      double gap = rounding * (1 + bit / 1e-16 * std::numeric_limits<double>::epsilon());
      for (int motion = 0; motion < 1000; ++motion) {
        const double required = clearance.required(gap);
        BOOST_TEST_REQUIRE(required <= gap);
        gap = required - bit;
      }
      BOOST_TEST(gap >= rounding - 1000 * clearance.allowance / 16);
    }
    BOOST_TEST(clearance.required(rounding / 4) == rounding / 8);  // a fit tighter than that is a fit all the same
  }
}

BOOST_AUTO_TEST_CASE(a_plane_that_holds_is_said_to_turn_with_the_tool_or_to_stand) {
  // A box 2 µm above a floor turns about its lower edge by 1 mrad: its face parts the two, and as it is at the end no plane that stands does.
  const feeler::Box<double> box({0.01, 0.01, 0.01});
  const Vector reference(-0.01, 0, -0.01);
  const Clearance<double> clearance;
  const feeler::MovingTool<feeler::Box<double>> turning(box, reference, feeler::radius_about(box, reference),
                                                        {Vector(0, 0, 2e-6), feeler::Quaternion<double>::Identity()},
                                                        {Vector::Zero(), Vector(0, -1e-3, 0)});
  Eigen::Matrix3d floor;
  floor << 0.001, 0.004, 0.002, 0, 0, 0.002, -2e-6, -2e-6, -2e-6;
  const auto start = turning.frame_at(0), end = turning.frame_at(1);
  const Vector face = end.rotation * Vector::UnitZ();
  const double slack = turning.lowest(face, end) - (face.transpose() * floor).maxCoeff();
  const auto with_tool = feeler::detail::held_fraction(turning, floor, {face, slack}, end, start, 1e-7, false);
  BOOST_TEST(with_tool.fraction == 1);
  BOOST_TEST(with_tool.turns);
  // A capsule spins about its axis over the floor: the plane below it stands, and one that spins with it would be in the floor.
  const feeler::Capsule<double> capsule({{-0.02, 0, 0}, {0.03, 0, 0}}, 0.01);
  const feeler::MovingTool<feeler::Capsule<double>> spinning(capsule, Vector::Zero(), feeler::radius_about(capsule, Vector(Vector::Zero())), {},
                                                             {Vector::Zero(), Vector(1, 0, 0)});
  Eigen::Matrix3d wide;
  wide << -9, 9, 0.1, -9, -9, 9, -0.01 - 1e-6, -0.01 - 1e-6, -0.01 - 1e-6;
  const auto standing =
      feeler::detail::held_fraction(spinning, wide, {Vector::UnitZ(), 1e-6}, spinning.frame_at(0), spinning.frame_at(1), 1e-7, true);
  BOOST_TEST(standing.fraction == 1);
  BOOST_TEST(!standing.turns);
}

BOOST_AUTO_TEST_CASE(lengths_of_a_clearance_are_apart_by_far_and_as_large_as_the_scene) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    const Clearance<double> clearance(1e-6 * size, 4e-4 * size);
    BOOST_TEST(clearance.kept == 1e-7 * size, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(clearance.negligible() >= 2 * clearance.allowance);
    BOOST_TEST(clearance.none() > 5 * clearance.negligible());
    BOOST_TEST(clearance.none() < clearance.kept / 100);
    BOOST_TEST(clearance.touching < clearance.kept);
    BOOST_TEST(clearance.probe == 1e-4 * size, boost::test_tools::tolerance(1e-12));  // a quarter of the way
    BOOST_TEST(clearance.resolution == 2.5e-7 * size, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_SUITE_END()
