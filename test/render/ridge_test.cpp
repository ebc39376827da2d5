// A tool that slips over a ridge: the chord to the far side runs through the object, the way along the
// tangent does not.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/steps.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(ridge)

using namespace feeler;
using namespace feeler::test;

namespace {

constexpr double slope = std::numbers::pi / 6;
constexpr double half_width = 0.05;

/// A roof with its ridge along y at height 0.
TriangleMesh<double> roof() {
  const double eaves = -half_width * std::tan(slope);
  Points<double> vertices(6, 3);
  vertices << -half_width, -0.1, eaves, 0, -0.1, 0, half_width, -0.1, eaves, -half_width, 0.1, eaves, 0, 0.1, 0, half_width, 0.1, eaves;
  Triangles triangles(4, 3);
  triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4;
  return {vertices, triangles};
}

struct Crossing {
  int slips = 0;  // ticks in which the tool moved from one side to the other
  int most_iterations = 0;
  int unconverged = 0;
  double farthest = 0;  // of a tool in contact from the roof [m]
};

/// The hand moves to and fro below the ridge, with the tip of the tool at a depth, and turns meanwhile.
template <class Tool>
Crossing cross(const Tool& tool, double tip, double depth, double turn) {
  const TriangleMesh<double> object = roof();
  HapticRenderer renderer(object, tool);
  Pose<double> hand{.translation = {-0.01, 0.003, 0.02 - tip}};
  BOOST_TEST_REQUIRE((renderer.reset(hand) == Status::converged));
  Crossing result;
  double last_side = -1;
  for (int i = 0; i < 450; ++i) {
    const double phase = std::max(0, i - 50) * 0.02;
    hand.translation = {-0.01 * std::cos(phase), 0.003 * std::cos(0.7 * phase), (i < 50 ? 0.02 - (0.02 + depth) * i / 50 : -depth) - tip};
    hand.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(turn * std::sin(phase), Eigen::Vector3d(1, 2, 3).normalized()));
    const auto& tick = renderer.update(hand);
    result.most_iterations = std::max(result.most_iterations, tick.iterations);
    result.unconverged += tick.converged() ? 0 : 1;
    const double side = std::copysign(1.0, (tick.graphic_pose * Eigen::Vector3d(0, 0, tip)).x());
    if (side != last_side && !tick.contacts.empty()) ++result.slips;
    last_side = side;
    if (tick.contacts.empty()) continue;
    double height = 1;
    for (int k = 0; k < tool.vertex_count(); ++k) {
      const Eigen::Vector3d vertex = tick.graphic_pose * tool.vertex(k);
      height = std::min(height, std::cos(slope) * (vertex.z() + std::tan(slope) * std::abs(vertex.x())));
    }
    result.farthest = std::max(result.farthest, height);
  }
  return result;
}

/// Each crossing is made in the tick in which its side of the ridge no longer holds the tool.
void check(const Crossing& found) {
  BOOST_TEST(found.slips == 2);
  BOOST_TEST(found.most_iterations <= 11);
  BOOST_TEST(found.unconverged == 0);
  BOOST_TEST(found.farthest < 1.001e-6);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_point_slips_over_it_at_once) {
  for (const double depth : {0.006, 0.007, 0.009}) {
    BOOST_TEST_CONTEXT("depth " << depth << " m") check(cross(Point<double>(), 0, depth, 0));
  }
}

BOOST_AUTO_TEST_CASE(a_tip_that_turns_slips_over_it_at_once) {
  Points<double> corners(5, 3);
  corners << 0, 0, -0.01, 0.002, 0, 0.01, 0, 0.002, 0.01, -0.002, 0, 0.01, 0, -0.002, 0.01;
  for (const double depth : {0.006, 0.007, 0.009}) {
    BOOST_TEST_CONTEXT("depth " << depth << " m")
    check(cross(ConvexPolytope<double>::hull_of(corners), -0.01, depth, 0.1));
  }
}

BOOST_AUTO_TEST_CASE(a_tool_that_falls_off_an_edge_is_down_in_ten_milliseconds_however_freely_it_turns) {
  // On one contact the optimum may be so flat that the step to it is of more than a turn.
  for (const scenes::Scene& scene : {scenes::steps(), scenes::steps_with_prism()}) {
    BOOST_TEST_CONTEXT(scene.name) {
      const TriangleMesh<double> object(scene.vertices, scene.triangles);
      with_tool_of(scene, [&](const auto& tool) {
        HapticRenderer renderer(object, tool, scene.settings());
        BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
        int falls = 0, on_its_way = 0, longest = 0;
        for (int i = 1; i <= 20'000; ++i) {
          const bool is_there = renderer.update(scene.motion(i * 1e-3)).converged();
          if (!is_there && on_its_way++ == 0) ++falls;
          if (is_there) on_its_way = 0;
          longest = std::max(longest, on_its_way);
        }
        BOOST_TEST(falls > 5);
        BOOST_TEST(longest <= 10);
      });
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
