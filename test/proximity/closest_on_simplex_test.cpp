#include "feeler/proximity/closest_on_simplex.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <vector>

#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(closest_on_simplex)

using feeler::detail::Simplex;
using feeler::test::closest_on_wide_segment;
using feeler::test::closest_on_wide_triangle;
using feeler::test::WideReal;
using feeler::test::WideVector;
using namespace feeler_test;

namespace {

WideVector wide_of(const Vector& v) { return v.cast<WideReal>(); }

/// Distance of the origin from the hull of up to four points by its faces, and 0 inside a tetrahedron.
WideReal distance_of_origin(const std::vector<Vector>& points) {
  const WideVector origin = WideVector::Zero();
  std::vector<WideVector> p;
  for (const Vector& v : points) p.push_back(wide_of(v));
  if (p.size() == 1) return p[0].norm();
  if (p.size() == 2) return closest_on_wide_segment(origin, p[0], p[1]).norm();
  if (p.size() == 3) return closest_on_wide_triangle(origin, p[0], p[1], p[2]).norm();
  WideReal best = std::numeric_limits<WideReal>::infinity();
  bool is_inside = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const WideVector &a = p[i], &b = p[(i + 1) % 4], &c = p[(i + 2) % 4], &d = p[(i + 3) % 4];
    best = std::min(best, closest_on_wide_triangle(origin, a, b, c).norm());
    const WideVector n = (b - a).cross(c - a);
    is_inside = is_inside && n.dot(d - a) * n.dot(-a) > 0;
  }
  return is_inside ? WideReal(0) : best;
}

Simplex<double> simplex_of(const std::vector<Vector>& points) {
  Simplex<double> simplex;
  simplex.size = int(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    simplex.points[i] = points[i];
    simplex.tool_vertices[i] = 10 + int(i);
    simplex.corners[i] = 20 + int(i);
  }
  return simplex;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_point_closest_to_the_origin_is_that_of_long_double_and_its_weights_make_it) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  WideReal worst = 0;
  for (int i = 0; i < 40000; ++i) {
    const std::size_t count = 1 + std::size_t(below(bits, 3));
    std::vector<Vector> points;
    const Vector offset = magnitude(bits, -6, 1) * random_vector(bits);
    for (std::size_t k = 0; k < count; ++k) points.push_back(offset + random_vector(bits));
    Simplex<double> simplex = simplex_of(points);
    BOOST_TEST_REQUIRE(feeler::detail::reduce_to_closest(simplex));
    WideVector sum = WideVector::Zero();
    double total = 0;
    for (std::size_t k = 0; k < std::size_t(simplex.size); ++k) {
      BOOST_TEST(simplex.weights[k] > 0);
      total += simplex.weights[k];
      // Points keep their names.
      const auto original = std::size_t(simplex.tool_vertices[k] - 10);
      BOOST_TEST(simplex.points[k] == points[original]);
      BOOST_TEST(simplex.corners[k] == 20 + int(original));
      sum += WideReal(simplex.weights[k]) * wide_of(simplex.points[k]);
    }
    BOOST_TEST(std::abs(total - 1) < 1e-14);
    BOOST_TEST((sum - wide_of(simplex.closest)).norm() < 1e-14L * (1 + sum.norm()));
    worst = std::max(worst, std::abs(sum.norm() - distance_of_origin(points)));
  }
  BOOST_TEST_MESSAGE("worst error " << worst);
  BOOST_TEST(worst < 1e-12L);
}

BOOST_AUTO_TEST_CASE(no_point_of_a_dense_sample_of_the_simplex_is_closer) {
  constexpr unsigned seed = 2;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vector> points{random_vector(bits), random_vector(bits), random_vector(bits)};
    Simplex<double> simplex = simplex_of(points);
    feeler::detail::reduce_to_closest(simplex);
    constexpr int n = 60;
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a <= n; ++a)
      for (int b = 0; a + b <= n; ++b) least = std::min(least, ((a * points[0] + b * points[1] + (n - a - b) * points[2]) / n).norm());
    BOOST_TEST(simplex.closest.norm() <= least + 1e-15);
    BOOST_TEST(least <= simplex.closest.norm() + 4.0 / n);
  }
}

BOOST_AUTO_TEST_CASE(a_tetrahedron_whose_last_point_came_last_is_reduced_to_the_face_that_sees_the_origin) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int inside = 0, outside = 0;
  WideReal worst = 0;
  while (outside < 10000) {
    const Vector offset = random_vector(bits);
    std::vector<Vector> points;
    for (int k = 0; k < 3; ++k) points.push_back(offset + random_vector(bits));
    // As in the algorithm: the triangle's closest point is in its inside, and the last point is beyond it.
    Simplex<double> triangle = simplex_of(points);
    feeler::detail::reduce_to_closest(triangle);
    if (triangle.size < 3) continue;
    const Vector towards = -triangle.closest;
    points.push_back(triangle.closest + magnitude(bits, -3, 0.5) * (towards.normalized() + 0.9 * random_vector(bits)));
    if ((points[3] - triangle.closest).dot(towards) <= 0) continue;
    Simplex<double> simplex = simplex_of(points);
    const bool is_outside = feeler::detail::reduce_to_closest(simplex);
    const WideReal distance = distance_of_origin(points);
    (is_outside ? outside : inside)++;
    worst = std::max(worst, std::abs(WideReal(simplex.closest.norm()) - distance));
    if (is_outside) BOOST_TEST(simplex.size < 4);
  }
  BOOST_TEST_MESSAGE(inside << " held the origin; worst error " << worst);
  BOOST_TEST(inside > 500);
  BOOST_TEST(worst < 1e-11L);
}

BOOST_AUTO_TEST_CASE(a_tetrahedron_in_any_order_gives_its_point_closest_to_the_origin) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  WideReal worst = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vector offset = random_vector(bits);
    std::vector<Vector> points;
    for (int k = 0; k < 4; ++k) points.push_back(offset + random_vector(bits));
    Simplex<double> simplex = simplex_of(points);
    const bool is_outside = feeler::detail::reduce_to_closest(simplex);
    const WideReal distance = distance_of_origin(points);
    BOOST_TEST(is_outside == (distance > 0));
    worst = std::max(worst, std::abs(WideReal(simplex.closest.norm()) - distance));
  }
  BOOST_TEST(worst < 1e-12L);
}

BOOST_AUTO_TEST_CASE(two_equal_corners_leave_the_edge_to_the_third) {
  // The closest point of the segment between them is (1, 0, 0), with the equal pair at either end and in any
  // order.
  for (const Vector& twice : {Vector(1, 1, 0), Vector(1, -2, 0)}) {
    const Vector once(1, twice.y() > 0 ? -2 : 1, 0);
    for (const auto& points : {std::vector<Vector>{twice, twice, once}, {twice, once, twice}, {once, twice, twice}}) {
      Simplex<double> simplex = simplex_of(points);
      BOOST_TEST_REQUIRE(feeler::detail::reduce_to_closest(simplex));
      BOOST_TEST((simplex.closest - Vector::UnitX()).norm() < 1e-15);
      BOOST_TEST(simplex.size == 2);
    }
  }
}

BOOST_AUTO_TEST_CASE(degenerate_simplices_give_a_point_of_theirs) {
  const Vector a(1, 0, 0), b(2, 0, 0), c(3, 0, 0);
  for (const auto& points : {std::vector<Vector>{a, a}, {a, a, a}, {a, b, c}, {c, b, a}, {b, a, a}, {b, c, a}, {a, b, c, b}}) {
    Simplex<double> simplex = simplex_of(points);
    BOOST_TEST_REQUIRE(feeler::detail::reduce_to_closest(simplex));
    BOOST_TEST((simplex.closest - a).norm() < 1e-15);
    BOOST_TEST(simplex.size >= 1);
  }
}

BOOST_AUTO_TEST_SUITE_END()
