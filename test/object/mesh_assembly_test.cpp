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

BOOST_AUTO_TEST_SUITE_END()
