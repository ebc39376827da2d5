// Closest points of a tool and a triangle that it overlaps on its way, along the plane that the two had before; against long double.
#include "feeler/render/constraints/closest_points_of_pair.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "feeler/render/constraints/working_set.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(closest_points_of_pair)

using namespace feeler_test;

using Box = feeler::Box<double>;
using Pair = feeler::WorkingPair<double>;
using Scene = feeler::RenderedScene<Box>;

namespace {

const feeler::TriangleMesh<double>& some_triangle() {
  static const feeler::TriangleMesh<double> mesh(feeler::Points<double>{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, feeler::Triangles{{0, 1, 2}});
  return mesh;
}
Scene scene_of(const Box& box) { return {some_triangle(), box, feeler::Settings<double>()}; }

/// Least of n·v over the vertices of a tool, less the greatest over the corners, in the tool frame.
double separation(const Box& box, const Eigen::Matrix3d& corners, const Vector& normal) {
  using Wide = Eigen::Matrix<long double, 3, 1>;
  const Wide n = normal.cast<long double>();
  long double lowest = std::numeric_limits<long double>::infinity(), highest = -lowest;
  for (int i = 0; i < box.vertex_count(); ++i) lowest = std::min(lowest, n.dot(Wide(box.vertex(i).cast<long double>())));
  for (int k = 0; k < 3; ++k) highest = std::max(highest, n.dot(Wide(corners.col(k).cast<long double>())));
  return double(lowest - highest);
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_way_an_overlap_is_along_the_plane_that_the_pair_had_and_the_point_is_the_deepest_along_it) {
  std::mt19937 bits(1);
  for (int round = 0; round < 300; ++round) {
    const Box box = random_box(bits);
    const Scene scene = scene_of(box);
    // The triangle has its middle in the box.
    Eigen::Matrix3d corners = random_triangle(bits, Shape::ordinary);
    const Vector inside = 0.9 * box.half_extents().cwiseProduct(random_vector(bits)), middle = corners.rowwise().mean();
    corners.colwise() += inside - middle;
    const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
    Pair pair;
    pair.set_plane(random_direction(bits), 1e-3);
    pair.features.size = 1;
    const auto closest = closest_points_of(pair, scene, corners, axes, false);
    const Vector normal = axes.transpose() * pair.normal;  // in the tool frame
    BOOST_TEST((closest.normal - normal).norm() < 1e-15);
    BOOST_TEST(std::abs(closest.distance - separation(box, corners, normal)) < 1e-15);
    double lowest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) lowest = std::min(lowest, normal.dot(Vector(box.vertex(i))));
    BOOST_TEST(std::abs(normal.dot(closest.tool_point) - lowest) < 1e-15);
    BOOST_TEST(closest.features.size == 0, "which features meet is not known of an overlap");
  }
}

BOOST_AUTO_TEST_CASE(a_ghost_that_touches_its_triangle_is_parted_by_the_plane_of_that_whichever_side_it_faces) {
  std::mt19937 bits(2);
  for (int round = 0; round < 200; ++round) {
    const Box box = random_box(bits);
    const Scene scene = scene_of(box);
    // A triangle in the plane of a face of the box, about the middle of that.
    const int f = below(bits, 6);
    const Vector out = box.face(f).normal, half = box.half_extents();
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      const Vector beside = 0.5 * half.cwiseProduct(random_vector(bits));
      corners.col(k) = half.cwiseProduct(out) + beside.cwiseProduct(Vector(Vector::Ones() - out.cwiseAbs()));
    }
    const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
    Pair pair;
    const Vector leaning = (-out + 0.3 * random_direction(bits)).normalized();
    pair.set_plane(axes * leaning, 1e-3);
    for (const bool is_ghost : {false, true}) {
      pair.is_ghost = is_ghost;
      const auto closest = closest_points_of(pair, scene, corners, axes, false);
      const Vector expected = is_ghost ? Vector(-out) : leaning;
      BOOST_TEST((closest.normal - expected).norm() < 1e-9);
      BOOST_TEST(std::abs(closest.distance - separation(box, corners, expected)) < 1e-12);
    }
    // Deep in the box the plane of the triangle parts nothing.
    corners.colwise() -= 0.5 * half.cwiseProduct(out);
    BOOST_TEST((closest_points_of(pair, scene, corners, axes, false).normal - leaning).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(apart_the_points_are_the_closest_ones_and_the_next_query_starts_from_their_features) {
  std::mt19937 bits(3);
  for (int round = 0; round < 200; ++round) {
    const Box box = random_box(bits);
    const Scene scene = scene_of(box);
    const double gap = magnitude(bits, -6, -2);
    const Eigen::Matrix3d corners = triangle_near(box, bits, Shape::ordinary, gap);
    Pair pair;
    pair.set_plane(random_direction(bits), 1e-3);
    const auto closest = closest_points_of(pair, scene, corners, Eigen::Matrix3d(Eigen::Matrix3d::Identity()), below(bits, 2) == 0);
    BOOST_TEST(closest.distance == gap, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(((closest.tool_point - closest.triangle_point) - gap * closest.normal).norm() < 1e-9);
    BOOST_TEST(pair.features.size == closest.features.size);
    BOOST_TEST(pair.features.size > 0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
