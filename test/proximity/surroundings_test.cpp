#include "feeler/proximity/surroundings.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "feeler/tool/box.hpp"
#include "support/contact_scenes.hpp"
#include "support/wide_distance.hpp"

BOOST_AUTO_TEST_SUITE(surroundings)

using namespace feeler_test;
using feeler::Clearance;
using feeler::MovingTool;
using feeler::Surroundings;
using Box = feeler::Box<double>;
using Vector = Eigen::Vector3d;

namespace {

constexpr double near = 4e-6, half_width = 5e-3, depth = 0.02;
constexpr int bands = 6;

/// A square peg in a square hole with a gap on each side, at any pose.
struct PegInHole {
  /// @param gaps         between the peg's sides and the walls at +x, +y, −x, −y [m]
  /// @param half_length  of the peg, whose middle is that of the hole [m]
  PegInHole(const std::array<double, 4>& gaps, double half_length, const Pose& pose)
      : mesh(hole(gaps).moved(pose, 1).mesh()),
        peg(Vector(half_width, half_width, half_length)),
        moving(peg, Vector::Zero(), peg.half_extents().norm(), pose, {}) {}

  /// Triangles of the wall on a side, from the bottom up.
  static std::vector<int> wall(int side) {
    std::vector<int> triangles;
    for (int band = 0; band < bands; ++band) {
      for (int half = 0; half < 2; ++half) triangles.push_back(2 * (4 * band + side) + half);
    }
    return triangles;
  }

  std::set<int> found(Surroundings<Box, double>& surroundings, int limit = std::numeric_limits<int>::max()) const {
    std::set<int> triangles;
    int work = 0;
    surroundings.visit(work, limit, [&](int triangle) { triangles.insert(triangle); });
    BOOST_TEST(work > 0);
    return triangles;
  }
  Eigen::Matrix3d corners(int triangle) const { return mesh.corners(triangle).colwise() - moving.origin(); }
  Vector inward(int side) const { return moving.pose().rotation * -outward(side); }
  /// Along the hole, from the middle.
  double height(int triangle, int corner) const { return (moving.pose().rotation.conjugate() * corners(triangle).col(corner)).z(); }

  feeler::TriangleMesh<double> mesh;
  Box peg;
  MovingTool<Box> moving;
  Clearance<double> clearance;

 private:
  static Vector outward(int side) { return side == 0 ? Vector::UnitX() : side == 1 ? Vector::UnitY() : side == 2 ? Vector(-Vector::UnitX()) : Vector(-Vector::UnitY()); }

  static Soup hole(const std::array<double, 4>& gaps) {
    Soup soup;
    const double right = half_width + gaps[0], back = half_width + gaps[1], left = -half_width - gaps[2], front = -half_width - gaps[3];
    for (int ring = 0; ring <= bands; ++ring) {
      const double z = depth * (double(ring) / bands - 0.5);
      for (const Vector& corner : {Vector(right, front, z), Vector(right, back, z), Vector(left, back, z), Vector(left, front, z)}) soup.vertices.push_back(corner);
    }
    for (int band = 0; band < bands; ++band) {
      for (int side = 0; side < 4; ++side) {
        const int a = 4 * band + side, b = 4 * band + (side + 1) % 4;
        soup.triangles.push_back({a, a + 4, b});
        soup.triangles.push_back({b, a + 4, b + 4});
      }
    }
    return soup;
  }
};

Pose somewhere(std::mt19937& bits) { return {0.1 * random_vector(bits), random_rotation(bits)}; }

int count_of(const std::set<int>& found, int side) {
  int count = 0;
  for (const int triangle : PegInHole::wall(side)) count += int(found.count(triangle));
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_triangle_of_each_wall_that_is_near_is_found) {
  std::mt19937 bits(1);
  for (int i = 0; i < 50; ++i) {
    const PegInHole scene({1e-6, 1e-3, 3e-6, 5e-6}, 0.015, somewhere(bits));
    Surroundings surroundings(scene.mesh, scene.moving, scene.clearance, near);
    const auto found = scene.found(surroundings);
    BOOST_TEST(count_of(found, 0) == 1);
    BOOST_TEST(count_of(found, 2) == 1);
    BOOST_TEST(found.size() == 2U);
  }
}

BOOST_AUTO_TEST_CASE(a_wall_that_is_known_is_not_found_again) {
  std::mt19937 bits(2);
  for (const int known : PegInHole::wall(0)) {
    const PegInHole scene({1e-6, 1e-3, 3e-6, 1e-3}, 0.015, somewhere(bits));
    Surroundings surroundings(scene.mesh, scene.moving, scene.clearance, near);
    for (int side = 0; side < 4; ++side) surroundings.add_normal(scene.inward(side));
    surroundings.add_known(scene.corners(known), scene.inward(0), false);
    const auto found = scene.found(surroundings);
    BOOST_TEST(count_of(found, 2) == 1);
    BOOST_TEST(found.size() == 1U);
  }
}

BOOST_AUTO_TEST_CASE(of_a_wall_that_holds_the_tool_the_ends_are_found) {
  std::mt19937 bits(3);
  // A peg that is longer than the hole, and one that ends within it.
  for (const double half_length : {0.015, 0.006}) {
    const double end = std::min(half_length, depth / 2);
    for (const int known : PegInHole::wall(0)) {
      const PegInHole scene({1e-6, 1e-3, 1e-3, 1e-3}, half_length, somewhere(bits));
      Surroundings surroundings(scene.mesh, scene.moving, scene.clearance, near);
      surroundings.add_known(scene.corners(known), scene.inward(0), true);
      auto triangles = scene.found(surroundings);
      BOOST_TEST(count_of(triangles, 0) == int(triangles.size()));
      BOOST_TEST(triangles.count(known) == 0U);
      BOOST_TEST(triangles.size() <= 4U);
      triangles.insert(known);
      double lowest = 1, highest = -1;
      for (const int triangle : triangles) {
        double low = 1, high = -1;
        for (int k = 0; k < 3; ++k) {
          low = std::min(low, scene.height(triangle, k));
          high = std::max(high, scene.height(triangle, k));
        }
        lowest = std::min(lowest, low);
        highest = std::max(highest, high);
      }
      BOOST_TEST(lowest <= -end + near);
      BOOST_TEST(highest >= end - near);
      // With them known there is nothing more to find.
      Surroundings again(scene.mesh, scene.moving, scene.clearance, near);
      for (const int triangle : triangles) again.add_known(scene.corners(triangle), scene.inward(0), true);
      BOOST_TEST(scene.found(again).empty());
    }
  }
}

BOOST_AUTO_TEST_CASE(where_a_wall_touches_or_work_lacks_it_gives_up) {
  std::mt19937 bits(4);
  const PegInHole fit({0, 0, 0, 0}, 0.015, somewhere(bits));
  Surroundings touched(fit.mesh, fit.moving, fit.clearance, near);
  BOOST_TEST(fit.found(touched).empty());

  const PegInHole scene({1e-6, 1e-6, 1e-6, 1e-6}, 0.015, somewhere(bits));
  for (const int limit : {0, 1, 4}) {
    Surroundings surroundings(scene.mesh, scene.moving, scene.clearance, near);
    int work = 0;
    surroundings.visit(work, limit, [](int) {});
    BOOST_TEST(work <= limit + 12);  // a leaf with eight triangles, each measured, is looked at whole
  }
}

BOOST_AUTO_TEST_CASE(of_a_floor_in_any_shape_all_that_is_near_is_found_or_lies_behind_what_is) {
  // Bumps of random height under a box, measured by brute force.
  std::mt19937 bits(5);
  int near_count = 0;
  for (int i = 0; i < 100; ++i) {
    Soup soup;
    for (int bump = 0; bump < 12; ++bump) {
      const Vector centre(0.004 * random_vector(bits).x(), 0.004 * random_vector(bits).y(), -magnitude(bits, -6.5, -5.2));
      for (int k = 0; k < 3; ++k) {
        soup.vertices.push_back(centre + 2e-3 * Vector(std::cos(2.1 * k), std::sin(2.1 * k), -0.2 * (k + bump % 3)));
      }
      soup.triangles.push_back({3 * bump, 3 * bump + 1, 3 * bump + 2});
    }
    const Pose pose = somewhere(bits);
    const auto mesh = soup.moved(pose, 1).mesh();
    const Box box(Vector(0.005, 0.004, 0.003));
    const Pose above{pose * Vector(0, 0, 0.003), pose.rotation};
    const MovingTool<Box> moving(box, Vector::Zero(), box.half_extents().norm(), above, {});
    Surroundings surroundings(mesh, moving, Clearance<double>{}, near);
    std::set<int> found;
    int work = 0;
    surroundings.visit(work, std::numeric_limits<int>::max(), [&](int triangle) { found.insert(triangle); });

    const feeler::test::WideTool tool(box);
    const auto distance = [&](int triangle) {
      const Eigen::Matrix3d corners = above.rotation.conjugate().toRotationMatrix() * (mesh.corners(triangle).colwise() - above.translation);
      const feeler::test::WideTriangle wide{corners.col(0).cast<long double>(), corners.col(1).cast<long double>(), corners.col(2).cast<long double>()};
      const auto closest = closest_features(tool, wide);
      return double(closest.distance);
    };
    double lowest_found = 1;
    for (const int triangle : found) lowest_found = std::min(lowest_found, distance(triangle));
    for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
      const double apart = distance(triangle);
      if (found.count(triangle) > 0) BOOST_TEST(apart < near);
      if (apart > near - 1e-12) continue;
      ++near_count;
      BOOST_TEST((found.count(triangle) > 0 || apart >= lowest_found - 2e-10));
    }
  }
  BOOST_TEST(near_count > 100);
}

BOOST_AUTO_TEST_SUITE_END()
