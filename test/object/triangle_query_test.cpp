#include "feeler/object/triangle_query.hpp"

#include <boost/test/unit_test.hpp>

#include <random>
#include <vector>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(triangle_query)

using namespace feeler_test;

BOOST_AUTO_TEST_CASE(every_triangle_whose_box_meets_the_box_is_visited_once) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int round = 0; round < 20; ++round) {
    const Eigen::Vector3d offset = round % 2 == 0 ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(1e3 * random_vector(bits));
    const int count = 1 + below(bits, 400);
    feeler::Points<double> vertices(3 * count, 3);
    feeler::Triangles triangles(count, 3);
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d centre = offset + 0.1 * random_vector(bits);
      for (int k = 0; k < 3; ++k) vertices.row(3 * i + k) = (centre + 0.02 * random_vector(bits)).transpose();
      triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
    }
    const feeler::TriangleMesh<double> mesh(vertices, triangles);
    for (int query = 0; query < 50; ++query) {
      Eigen::AlignedBox3d box(Eigen::Vector3d(offset + 0.1 * random_vector(bits)));
      box.extend(Eigen::Vector3d(box.min() + 0.05 * random_vector(bits)));
      std::vector<int> visits(std::size_t(count), 0);
      feeler::visit_triangles_in<double>(mesh, box, [&](int triangle) {
        ++visits[std::size_t(triangle)];
        return true;
      });
      int extra = 0, meeting = 0;
      for (int i = 0; i < count; ++i) {
        Eigen::AlignedBox3d own;
        for (int k = 0; k < 3; ++k) own.extend(Eigen::Vector3d(mesh.corners(i).col(k)));
        const int visited = visits[std::size_t(i)];
        BOOST_TEST(visited <= 1);
        if (own.intersects(box)) BOOST_TEST(visited == 1);
        meeting += own.intersects(box) ? 1 : 0;
        extra += visited == 1 && !own.intersects(box) ? 1 : 0;
      }
      BOOST_TEST(extra <= feeler::BvhLeaf::width * (meeting + 4));  // those in the same leaf
    }
  }
}

BOOST_AUTO_TEST_CASE(a_visit_that_says_no_is_the_last) {
  feeler::Points<double> vertices(3, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  feeler::Triangles triangles(5, 3);
  for (int i = 0; i < 5; ++i) triangles.row(i) << 0, 1, 2;
  const feeler::TriangleMesh<double> mesh(vertices, triangles);
  int visits = 0;
  feeler::visit_triangles_in<double>(mesh, Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()), [&](int) { return ++visits < 2; });
  BOOST_TEST(visits == 2);
}

BOOST_AUTO_TEST_SUITE_END()
