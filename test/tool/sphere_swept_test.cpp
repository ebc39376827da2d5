#include "feeler/tool/sphere_swept.hpp"

#include <boost/test/unit_test.hpp>

#include <limits>
#include <type_traits>

#include "support/refusal.hpp"
#include "support/tool_laws.hpp"

BOOST_AUTO_TEST_SUITE(sphere_swept)

using feeler::Box;
using feeler::Capsule;
using feeler::ConvexPolytope;
using feeler::Point;
using feeler::RoundedBox;
using feeler::RoundedPolytope;
using feeler::Segment;
using feeler::Sphere;
using feeler::SphereSwept;
using feeler_test::contains;
using feeler_test::refusal;
using Vector = feeler::Vector3<double>;

namespace {
template <class Tool>
void check_in_every_scalar(const Tool& tool, bool solid) {
  feeler_test::check_tool_laws(tool, solid);
  feeler_test::check_tool_laws(tool.template cast<float>(), solid);
  // A polytope's normals are those of the scalar it was built in.
  if constexpr (!std::is_same_v<Tool, RoundedPolytope<double>>) feeler_test::check_tool_laws(tool.template cast<long double>(), solid);
}
}  // namespace

BOOST_AUTO_TEST_CASE(points_and_swept_tools_obey_the_laws_of_their_cores_in_every_scalar) {
  check_in_every_scalar(Point<double>(), false);
  check_in_every_scalar(Point<double>(Vector(1, -2, 3)), false);
  check_in_every_scalar(Sphere<double>(0.01), false);
  check_in_every_scalar(Capsule<double>({{0, 0, -1}, {0.5, 0, 1}}, 0.25), false);
  check_in_every_scalar(RoundedBox<double>(Box<double>({1, 2, 3}), 0.5), true);
  check_in_every_scalar(
      RoundedPolytope<double>(ConvexPolytope<double>::hull_of(feeler::Points<double>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 0.125), true);
}

BOOST_AUTO_TEST_CASE(a_swept_tool_is_its_core_and_a_radius_in_every_scalar) {
  const RoundedBox<double> box(Box<double>({1, 2, 3}), 0.5);
  BOOST_TEST(box.swept_radius() == 0.5);
  BOOST_TEST(box.cast<float>().swept_radius() == 0.5F);
  BOOST_TEST(feeler::swept_radius(box) == 0.5);
  BOOST_TEST(feeler::swept_radius(box.core()) == 0);
  BOOST_TEST(box.vertex_count() == 8);
  BOOST_TEST((box.vertex(box.support({1, -1, 1})) == Vector(1, -2, 3)));
  BOOST_TEST((Sphere<double>(Vector(1, 2, 3), 0.5).vertex(0) == Vector(1, 2, 3)));
  BOOST_TEST((Sphere<double>({1, 2, 3}, 0.5).vertex(0) == Vector(1, 2, 3)));
  BOOST_TEST((Sphere<double>(0.5).vertex(0) == Vector(0, 0, 0)));
}

BOOST_AUTO_TEST_CASE(a_tool_says_by_its_type_which_turns_leave_it_as_it_is) {
  using enum feeler::Symmetry;
  static_assert(feeler::symmetry_of<Sphere<double>> == about_point);
  static_assert(feeler::symmetry_of<Segment<double>> == about_axis);
  static_assert(feeler::symmetry_of<Capsule<float>> == about_axis);
  static_assert(feeler::symmetry_of<RoundedBox<double>> == none);
  static_assert(feeler::symmetry_of<Box<double>> == none);
  BOOST_TEST(true);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_with_a_sentence) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  BOOST_TEST(contains(refusal([&] { Point<double>(Vector(0, nan, 0)); }), "NaN"));
  for (const double radius : {0.0, -1.0, 1e-8}) BOOST_TEST(contains(refusal([&] { Sphere<double> tool(radius); }), "under 1e-7"));
  for (const double radius : {nan, infinity}) BOOST_TEST(contains(refusal([&] { Sphere<double> tool(radius); }), "NaN or infinite"));
  BOOST_TEST(refusal([] { Sphere<double> tool(1e-7); }) == "accepted");
}

BOOST_AUTO_TEST_CASE(a_point_and_a_sphere_are_where_they_were_in_another_scalar) {
  using Narrow = feeler::Vector3<float>;
  BOOST_TEST((Point<double>(Vector(1, -2, 3)).cast<float>().vertex(0) == Narrow(1, -2, 3)));
  BOOST_TEST((Sphere<double>(Vector(1, -2, 3), 0.5).cast<float>().vertex(0) == Narrow(1, -2, 3)));
  BOOST_TEST((Capsule<double>({{0, 0, -1}, {0.5, 0, 1}}, 0.25).cast<float>().vertex(1) == Narrow(0.5F, 0, 1)));
}

BOOST_AUTO_TEST_SUITE_END()
