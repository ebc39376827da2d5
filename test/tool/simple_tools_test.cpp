#include <boost/test/unit_test.hpp>

#include <limits>

#include "feeler/tool/box.hpp"
#include "feeler/tool/segment.hpp"
#include "support/refusal.hpp"
#include "support/tool_laws.hpp"

BOOST_AUTO_TEST_SUITE(simple_tools)

using feeler::Box;
using feeler::Segment;
using feeler_test::contains;
using feeler_test::refusal;
using Vector = feeler::Vector3<double>;

BOOST_AUTO_TEST_CASE(box_and_segment_obey_the_laws_in_every_scalar) {
  for (const Vector& h : {Vector(1, 2, 3), Vector(1e-6, 1, 1e6), Vector(0.01, 0.01, 0.01)}) {
    const Box<double> box(h);
    feeler_test::check_tool_laws(box);
    feeler_test::check_tool_laws(box.cast<float>());
    feeler_test::check_tool_laws(box.cast<long double>());
    const Segment<double> segment(h, -2 * h);
    feeler_test::check_tool_laws(segment, false);
    feeler_test::check_tool_laws(segment.cast<float>(), false);
    feeler_test::check_tool_laws(segment.cast<long double>(), false);
  }
}

BOOST_AUTO_TEST_CASE(box_has_the_counts_of_a_box_and_its_corners_are_exact) {
  const Box<double> box(Vector(1, 2, 3));
  BOOST_TEST(box.vertex_count() == 8);
  BOOST_TEST(box.edge_count() == 12);
  BOOST_TEST(box.face_count() == 6);
  BOOST_TEST(box.edge_direction_count() == 3);
  BOOST_TEST(box.face_axis_count() == 3);
  BOOST_TEST((box.vertex(box.support(Vector(1, -1, 1))) == Vector(1, -2, 3)));
}

BOOST_AUTO_TEST_CASE(segment_answers_with_the_end_that_is_farther) {
  const Segment<double> segment(Vector(0, 0, 1), Vector(0, 0, 5));
  BOOST_TEST(segment.support(Vector(0, 0, 1)) == 1);
  BOOST_TEST(segment.support(Vector(0, 0, -1)) == 0);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_with_a_sentence) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  BOOST_TEST(contains(refusal([] { Segment<double>(Vector(1, 2, 3), Vector(1, 2, 3)); }), "the same point"));
  BOOST_TEST(contains(refusal([&] { Segment<double>(Vector(nan, 2, 3), Vector(1, 2, 3)); }), "NaN"));
  BOOST_TEST(contains(refusal([&] { Segment<double>(Vector(1, 2, 3), Vector(1, infinity, 3)); }), "infinity"));
  BOOST_TEST(contains(refusal([] { Box<double>(Vector(1, 0, 1)); }), "zero or negative"));
  BOOST_TEST(contains(refusal([] { Box<double>(Vector(1, -1, 1)); }), "zero or negative"));
  BOOST_TEST(contains(refusal([&] { Box<double>(Vector(1, infinity, 1)); }), "infinity"));
}

BOOST_AUTO_TEST_CASE(the_middle_of_a_tool_is_the_mean_of_its_vertices) {
  BOOST_TEST(feeler::middle_of(Box<double>(Vector(1, 2, 3))).norm() == 0);
  BOOST_TEST((feeler::middle_of(Segment<double>(Vector(1, 2, 3), Vector(3, 0, -3))) == Vector(2, 1, 0)));
}

BOOST_AUTO_TEST_SUITE_END()
