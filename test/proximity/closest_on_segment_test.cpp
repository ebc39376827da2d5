#include "feeler/proximity/closest_on_segment.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "feeler/object/triangle_normal.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(closest_on_segment)

using namespace feeler_test;
using feeler::test::WideReal;
using feeler::test::WideVector;

BOOST_AUTO_TEST_CASE(the_nearest_points_of_segments_and_triangles_are_those_of_long_double) {
  std::mt19937 bits(1);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Shape shape = random_shape(bits);
    const Eigen::Matrix3d triangle = random_triangle(bits, shape);
    const Vector point = magnitude(bits, -3, 0) * random_vector(bits);
    const auto corners = wide(triangle);
    const WideVector seen = point.cast<WideReal>();
    const Vector on_segment = feeler::closest_on_segment<double>(point, triangle.col(0), triangle.col(1));
    const WideVector expected_on_segment = feeler::test::closest_on_wide_segment(seen, corners[0], corners[1]);
    BOOST_TEST((on_segment.cast<WideReal>() - expected_on_segment).norm() < 1e-14L);
    if (shape == Shape::sliver || shape == Shape::needle) continue;  // whose normals are known to some digits
    const Vector normal = feeler::triangle_normal<double>(triangle.col(0), triangle.col(1), triangle.col(2));
    const WideVector on_triangle = feeler::closest_on_triangle<double>(point, triangle, normal).cast<WideReal>();
    const WideVector expected = feeler::test::closest_on_wide_triangle(seen, corners[0], corners[1], corners[2]);
    BOOST_TEST((on_triangle - expected).norm() < 1e-11L);
    inside += (expected - expected_on_segment).norm() > 1e-4L ? 1 : 0;
  }
  BOOST_TEST(inside > 1000);
}

BOOST_AUTO_TEST_CASE(a_point_seen_over_the_inside_of_a_triangle_is_nearest_to_its_foot_from_either_side) {
  Eigen::Matrix3d triangle;
  triangle << 0, 4, 0, 0, 0, 3, 0, 0, 0;
  for (const double height : {2.0, -2.0})
    for (const double turn : {1.0, -1.0})  // of its corners
      for (const Vector& foot : {Vector(1, 1, 0), Vector(0.5, 2, 0)}) {
        Eigen::Matrix3d corners = triangle;
        if (turn < 0) corners.col(1).swap(corners.col(2));
        const Vector point = foot + height * Vector::UnitZ();
        BOOST_TEST((feeler::closest_on_triangle<double>(point, corners, turn * Vector::UnitZ()) - foot).norm() < 1e-15);
      }
}

BOOST_AUTO_TEST_CASE(a_segment_that_is_a_point_is_nearest_there) {
  const Vector place(1, 2, 3);
  BOOST_TEST(feeler::closest_on_segment<double>(Vector(5, 0, 0), place, place) == place);
}

BOOST_AUTO_TEST_CASE(segments_cross_where_their_common_perpendicular_meets_both_between_their_ends) {
  std::mt19937 bits(2);
  int crossing = 0, beyond = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector first = magnitude(bits, -2, 1) * random_direction(bits), second = magnitude(bits, -2, 1) * random_direction(bits);
    const Vector across = first.cross(second).normalized();
    if (first.normalized().cross(second.normalized()).norm() < 0.01) continue;
    // What part of each lies before the crossing; beyond an end by a hundredth of its length at least.
    double s = 1.5 * unit(bits) + 0.5, t = 1.5 * unit(bits) + 0.5;
    if (std::abs(s) < 0.01 || std::abs(s - 1) < 0.01 || std::abs(t) < 0.01 || std::abs(t - 1) < 0.01) continue;
    const Vector place = random_vector(bits), other = place + unit(bits) * across;
    const auto found = feeler::crossing_of_segments<double>(place - s * first, place + (1 - s) * first, other - t * second, other + (1 - t) * second);
    const bool exists = s > 0 && s < 1 && t > 0 && t < 1;
    ++(exists ? crossing : beyond);
    BOOST_TEST(found.exists == exists);
    if (!exists) continue;
    BOOST_TEST((found.on_first - place).norm() < 1e-11);
    BOOST_TEST((found.on_second - other).norm() < 1e-11);
  }
  BOOST_TEST(crossing > 300);
  BOOST_TEST(beyond > 300);
}

BOOST_AUTO_TEST_CASE(segments_that_meet_in_an_end_cross_there_and_parallel_ones_nowhere) {
  const Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();
  for (const double from : {0.0, -1.0}) {  // the second begins or ends above the first's start, or above its end
    for (const double at : {0.0, 1.0}) {
      const auto found = feeler::crossing_of_segments<double>(Vector::Zero(), x, Vector(at * x + from * y + z), Vector(at * x + (from + 1) * y + z));
      BOOST_TEST_REQUIRE(found.exists);
      BOOST_TEST((found.on_first - at * x).norm() < 1e-15);
      BOOST_TEST((found.on_second - at * x - z).norm() < 1e-15);
    }
  }
  BOOST_TEST(!feeler::crossing_of_segments<double>(Vector::Zero(), x, z, Vector(x + z)).exists);
  BOOST_TEST(!feeler::crossing_of_segments<double>(Vector::Zero(), x, z, Vector(-3 * x + z)).exists);
  BOOST_TEST(!feeler::crossing_of_segments<double>(Vector::Zero(), Vector::Zero(), z, Vector(x + z)).exists);
}

BOOST_AUTO_TEST_SUITE_END()
