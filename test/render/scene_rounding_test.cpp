// What rounding can do in a scene: lengths by hand, and poses that are rounded.
#include "feeler/render/scene_rounding.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "feeler/spatial/pose.hpp"
#include "feeler/tool/compound_tool.hpp"
#include "support/random_tools.hpp"

BOOST_AUTO_TEST_SUITE(scene_rounding)

using namespace feeler_test;

using feeler::SceneRounding;

namespace {

/// A triangle that fills the box between two points.
template <class Scalar>
feeler::TriangleMesh<Scalar> triangle_in(const Vector& lower, const Vector& upper) {
  feeler::Points<Scalar> vertices(3, 3);
  vertices.row(0) = lower.cast<Scalar>().transpose();
  vertices.row(1) = upper.cast<Scalar>().transpose();
  vertices.row(2) << Scalar(lower.x()), Scalar(upper.y()), Scalar(lower.z());
  return {vertices, feeler::Triangles{{0, 1, 2}}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(lengths_are_those_of_the_round_surface_about_the_reference_point_and_of_the_farthest_corner_of_the_object) {
  // A ball of 0.5 m with its centre 5 m from the origin of its frame, held 13 m from its centre and 12 m from that origin.
  const feeler::Sphere<double> ball(feeler::Point<double>({3, 0, 4}), 0.5);
  const Vector reference(0, 12, 0);
  const auto object = triangle_in<double>({-4, 1, -2}, {2, 3, 4});  // 6, 2 and 6 m wide; the farthest corner has coordinates 4, 3 and 4
  const SceneRounding<double, double> rounding(object, ball, reference);
  BOOST_TEST(rounding.size == 13.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(rounding.reach == 25.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(rounding.farthest == std::sqrt(41.0), boost::test_tools::tolerance(1e-15));
  BOOST_TEST((SceneRounding<double, double>(object, ball, {3, 0, 4}).size == object.bounds().diagonal().norm()));

  // Of pieces the farthest counts, wherever it stands among them.
  using Box = feeler::Box<double>;
  using Hull = feeler::ConvexPolytope<double>;
  const auto cube_at = [](double x) {
    feeler::Points<double> corners(8, 3);
    for (int i = 0; i < 8; ++i) corners.row(i) << x + (i & 1), i >> 1 & 1, i >> 2;
    return Hull::hull_of(corners);
  };
  for (const bool is_first : {true, false}) {
    const feeler::CompoundTool<Hull> pieces({cube_at(is_first ? 90 : 0), cube_at(is_first ? 0 : 90)});
    BOOST_TEST((SceneRounding<double, double>(object, pieces, Vector::Zero()).reach == std::sqrt(91.0 * 91 + 2)),
               boost::test_tools::tolerance(1e-15));
  }
  BOOST_TEST((SceneRounding<double, double>(object, Box({2, 3, 6}), Vector::Zero()).reach == 7.0));
}

BOOST_AUTO_TEST_CASE(poses_of_float_move_no_point_of_a_touching_tool_farther_than_is_said) {
  // Worst is a last bit of half a unit in each place: of the translation, and twice each of a quaternion, which turns and stretches.
  std::mt19937 bits(1);
  const long double half_a_unit = std::ldexp(1.0L, -24);
  for (int round = 0; round < 50; ++round) {
    const feeler::Box<double> tool = random_box(bits);
    const Vector reference = magnitude(bits, -2, 1) * random_direction(bits), corner = magnitude(bits, -2, 2) * random_direction(bits);
    const auto object = triangle_in<float>(-corner.cwiseAbs(), corner.cwiseAbs());
    const SceneRounding<float, double> rounding(object, tool, reference);
    const long double expected = half_a_unit * (rounding.farthest + rounding.reach) + 4 * half_a_unit * rounding.reach;
    BOOST_TEST(rounding.of_poses() == double(expected), boost::test_tools::tolerance(1e-14));
    double most = 0;
    for (int i = 0; i < 200; ++i) {
      // The tool touches the corner that is farthest away, with one of its vertices.
      const Eigen::Quaterniond rotation = random_rotation(bits);
      const Vector vertex = tool.vertex(below(bits, 8));
      const feeler::Pose<double> pose{Vector(corner.cwiseAbs().cast<float>().cast<double>() - rotation * vertex), rotation};
      const feeler::Pose<double> rounded = pose.cast<float>().cast<double>();
      const Vector moved = rounded.translation + rounded.rotation.toRotationMatrix() * vertex;
      most = std::max(most, (moved - pose * vertex).norm());
    }
    BOOST_TEST(most <= rounding.of_poses());
  }
}

BOOST_AUTO_TEST_SUITE_END()
