// Where contacts are said to be: on the triangle that they are of, for sharp tools and for round ones, on faces, edges and corners.
#include "feeler/render/closest_features.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "feeler/feeler.hpp"
#include "support/random_tools.hpp"
#include "support/rendering.hpp"
#include "support/wide_distance.hpp"

BOOST_AUTO_TEST_SUITE(closest_features)

using namespace feeler;
using namespace feeler_test;

namespace {

constexpr double margin = 1e-6;

/// Four triangles down from a corner at the origin.
TriangleMesh<double> tip() {
  return {Points<double>{{0, 0, 0}, {0.1, 0, -0.04}, {0, 0.1, -0.04}, {-0.1, 0, -0.04}, {0, -0.1, -0.04}},
          Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
}

/// Distance of a point from a triangle, in long double [m].
double distance(const Vector3<double>& point, const Matrix3<double>& corners) {
  return double(feeler::test::closest_features(feeler::test::WideTool(Point<double>(point)), wide(corners)).distance);
}

/// Presses a tool on the tip from many sides, and looks at where it is held; returns in how many places.
template <class Tool>
int press(const Tool& tool, double size) {
  std::mt19937 bits(1);
  const TriangleMesh<double> object = tip();
  HapticRenderer renderer(object, tool);
  int count = 0;
  for (int round = 0; round < 12; ++round) {
    const Quaternion<double> rotation(Eigen::AngleAxisd(0.3 * unit(bits), random_direction(bits)));
    const Vector3<double> beside(0.3 * size * unit(bits), 0.3 * size * unit(bits), 0);
    renderer.reset({beside + Vector3<double>(0, 0, 3 * size), rotation});
    for (int i = 0; i < 30; ++i) renderer.update({beside + Vector3<double>(0, 0, size * (i < 20 ? 3 - 0.15 * i : 0)), rotation});
    for (const auto& contact : renderer.tick().contacts) {
      const double off = distance(contact.point_world, object.corners(contact.triangle));
      BOOST_TEST(off <= 2 * margin, "round " << round << ": " << off << " m");
      BOOST_TEST(contact.normal_world.norm() == 1.0, boost::test_tools::tolerance(1e-14));
      ++count;
    }
  }
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(contacts_of_a_box_are_on_their_triangles) { BOOST_TEST(press(Box<double>({0.01, 0.008, 0.004}), 0.01) >= 12); }
BOOST_AUTO_TEST_CASE(contacts_of_a_ball_and_of_a_capsule_are_on_their_triangles) {
  BOOST_TEST(press(Sphere<double>(0.01), 0.01) >= 12);
  BOOST_TEST(press(Capsule<double>({{-0.01, 0, 0}, {0.01, 0, 0}}, 0.004), 0.01) >= 12);
}
BOOST_AUTO_TEST_CASE(contacts_of_a_rounded_box_are_on_their_triangles_also_where_a_face_meets_a_corner) {
  BOOST_TEST(press(RoundedBox<double>(Box<double>({0.01, 0.008, 0.004}), 0.002), 0.01) >= 12);
}

BOOST_AUTO_TEST_SUITE_END()
