#include "feeler/contact/surface_around.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(surface_around)

using namespace feeler_test;
using Vector = Eigen::Vector3d;
using Mesh = feeler::TriangleMesh<double>;
using Surface = feeler::SurfaceAround<double, double>;

namespace {

/// A sheet of 4 × 4 squares of side 1 about the origin, each of two triangles, that is bent by `slope` to both sides of the y axis.
Mesh sheet(double slope) {
  feeler::Points<double> vertices(25, 3);
  feeler::Triangles triangles(32, 3);
  for (int i = 0; i < 25; ++i) vertices.row(i) << i % 5 - 2, i / 5 - 2, slope * std::abs(i % 5 - 2);
  for (int square = 0; square < 16; ++square) {
    const int corner = square / 4 * 5 + square % 4;
    triangles.row(2 * square) << corner, corner + 1, corner + 6;
    triangles.row(2 * square + 1) << corner, corner + 6, corner + 5;
  }
  return {vertices, triangles};
}
/// Of the first triangle of the square whose lowest corner is (x, y); its edges are below, to the right, and the diagonal.
int triangle_at(int x, int y) { return 2 * ((y + 2) * 4 + x + 2); }
constexpr int right = 1;

}  // namespace

BOOST_AUTO_TEST_CASE(a_flat_surface_is_under_what_is_above_it_as_far_as_it_goes) {
  std::mt19937 bits(2612);
  const Mesh mesh = sheet(0);
  const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
  Surface surface(mesh, axes, 1e-9);
  for (int trial = 0; trial < 500; ++trial) {
    const int triangle = below(bits, 32);
    surface.stand_on(triangle);
    const Vector above(3 * unit(bits), 3 * unit(bits), unit(bits));
    const Vector corner_tool = axes.transpose() * mesh.corners(triangle).col(0);
    const bool is_above_sheet = std::abs(above.x()) < 2 && std::abs(above.y()) < 2;
    BOOST_TEST(surface.is_under(axes.transpose() * above, corner_tool) == is_above_sheet);
  }
}

BOOST_AUTO_TEST_CASE(a_bend_ends_a_flat_part_and_its_sides_rise_in_a_valley_alone) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (const double slope : {0.5, -0.5}) {  // a valley and a ridge
    const Mesh mesh = sheet(slope);
    Surface surface(mesh, axes, 1e-9);
    const int triangle = triangle_at(-1, 0);  // left of the bend, with the bend on its right
    surface.stand_on(triangle);
    const Vector corner = mesh.corners(triangle).col(0);
    const Vector upward = Vector(slope, 0, 1).normalized();
    BOOST_TEST(surface.is_under({-1.5, 1.5, 1.5 * slope + 0.1}, corner));
    BOOST_TEST(!surface.is_under({0.5, 0.5, 0.5 * slope + 0.1}, corner));
    BOOST_TEST(!surface.is_flat_across(right));
    BOOST_TEST(surface.is_flat_across(2));
    BOOST_TEST(surface.rises_across(right, upward) == (slope > 0));
    BOOST_TEST(surface.rises_across(right, Vector(-upward)) == (slope < 0));
    // Straight up over the bend a ridge is touched there, and a valley is not; nor is its neighbour clear.
    BOOST_TEST(surface.is_in_edge_cone(right, Vector::UnitZ()) == (slope < 0));
    BOOST_TEST(surface.is_clear_of_neighbour_across(right, Vector::UnitZ()) == (slope < 0));
  }
}

BOOST_AUTO_TEST_CASE(a_flat_surface_rises_nowhere_however_it_is_turned_and_one_beside_a_valley_only_across_it) {
  std::mt19937 bits(7);
  for (int turn = 0; turn < 20; ++turn) {
    const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
    const Mesh flat = sheet(0);
    feeler::Points<double> vertices(25, 3);
    feeler::Triangles triangles(32, 3);
    for (int i = 0; i < 25; ++i) vertices.row(i) = (axes * flat.vertex(i)).transpose();
    for (int t = 0; t < 32; ++t) triangles.row(t) << flat.triangle(t)[0], flat.triangle(t)[1], flat.triangle(t)[2];
    const Mesh mesh(vertices, triangles);
    Surface surface(mesh, axes, 1e-9);
    for (int triangle = 0; triangle < 32; ++triangle) {
      surface.stand_on(triangle);
      for (int k = 0; k < 3; ++k) {
        BOOST_TEST(!surface.rises_across(k, Vector::UnitZ()));
        for (const Vector& way : {Vector(Vector::UnitX()), Vector(-Vector::UnitX())})
          BOOST_TEST(!surface.leads_under_a_neighbour(k, way, Vector::UnitZ()));
      }
    }
  }
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (const double slope : {0.5, -0.5}) {
    const Mesh mesh = sheet(slope);
    Surface surface(mesh, axes, 1e-9);
    surface.stand_on(triangle_at(-1, 0));
    const Vector upward = Vector(slope, 0, 1).normalized();
    const Vector ray(1, 0, -slope);  // along the triangle, from its corner on the bend
    BOOST_TEST(surface.leads_under_a_neighbour(1, ray, upward) == (slope > 0));
    BOOST_TEST(!surface.leads_under_a_neighbour(1, Vector(-ray), upward));
  }
}

BOOST_AUTO_TEST_CASE(a_wall_is_flat_across_its_edges_though_rounding_bends_them) {
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (const double slope : {1e-9, -1e-9}) {
    const Mesh mesh = sheet(slope);
    const int triangle = triangle_at(-1, 0);
    BOOST_TEST_REQUIRE(mesh.walls().count() == 1);
    BOOST_TEST_REQUIRE((mesh.topology().edge_convexity(triangle, right) != feeler::Convexity::flat));
    Surface surface(mesh, axes, 1e-9);
    surface.stand_on(triangle);
    BOOST_TEST(surface.is_flat_across(right));
    surface.stand_on(triangle_at(1, 0));
    BOOST_TEST(!surface.is_flat_across(right));  // there it ends
  }
}

BOOST_AUTO_TEST_CASE(no_ray_leads_under_a_neighbour_of_a_triangle_alone) {
  // Seen along any normal one of its own edges may rise; what is beside it is what counts.
  std::mt19937 bits(8);
  const feeler::Points<double> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Mesh mesh(vertices, feeler::Triangles{{0, 1, 2}});
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Surface surface(mesh, axes, 1e-9);
  surface.stand_on(0);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector way = random_direction(bits), normal = random_direction(bits);
    for (int corner = 0; corner < 3; ++corner) BOOST_TEST(!surface.leads_under_a_neighbour(corner, way, normal));
  }
}

BOOST_AUTO_TEST_CASE(a_triangle_that_is_in_no_wall_is_the_only_one_under_a_point) {
  feeler::Points<double> vertices(25, 3);
  const Mesh flat = sheet(0);
  std::mt19937 bits(9);
  for (int i = 0; i < 25; ++i) vertices.row(i) = (flat.vertex(i) + Vector(0, 0, 0.1 * unit(bits))).transpose();
  feeler::Triangles triangles(32, 3);
  for (int t = 0; t < 32; ++t) triangles.row(t) << flat.triangle(t)[0], flat.triangle(t)[1], flat.triangle(t)[2];
  const Mesh rough(vertices, triangles);
  BOOST_TEST_REQUIRE(rough.walls().count() == 0);
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Surface surface(rough, axes, 1e-9);
  const int triangle = triangle_at(-2, -2);
  surface.stand_on(triangle);
  const Vector corner = rough.corners(triangle).col(0);
  BOOST_TEST(surface.triangle_under({0.9, -1.9, 0.3}, corner) == -1);
  BOOST_TEST(!surface.is_under({0.9, -1.9, 0.3}, corner));
}

BOOST_AUTO_TEST_CASE(for_a_point_beside_a_wall_the_triangle_is_that_at_the_rim_on_the_way) {
  const Mesh mesh = sheet(0);
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Surface surface(mesh, axes, 1e-9);
  surface.stand_on(triangle_at(-2, -2));
  const Vector corner = mesh.corners(triangle_at(-2, -2)).col(0);
  BOOST_TEST(surface.triangle_under({5, -1.9, 0.1}, corner) == triangle_at(1, -2));
  BOOST_TEST(surface.triangle_under({0.9, -1.9, 0.1}, corner) == triangle_at(0, -2));
  BOOST_TEST(surface.triangle_under({-1.1, -1.9, 0.1}, corner) == -1);  // its own
}

BOOST_AUTO_TEST_CASE(the_rim_of_a_surface_has_no_neighbour_and_nothing_rises_there) {
  const Mesh mesh = sheet(0);
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Surface surface(mesh, axes, 1e-9);
  surface.stand_on(triangle_at(1, 1));
  BOOST_TEST(surface.neighbour(right) < 0);
  BOOST_TEST(!surface.rises_across(right, Vector::UnitZ()));
  BOOST_TEST(surface.is_clear_of_neighbour_across(right, Vector::UnitX()));
  BOOST_TEST(surface.nearer_neighbour({2, right}, Vector::UnitX()) == -1);
  BOOST_TEST(surface.nearer_neighbour({2, 2}, Vector::UnitZ()) == triangle_at(1, 1) + 1);
  BOOST_TEST(surface.nearer_neighbour({3, 0}, Vector::UnitZ()) == -1);
}

BOOST_AUTO_TEST_SUITE_END()
