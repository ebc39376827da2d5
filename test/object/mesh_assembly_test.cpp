// Parts as they are given: units, arrays, and what is refused.
#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>

#include "feeler/object/mesh_assembly.hpp"
#include "support/refusal.hpp"

BOOST_AUTO_TEST_SUITE(mesh_assembly)

using namespace feeler;
using feeler_test::contains;
using feeler_test::refusal;

BOOST_AUTO_TEST_CASE(a_part_in_another_unit_and_from_arrays_lands_where_its_pose_puts_it) {
  const std::array<float, 9> millimetres{0, 0, 0, 10, 0, 0, 0, 20, 0};
  const std::array<unsigned short, 3> corners{0, 1, 2};
  const Pose<double> pose{{1, 2, 3}, Quaternion<double>(0, 0, 0, 2)};  // half a turn about z; not unit
  MeshAssembly<double> assembly;
  Points<double> vertices(3, 3);
  for (int i = 0; i < 9; ++i) vertices(i / 3, i % 3) = double(millimetres[std::size_t(i)]);
  const Triangles triangles{{0, 1, 2}};
  BOOST_TEST(assembly.add(vertices, triangles, pose, 0.001) == 0);
  BOOST_TEST(assembly.add(millimetres.data(), 3, corners.data(), 1, pose, 0.001) == 1);
  for (const int part : {0, 1}) {
    BOOST_TEST((assembly.vertices().row(3 * part + 1) - Eigen::RowVector3d(0.99, 2, 3)).norm() < 1e-15);
    BOOST_TEST((assembly.vertices().row(3 * part + 2) - Eigen::RowVector3d(1, 1.98, 3)).norm() < 1e-15);
    BOOST_TEST(assembly.triangles()(part, 2) == 3 * part + 2);
  }
}

BOOST_AUTO_TEST_CASE(a_part_without_a_place_is_refused_and_leaves_the_assembly_as_it_was) {
  const Points<double> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Triangles triangles{{0, 1, 2}};
  MeshAssembly<double> assembly;
  assembly.add(vertices, triangles);
  const auto refused = [&](const Pose<double>& pose, double scale = 1) { return refusal([&] { assembly.add(vertices, triangles, pose, scale); }); };
  BOOST_TEST(contains(refused({{0, std::nan(""), 0}, Quaternion<double>::Identity()}), "the pose of part 1 has a NaN"));
  BOOST_TEST(contains(refused({{0, 0, HUGE_VAL}, Quaternion<double>::Identity()}), "the pose of part 1"));
  BOOST_TEST(contains(refused({{0, 0, 0}, Quaternion<double>(0, 0, 0, 0)}), "a quaternion near zero"));
  BOOST_TEST(contains(refused({{0, 0, 0}, Quaternion<double>(1e155, 0, 0, 0)}), "too large to be squared"));
  BOOST_TEST(contains(refused({}, std::nan("")), "the scale is not a positive number"));
  Points<double> broken = vertices;
  broken(2, 1) = HUGE_VAL;
  BOOST_TEST(contains(refusal([&] { assembly.add(broken, triangles); }), "vertex 2 of part 1 has a NaN or an infinity"));
  broken(2, 1) = broken(2, 0) = 1.7e308;
  BOOST_TEST(
      contains(refusal([&] { assembly.add(broken, triangles, {{0, 0, 0}, Quaternion<double>(0.92, 0, 0, 0.38)}); }), "of part 1 is too far away"));
  BOOST_TEST(assembly.part_count() == 1);
  BOOST_TEST(assembly.vertices().rows() == 3);
  BOOST_TEST(assembly.mesh().triangle_count() == 1);
}

BOOST_AUTO_TEST_CASE(triangles_are_numbered_part_by_part) {
  const Points<double> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Triangles one{{0, 1, 2}}, two{{0, 1, 2}, {0, 2, 3}}, none(0, 3);
  MeshAssembly<double> assembly;
  BOOST_TEST(assembly.add(square, two) == 0);
  BOOST_TEST(assembly.add(square, one, {{0, 0, 1}, Quaternion<double>::Identity()}) == 1);
  BOOST_TEST(assembly.add(square, none) == 2);
  BOOST_TEST(assembly.add(square, two, {{0, 0, 2}, Quaternion<double>::Identity()}) == 3);
  const std::array<int, 5> parts{0, 0, 1, 3, 3};
  const TriangleMesh<double> mesh = assembly.mesh();
  BOOST_TEST_REQUIRE(mesh.triangle_count() == 5);
  for (int t = 0; t < 5; ++t) {
    BOOST_TEST(assembly.part_of(t) == parts[std::size_t(t)]);
    BOOST_TEST(mesh.corners(t).row(2).mean() == (parts[std::size_t(t)] == 3 ? 2 : parts[std::size_t(t)]));
  }
  const std::array<int, 4> first{0, 2, 3, 3};
  for (int part = 0; part < 4; ++part) BOOST_TEST(assembly.first_triangle(part) == first[std::size_t(part)]);
}

BOOST_AUTO_TEST_SUITE_END()
