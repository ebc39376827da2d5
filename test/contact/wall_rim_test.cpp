#include "feeler/contact/wall_rim.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "feeler/object/triangle_mesh.hpp"
#include "scenes/height_field.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(wall_rim)

using namespace feeler_test;
using feeler::TriangleMesh;
using Vector = feeler::Vector3<double>;

namespace {

struct Sheet {
  /// n×n squares of two triangles, 1 m wide, in a plane turned in space, with a roof of another plane beside it.
  Sheet(const Eigen::Matrix3d& turned, int n) : axes(turned), mesh(make(n)) {}
  Sheet(std::mt19937& bits, int n) : Sheet(random_rotation(bits).toRotationMatrix(), n) {}

  TriangleMesh<double> make(int n) const {
    feeler::Points<double> vertices;
    feeler::Triangles triangles;
    feeler::scenes::mesh_height_field({0, 2, 0, 1, 2 * n, n}, [](double x, double) { return x > 1 ? 0.5 * (1 - x) : 0.0; }, vertices, triangles);
    for (auto vertex : vertices.rowwise()) vertex = (axes * vertex.transpose()).transpose().eval();
    return {vertices, triangles};
  }

  Eigen::Matrix3d axes;
  TriangleMesh<double> mesh;
};

bool is_inside(const std::vector<Vector>& face, const Vector& point) {
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vector side = face[(i + 1) % face.size()] - face[i];
    if (side.x() * (point.y() - face[i].y()) < side.y() * (point.x() - face[i].x())) return false;
  }
  return true;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_outermost_points_of_a_face_over_the_rim_are_on_the_triangles_that_are_found) {
  constexpr unsigned seed = 17;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int over_rim = 0, elsewhere = 0;
  for (const int n : {1, 3, 12}) {
    const Sheet sheet(bits, n);
    const int wall = sheet.mesh.walls().of_triangle(0);
    BOOST_REQUIRE(wall >= 0);
    for (int i = 0; i < 100; ++i) {
      // A polygon of four to seven corners on a circle, just above the wall or below it, either way round.
      const Vector centre(1.4 * fraction(bits) - 0.2, 1.4 * fraction(bits) - 0.2, 1e-5);
      const double radius = magnitude(bits, -1.5, 0), turn = fraction(bits);
      const int corners = 4 + below(bits, 4);
      std::vector<Vector> face;
      for (int k = 0; k < corners; ++k) {
        const double angle = 2 * 3.14159265358979 * (k + turn) / corners;
        face.push_back(centre + radius * Vector(std::cos(angle), 0.6 * std::sin(angle), 0));
      }
      std::vector<Vector> in_world;
      for (const Vector& corner : face) in_world.push_back(sheet.axes * corner);
      const bool is_below = i % 2 == 0;
      if (is_below) std::reverse(in_world.begin(), in_world.end());
      feeler::FixedVector<Vector, 16> loop;
      for (const Vector& corner : in_world) loop.push_back(corner);
      std::set<int> found;
      feeler::OutermostAtRim<double, double>(
          sheet.mesh, wall, loop.size(), [&](int k) { return loop[k]; }, Vector((is_below ? -1 : 1) * sheet.axes.col(2)))
          .find([](int) { return false; }, [&](int triangle) { found.insert(triangle); });
      // All rim edges of the wall, point by point.
      std::array<double, 8> all, those;
      all.fill(-std::numeric_limits<double>::infinity());
      those = all;
      const Vector along = (sheet.axes.transpose() * (in_world[1] - in_world[0])).normalized(), across = Vector::UnitZ().cross(along);
      std::set<int> at_rim;
      for (int t = 0; t < sheet.mesh.triangle_count(); ++t) {
        if (sheet.mesh.walls().of_triangle(t) != wall) continue;
        const Eigen::Matrix3d triangle = sheet.axes.transpose() * sheet.mesh.corners(t);
        for (int k = 0; k < 3; ++k) {
          const Vector start = triangle.col(k), end = triangle.col((k + 1) % 3);
          const auto is_at = [&](int axis, double value) { return std::abs(start[axis] - value) < 1e-12 && std::abs(end[axis] - value) < 1e-12; };
          if (!is_at(0, 0) && !is_at(0, 1) && !is_at(1, 0) && !is_at(1, 1)) continue;
          constexpr int samples = 2000;
          for (int s = 0; s <= samples; ++s) {
            const Vector point = start + (end - start) * s / samples;
            if (!is_inside(face, point)) continue;
            at_rim.insert(t);
            for (std::size_t d = 0; d < 8; ++d) {
              const double angle = double(d) * 3.14159265358979 / 4;
              const double distance = std::cos(angle) * along.dot(point) + std::sin(angle) * across.dot(point);
              all[d] = std::max(all[d], distance);
              if (found.count(t) > 0) those[d] = std::max(those[d], distance);
            }
          }
        }
      }
      (at_rim.empty() ? elsewhere : over_rim)++;
      BOOST_TEST(found.size() <= 8U);
      for (const int t : found) BOOST_TEST((at_rim.count(t) > 0 || radius < 0.1));  // of a small face samples miss some
      if (!at_rim.empty()) {
        for (std::size_t d = 0; d < 8; ++d) BOOST_TEST(those[d] >= all[d] - 1.5 / 2000);
      }
    }
  }
  BOOST_TEST(over_rim > 100);
  BOOST_TEST(elsewhere > 30);
}

BOOST_AUTO_TEST_CASE(of_triangles_that_share_a_point_the_known_one_is_preferred) {
  std::mt19937 bits(3);
  const Sheet sheet(bits, 4);
  const int wall = sheet.mesh.walls().of_triangle(0);
  // Its corner touches the rim where two triangles meet.
  feeler::FixedVector<Vector, 16> loop;
  for (const Vector& corner : {Vector(0.1, -0.1, 0), Vector(0.4, -0.1, 0), Vector(0.4, 0.1, 0), Vector(0.1, 0.1, 0)})
    loop.push_back(sheet.axes * corner);
  std::set<int> any;
  feeler::OutermostAtRim<double, double>(
      sheet.mesh, wall, loop.size(), [&](int k) { return loop[k]; }, Vector(sheet.axes.col(2)))
      .find([](int) { return false; }, [&](int t) { any.insert(t); });
  BOOST_TEST(any.size() == 2U);  // the ends of what is over the rim
  for (const int known : any) {
    std::set<int> found;
    feeler::OutermostAtRim<double, double>(
        sheet.mesh, wall, loop.size(), [&](int k) { return loop[k]; }, Vector(sheet.axes.col(2)))
        .find([&](int t) { return t == known; }, [&](int t) { found.insert(t); });
    BOOST_TEST(found.count(known) == 1U);
  }
}

BOOST_AUTO_TEST_CASE(of_two_rim_triangles_with_one_outermost_point_the_known_one_has_it) {
  std::mt19937 bits(4);
  const Sheet sheet(bits, 4);
  const int wall = sheet.mesh.walls().of_triangle(0);
  // The face begins a nanometre before the point at x = 0.25 where two triangles of the rim meet.
  feeler::FixedVector<Vector, 16> loop;
  for (const Vector& corner : {Vector(0.25 - 1e-9, -0.1, 0), Vector(0.4, -0.1, 0), Vector(0.4, 0.1, 0), Vector(0.25 - 1e-9, 0.1, 0)})
    loop.push_back(sheet.axes * corner);
  const auto found_knowing = [&](int known) {
    std::set<int> found;
    feeler::OutermostAtRim<double, double>(
        sheet.mesh, wall, loop.size(), [&](int k) { return loop[k]; }, Vector(sheet.axes.col(2)))
        .find([&](int t) { return t == known; }, [&](int t) { found.insert(t); });
    return found;
  };
  std::vector<int> rim;  // triangles with an edge on y = 0, from x = 0 on
  for (int t = 0; t < sheet.mesh.triangle_count(); ++t) {
    const Eigen::Matrix3d corners = sheet.axes.transpose() * sheet.mesh.corners(t);
    int on_rim = 0;
    for (int k = 0; k < 3; ++k) on_rim += std::abs(corners(1, k)) < 1e-12;
    if (on_rim == 2 && corners.row(0).maxCoeff() < 0.51) rim.push_back(t);
  }
  BOOST_TEST_REQUIRE(rim.size() == 2u);
  std::sort(rim.begin(), rim.end(), [&](int a, int b) {
    return (sheet.axes.transpose() * sheet.mesh.corners(a)).row(0).mean() < (sheet.axes.transpose() * sheet.mesh.corners(b)).row(0).mean();
  });
  BOOST_TEST(found_knowing(rim[0]).count(rim[0]) == 1u);
  BOOST_TEST(found_knowing(rim[1]).count(rim[0]) == 0u);
  BOOST_TEST(found_knowing(rim[1]).count(rim[1]) == 1u);
}

BOOST_AUTO_TEST_CASE(a_face_a_little_above_a_level_wall_finds_its_rim) {
  const Sheet sheet(Eigen::Matrix3d::Identity(), 4);
  feeler::FixedVector<Vector, 16> loop;
  for (const Vector& corner : {Vector(0.1, -0.1, 1e-5), Vector(0.4, -0.1, 1e-5), Vector(0.4, 0.1, 1e-5), Vector(0.1, 0.1, 1e-5)})
    loop.push_back(corner);
  std::set<int> found;
  feeler::OutermostAtRim<double, double>(
      sheet.mesh, sheet.mesh.walls().of_triangle(0), loop.size(), [&](int k) { return loop[k]; }, Vector::UnitZ())
      .find([](int) { return false; }, [&](int t) { found.insert(t); });
  BOOST_TEST(found.size() == 2u);
}

BOOST_AUTO_TEST_CASE(of_a_round_face_a_little_above_a_level_wall_the_rim_is_found_however_short_its_sides_are) {
  const Sheet sheet(Eigen::Matrix3d::Identity(), 4);
  for (const int corners : {4, 12, 32, 128}) {
    const auto corner = [&](int k) {
      const double angle = 2 * 3.14159265358979 * (k + 0.5) / corners;
      return Vector(0.25 + 0.2 * std::cos(angle), 0.2 * std::sin(angle), 1e-4);
    };
    std::set<int> found;
    feeler::OutermostAtRim<double, double>(sheet.mesh, sheet.mesh.walls().of_triangle(0), corners, corner, Vector::UnitZ())
        .find([](int) { return false; }, [&](int t) { found.insert(t); });
    BOOST_TEST(found.size() == 2U, corners << " corners");
  }
}

BOOST_AUTO_TEST_CASE(of_a_face_of_as_many_corners_as_there_is_room_for_each_counts) {
  // A round face whose corners point at the rim one by one: only the tip of that corner is over it.
  const Sheet sheet(Eigen::Matrix3d::Identity(), 4);
  constexpr int corners = feeler::OutermostAtRim<double, double>::capacity;
  const double radius = 0.1, step = 2 * 3.14159265358979 / corners, distance = radius * (1 + std::cos(step)) / 2;
  for (const int tip : {0, 1, 64, 127}) {
    const auto corner = [&](int k) {
      const double angle = step * (k - tip) - 3.14159265358979 / 2;
      return Vector(0.4 + radius * std::cos(angle), distance + radius * std::sin(angle), 1e-6);
    };
    std::set<int> found;
    feeler::OutermostAtRim<double, double>(sheet.mesh, sheet.mesh.walls().of_triangle(0), corners, corner, Vector::UnitZ())
        .find([](int) { return false; }, [&](int t) { found.insert(t); });
    BOOST_TEST(found.size() == 1U, "corner " << tip);
  }
}

BOOST_AUTO_TEST_SUITE_END()
