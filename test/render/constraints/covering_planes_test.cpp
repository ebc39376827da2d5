#include "feeler/render/constraints/covering_planes.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(covering_planes)

namespace {
using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

/// A triangle with corners at the heights given, about a metre apart.
Matrix triangle(double a, double b, double c) {
  Matrix corners;
  corners << 0, 1, 0, 0, 0, 1, a, b, c;
  return corners;
}
}  // namespace

BOOST_AUTO_TEST_CASE(what_falls_away_from_a_plane_is_covered_and_as_far_from_the_tool_as_it_is_below) {
  feeler::CoveringPlanes<double> covers;
  BOOST_TEST(!covers.above(triangle(-1, -1, -1), 1e-9, 1e-6).has_value());
  covers.add(Vector::UnitZ(), triangle(0, 0, 0), 1e-6);
  const auto shared_corner = covers.above(triangle(0, -0.1, -0.2), 1e-9, 1e-6);
  BOOST_TEST_REQUIRE(shared_corner.has_value());
  BOOST_TEST(shared_corner->distance == 1e-6);
  BOOST_TEST(shared_corner->normal == Vector::UnitZ());
  const auto lower = covers.above(triangle(-0.5, -0.25, -1), 1e-9, 1e-6);
  BOOST_TEST_REQUIRE(lower.has_value());
  BOOST_TEST(lower->distance == 0.25 + 1e-6);
}

BOOST_AUTO_TEST_CASE(what_rises_above_every_plane_or_lies_in_one_is_not_covered) {
  feeler::CoveringPlanes<double> covers;
  covers.add(Vector::UnitZ(), triangle(0, 0, 0), 1e-6);
  BOOST_TEST(!covers.above(triangle(2e-9, -1, -1), 1e-9, 1e-6).has_value());
  BOOST_TEST(!covers.above(triangle(0, 0, -1e-7), 1e-9, 1e-6).has_value());
  covers.add(Vector::UnitZ(), triangle(1e-8, 0, 0), 1e-6);  // another one, higher
  BOOST_TEST(covers.above(triangle(2e-9, -1, -1), 1e-9, 1e-6).has_value());
  covers.clear();
  BOOST_TEST(!covers.above(triangle(-1, -1, -2), 1e-9, 1e-6).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
