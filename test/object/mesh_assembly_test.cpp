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

BOOST_AUTO_TEST_SUITE_END()
