// The words for the types of contact.
#include "feeler/recognition/principal_contact.hpp"

#include <boost/test/unit_test.hpp>

#include <string>

BOOST_AUTO_TEST_SUITE(principal_contact)

using feeler::Convexity;
using feeler::FeatureKind;
using feeler::PrincipalContactClass;

BOOST_AUTO_TEST_CASE(names_are_made_of_the_features_and_of_the_shape_that_the_object_has) {
  using enum FeatureKind;
  for (const FeatureKind tool : {vertex, edge, face}) {
    for (const FeatureKind object : {vertex, edge, face}) {
      for (const Convexity shape : {Convexity::convex, Convexity::concave}) {
        const bool is_concave = shape == Convexity::concave && object != face;
        if (is_concave && (tool == face || (tool == edge && object == vertex))) continue;  // "----" in Table 1
        const std::string place = object == face ? " on " : is_concave ? " in concave " : " on convex ";
        BOOST_TEST(to_string(principal_contact_type(tool, object, shape)) == to_string(tool) + place + to_string(object));
      }
    }
  }
  BOOST_TEST(to_string(PrincipalContactClass::single) == std::string("single"));
  BOOST_TEST(to_string(PrincipalContactClass::combination) == std::string("combination"));
  BOOST_TEST(to_string(PrincipalContactClass::degenerate) == std::string("degenerate"));
}

BOOST_AUTO_TEST_CASE(two_contacts_have_the_same_features_if_kinds_and_numbers_of_both_are_the_same) {
  using enum FeatureKind;
  const auto contact = [](const feeler::Feature& tool, const feeler::Feature& object) {
    feeler::PrincipalContact<double> result;
    result.tool = tool;
    result.object = object;
    return result;
  };
  auto one = contact({vertex, 1}, {edge, 2});
  const auto same = one;
  one.region = 3;
  one.gap = 1e-6;
  BOOST_TEST(one.has_features_of(same));
  BOOST_TEST(!one.has_features_of(contact({edge, 1}, {edge, 2})));
  BOOST_TEST(!one.has_features_of(contact({vertex, 2}, {edge, 2})));
  BOOST_TEST(!one.has_features_of(contact({vertex, 1}, {face, 2})));
  BOOST_TEST(!one.has_features_of(contact({vertex, 1}, {edge, 1})));
}

BOOST_AUTO_TEST_SUITE_END()
