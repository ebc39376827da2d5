// Which planes around a triangle bound one convex piece of the free space, against surfaces where that is plain.
#include "feeler/paper/triangle_ring.hpp"

#include <boost/test/unit_test.hpp>

#include <bit>
#include <set>

BOOST_AUTO_TEST_SUITE(triangle_ring)

using Ring = feeler::TriangleRing<double, double>;
using Mesh = feeler::TriangleMesh<double>;
using Vector = feeler::Vector3<double>;

namespace {

/// The corner of a block that stands on a floor: walls x = 0 and y = 0 over it.
Mesh block_on_floor() {
  feeler::Points<double> vertices(9, 3);
  vertices << 0, 0, 0, 0, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, 0, 0, 0, 0, 1, 0, -1, 1, -1, 0, 1;
  feeler::Triangles triangles(8, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 6, 1, 1, 6, 7, 0, 5, 6, 5, 8, 6;
  return {vertices, triangles};
}
/// Four slopes around a tip, or a pit.
Mesh pyramid(double height) {
  feeler::Points<double> vertices(5, 3);
  vertices << 0, 0, height, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
  return {vertices, triangles};
}
const auto any = [](const Ring::Plane&) { return true; };

}  // namespace

BOOST_AUTO_TEST_CASE(of_two_walls_that_meet_on_a_ridge_one_is_in_a_piece_with_the_floor) {
  const Mesh mesh = block_on_floor();
  Ring ring(mesh);
  BOOST_TEST(ring.find(0, false) == 0);
  BOOST_TEST(ring.triangles().size() == 7);  // but for one that shares none of its corners
  BOOST_TEST_REQUIRE(ring.planes().size() == 3);
  for (int seed = 0; seed < 3; ++seed) BOOST_TEST(std::popcount(ring.convex_piece(seed, any)) == 2);
  // From behind valleys are ridges: the walls are in a piece without the floor.
  BOOST_TEST(ring.find(0, true) == 0);
  for (int seed = 0; seed < 3; ++seed) BOOST_TEST(std::popcount(ring.convex_piece(seed, any)) == (ring.planes()[seed].normal.z() < -0.5 ? 1 : 2));
}

BOOST_AUTO_TEST_CASE(slopes_that_meet_in_a_pit_alone_are_in_one_piece_and_on_a_tip_in_none) {
  for (const bool is_pit : {true, false}) {
    const Mesh mesh = pyramid(is_pit ? -1 : 1);
    Ring ring(mesh);
    BOOST_TEST(ring.find(0, false) == 0);
    BOOST_TEST_REQUIRE(ring.planes().size() == 4);
    for (int seed = 0; seed < 4; ++seed) {
      BOOST_TEST(std::popcount(ring.convex_piece(seed, any)) == (is_pit ? 4 : 1));
      const Vector opposite = ring.planes()[seed].normal.cwiseProduct(Vector(-1, -1, 1));
      const auto is_opposite = [&](const Ring::Plane& plane) { return (plane.normal - opposite).norm() < 1e-12; };
      BOOST_TEST(std::popcount(ring.convex_piece(seed, is_opposite)) == (is_pit ? 2 : 1));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_point_is_past_a_ridge_by_how_far_it_is_beyond_it_along_the_plane) {
  const Mesh mesh = block_on_floor();
  Ring ring(mesh);
  ring.find(0, false);
  for (const Ring::Plane& plane : ring.planes()) {
    if (plane.normal.x() < 0.5) continue;
    for (const double height : {0.1, 0.9}) {
      BOOST_TEST(ring.is_past_ridge(plane, Vector(0.3, 0.11, height), 0.1));
      BOOST_TEST(!ring.is_past_ridge(plane, Vector(0.3, 0.09, height), 0.1));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
