#include "feeler/tool/compound_tool.hpp"

#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

#include "feeler/tool/box.hpp"
#include "support/refusal.hpp"
#include "support/tool_laws.hpp"

BOOST_AUTO_TEST_SUITE(compound_tool)

using feeler::Box;
using feeler::CompoundTool;
using feeler::ConvexPolytope;
using feeler_test::contains;
using Hull = ConvexPolytope<double>;
using Vector = feeler::Vector3<double>;

namespace {
feeler::Points<double> cuboid(const Vector& centre, const Vector& half) {
  feeler::Points<double> points(8, 3);
  for (int i = 0; i < 8; ++i) points.row(i) = (centre + Box<double>(half).vertex(i)).transpose();
  return points;
}
std::string refusal_of(std::size_t pieces) {
  return feeler_test::refusal([&] { CompoundTool<Box<double>>(std::vector<Box<double>>(pieces, Box<double>(Vector(1, 1, 1)))); });
}
}  // namespace

BOOST_AUTO_TEST_CASE(pieces_keep_their_order_and_their_place_in_the_tool_frame) {
  const std::vector<feeler::Points<double>> sets{cuboid({0, 0, 0}, {1, 1, 1}), cuboid({3, 0, 0}, {2, 1, 0.5})};
  const auto tool = CompoundTool<Hull>::hulls_of(sets);
  BOOST_TEST_REQUIRE(tool.piece_count() == 2);
  for (int i = 0; i < 2; ++i) feeler_test::check_tool_laws(tool.piece(i));
  BOOST_TEST(tool.piece(0).vertex(tool.piece(0).support(Vector::UnitX())).x() == 1);
  BOOST_TEST(tool.piece(1).vertex(tool.piece(1).support(Vector::UnitX())).x() == 5);
  const auto narrow = tool.cast<float>();
  BOOST_TEST(narrow.piece_count() == 2);
  BOOST_TEST(narrow.piece(1).vertex(narrow.piece(1).support(feeler::Vector3<float>::UnitX())).x() == 5.0f);
}

BOOST_AUTO_TEST_CASE(no_pieces_and_more_than_64_are_refused_with_a_sentence) {
  BOOST_TEST(contains(refusal_of(0), "at least one"));
  BOOST_TEST(contains(refusal_of(65), "65 pieces, more than 64"));
  BOOST_TEST(refusal_of(64) == "accepted");
}

BOOST_AUTO_TEST_CASE(a_convex_tool_is_its_own_only_piece) {
  const Box<double> box(Vector(1, 2, 3));
  BOOST_TEST(feeler::piece_count(box) == 1);
  BOOST_TEST(&feeler::piece_of(box, 0) == &box);
  static_assert(feeler::maximum_pieces<Box<double>> == 1);
  static_assert(feeler::maximum_pieces<CompoundTool<Hull>> == 64);
  static_assert(!feeler::CompoundShape<Box<double>> && !feeler::ConvexTool<CompoundTool<Hull>>);
}

BOOST_AUTO_TEST_SUITE_END()
