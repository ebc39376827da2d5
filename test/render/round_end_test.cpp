// A cylinder stands on its round end: more corners touch than any problem needs, and those that tilting would bring down must be among its rows.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

#include "feeler/tool/round_solids.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(round_end)

using namespace feeler;
using namespace feeler::test;

BOOST_AUTO_TEST_CASE(a_cylinder_pressed_onto_a_floor_and_tilted_about_comes_to_rest_in_each_tick) {
  Points<double> corners(4, 3);
  corners << -0.1, -0.1, 0, 0.1, -0.1, 0, 0.1, 0.1, 0, -0.1, 0.1, 0;
  Triangles halves(2, 3);
  halves << 0, 1, 2, 0, 2, 3;
  const TriangleMesh<double> floor(corners, halves);
  for (const int facets : {16, 24, 32, 128, 500}) {
    const auto tool = cylinder<double>(0.015, 0.02, facets);
    HapticRenderer renderer(floor, tool);
    BOOST_TEST_REQUIRE((renderer.reset({.translation = {0, 0, 0.015}}) == Status::converged));
    int converged = 0;
    double lowest = 1;
    for (int i = 0; i < 1000; ++i) {
      const double t = 0.01 * i;
      const Pose<double> hand{.translation = {0.02 * std::sin(0.7 * t), 0.02 * std::cos(0.9 * t) - 0.02, 0.008 + 0.001 * std::sin(3 * t)},
                              .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.05 * std::sin(2 * t), Eigen::Vector3d::UnitX()) *
                                                             Eigen::AngleAxisd(0.05 * std::cos(1.7 * t), Eigen::Vector3d::UnitY()))};
      const auto& tick = renderer.update(hand);
      converged += tick.converged() ? 1 : 0;
      for (int k = 0; k < tool.vertex_count(); ++k) lowest = std::min(lowest, (tick.graphic_pose * tool.vertex(k)).z());
    }
    BOOST_TEST_CONTEXT("facets " << facets) {
      BOOST_TEST(converged >= 985);
      BOOST_TEST(lowest > 0);
      BOOST_TEST(lowest < 2e-6);  // it did stand there
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
