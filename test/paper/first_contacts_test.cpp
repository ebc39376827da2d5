#include "feeler/paper/first_contacts.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "feeler/tool/box.hpp"
#include "feeler/tool/point.hpp"
#include "feeler/tool/segment.hpp"
#include "scenes/height_field.hpp"
#include "scenes/terrain.hpp"
#include "support/random_geometry.hpp"
#include "support/wide_distance.hpp"

BOOST_AUTO_TEST_SUITE(first_contacts)

using feeler::Pose;
using feeler::test::WideReal;
using feeler::test::WideVector;
using namespace feeler_test;

namespace {

/// Time at which a point on a straight way crosses a triangle, by barycentric coordinates in long double; 2
/// for never.
WideReal crossing_time(const WideVector& from, const WideVector& to, const Eigen::Matrix3d& corners) {
  const WideVector a = corners.col(0).cast<WideReal>(), b = corners.col(1).cast<WideReal>(), c = corners.col(2).cast<WideReal>();
  Eigen::Matrix<WideReal, 3, 3> system;
  system << (b - a), (c - a), (from - to);
  if (std::abs(system.determinant()) < 1e-25L) return 2;
  const WideVector solution = system.fullPivLu().solve(WideVector(from - a));
  const bool is_inside = solution.x() >= 0 && solution.y() >= 0 && solution.x() + solution.y() <= 1;
  return is_inside && solution.z() >= 0 && solution.z() <= 1 ? solution.z() : WideReal(2);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_first_vertex_hit_is_that_of_brute_force) {
  constexpr unsigned seed = 1;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto scene = feeler::scenes::terrain(12);
  const feeler::TriangleMesh<double> mesh(scene.vertices, scene.triangles);
  const feeler::Box<double> tool(feeler::Vector3<double>(0.01, 0.02, 0.005));
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose<double> from{0.05 * random_vector(bits), random_rotation(bits)};
    const Pose<double> to{from.translation + 0.03 * random_vector(bits), random_rotation(bits)};
    const auto found = feeler::first_vertex_hit(tool, mesh, from, to);
    WideReal earliest = 2;
    for (int v = 0; v < tool.vertex_count(); ++v) {
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        earliest =
            std::min(earliest, crossing_time((from * tool.vertex(v)).cast<WideReal>(), (to * tool.vertex(v)).cast<WideReal>(), mesh.corners(t)));
      }
    }
    BOOST_TEST((found.triangle >= 0) == (earliest <= 1));
    if (found.triangle < 0) continue;
    ++hits;
    const int v = found.features.tool_vertices[0];
    const Eigen::Vector3d start = from * tool.vertex(v), end = to * tool.vertex(v);
    const WideReal time = crossing_time(start.cast<WideReal>(), end.cast<WideReal>(), mesh.corners(found.triangle));
    BOOST_TEST(std::abs(time - earliest) < 1e-12L);
    BOOST_TEST(found.normal_world.dot(end - start) < 0);  // it comes from the side that the normal points to
  }
  BOOST_TEST(hits > 200);
}

BOOST_AUTO_TEST_CASE(no_vertex_slips_through_between_two_triangles) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto scene = feeler::scenes::terrain(12);
  const feeler::TriangleMesh<double> mesh(scene.vertices, scene.triangles);
  const feeler::Point<double> tool;
  int edges = 0, missed = 0, missed_at_start = 0;
  for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.topology().neighbour(triangle, k) < 0) continue;
      ++edges;
      const Eigen::Matrix3d corners = mesh.corners(triangle);
      for (int i = 0; i < 20; ++i) {
        // To rounding the way leads through a point of the edge, and at times straight down.
        const double share = 0.1 + 0.4 * (1 + unit(bits));
        const Eigen::Vector3d point = (1 - share) * corners.col(k) + share * corners.col((k + 1) % 3);
        const double tilt = i % 2 == 0 ? 0 : 0.3;
        const Eigen::Vector3d way(tilt * unit(bits), tilt * unit(bits), -1);
        const auto at = [&](double distance) { return Pose<double>{point + distance * way, Eigen::Quaterniond::Identity()}; };
        if (feeler::first_vertex_hit(tool, mesh, at(-0.01), at(0.01)).triangle < 0) ++missed;
        if (feeler::first_vertex_hit(tool, mesh, at(0), at(0.01)).triangle < 0) ++missed_at_start;
      }
    }
  }
  BOOST_TEST(edges > 500);
  BOOST_TEST(missed == 0);
  BOOST_TEST(missed_at_start == 0);
}

BOOST_AUTO_TEST_CASE(an_edge_that_lands_on_a_ridge_is_not_seen) {
  // The paper's simple CCD tracks vertices: here both pass the wall on either side.
  feeler::Points<double> vertices(4, 3);
  vertices << 0, -1, 0, 0, 1, 0, 0, 1, -1, 0, -1, -1;
  feeler::Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const feeler::TriangleMesh<double> mesh(vertices, triangles);
  const feeler::Segment<double> tool(feeler::Vector3<double>(-0.1, 0, 0), feeler::Vector3<double>(0.1, 0, 0));
  const Pose<double> above{{0, 0, 0.01}, Eigen::Quaterniond::Identity()}, below{{0, 0, -0.01}, Eigen::Quaterniond::Identity()};
  BOOST_TEST(feeler::first_vertex_hit(tool, mesh, above, below).triangle == -1);
  // At the pose reached, the overlap is there to be found.
  BOOST_TEST(!feeler::overlapped_triangles(tool, mesh, below, 1e-8).triangles.empty());
}

BOOST_AUTO_TEST_CASE(the_triangles_overlapped_are_those_of_brute_force) {
  constexpr unsigned seed = 2;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const auto scene = feeler::scenes::terrain(20);
  const feeler::TriangleMesh<double> mesh(scene.vertices, scene.triangles);
  const feeler::Box<double> tool(feeler::Vector3<double>(0.01, 0.015, 0.005));
  const feeler::test::WideTool wide(tool);
  int overlapped = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose<double> pose{Eigen::Vector3d(0.08 * unit(bits), 0.08 * unit(bits), 0.01 * unit(bits)), random_rotation(bits)};
    const auto found = feeler::overlapped_triangles(tool, mesh, pose, 1e-8);
    BOOST_TEST(found.is_complete);
    const auto moved = wide.moved(pose.rotation.toRotationMatrix().cast<WideReal>(), pose.translation.cast<WideReal>());
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const Eigen::Matrix3d corners = mesh.corners(t);
      const feeler::test::WideTriangle triangle{corners.col(0).cast<WideReal>(), corners.col(1).cast<WideReal>(), corners.col(2).cast<WideReal>()};
      // Apart if any face normal, or any cross product of edges, separates.
      WideReal separation = -1;
      const auto try_axis = [&](const WideVector& axis) {
        if (axis.norm() < 1e-12L) return;
        for (const WideReal sign : {1.0L, -1.0L}) separation = std::max(separation, moved.separation_along(sign * axis.normalized(), triangle));
      };
      for (int k = 0; k < 3; ++k) try_axis((pose.rotation * Eigen::Vector3d::Unit(k)).cast<WideReal>());
      try_axis((triangle[1] - triangle[0]).cross(WideVector(triangle[2] - triangle[0])));
      for (int k = 0; k < 3; ++k)
        for (std::size_t e = 0; e < 3; ++e)
          try_axis(WideVector((pose.rotation * Eigen::Vector3d::Unit(k)).cast<WideReal>()).cross(WideVector(triangle[(e + 1) % 3] - triangle[e])));
      if (std::abs(separation) < 1e-7L) continue;
      const bool is_found = std::find(found.triangles.begin(), found.triangles.end(), t) != found.triangles.end();
      BOOST_TEST(is_found == (separation < 0));
      overlapped += is_found ? 1 : 0;
    }
  }
  BOOST_TEST(overlapped > 500);
}

BOOST_AUTO_TEST_SUITE_END()
