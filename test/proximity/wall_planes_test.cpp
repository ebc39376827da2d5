#include "feeler/proximity/wall_planes.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "feeler/object/triangle_mesh.hpp"
#include "scenes/height_field.hpp"
#include "support/random_motions.hpp"
#include "support/random_tools.hpp"
#include "support/sanitized.hpp"

BOOST_AUTO_TEST_SUITE(wall_planes)

using namespace feeler_test;
using feeler::TriangleMesh;
using feeler::test::trials_to_run;
using feeler::test::WideReal;
using feeler::test::WideTool;
using feeler::test::WideVector;

namespace {

/// A roof of two flat sheets of n×n squares, 1 m wide, with ground of small bumps beside them, and a triangle without area; turned in space.
TriangleMesh<double> roof(std::mt19937& bits, int n) {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  const auto height = [](double x, double y) { return y > 1 ? 0.02 * (x * 12 - int(x * 12)) : x < 0.5 ? 0.3 * x : 0.3 * (1 - x); };
  feeler::scenes::mesh_height_field({0, 1, 0, 1.5, n, n}, height, vertices, triangles);
  const Eigen::Matrix3d axes = random_rotation(bits).toRotationMatrix();
  for (auto vertex : vertices.rowwise()) vertex = (axes * (vertex.transpose() - Vector(0.5, 0.5, 0.1))).transpose().eval();
  triangles.conservativeResize(triangles.rows() + 1, Eigen::NoChange);
  triangles.bottomRows(1) << 0, 1, 1;
  return {vertices, triangles};
}

constexpr WideReal near_distance = 0.01L;

/// How far the tool is at least from triangles along all directions that were asked, in samples of a motion: by brute force where it is near [m].
WideReal least_distance(const RandomMotion<feeler::Box<double>>& random, const Eigen::Matrix3d& corners, WideReal until) {
  WideReal least = std::numeric_limits<WideReal>::infinity();
  const WideTool tool(random.tool);
  const auto motion = random.wide();
  const double radii = random.tool.half_extents().norm() + (corners.colwise() - corners.col(0)).colwise().norm().maxCoeff();
  constexpr int samples = 24;
  for (int k = 0; k <= samples; ++k) {
    const WideReal time = until * k / samples;
    // By the balls about both it is no nearer than this; where that is not near it suffices.
    WideReal apart = (corners.col(0).cast<WideReal>() - motion.pose_at(time).translation).norm() - WideReal(radii) - 1e-9L;
    if (apart < std::min(near_distance, least)) {
      const WideTool there = motion.tool_at(tool, time);
      apart = feeler::test::intersect(there, wide(corners)) ? WideReal(0) : closest_features(there, wide(corners)).distance;
    }
    least = std::min(least, apart);
  }
  return least;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_a_remembered_plane_parts_the_tool_never_comes_near_on_the_whole_way) {
  constexpr unsigned seed = 5;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  const TriangleMesh<double> mesh = roof(bits, 8);
  const auto planes = std::make_unique<feeler::WallPlanes<double>>();
  planes->clear();
  feeler::Clearance<double> clearance;
  clearance.kept = 1e-6;
  int parted = 0, walls_parted = 0, checked = 0;
  int under = 0;
  for (int i = 0, link = 0; i < trials_to_run(1500); ++i, link = (link + 1) % 5) {
    static feeler::Pose<double> pose;
    static RandomMotion<feeler::Box<double>> random(bits, random_box(bits));
    if (link == 0) {  // else the same tool goes on from where it stopped
      planes->clear();
      random = RandomMotion<feeler::Box<double>>(bits, random_box(bits));
      // Just above the middle of a triangle.
      under = below(bits, mesh.triangle_count() - 1);
      const Vector up = (below(bits, 2) == 0 ? 1 : -1) * mesh.normal(under);
      const int lowest = random.tool.support(random.pose.rotation.inverse() * -up);
      random.pose.translation =
          mesh.corners(under).rowwise().mean() + magnitude(bits, -5, -1) * up - random.pose.rotation * random.tool.vertex(lowest);
      random.motion.linear = magnitude(bits, -4, -1) * random_direction(bits);
      random.motion.angular = magnitude(bits, -4, 0.3) * random_direction(bits);
    } else {
      random.pose = pose;
      random.motion.linear = magnitude(bits, -4, -1) * random_direction(bits);
      random.motion.angular = link % 2 == 0 ? Vector(Vector::Zero()) : Vector(magnitude(bits, -4, 0.3) * random_direction(bits));
    }
    const auto moving = random.moving();
    const auto start = moving.frame_at_start();
    planes->begin(mesh, 0, moving, start, i % 2 == 0);
    // A motion that is shortened while it is looked at.
    for (const double until : {1.0, 0.3}) {
      const auto end = moving.frame_at(until);
      planes->end(end);
      for (int k = 0; k < 12; ++k) {
        const int beside = mesh.topology().neighbour(under, k % 3);
        const int triangle = k < 3 ? under : k < 6 && beside >= 0 ? beside : below(bits, mesh.triangle_count());
        const Eigen::Matrix3d corners = mesh.corners(triangle);
        const bool is_parted = planes->parts_triangle(mesh, triangle, moving, start, end, clearance);
        const int wall = mesh.walls().of_triangle(triangle);
        const bool is_wall_parted = wall >= 0 && planes->parts_wall(mesh, wall, moving, start, end, clearance);
        walls_parted += is_wall_parted ? 1 : 0;
        if (!is_parted && !is_wall_parted) continue;
        ++parted;
        const WideReal least = least_distance(random, corners, WideReal(until));
        BOOST_TEST(least > 0);
        if (least < near_distance) ++checked;
      }
    }
    pose = moving.pose_at(0.3);
  }
  BOOST_TEST_MESSAGE(parted << " triangles parted, " << walls_parted << " with their wall, " << checked << " near");
  BOOST_TEST(parted > trials_to_run(2000));
  BOOST_TEST(walls_parted > trials_to_run(1000));
  BOOST_TEST(checked > trials_to_run(500));
}

BOOST_AUTO_TEST_CASE(a_wall_that_the_tool_sinks_into_is_parted_until_it_comes_near) {
  std::mt19937 bits(9);
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({0, 1, 0, 1, 8, 8}, [](double, double) { return 0.0; }, vertices, triangles);
  const TriangleMesh<double> mesh(vertices, triangles);
  BOOST_REQUIRE(mesh.walls().count() == 1);
  const feeler::Box<double> tool(Vector(0.01, 0.02, 0.03));
  const auto planes = std::make_unique<feeler::WallPlanes<double>>();
  planes->clear();
  feeler::Clearance<double> clearance;
  clearance.kept = 1e-6;
  for (int i = 0; i < 50; ++i) {
    feeler::Pose<double> pose;
    pose.rotation = random_rotation(bits);
    const Vector down(0.1 * fraction(bits), 0.1 * fraction(bits), -1);
    const double lowest = -(pose.rotation.toRotationMatrix().transpose() * -Vector::UnitZ()).cwiseAbs().dot(tool.half_extents());
    pose.translation = Vector(0.3 + 0.2 * fraction(bits), 0.3 + 0.2 * fraction(bits), 0.2 - lowest);
    const feeler::MovingTool<feeler::Box<double>> moving(tool, Vector::Zero(), feeler::radius_about(tool, Vector(Vector::Zero())), pose,
                                                         {down, Vector::Zero()});
    const auto start = moving.frame_at_start(), end = moving.frame_at(i % 2 == 0 ? 1.0 : 0.4);
    planes->begin(mesh, 0, moving, start, true);
    planes->end(end);
    BOOST_TEST(!planes->parts_wall(mesh, 0, moving, start, end, clearance));
    const double until = planes->parts_wall_until(mesh, 0, moving, start, end, clearance);
    BOOST_TEST(std::abs(until - 0.2) < 1e-5);
    const int below = planes->triangle_below(mesh, 0, moving, start, until);
    BOOST_REQUIRE(below >= 0);
    // The lowest vertex is over that triangle.
    const auto at = moving.pose_at(until);
    Vector deepest = Vector(0, 0, 1);
    for (int v = 0; v < 8; ++v) {
      const Vector vertex = at.rotation * tool.vertex(v) + at.translation;
      if (vertex.z() < deepest.z()) deepest = vertex;
    }
    const Eigen::Matrix3d corners = mesh.corners(below);
    BOOST_TEST(deepest.x() >= corners.row(0).minCoeff() - 1e-9);
    BOOST_TEST(deepest.x() <= corners.row(0).maxCoeff() + 1e-9);
    BOOST_TEST(deepest.y() >= corners.row(1).minCoeff() - 1e-9);
    BOOST_TEST(deepest.y() <= corners.row(1).maxCoeff() + 1e-9);
    BOOST_TEST(planes->note_question(mesh, 0, moving, start));
    BOOST_TEST(!planes->note_question(mesh, 0, moving, start));
  }
}

BOOST_AUTO_TEST_CASE(a_wall_that_is_as_rough_as_rounding_is_parted_from_what_keeps_off_all_of_it) {
  std::mt19937 bits(10);
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({-0.5, 0.5, -0.5, 0.5, 8, 8}, [&](double, double) { return 3e-9 * unit(bits); }, vertices, triangles);
  const TriangleMesh<double> mesh(vertices, triangles);
  BOOST_REQUIRE(mesh.walls().count() == 1);
  const Vector normal = mesh.normal(mesh.walls()[0].triangle);
  const double top = (vertices * normal).maxCoeff();
  const feeler::Box<double> tool(Vector(0.01, 0.02, 0.03));
  feeler::Clearance<double> clearance;
  clearance.kept = 1e-9;
  int parted = 0, near = 0;
  for (int i = 0; i < 400; ++i) {
    const feeler::Pose<double> pose{{0.1 * unit(bits), 0.1 * unit(bits), 0.03 + std::pow(10, -9 + i / 180.0)},
                                    feeler::Quaternion<double>::Identity()};
    const feeler::MovingTool<feeler::Box<double>> moving(tool, Vector::Zero(), feeler::radius_about(tool, Vector(Vector::Zero())), pose, {});
    const auto start = moving.frame_at_start(), end = moving.frame_at(1);
    const auto planes = std::make_unique<feeler::WallPlanes<double>>();
    planes->clear();
    planes->begin(mesh, 0, moving, start, false);
    planes->end(end);
    const bool is_parted = planes->parts_wall(mesh, 0, moving, start, end, clearance);
    const double room = normal.dot(pose.translation) + moving.lowest(normal, start) - top;
    if (is_parted) BOOST_TEST(room >= clearance.kept - 1e-15);
    ++(is_parted ? parted : near);
  }
  BOOST_TEST(parted > 50);
  BOOST_TEST(near > 50);
}

BOOST_AUTO_TEST_CASE(a_tool_on_both_sides_of_a_wall_is_never_parted_from_it) {
  feeler::Points<double> vertices;
  feeler::Triangles triangles;
  feeler::scenes::mesh_height_field({0, 1, 0, 1, 4, 4}, [](double, double) { return 0.0; }, vertices, triangles);
  const TriangleMesh<double> mesh(vertices, triangles);
  const feeler::Box<double> tool(Vector(0.01, 0.02, 0.03));
  for (const double height : {0.0, 0.02, -0.02, 0.03 - 1e-6}) {
    const feeler::MovingTool<feeler::Box<double>> moving(tool, Vector::Zero(), feeler::radius_about(tool, Vector(Vector::Zero())),
                                                         {Vector(0.3, 0.3, height), feeler::Quaternion<double>::Identity()},
                                                         {Vector(0, 0, 1e-4), Vector::Zero()});
    const auto start = moving.frame_at_start(), end = moving.frame_at(1);
    const auto planes = std::make_unique<feeler::WallPlanes<double>>();
    planes->clear();
    planes->begin(mesh, 0, moving, start, true);
    planes->end(end);
    const feeler::Clearance<double> clearance;
    BOOST_TEST(!planes->parts_wall(mesh, 0, moving, start, end, clearance));
    BOOST_TEST(planes->parts_wall_until(mesh, 0, moving, start, end, clearance) < 0);
  }
}

BOOST_AUTO_TEST_CASE(a_plane_that_parted_a_triangle_from_the_front_parts_nothing_once_it_is_seen_from_behind) {
  // Plates a metre apart, each a wall, at any height; more than there is room for planes.
  std::mt19937 bits(11);
  constexpr int plates = 3000;
  feeler::Points<double> vertices(4 * plates, 3);
  feeler::Triangles triangles(2 * plates, 3);
  for (int i = 0; i < plates; ++i) {
    const double z = i == 0 ? -0.5 : 0.5 * unit(bits);
    vertices.middleRows(4 * i, 4) << i, 0, z, i + 0.5, 0, z, i + 0.5, 0.5, z, i, 0.5, z;
    triangles.row(2 * i) << 4 * i, 4 * i + 1, 4 * i + 2;
    triangles.row(2 * i + 1) << 4 * i, 4 * i + 2, 4 * i + 3;
  }
  const TriangleMesh<double> mesh(vertices, triangles);
  BOOST_TEST_REQUIRE(mesh.walls().count() == plates);
  const feeler::Box<double> tool(Vector(0.01, 0.02, 0.03));
  const auto planes = std::make_unique<feeler::WallPlanes<double>>();
  planes->clear();
  const feeler::Clearance<double> clearance;
  const auto parts_at = [&](double height) {  // of the tool's middle above the first plate
    const feeler::MovingTool<feeler::Box<double>> standing(tool, Vector::Zero(), feeler::radius_about(tool, Vector(Vector::Zero())),
                                                           {Vector(0.2, 0.1, height - 0.5), feeler::Quaternion<double>::Identity()}, {});
    const auto start = standing.frame_at_start(), end = standing.frame_at(1);
    planes->begin(mesh, 0, standing, start, true);
    planes->end(end);
    const bool parts = planes->parts_triangle(mesh, 0, standing, start, end, clearance);
    for (int wall = 0; wall < plates; ++wall)  // take its place
      if (wall != mesh.walls().of_triangle(0)) planes->parts_wall(mesh, wall, standing, start, end, clearance);
    return parts;
  };
  BOOST_TEST(parts_at(0.04));
  BOOST_TEST(!parts_at(-0.02));  // it is astride, and farther out behind the plate
  BOOST_TEST(parts_at(-0.04));
  BOOST_TEST(!parts_at(0.02));
}

BOOST_AUTO_TEST_SUITE_END()
