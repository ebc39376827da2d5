#include "feeler/tool/round_solids.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/refusal.hpp"
#include "support/tool_laws.hpp"

BOOST_AUTO_TEST_SUITE(round_solids)

using feeler::ConvexPolytope;
using feeler::Facets;
using feeler_test::contains;
using feeler_test::refusal;
using Vector = feeler::Vector3<double>;

namespace {

/// How far the round shape reaches beyond the tool, and the tool beyond it, over directions across the z axis and askew [m].
struct Excess {
  double of_round = 0, of_tool = 0;
};
template <class RoundSupport>
Excess excess_of(const ConvexPolytope<double>& tool, const RoundSupport& round) {
  Excess excess;
  for (int i = 0; i < 4000; ++i) {
    const double turn = 0.0015708 * i, rise = (i % 7 - 3) * 0.4;
    const Vector n = Vector(std::cos(turn), std::sin(turn), rise).normalized();
    const double by_tool = n.dot(tool.vertex(tool.support(n)));
    excess.of_round = std::max(excess.of_round, round(n) - by_tool);
    excess.of_tool = std::max(excess.of_tool, by_tool - round(n));
  }
  return excess;
}

}  // namespace

BOOST_AUTO_TEST_CASE(cylinders_and_cones_obey_the_laws_and_have_the_features_of_prisms_and_pyramids) {
  for (const int facets : {3, 7, 32, 128}) {
    const auto prism = feeler::cylinder(0.01, 0.03, facets);
    feeler_test::check_tool_laws(prism);
    BOOST_TEST(prism.vertex_count() == 2 * facets);
    BOOST_TEST(prism.face_count() == facets + 2);
    BOOST_TEST(prism.edge_count() == 3 * facets);
    const auto pyramid = feeler::cone(0.01, 0.03, facets);
    feeler_test::check_tool_laws(pyramid);
    BOOST_TEST(pyramid.vertex_count() == facets + 1);
    BOOST_TEST(pyramid.face_count() == facets + 1);
  }
  BOOST_TEST(feeler::cone(0.01F, 0.03F, 255).vertex_count() == 256);
}

BOOST_AUTO_TEST_CASE(inscribed_and_circumscribed_tools_are_off_by_the_stated_error_on_one_side_only) {
  constexpr double radius = 0.01, height = 0.03;
  const auto round_cylinder = [](const Vector& n) { return radius * n.head<2>().norm() + height / 2 * std::abs(n.z()); };
  const auto round_cone = [](const Vector& n) { return std::max(0.0, radius * n.head<2>().norm() - height * n.z()); };
  for (const int facets : {5, 16, 64}) {
    const double inside = feeler::facet_error(radius, facets), outside = feeler::facet_error(radius, facets, Facets::circumscribed);
    BOOST_TEST(std::abs(inside - radius * (1 - std::cos(std::acos(-1.0) / facets))) <= 1e-17);
    BOOST_TEST(std::abs(outside - radius * (1 / std::cos(std::acos(-1.0) / facets) - 1)) <= 1e-17);
    const auto check = [&](const auto& round, const auto& build) {
      const Excess in = excess_of(build(Facets::inscribed), round), out = excess_of(build(Facets::circumscribed), round);
      BOOST_TEST(in.of_tool <= 1e-16);
      BOOST_TEST(in.of_round <= inside + 1e-16);
      BOOST_TEST(in.of_round >= 0.98 * inside);
      BOOST_TEST(out.of_round <= 1e-16);
      BOOST_TEST(out.of_tool <= outside + 1e-16);
      BOOST_TEST(out.of_tool >= 0.98 * outside);
    };
    check(round_cylinder, [&](Facets side) { return feeler::cylinder(radius, height, facets, side); });
    check(round_cone, [&](Facets side) { return feeler::cone(radius, height, facets, side); });
  }
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_with_a_sentence) {
  BOOST_TEST(contains(refusal([] { feeler::cylinder(0.0, 1.0); }), "not a positive length"));
  BOOST_TEST(contains(refusal([] { feeler::cone(1.0, std::nan("")); }), "not a positive length"));
  BOOST_TEST(contains(refusal([] { feeler::cylinder(1.0, 1.0, 16384); }), "3 to 16383"));
  BOOST_TEST(contains(refusal([] { feeler::cone(1.0, 1.0, 2); }), "3 to 32766"));
}

BOOST_AUTO_TEST_SUITE_END()
