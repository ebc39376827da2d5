#include "feeler/recognition/contact_formation.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "feeler/recognition/contact_recogniser.hpp"
#include "scenes/rotation_between.hpp"
#include "scenes/steps.hpp"

BOOST_AUTO_TEST_SUITE(contact_formation)

using feeler::ContactFormation;
using feeler::ContactSwitch;
using feeler::FeatureKind;
using feeler::FormationTracker;
using feeler::PrincipalContactClass;
using feeler::PrincipalContactType;
using Segment = feeler::Segment<double>;
using Vector = Eigen::Vector3d;

namespace {

/// "1 1 in 2" for two contacts of type 1 in two regions.
std::string summary(const ContactFormation<double>& formation) {
  std::string result;
  for (int type = 1; type <= 12; ++type)
    for (int i = formation.count(PrincipalContactType(type)); i > 0; --i) result += std::to_string(type) + " ";
  return result + "in " + std::to_string(formation.region_count);
}

feeler::PrincipalContact<double> contact(FeatureKind tool, int t, FeatureKind object, int o) {
  feeler::PrincipalContact<double> result;
  result.type = feeler::principal_contact_type(tool, object, feeler::Convexity::convex);
  result.tool = {tool, t};
  result.object = {object, o};
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(types_are_those_of_table_1) {
  using enum FeatureKind;
  using feeler::Convexity;
  const auto type = [](FeatureKind tool, FeatureKind object, Convexity shape) { return number_of(principal_contact_type(tool, object, shape)); };
  static_assert(principal_contact_type(vertex, face, Convexity::flat) == PrincipalContactType::vertex_face);
  const int rows[3][5] = {{9, 4, 8, 3, 1}, {10, 4, 2, 5, 6}, {11, 4, 12, 5, 7}};  // with "----" as the row above
  for (const FeatureKind tool : {vertex, edge, face}) {
    const int* row = rows[int(tool)];
    BOOST_TEST(type(tool, vertex, Convexity::convex) == row[0]);
    BOOST_TEST(type(tool, vertex, Convexity::concave) == row[1]);
    BOOST_TEST(type(tool, edge, Convexity::convex) == row[2]);
    BOOST_TEST(type(tool, edge, Convexity::concave) == row[3]);
    BOOST_TEST(type(tool, face, Convexity::flat) == row[4]);
    BOOST_TEST(type(tool, vertex, Convexity::mixed) == (tool == vertex ? 4 : row[0]));
  }
  const std::string classes =
      " ssccccc"
      "dddcc";  // section III.A: 1 and 2 single, 3 to 7, 11 and 12 combinations, 8 to 10 degenerate
  for (int number = 1; number <= 12; ++number) {
    const auto kind = principal_contact_class(PrincipalContactType(number));
    const char expected = classes[std::size_t(number)];
    BOOST_TEST((kind == (expected == 's'   ? PrincipalContactClass::single
                         : expected == 'c' ? PrincipalContactClass::combination
                                           : PrincipalContactClass::degenerate)));
    for (int other = 1; other < number; ++other)
      BOOST_TEST(std::string(to_string(PrincipalContactType(number))) != to_string(PrincipalContactType(other)));
  }
}

BOOST_AUTO_TEST_CASE(formations_are_compared_by_features_or_by_types) {
  using enum FeatureKind;
  ContactFormation<double> a, b;
  a.contacts.push_back(contact(edge, 1, edge, 2));
  a.contacts.push_back(contact(vertex, 4, face, 0));
  b.contacts.push_back(contact(vertex, 4, face, 0));
  b.contacts.push_back(contact(edge, 1, edge, 2));
  a.sort();
  b.sort();
  BOOST_TEST(same_features(a, b));
  BOOST_TEST(same_types(a, b));
  b.contacts[0].object.index = 1;
  BOOST_TEST(!same_features(a, b));
  BOOST_TEST(same_types(a, b));
  b.region_count = 1;
  BOOST_TEST(!same_types(a, b));
  b.contacts.pop_back();
  BOOST_TEST(!same_features(a, b));
}

BOOST_AUTO_TEST_CASE(contacts_are_sorted_by_the_feature_of_the_tool_and_then_by_that_of_the_object) {
  std::mt19937 bits(1);
  for (int round = 0; round < 100; ++round) {
    ContactFormation<double> formation;
    // As kinds and numbers are written: kind, number, kind, number.
    std::vector<std::array<int, 4>> expected;
    for (int i = 0; i < 20; ++i) {
      const std::array<int, 4> features{int(bits() % 3), int(bits() % 2), int(bits() % 3), int(bits() % 4)};
      formation.contacts.push_back(contact(FeatureKind(features[0]), features[1], FeatureKind(features[2]), features[3]));
      expected.push_back(features);
    }
    std::sort(expected.begin(), expected.end());
    formation.sort();
    for (int i = 0; i < formation.size(); ++i) {
      const auto& c = formation[i];
      BOOST_TEST((std::array<int, 4>{int(c.tool.kind), c.tool.index, int(c.object.kind), c.object.index} == expected[std::size_t(i)]));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_formation_is_complete_only_if_nothing_was_dropped_of_any_kind) {
  ContactFormation<double> formation;
  BOOST_TEST(formation.is_complete());
  for (int ContactFormation<double>::* dropped :
       {&ContactFormation<double>::dropped_contacts, &ContactFormation<double>::dropped_witnesses, &ContactFormation<double>::dropped_triangles}) {
    formation.*dropped = 1;
    BOOST_TEST(!formation.is_complete());
    formation.*dropped = 0;
  }
}

BOOST_AUTO_TEST_CASE(tracker_tells_switches_and_keeps_quiet_while_a_contact_slides) {
  using enum FeatureKind;
  FormationTracker<double> tracker;
  ContactFormation<double> none, one;
  one.contacts.push_back(contact(vertex, 4, face, 0));
  BOOST_TEST(tracker.observe(none) == nullptr);
  const ContactSwitch<double>* event = tracker.observe(one);
  BOOST_TEST_REQUIRE(event != nullptr);
  BOOST_TEST(event->before.empty());
  BOOST_TEST(event->after.size() == 1);
  one.contacts[0].point_world.x() = 1;
  BOOST_TEST(tracker.observe(one) == nullptr);
  BOOST_TEST(tracker.current()[0].point_world.x() == 1);
  event = tracker.observe(none);
  BOOST_TEST_REQUIRE(event != nullptr);
  BOOST_TEST(event->before[0].point_world.x() == 1);
  tracker.observe(one);
  tracker.reset();
  BOOST_TEST(tracker.current().empty());
}

// The paper's section V.B, by script: a line-shaped tool comes down on a step, slides over its edge, down along the edge to the floor, off the
// edge, and lies down until its other end meets the wall of the step.
BOOST_AUTO_TEST_CASE(events_of_a_segment_that_slides_down_a_step_come_in_order) {
  const auto scene = feeler::scenes::steps();
  const feeler::TriangleMesh<double> object(scene.vertices, scene.triangles);
  const feeler::SurfaceFeatures<double> surface(object);
  const Segment tool = std::get<Segment>(scene.tool);
  feeler::ContactRecogniser<Segment> recogniser(object, surface, tool);
  FormationTracker<double> tracker;
  std::vector<std::string> events;
  const Vector along_tool = tool.vertex(1) - tool.vertex(0);
  const double length = along_tool.norm();
  const auto visit = [&](const Vector& tip, const Vector& direction) {
    const Eigen::Quaterniond rotation = feeler::scenes::rotation_between(along_tool, direction);
    const auto* event = tracker.observe(recogniser.recognise({tip - rotation * tool.vertex(0), rotation}));
    if (event == nullptr) return;
    BOOST_TEST(summary(event->before) == (events.empty() ? "in 0" : events.back()));
    events.push_back(summary(event->after));
  };
  const double margin = 1e-6;
  const Vector lean = Vector(1, 0.1, 1).normalized(), ridge(-0.03, 0, 0.01);
  const Vector above = margin * Vector(-1, 0, 1).normalized();
  for (int i = 0; i <= 20; ++i) visit({-0.02, 0, 0.01 + margin + 0.001 * (20 - i)}, lean);  // down to the step
  for (int i = 0; i < 20; ++i) visit({-0.02 - 0.0005 * i, 0, 0.01 + margin}, lean);          // to its edge
  const double reach = (0.01 - margin + above.z()) / lean.z();  // where the tip meets the floor, at the margin
  for (int i = 1; i <= 20; ++i) visit(ridge + above - reach * i / 20.0 * lean, lean);        // down along it
  const Vector landed = ridge + above - reach * lean;
  const double wall = std::acos((0.0298 - margin) / length);
  for (int i = 1; i <= 20; ++i) visit(landed + (Vector(-0.0598, 0, margin) - landed) * i / 20.0, lean);
  for (int i = 0; i <= 20; ++i) {
    const double angle = 0.785 + (wall - 0.785) * i / 20.0;
    visit({-0.0598, 0, margin}, {std::cos(angle), 0, std::sin(angle)});
  }
  const std::vector<std::string> expected{"1 in 1", "2 in 1", "1 2 in 2", "1 in 1", "1 1 in 2"};
  BOOST_TEST(events == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
