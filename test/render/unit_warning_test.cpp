// Numbers that look like millimetres are told, those of a bench are not.
#include <boost/test/unit_test.hpp>

#include <vector>

#include "feeler/render/unit_warning.hpp"
#include "feeler/tool/compound_tool.hpp"
#include "feeler/tool/sphere_swept.hpp"
#include "support/refusal.hpp"

BOOST_AUTO_TEST_SUITE(units)

using namespace feeler;
using feeler_test::contains;

BOOST_AUTO_TEST_CASE(an_object_of_100_and_a_tool_of_5_are_told_to_look_like_millimetres) {
  const Points<double> corners{{0, 0, 0}, {100, 0, 0}, {0, 50, 0}};
  const Triangles triangle{{0, 1, 2}};
  const TriangleMesh<double> object(corners, triangle, 0.001), huge(corners, triangle);
  const Box<double> tool({0.005, 0.004, 0.003});
  BOOST_TEST(unit_warning(object, tool).empty());
  BOOST_TEST(contains(unit_warning(huge, tool), "The object is 100 m wide and the tool 0.01 m; if the object's numbers are in millimetres"));
  BOOST_TEST(contains(unit_warning(object, Box<double>({2.5, 1, 1})), "the tool 5 m; if the numbers are in millimetres"));
  BOOST_TEST(width_of(Sphere<double>(2.5)) == 5);
  BOOST_TEST(width_of(Capsule<double>({{0, 0, -1}, {0, 0, 2}}, 0.5)) == 4);
  const std::vector<Sphere<double>> apart{{Vector3<double>(1, 0, 0), 0.5}, {Vector3<double>(4, 0, 0), 0.5}};
  BOOST_TEST(width_of(CompoundTool<Sphere<double>>(apart)) == 4);
}

BOOST_AUTO_TEST_SUITE_END()
