#include "feeler/contact/patch_triangle.hpp"

#include <boost/test/unit_test.hpp>

#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(patch_triangle)

using namespace feeler_test;
using Vector = Eigen::Vector3d;

namespace {

Eigen::Matrix3d columns(const Vector& a, const Vector& b, const Vector& c) {
  Eigen::Matrix3d corners;
  corners << a, b, c;
  return corners;
}

}  // namespace

BOOST_AUTO_TEST_CASE(heights_are_on_the_side_of_the_tool_and_room_is_what_a_point_has_to_each_edge) {
  std::mt19937 bits(2611);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Quaterniond turn = random_rotation(bits);
    const Vector place = random_vector(bits);
    const auto placed = [&](double x, double y, double z) { return Vector(turn * Vector(x, y, z) + place); };
    const double side = trial % 2 == 0 ? 1 : -1;
    feeler::PatchTriangle<double> triangle;
    triangle.set(columns(placed(0, 0, 0), placed(3, 0, 0), placed(0, 4, 0)), turn * Vector(0, 0, side));
    triangle.measure_edges();
    BOOST_TEST(triangle.has_face());
    BOOST_TEST(triangle.faces_tool());
    BOOST_TEST((triangle.face_normal() - turn * Vector::UnitZ()).norm() < 1e-14);
    BOOST_TEST((triangle.outward() - turn * Vector(0, 0, side)).norm() < 1e-14);
    BOOST_TEST(std::abs(triangle.edge_length(1) - 5) < 1e-14);
    BOOST_TEST(std::abs(triangle.squared_size() - 16) < 1e-12);
    triangle.set(columns(placed(0, 0, 0), placed(0, 4, 0), placed(3, 0, 0)), turn * Vector(0, 0, side));  // the longer side first
    BOOST_TEST(std::abs(triangle.squared_size() - 16) < 1e-12);
    triangle.set(columns(placed(0, 0, 0), placed(3, 0, 0), placed(0, 4, 0)), turn * Vector(0, 0, side));

    const double x = 3 * unit(bits), y = 3 * unit(bits), z = unit(bits);
    const Vector point = placed(x, y, z);
    BOOST_TEST(std::abs(triangle.height_of(point) - side * z) < 1e-14);
    BOOST_TEST(std::abs(triangle.room_inside(0, point) - y) < 1e-14);
    BOOST_TEST(std::abs(triangle.room_inside(1, point) - (12 - 4 * x - 3 * y) / 5) < 1e-13);
    BOOST_TEST(std::abs(triangle.room_inside(2, point) - x) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(a_plane_that_leans_is_not_its_own_and_one_that_leans_by_far_does_not_face_the_tool) {
  const auto corners = columns({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  feeler::PatchTriangle<double> triangle;
  triangle.set(corners, Vector::UnitZ());
  BOOST_TEST(triangle.has_plane(Vector::UnitZ(), 1e-6));
  BOOST_TEST(!triangle.has_plane(Vector(-Vector::UnitZ()), 1e-6));
  BOOST_TEST(!triangle.has_plane(Vector(2e-6, 0, 1), 1e-6));
  triangle.set(corners, Vector(0.4, 0, 1).normalized());
  BOOST_TEST(triangle.faces_tool());
  triangle.set(corners, Vector(0.6, 0, 1).normalized());
  BOOST_TEST(!triangle.faces_tool());
}

BOOST_AUTO_TEST_CASE(a_sliver_has_no_face_whatever_was_set_before) {
  feeler::PatchTriangle<double> triangle;
  triangle.set(columns({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), Vector::UnitZ());
  triangle.set(columns({0, 0, 0}, {1, 0, 0}, {2, 1e-16, 0}), Vector::UnitZ());
  BOOST_TEST(!triangle.has_face());
  BOOST_TEST(!triangle.faces_tool());
  BOOST_TEST(!triangle.has_plane(Vector::UnitZ(), 1e-6));
}

BOOST_AUTO_TEST_SUITE_END()
