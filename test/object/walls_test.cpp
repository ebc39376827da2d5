#include "feeler/object/walls.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "scenes/height_field.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(walls)

using namespace feeler_test;
using feeler::TriangleMesh;

namespace {

/// A sheet of n×n squares of two triangles, 1 m wide, with corners shaken in its plane and bumps of a height, turned in space.
TriangleMesh<double> sheet(std::mt19937& bits, int n, double height, bool is_float = false) {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({0, 1, 0, 1, n, n}, [](double, double) { return 0.0; }, vertices, triangles);
  const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
  for (auto vertex : vertices.rowwise()) {
    const bool is_rim = vertex.head<2>().minCoeff() == 0.0 || vertex.head<2>().maxCoeff() == 1.0;
    const double jitter = is_rim ? 0.0 : 0.2 / n;
    vertex = (axes * (vertex.transpose() + random_vector(bits).cwiseProduct(Eigen::Vector3d(jitter, jitter, height)))).transpose().eval();
    if (is_float) vertex = vertex.cast<float>().cast<double>().eval();
  }
  return {vertices, triangles};
}

/// All triangles in the box of a child of a node.
void gather(const feeler::Bvh<double>& bvh, std::int32_t child, std::vector<int>& triangles) {
  if (feeler::BvhNode::is_leaf(child)) {
    for (const std::int32_t triangle : bvh.leaves()[std::size_t(~child)].triangle) {
      if (triangle >= 0) triangles.push_back(triangle);
    }
    return;
  }
  for (const std::int32_t next : bvh.nodes()[std::size_t(child)].child) {
    if (next != 0) gather(bvh, next, triangles);
  }
}

/// What walls say of boxes and vertices, held against their triangles one by one.
void check_boxes_and_vertices(const TriangleMesh<double>& mesh) {
  const auto& walls = mesh.walls();
  std::vector<std::set<int>> walls_at(std::size_t(mesh.vertex_count()));
  std::vector<bool> is_rim(std::size_t(mesh.vertex_count()), false);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto& corners = mesh.triangle(t);
      walls_at[std::size_t(corners[std::size_t(k)])].insert(walls.of_triangle(t));
      if (mesh.topology().neighbour(t, k) < 0)
        is_rim[std::size_t(corners[std::size_t(k)])] = is_rim[std::size_t(corners[std::size_t((k + 1) % 3)])] = true;
    }
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const auto& at = walls_at[std::size_t(v)];
    BOOST_TEST(walls.is_inside(v) == (at.size() == 1 && *at.begin() >= 0 && !is_rim[std::size_t(v)]));
  }
  if (walls.count() == 0) return;
  for (std::size_t n = 0; n < mesh.bvh().nodes().size(); ++n) {
    for (std::size_t i = 0; i < feeler::BvhNode::width; ++i) {
      const std::int32_t child = mesh.bvh().nodes()[n].child[i];
      if (child == 0) continue;
      std::vector<int> triangles;
      gather(mesh.bvh(), child, triangles);
      std::set<int> found;
      bool is_inside = true;
      for (const int t : triangles) {
        found.insert(walls.of_triangle(t));
        for (const int v : mesh.triangle(t)) is_inside = is_inside && walls.is_inside(v);
      }
      BOOST_TEST(walls.under(int(n))[i] == (found.size() == 1 ? *found.begin() : -1));
      BOOST_TEST(walls.is_inside(int(n), i) == is_inside);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_plane_is_one_wall_however_finely_it_is_cut_and_its_coordinates_are_rounded) {
  std::mt19937 bits(1);
  for (const int n : {1, 2, 9, 40}) {
    for (const bool is_float : {false, true}) {
      const auto mesh = sheet(bits, n, 0, is_float);
      BOOST_TEST_REQUIRE(mesh.walls().count() == 1);
      const auto& wall = mesh.walls()[0];
      const Eigen::Vector3d normal = mesh.normal(wall.triangle), point = mesh.corners(wall.triangle).col(0);
      double farthest = 0;
      for (int v = 0; v < mesh.vertex_count(); ++v) farthest = std::max(farthest, std::abs(normal.dot(mesh.vertex(v) - point)));
      BOOST_TEST(farthest <= double(wall.flatness));
      BOOST_TEST(wall.flatness <= (is_float ? 3e-7F : 1e-14F));
      check_boxes_and_vertices(mesh);
    }
  }
}

BOOST_AUTO_TEST_CASE(rough_ground_has_no_walls_and_a_cube_has_six) {
  std::mt19937 bits(2);
  const auto rough = sheet(bits, 12, 1e-3);
  BOOST_TEST(rough.walls().count() == 0);
  BOOST_TEST(rough.walls().of_triangle(7) == -1);
  check_boxes_and_vertices(rough);
  feeler::Points<double> vertices(8, 3);
  for (int i = 0; i < 8; ++i) vertices.row(i) << (i & 1), (i >> 1 & 1), (i >> 2 & 1);
  feeler::Triangles triangles(12, 3);
  triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
  const TriangleMesh<double> cube(vertices, triangles);
  BOOST_TEST(cube.walls().count() == 6);
  for (int v = 0; v < 8; ++v) BOOST_TEST(!cube.walls().is_inside(v));
  check_boxes_and_vertices(cube);
}

BOOST_AUTO_TEST_CASE(the_triangle_of_a_wall_under_a_point_is_found_or_the_point_is_beside_it) {
  std::mt19937 bits(3);
  const auto mesh = sheet(bits, 25, 0);
  const Eigen::Vector3d normal = mesh.normal(mesh.walls()[0].triangle);
  const Eigen::Vector3d corner = mesh.vertex(0), middle = mesh.bvh().origin();
  int over = 0, beside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d way = 2 * (corner - middle).norm() * random_vector(bits);
    const Eigen::Vector3d below = middle + way - normal * normal.dot(way), point = below + random_vector(bits).x() * normal;
    int expected = -1;
    for (int t = 0; t < mesh.triangle_count() && expected < 0; ++t) {
      if (feeler::edge_towards(mesh, t, below) < 0) expected = t;
    }
    BOOST_TEST(feeler::triangle_of_wall_under(mesh, 0, point) == expected);
    ++(expected >= 0 ? over : beside);
  }
  BOOST_TEST(over > 100);
  BOOST_TEST(beside > 100);
}

BOOST_AUTO_TEST_CASE(the_two_sides_of_a_sheet_are_two_walls) {
  feeler::Points<double> vertices(4, 3);
  vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2;
  const TriangleMesh<double> mesh(vertices, triangles);
  BOOST_TEST(mesh.walls().count() == 2);
  BOOST_TEST(mesh.walls().of_triangle(0) == mesh.walls().of_triangle(1));
  BOOST_TEST(mesh.walls().of_triangle(2) == mesh.walls().of_triangle(3));
}

BOOST_AUTO_TEST_CASE(a_point_over_a_wall_that_is_as_rough_as_rounding_has_a_triangle_under_it) {
  std::mt19937 bits(4);
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({0, 1, 0, 1, 20, 20}, [&](double, double) { return 3e-9 * random_vector(bits).x(); }, vertices, triangles);
  const TriangleMesh<double> mesh(vertices, triangles);
  BOOST_TEST_REQUIRE(mesh.walls().count() == 1);
  for (int i = 0; i < 1000; ++i)
    BOOST_TEST(feeler::triangle_of_wall_under(mesh, 0, Eigen::Vector3d(fraction(bits), fraction(bits), 0.3), 1e-12) >= 0);
}

BOOST_AUTO_TEST_CASE(a_wall_lies_about_the_first_corner_of_one_of_its_largest_triangles) {
  std::mt19937 bits(5);
  for (const int n : {1, 2, 9, 40}) {
    const auto mesh = sheet(bits, n, 0);
    const auto area_of = [&](int t) {
      const Eigen::Matrix3d corners = mesh.corners(t);
      return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
    };
    BOOST_TEST_REQUIRE(mesh.walls().count() == 1);
    const auto& wall = mesh.walls()[0];
    double largest = 0, farthest = 0;
    for (int t = 0; t < mesh.triangle_count(); ++t) largest = std::max(largest, area_of(t));
    for (int v = 0; v < mesh.vertex_count(); ++v) farthest = std::max(farthest, (mesh.vertex(v) - mesh.corners(wall.triangle).col(0)).norm());
    BOOST_TEST(area_of(wall.triangle) >= largest / std::sqrt(2.0) * (1 - 1e-12));  // by the binary exponent of its square
    BOOST_TEST(double(wall.radius) >= farthest);
    BOOST_TEST(double(wall.radius) <= farthest * (1 + 1e-6));
  }
}

BOOST_AUTO_TEST_CASE(a_point_beside_the_rim_of_a_wall_by_less_than_a_seam_is_over_it) {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({0, 1, 0, 1, 8, 8}, [](double, double) { return 0.0; }, vertices, triangles);
  const TriangleMesh<double> mesh(vertices, triangles);
  const double seam = 1e-3;
  for (const double beside : {0.9 * seam, 1.1 * seam}) {
    for (const Eigen::Vector3d& point : {Eigen::Vector3d(-beside, 0.3, 0.2), Eigen::Vector3d(1 + beside, 0.3, -0.2),
                                         Eigen::Vector3d(0.3, -beside, 0.2), Eigen::Vector3d(0.3, 1 + beside, 0)})
      BOOST_TEST((feeler::triangle_of_wall_under(mesh, 0, point, seam) >= 0) == (beside < seam));
  }
}

BOOST_AUTO_TEST_SUITE_END()
