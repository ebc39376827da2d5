// Rays leave out what they pass by, and meet what they met among all triangles.
#include <boost/test/unit_test.hpp>

#include <random>

#include "scenes/surface_path.hpp"

BOOST_AUTO_TEST_SUITE(surface_path)

using feeler::Points;
using feeler::Triangles;
using feeler::scenes::Ray;
using feeler::scenes::TriangleBundles;
using feeler::scenes::Vector;

BOOST_AUTO_TEST_CASE(a_ray_through_bundles_crosses_what_it_crosses_among_all_triangles) {
  std::mt19937 bits(62);
  const auto number = [&] { return double(bits()) / double(0x80000000u) - 1.0; };
  constexpr int patches = 40, a_patch = 50;  // so that bundles are small, and a patch may be in two
  Points<double> vertices(3 * patches * a_patch, 3);
  Triangles triangles(patches * a_patch, 3);
  for (int i = 0; i < patches * a_patch; ++i) {
    static Vector place;
    if (i % a_patch == 0) place = Vector(number(), number(), number());
    for (int k = 0; k < 3; ++k) vertices.row(3 * i + k) = (place + 0.2 * Vector(number(), number(), number())).transpose();
    triangles.row(i) = Eigen::RowVector3i(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const TriangleBundles bundles(vertices, triangles);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{{number(), number(), number()}, Vector(number(), number(), number()).normalized()};
    const double expected = feeler::scenes::outermost_crossing(vertices, triangles, ray, 0, triangles.rows());
    hits += std::isfinite(expected) ? 1 : 0;
    BOOST_TEST(bundles.outermost_crossing(ray) == expected);
  }
  BOOST_TEST(hits > 1000);
  BOOST_TEST(hits < 2000);
}

BOOST_AUTO_TEST_SUITE_END()
