// Objects of several meshes: parts that touch, that intersect, and open sheets among them.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>

#include "feeler/object/mesh_assembly.hpp"
#include "scenes/motions.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(several_meshes)

using namespace feeler;
using namespace feeler::test;

namespace {

/// A closed block; a face of it is cut into n×n squares of two triangles.
struct Block {
  Points<double> vertices;
  Triangles triangles;

  Block(const Vector3<double>& low, const Vector3<double>& high, int n) {
    const int side = (n + 1) * (n + 1);
    vertices.resize(6 * side, 3);
    triangles.resize(12 * n * n, 3);
    int triangle = 0;
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
      const bool is_high = face % 2 == 1;
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          const int row = face * side + i * (n + 1) + j;
          vertices(row, axis) = (is_high ? high : low)[axis];
          vertices(row, u) = low[u] + (high[u] - low[u]) * i / n;
          vertices(row, v) = low[v] + (high[v] - low[v]) * j / n;
          if (i == n || j == n) continue;
          const int next = row + n + 1;
          if (is_high) {
            triangles.row(triangle++) << row, next, next + 1;
            triangles.row(triangle++) << row, next + 1, row + 1;
          } else {
            triangles.row(triangle++) << row, next + 1, next;
            triangles.row(triangle++) << row, row + 1, next + 1;
          }
        }
      }
    }
  }
};

constexpr double margin = 1e-6;

}  // namespace

BOOST_AUTO_TEST_CASE(a_part_is_placed_by_its_pose_and_found_by_its_triangles) {
  const Block block({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}, 1);
  MeshAssembly<double> assembly;
  BOOST_TEST(assembly.add(block.vertices, block.triangles) == 0);
  const Pose<double> pose = scenes::pose_of({0.3, -0.4, 1.2}, {0.1, 0.2, 0.3});
  BOOST_TEST(assembly.add(block.vertices, block.triangles, pose) == 1);
  const TriangleMesh<double> mesh = assembly.mesh();
  BOOST_TEST(mesh.triangle_count() == 24);
  BOOST_TEST(assembly.first_triangle(1) == 12);
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    BOOST_TEST(assembly.part_of(i) == i / 12);
    for (int k = 0; k < 3; ++k) {
      const Vector3<double> own = block.vertices.row(block.triangles(i % 12, k)).transpose();
      BOOST_TEST((mesh.corners(i).col(k) - (i < 12 ? own : pose * own)).norm() < 1e-16);
    }
  }
  Triangles wrong = block.triangles;
  wrong(3, 1) = 24;  // would be the first vertex of the next part
  BOOST_CHECK_EXCEPTION(assembly.add(block.vertices, wrong), std::invalid_argument, [](const std::exception& problem) {
    return std::string(problem.what()).find("triangle 3 of part 2 has the index 24, but the part has 24 vertices") != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(a_tool_slides_over_the_seam_of_parts_that_touch_and_is_late_there_by_a_tick_at_most) {
  // Their tops are one plane, cut into other triangles on each side, and the faces between them lie on each other.
  MeshAssembly<double> assembly;
  const Block left({-0.04, -0.03, -0.02}, {0, 0.03, 0}, 2), right({0, -0.03, -0.02}, {0.04, 0.03, 0}, 3);
  assembly.add(left.vertices, left.triangles);
  assembly.add(right.vertices, right.triangles);
  const TriangleMesh<double> object = assembly.mesh();
  const Box<double> tool({0.005, 0.004, 0.003});
  for (const double turn : {0.0, 0.4}) {
    HapticRenderer renderer(object, tool);
    BOOST_TEST((renderer.reset(scenes::pose_of({0, 0, turn}, {-0.02, 0.001, 0.004})) == Status::converged));
    std::set<int> parts;
    double worst_height = 0, worst_slide = 0;
    int late = 0;
    for (int i = 0; i <= 400; ++i) {
      const double x = -0.02 + 1e-4 * i;
      const auto& tick = renderer.update(scenes::pose_of({0, 0, turn}, {x, 0.001, 0.002}));
      if (i == 0) continue;
      for (const auto& contact : tick.contacts) parts.insert(assembly.part_of(contact.triangle));
      const double height = tick.graphic_pose.translation.z() - 0.003;
      BOOST_TEST(std::abs(height - margin) < 2 * margin);
      if (!tick.converged()) {
        ++late;
        continue;
      }
      worst_height = std::max(worst_height, std::abs(height - margin));
      worst_slide = std::max(worst_slide, std::abs(tick.graphic_pose.translation.x() - x));
    }
    BOOST_TEST(late <= 1);
    BOOST_TEST(worst_height < 1e-9);
    BOOST_TEST(worst_slide < 1e-9);
    BOOST_TEST(parts.size() == 2U);
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_penetrated_where_parts_intersect_and_sheets_stand_on_them) {
  MeshAssembly<double> assembly;
  const Block block({-0.02, -0.02, -0.01}, {0.02, 0.02, 0.01}, 2);
  assembly.add(block.vertices, block.triangles);
  assembly.add(block.vertices, block.triangles, scenes::pose_of({0.4, 0.2, 0.7}, {0.02, 0.005, 0.006}));
  Points<double> sheet(4, 3);
  sheet << -0.02, 0, -0.02, 0.02, 0, -0.02, 0.02, 0, 0.02, -0.02, 0, 0.02;
  Triangles halves(2, 3);
  halves << 0, 1, 2, 0, 2, 3;
  assembly.add(sheet, halves, scenes::pose_of({0, 0.1, -0.3}, {-0.005, 0, 0.008}));
  const TriangleMesh<double> object = assembly.mesh();
  const Box<double> tool({0.004, 0.003, 0.005});
  const Witness witness(assembly.vertices(), assembly.triangles(), tool);
  const auto motion = [](double t) {
    return scenes::pose_of({0.6 * std::sin(3 * t), 0.5 * std::sin(4 * t), 2 * std::sin(0.7 * t)},
                           {0.025 * std::sin(1.3 * t), 0.02 * std::sin(1.7 * t), 0.024 + 0.018 * std::cos(2.9 * t)});
  };
  for (const bool is_hostile : {false, true}) {
    const auto device = is_hostile ? scenes::hostile(motion, 5) : std::function<Pose<double>(double)>(motion);
    HapticRenderer renderer(object, tool);
    BOOST_TEST((renderer.reset(motion(0)) == Status::converged));
    std::set<int> parts;
    double deepest = 0;
    const int ticks = ticks_to_run(4000);
    for (int i = 1; i <= ticks; ++i) {
      const Pose<double> before = renderer.tick().graphic_pose;
      const auto& tick = renderer.update(device(i * 1e-3));
      for (const auto& contact : tick.contacts) parts.insert(assembly.part_of(contact.triangle));
      if (i % 4 == 0) deepest = std::max(deepest, witness.depth_on_way(before, tick, 2));
    }
    BOOST_TEST(deepest <= touching_depth);
    if (runs_all_ticks) BOOST_TEST(parts.size() == 3U);
  }
}

BOOST_AUTO_TEST_SUITE_END()
