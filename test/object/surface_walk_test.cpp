#include "feeler/object/surface_walk.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "scenes/height_field.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(surface_walk)

using namespace feeler_test;

namespace {

constexpr int cells = 12;

/// A sheet of 12×12 squares of two triangles with shaken corners, 1 m wide and turned in space; `height` is that of its bumps [m].
feeler::TriangleMesh<double> sheet(std::mt19937& bits, const Eigen::Matrix3d& axes, double height) {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({0, 1, 0, 1, cells, cells}, [](double, double) { return 0.0; }, vertices, triangles);
  for (auto vertex : vertices.rowwise()) {
    const bool is_rim = vertex.head<2>().minCoeff() == 0.0 || vertex.head<2>().maxCoeff() == 1.0;
    const double jitter = is_rim ? 0.0 : 0.2 / cells;
    const Eigen::Vector3d shake = random_vector(bits).cwiseProduct(Eigen::Vector3d(jitter, jitter, height));
    vertex = (axes * (vertex.transpose() + shake)).transpose().eval();
  }
  return {vertices, triangles};
}

/// Least of the barycentric coordinates of a point projected along the triangle's normal, by solving for them.
long double least_coordinate(const feeler::TriangleMesh<double>& mesh, int triangle, const Eigen::Vector3d& point) {
  using Wide = Eigen::Matrix<long double, 3, 3>;
  const Wide corners = mesh.corners(triangle).cast<long double>();
  Wide system;
  system.col(0) = corners.col(1) - corners.col(0);
  system.col(1) = corners.col(2) - corners.col(0);
  system.col(2) = system.col(0).cross(system.col(1));
  const Eigen::Matrix<long double, 3, 1> right = point.cast<long double>() - corners.col(0);
  const Eigen::Matrix<long double, 3, 1> x = system.fullPivLu().solve(right);
  return std::min({x[0], x[1], 1 - x[0] - x[1]});
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_walk_ends_on_the_triangle_that_the_point_lies_over_or_off_the_rim) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int found = 0, off = 0;
  for (int round = 0; round < 2000; ++round) {
    const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
    const double height = round % 2 == 0 ? 0.0 : 0.001;
    const auto mesh = sheet(bits, axes, height);
    const int start = below(bits, mesh.triangle_count());
    const Eigen::Vector3d centre = mesh.corners(start).rowwise().mean();
    Eigen::Vector3d step = 2.0 / cells * random_vector(bits);
    step.z() = 0.001 + height;
    const Eigen::Vector3d point = centre + axes * step;
    const Eigen::Vector3d local = axes.transpose() * point;
    const double to_rim = std::min({local.x(), local.y(), 1.0 - local.x(), 1.0 - local.y()});
    if (std::abs(to_rim) < 0.002) continue;
    const int end = feeler::triangle_under(mesh, start, point);
    if (to_rim < 0.0) {
      ++off;
      BOOST_TEST(end == -1);
    } else {
      ++found;
      BOOST_TEST_REQUIRE(end >= 0);
      // Over a ridge a point may be over neither side.
      BOOST_TEST(least_coordinate(mesh, end, point) > (height > 0.0 ? -0.01L : -1e-12L));
      if (height == 0.0) BOOST_TEST(feeler::edge_towards(mesh, end, point) == -1);
    }
  }
  BOOST_TEST(found > 1000);
  BOOST_TEST(off > 100);
}

BOOST_AUTO_TEST_CASE(the_edge_is_the_one_that_the_point_is_farthest_beyond) {
  feeler::Points<double> vertices(3, 3);
  vertices << 0, 0, 0, 4, 0, 0, 0, 4, 0;
  feeler::Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const feeler::TriangleMesh<double> mesh(vertices, triangles);
  const auto edge = [&mesh](double x, double y, double seam) { return feeler::edge_towards(mesh, 0, Eigen::Vector3d(x, y, 7.0), seam); };
  BOOST_TEST(edge(1.0, 1.0, 0.0) == -1);
  BOOST_TEST(edge(1.0, -0.5, 0.0) == 0);
  BOOST_TEST(edge(3.0, 3.0, 0.0) == 1);
  BOOST_TEST(edge(-0.5, 1.0, 0.0) == 2);
  BOOST_TEST(edge(-0.5, -1.0, 0.0) == 0);
  BOOST_TEST(edge(-1.0, -0.5, 0.0) == 2);
  BOOST_TEST(edge(1.0, -0.5, 0.5) == -1);
  BOOST_TEST(edge(1.0, -0.5, 0.25) == 0);
}

BOOST_AUTO_TEST_CASE(over_a_ridge_the_walk_comes_to_the_other_side) {
  // Two squares that meet at a right angle along the x-axis: one lies, one hangs down.
  feeler::Points<double> vertices(6, 3);
  vertices << 0, -1, 0, 1, -1, 0, 1, 0, 0, 0, 0, 0, 1, 0, -1, 0, 0, -1;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5;
  const feeler::TriangleMesh<double> mesh(vertices, triangles);
  const int end = feeler::triangle_under(mesh, 0, Eigen::Vector3d(0.7, 0.1, -0.2));
  BOOST_TEST(end == 2);
  BOOST_TEST(feeler::triangle_under(mesh, 0, Eigen::Vector3d(1.3, -0.5, 0.1)) == -1);
}

BOOST_AUTO_TEST_SUITE_END()
