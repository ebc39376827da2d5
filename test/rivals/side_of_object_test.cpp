// The side of an object on which a point is, on ways whose crossings can be told by eye.
#include "rivals/side_of_object.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(side_of_object)

namespace {

using feeler::rivals::SideOfObject;
using Vector = Eigen::Vector3d;

/// The square [−1, 1]² at z = 0, open, as two triangles that share the diagonal x = y.
feeler::test::CheckedObject sheet() {
  Eigen::Matrix<double, Eigen::Dynamic, 3> vertices(4, 3);
  vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Eigen::Matrix<int, Eigen::Dynamic, 3> triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  return {vertices, triangles};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_way_through_and_back_changes_the_side_twice) {
  const auto object = sheet();
  SideOfObject side(object, Vector(0.3, 0.1, 1.0));
  BOOST_TEST(!side.is_other());
  side.move_to({0.2, -0.1, -1.0});
  BOOST_TEST(side.is_other());
  side.move_to({-0.5, 0.1, -2.0});
  BOOST_TEST(side.is_other());
  side.move_to({-0.5, 0.1, 0.5});
  BOOST_TEST(!side.is_other());
}

BOOST_AUTO_TEST_CASE(a_way_around_the_rim_is_none_through) {
  const auto object = sheet();
  SideOfObject side(object, Vector(0.5, 0.1, 0.5));
  for (const Vector& place : {Vector(1.5, 0.1, 0.5), Vector(1.5, 0.1, -0.5), Vector(0.5, 0.1, -0.5)}) side.move_to(place);
  BOOST_TEST(!side.is_other());
}

BOOST_AUTO_TEST_CASE(nothing_slips_between_triangles_that_share_an_edge) {
  const auto object = sheet();
  for (int i = -99; i < 100; ++i) {
    // Across the diagonal by steps of rounding, and a hair beside it.
    const double x = 0.01 * double(i), beside = 1e-17 * double(i % 3);
    SideOfObject side(object, Vector(x + beside, x, 0.7));
    side.move_to({x, x + beside, -0.3});
    BOOST_TEST(side.is_other(), "x = " << x);
  }
}

BOOST_AUTO_TEST_CASE(the_middle_of_pieces_is_the_mean_of_their_vertices) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> line(2, 3), other(2, 3);
  line << 0, 0, 0, 4, 0, 0;
  other << 0, 8, 0, 0, 0, 16;
  const std::vector<feeler::test::CheckedTool> pieces{{line, {{0, 1}}, {}}, {other, {{0, 1}}, {}}};
  BOOST_TEST((feeler::rivals::middle_of(pieces) == Vector(1.0, 2.0, 4.0)));
}

BOOST_AUTO_TEST_SUITE_END()
