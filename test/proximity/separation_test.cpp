#include "feeler/proximity/separation.hpp"

#include <boost/test/unit_test.hpp>

#include <random>
#include <type_traits>

#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(separation)

using feeler::test::WideReal;
using feeler::test::WideTool;
using feeler::test::WideVector;
using namespace feeler_test;

namespace {

/// The checker's depth of the tool in one triangle, both in the tool frame.
template <class Tool>
WideReal depth_of(const Tool& tool, const Eigen::Matrix3d& corners) {
  return feeler::test::detail::depth_in_triangle(feeler::test::checked_tool(tool), wide(corners), 0);
}

template <class MakeTool>
void check_depth(unsigned seed, int count, const MakeTool& make_tool) {
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int overlapping = 0;
  WideReal worst = 0;
  for (int i = 0; i < count; ++i) {
    const auto tool = make_tool(bits);
    const Shape shape = i % 4 == 0 ? Shape::sliver : i % 4 == 1 ? Shape::large : Shape::ordinary;
    const Eigen::Matrix3d corners = random_triangle(bits, shape).colwise() + 0.05 * random_vector(bits);
    const WideReal depth = depth_of(tool, corners);
    if (!(depth > 1e-6L)) continue;
    ++overlapping;
    const auto found = feeler::separation(tool, corners, {}, 1e-8);
    const WideReal shown = WideTool(tool).separation_along(found.normal.template cast<WideReal>(), wide(corners));
    BOOST_TEST(std::abs(shown - WideReal(found.distance)) < 1e-15L);
    worst = std::max(worst, std::abs(depth + WideReal(found.distance)));
    if constexpr (!feeler::SweptTool<std::remove_cvref_t<decltype(tool)>>)
      BOOST_TEST((found.tool_point - found.triangle_point - found.distance * found.normal).norm() < 1e-15);
    // Moved by its depth along the normal the tool is free.
    const Eigen::Matrix3d moved = corners.colwise() + found.normal * found.distance;
    BOOST_TEST(depth_of(tool, moved) < 1e-14L);
  }
  BOOST_TEST_MESSAGE(overlapping << " overlapped, worst error " << worst);
  BOOST_TEST(overlapping > count / 20);
  BOOST_TEST(worst < 1e-13L);
}

}  // namespace

BOOST_AUTO_TEST_CASE(depth_of_a_box_is_that_of_the_separating_axis_theorem_in_long_double) { check_depth(1, 2000, random_box); }
BOOST_AUTO_TEST_CASE(depth_of_a_hull_is_that_of_the_separating_axis_theorem_in_long_double) {
  check_depth(2, 400, [](std::mt19937& bits) { return random_hull(bits, 4 + below(bits, 20)); });
}

BOOST_AUTO_TEST_CASE(depth_of_a_round_tool_is_that_of_all_pairs_of_features_of_its_core_in_long_double) {
  check_depth(3, 1000, [](std::mt19937& bits) { return feeler::Sphere<double>(0.1 * random_vector(bits), magnitude(bits, -1.6, -0.9)); });
  check_depth(4, 1000, random_capsule);
  check_depth(5, 500, random_rounded_box);
  check_depth(6, 200, [](std::mt19937& bits) { return swept(bits, random_hull(bits, 4 + below(bits, 20))); });
}

BOOST_AUTO_TEST_CASE(a_box_sunk_in_a_floor_is_as_deep_as_it_sank) {
  const feeler::Box<double> box(Vector(0.03, 0.02, 0.01));
  for (const double depth : {0.0, 1e-9, 1e-6, 1e-3}) {
    Eigen::Matrix3d corners;
    corners << -9, 9, 0.1, -9, -9, 9, -0.01 + depth, -0.01 + depth, -0.01 + depth;
    const auto found = feeler::separation(box, corners, {}, 1e-8);
    BOOST_TEST((found.normal - Vector::UnitZ()).norm() == 0);
    BOOST_TEST(std::abs(found.distance + depth) < 1e-17);
  }
}

BOOST_AUTO_TEST_CASE(a_cube_sunk_with_its_corner_in_a_slope_is_as_deep_as_its_corner) {
  const double h = 0.01;
  const feeler::Box<double> cube(Vector(h, h, h));
  const Vector normal = Vector(1, 1, 1).normalized(), u = normal.unitOrthogonal(), v = normal.cross(u);
  for (const double depth : {0.0, 1e-9, 1e-5, 1e-3}) {
    const Vector foot = normal * (-std::sqrt(3.0) * h + depth);
    Eigen::Matrix3d corners;
    corners << foot + u, foot - u + 2 * v, foot - u - 2 * v;
    const auto found = feeler::separation(cube, corners, {}, 1e-8);
    BOOST_TEST((found.normal - normal).norm() < 1e-14);
    BOOST_TEST(std::abs(found.distance + depth) < 1e-15);
    BOOST_TEST((found.tool_point + Vector(h, h, h)).norm() == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_spike_in_a_face_is_as_deep_as_its_tip) {
  const feeler::Box<double> box(Vector(0.1, 0.1, 0.1));
  for (const double depth : {1e-9, 1e-6, 1e-3}) {
    Eigen::Matrix3d corners;
    corners << 0.01, 0.02, 0.02, 0.01, 0.011, 0.012, 0.1 - depth, 0.3, 0.31;
    const auto found = feeler::separation(box, corners, {}, 1e-8);
    BOOST_TEST((found.normal + Vector::UnitZ()).norm() == 0);
    BOOST_TEST(std::abs(found.distance + depth) < 1e-16);
  }
}

BOOST_AUTO_TEST_CASE(edges_that_cross_at_contact_are_parted_by_their_common_normal) {
  const feeler::Box<double> box(Vector(0.1, 0.1, 0.1));
  // The box's edge along x at (y, z) = (−0.1, −0.1); a triangle edge across it, tilted, with the rest below.
  const Vector normal = Vector(0, 1, 1).normalized(), along = Vector(0.3, 1, -1).normalized();
  for (const double gap : {-1e-4, -1e-7, 0.0, 1e-9}) {
    const Vector point = Vector(0.01, -0.1, -0.1) - gap * normal;
    Eigen::Matrix3d corners;
    corners << point - 0.05 * along, point + 0.05 * along, point - 0.2 * normal;
    const auto found = feeler::separation(box, corners, {}, 1e-8);
    const Vector expected = Vector::UnitX().cross(along).normalized();
    BOOST_TEST(found.normal.cross(expected).norm() < 1e-14);
    BOOST_TEST(found.normal.dot(normal) > 0);
    BOOST_TEST(std::abs(found.distance - gap * std::abs(normal.dot(expected))) < 1e-16);
  }
}

BOOST_AUTO_TEST_CASE(no_axis_at_all_is_answered_with_a_direction_that_proves_what_it_says) {
  const feeler::Segment<double> line(Vector(-1, 0, 0), Vector(1, 0, 0));
  Eigen::Matrix3d corners;  // a degenerate triangle along the line
  corners << -0.5, 0.5, 0.2, 0, 0, 0, 0, 0, 0;
  const auto found = feeler::separation(line, corners, {}, 1e-8);
  BOOST_TEST(std::abs(found.normal.norm() - 1) < 1e-15);
  BOOST_TEST(found.distance <= 0);
}

BOOST_AUTO_TEST_CASE(apart_touching_or_overlapping_the_distance_is_proved_by_its_normal) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 5000; ++i) {
    const auto box = random_box(bits);
    const double gap = i % 3 == 0 ? 0.0 : magnitude(bits, -10, -7) * (i % 3 == 1 ? 1 : -1);
    const Shape shape = random_shape(bits);
    const Eigen::Matrix3d corners = triangle_near(box, bits, shape, gap);
    BOOST_TEST_CONTEXT("pair " << i << " gap " << gap << " shape " << int(shape)) {
      const auto found = feeler::separation(box, corners, {}, 1e-8);
      const WideReal size = 0.2L + WideReal(corners.cwiseAbs().maxCoeff());
      const WideVector normal = found.normal.cast<WideReal>();
      BOOST_TEST(std::abs(normal.norm() - 1) < 1e-15L);
      BOOST_TEST(std::abs(WideTool(box).separation_along(normal, wide(corners)) - WideReal(found.distance)) <= 1e-15L * size);
      // Moved into each other along one way, they may be parted along a shorter one.
      if (gap >= 0) BOOST_TEST(found.distance <= gap + 1e-15 * double(size));
      if (gap < 0) BOOST_TEST(WideReal(found.distance) <= 1e-15L * size - depth_of(box, corners));
    }
  }
}

BOOST_AUTO_TEST_CASE(an_overlap_that_is_accepted_keeps_the_normal_of_the_face) {
  // A box that leans by 20 mrad stands on an edge 1 µm deep in a floor that ends 0.1 µm inside of it: beside it they overlap by less.
  const feeler::Box<double> box(Vector(0.03, 0.02, 0.01));
  const Eigen::Matrix3d lean = Eigen::AngleAxisd(0.02, Vector::UnitX()).toRotationMatrix();
  const Vector edge = lean * Vector(0, -0.02, -0.01);
  Eigen::Matrix3d floor;
  floor << -0.02, 0.02, 0, edge.y() + 1e-7, edge.y() + 1e-7, -0.03, 0, 0, 0;
  floor.row(2).setConstant(edge.z() + 1e-6);
  const Eigen::Matrix3d corners = lean.transpose() * floor;
  feeler::ClosestPoints<double> closest;
  closest.is_touching = true;
  const auto accepted = feeler::separation_of_touching(box, corners, closest, 1e-5), best = feeler::separation_of_touching(box, corners, closest);
  BOOST_TEST((accepted.normal - lean.transpose() * Vector::UnitZ()).norm() < 1e-12);
  BOOST_TEST(std::abs(accepted.distance + 1e-6) < 1e-15);
  BOOST_TEST(best.distance > -2e-7);
  BOOST_TEST(best.distance < 0);
}

BOOST_AUTO_TEST_SUITE_END()
