// The part of a large triangle near a tool, and queries that it saves, against closed forms.
#include "feeler/proximity/near_part.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>

#include "feeler/proximity/gjk.hpp"
#include "feeler/tool/box.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(near_part)

using namespace feeler;
using Vector = Eigen::Vector3d;

BOOST_AUTO_TEST_CASE(a_part_lies_in_the_box_and_in_the_triangle_and_knows_where) {
  constexpr unsigned seed = 11;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const Box<double> tool(Vector(0.01, 0.02, 0.005));
  int parts = 0;
  for (int i = 0; i < 2000; ++i) {
    Eigen::Matrix3d triangle;
    const double size = feeler_test::magnitude(bits, -2, 2);
    for (int k = 0; k < 3; ++k) triangle.col(k) = size * feeler_test::random_vector(bits);
    const Vector weights(0.3, 0.3, 0.4);
    if (i % 2 == 0) triangle.colwise() -= Vector(triangle * weights);  // through the middle of the tool
    const double distance = 0.003;
    const auto part = feeler::near_part(tool, triangle, distance);
    if (i % 2 == 0) BOOST_TEST(!part.empty());
    parts += !part.empty();
    const Vector normal = Vector(triangle.col(1) - triangle.col(0)).cross(Vector(triangle.col(2) - triangle.col(0)));
    for (const auto& corner : part) {
      BOOST_TEST((corner.point.cwiseAbs() - Vector(0.013, 0.023, 0.008)).maxCoeff() < 1e-13 * (1 + size));
      BOOST_TEST(std::abs(normal.dot(corner.point - triangle.col(0))) <= 1e-12 * normal.norm() * size);
      Eigen::Matrix3d sides = triangle;
      const Vector shares = sides.fullPivLu().solve(corner.point);  // of the corners, where the origin is off the plane
      if (std::abs(sides.determinant()) < 1e-3 * size * size * size) continue;
      for (int k = 0; k < 3; ++k) {
        BOOST_TEST(shares[k] > -1e-9);
        if ((corner.corners >> unsigned(k) & 1U) == 0) BOOST_TEST(std::abs(shares[k]) < 1e-9);
      }
    }
  }
  BOOST_TEST(parts > 1000);
}

BOOST_AUTO_TEST_CASE(a_corner_cut_from_an_edge_of_kilometres_lies_on_it_to_rounding_of_the_tool) {
  const Box<double> tool(Vector::Constant(0.01));
  Eigen::Matrix3d triangle;
  triangle << 0.001, 1e6, -4e5, 0.002, 3e5, 1e6, -0.003, 2e5, 1e5;
  int cut = 0;
  const auto part = feeler::near_part(tool, triangle, 0.003);
  for (const auto& corner : part) {
    for (int k = 0; k < 3; ++k) {
      if (corner.corners != (1U << unsigned(k) | 1U << unsigned((k + 1) % 3))) continue;
      ++cut;
      using Wide = Eigen::Matrix<long double, 3, 1>;
      const Wide start = triangle.col(k).cast<long double>(), along = (triangle.col((k + 1) % 3).cast<long double>() - start).normalized();
      BOOST_TEST((corner.point.cast<long double>() - start).cross(along).norm() < 1e-17L);
    }
  }
  BOOST_TEST(cut == 2);
}

BOOST_AUTO_TEST_CASE(a_box_over_a_triangle_of_kilometres_is_as_far_away_as_it_is) {
  const Vector half(0.01, 0.01, 0.01);
  const Box<double> tool(half);
  for (const double size : {1.0, 10.0, 500.0, 20000.0}) {
    for (const double gap : {1e-6, 1e-4}) {
      // The table z = 0 of two triangles, seen from a tool that stands on it: on the diagonal, and beside it.
      for (const double beside : {0.0, 0.003, 0.3}) {
        Eigen::Matrix3d triangle;
        triangle << -size, size, size, -size, -size, size, 0, 0, 0;
        triangle.colwise() -= Vector(beside, 0, 0.01 + gap);
        const auto closest = feeler::gjk(tool, triangle, {}, 1e-8);
        BOOST_TEST_CONTEXT("size " << size << " gap " << gap << " beside " << beside) {
          BOOST_TEST(std::abs(closest.distance - gap) < 1e-12);
          BOOST_TEST((closest.normal - Vector::UnitZ()).norm() < 1e-12);
          BOOST_TEST(closest.tool_point.z() == -0.01, boost::test_tools::tolerance(1e-12));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_query_of_a_triangle_of_kilometres_names_the_features_that_are_nearest) {
  const Box<double> tool(Vector(0.01, 0.02, 0.03));
  const Vector down = tool.vertex(0).normalized();  // towards its lowest corner
  const Vector u = down.unitOrthogonal(), v = down.cross(u);
  for (const double size : {10.0, 500.0, 20000.0}) {
    const Vector below = tool.vertex(0) + 1e-5 * down;
    Eigen::Matrix3d inside, edge;
    inside << below - size * u - size * v, below + size * u - size * v, below + size * v;
    edge << below - size * u, below + size * u, below + size * down;  // across the corner
    const auto on_face = feeler::gjk(tool, inside, {}, 1e-8), on_edge = feeler::gjk(tool, edge, {}, 1e-8);
    const auto corners_of = [](const auto& closest) {
      unsigned corners = 0;
      for (std::size_t i = 0; i < std::size_t(closest.features.size); ++i) corners |= 1U << unsigned(closest.features.corners[i]);
      return corners;
    };
    BOOST_TEST_CONTEXT("size " << size) {
      BOOST_TEST(std::abs(on_face.distance - 1e-5) < 2e-11);
      BOOST_TEST(std::abs(on_edge.distance - 1e-5) < 2e-11);
      BOOST_TEST(corners_of(on_face) == 7U);
      BOOST_TEST(corners_of(on_edge) == 3U);
      for (const auto* closest : {&on_face, &on_edge}) {
        for (std::size_t i = 0; i < std::size_t(closest->features.size); ++i) BOOST_TEST(closest->features.tool_vertices[i] == 0);
        BOOST_TEST((closest->normal + down).norm() < 1e-5);  // the edge is where rounding puts it
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
