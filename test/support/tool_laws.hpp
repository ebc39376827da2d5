// The laws that every convex tool obeys, as one call: check_tool_laws(tool).
#pragma once

#include <boost/test/unit_test.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "feeler/tool/convex_tool.hpp"
#include "support/random_geometry.hpp"

namespace feeler_test {

/// Checks a tool against the definition of its features, in long double.
/// @param solid  the tool has a volume: Euler's formula holds, and every edge is shared by two faces
template <feeler::ConvexTool Tool>
void check_tool_laws(const Tool& tool, bool solid = true, unsigned seed = 1) {
  using Scalar = typename Tool::Scalar;
  using Wide = feeler::Vector3<long double>;
  const auto wide = [](const feeler::Vector3<Scalar>& v) { return Wide(v.template cast<long double>()); };
  BOOST_TEST_MESSAGE("seed " << seed);
  const int n = tool.vertex_count();
  BOOST_TEST_REQUIRE(n >= 1);
  Wide lower = wide(tool.vertex(0)), upper = lower;
  for (int i = 0; i < n; ++i) {
    lower = lower.cwiseMin(wide(tool.vertex(i)));
    upper = upper.cwiseMax(wide(tool.vertex(i)));
  }
  const auto eps = static_cast<long double>(std::numeric_limits<Scalar>::epsilon());
  const long double size = (upper - lower).norm() + std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
  const long double tolerance = 16 * eps * size;

  // support is a vertex with the largest dot product, to the rounding of a dot product
  std::mt19937 bits(seed);
  const auto check_support = [&](const feeler::Vector3<Scalar>& direction) {
    const int found = tool.support(direction);
    BOOST_TEST_REQUIRE((found >= 0 && found < n));
    long double best = -std::numeric_limits<long double>::infinity();
    for (int i = 0; i < n; ++i) best = std::max(best, wide(direction).dot(wide(tool.vertex(i))));
    BOOST_TEST(wide(direction).dot(wide(tool.vertex(found))) >= best - 4 * eps * size * wide(direction).norm());
    BOOST_TEST(std::abs(static_cast<long double>(feeler::highest_along(tool, direction)) - best) <= 4 * eps * size * wide(direction).norm());
  };
  for (int i = 0; i < 200; ++i) check_support(random_vector(bits).cast<Scalar>());
  for (int k = 0; k < 3; ++k) {
    check_support(feeler::Vector3<Scalar>::Unit(k));
    check_support(-feeler::Vector3<Scalar>::Unit(k));
  }
  const int any = tool.support(feeler::Vector3<Scalar>::Constant(std::numeric_limits<Scalar>::quiet_NaN()));
  BOOST_TEST((any >= 0 && any < n));

  // edges join two vertices, each pair once, and have a direction listed
  std::set<std::pair<int, int>> edges;
  for (int i = 0; i < tool.edge_count(); ++i) {
    const feeler::ToolEdge edge = tool.edge(i);
    BOOST_TEST_REQUIRE((edge.start >= 0 && edge.start < n && edge.end >= 0 && edge.end < n && edge.start != edge.end));
    BOOST_TEST(edges.insert(std::minmax({edge.start, edge.end})).second);
    const Wide along = wide(tool.vertex(edge.end)) - wide(tool.vertex(edge.start));
    long double off = std::numeric_limits<long double>::infinity();
    for (int d = 0; d < tool.edge_direction_count(); ++d) off = std::min(off, along.cross(wide(tool.edge_direction(d)).normalized()).norm());
    BOOST_TEST(off <= 32 * eps * along.norm() + tolerance);
  }
  for (int a = 0; a < tool.edge_direction_count(); ++a)
    for (int b = 0; b < a; ++b) BOOST_TEST(wide(tool.edge_direction(a)).normalized().cross(wide(tool.edge_direction(b)).normalized()).norm() > 0);

  // faces are planar, support the tool from outside, run counter-clockwise, and have an axis listed
  std::map<std::pair<int, int>, int> sides;
  for (int i = 0; i < tool.face_count(); ++i) {
    const auto face = tool.face(i);
    const Wide face_normal = wide(face.normal);
    BOOST_TEST(std::abs(face_normal.norm() - 1) < 4 * eps);
    const auto corners = face.vertices;
    BOOST_TEST_REQUIRE(corners.size() >= 3);
    const Wide first = wide(tool.vertex(corners[0]));
    Wide area = Wide::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int start = corners[k], end = corners[(k + 1) % corners.size()];
      BOOST_TEST(++sides[std::make_pair(start, end)] == 1);
      BOOST_TEST(edges.count(std::minmax({start, end})) == 1);
      BOOST_TEST(std::abs(face_normal.dot(wide(tool.vertex(start)) - first)) <= tolerance);
      area += (wide(tool.vertex(start)) - first).cross(wide(tool.vertex(end)) - first);
    }
    BOOST_TEST(area.dot(face_normal) > 0);
    for (int v = 0; v < n; ++v) BOOST_TEST(face_normal.dot(wide(tool.vertex(v)) - first) <= tolerance);
    long double off = std::numeric_limits<long double>::infinity();
    for (int a = 0; a < tool.face_axis_count(); ++a) off = std::min(off, face_normal.cross(wide(tool.face_axis(a)).normalized()).norm());
    BOOST_TEST(off <= 64 * eps);
  }
  if (!solid) return;
  BOOST_TEST(n - tool.edge_count() + tool.face_count() == 2);
  BOOST_TEST(sides.size() == 2 * edges.size());
  for (const auto& [side, count] : sides) BOOST_TEST(sides.count({side.second, side.first}) == 1);
}

}  // namespace feeler_test
