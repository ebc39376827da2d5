// The drivers by name, and the words of a search that finds nothing or something.
#include <boost/test/unit_test.hpp>

#include <string>

#include "feeler/device/device_catalogue.hpp"
#include "stand_in/force_dimension_stand_in.hpp"
#include "stand_in/stand_in.hpp"

BOOST_AUTO_TEST_SUITE(device_catalogue)

BOOST_AUTO_TEST_CASE(every_maker_has_a_name_that_leads_back_to_it_and_a_driver) {
  for (const feeler::Maker maker : feeler::all_makers) {
    const auto named = feeler::maker_named(feeler::name_of(maker));
    BOOST_REQUIRE(named.has_value());
    BOOST_TEST((*named == maker));
    const auto device = feeler::make_device(maker, "/nowhere/library.so");
    BOOST_REQUIRE(device != nullptr);
    const auto opened = device->open();
    BOOST_TEST(!opened);
    BOOST_TEST(opened.problem.find("/nowhere/library.so: cannot open shared object file") !=
               std::string::npos);
    BOOST_TEST(opened.problem.find("install") != std::string::npos);
  }
  BOOST_TEST(!feeler::maker_named("falcon"));
}

BOOST_AUTO_TEST_CASE(a_listing_says_what_a_device_can_or_why_there_is_none) {
  feeler_test::stand_in<feeler_test::ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN);
  const auto device = feeler::make_device(feeler::Maker::force_dimension, FEELER_FORCE_DIMENSION_STAND_IN);
  BOOST_REQUIRE(bool(device->open()));
  BOOST_TEST(to_string(feeler::DeviceListing{feeler::Maker::force_dimension, device->specification(), ""}) ==
             "forcedimension: sigma.7, 12 N (3 N for ever), 0.2 N m, 2200 N/m\n");
  BOOST_TEST(to_string(feeler::DeviceListing{feeler::Maker::open_haptics, feeler::touch(), ""}) ==
             "openhaptics: Touch, 3.3 N (0.88 N for ever), force-only, 400 N/m\n");
  BOOST_TEST(to_string(feeler::DeviceListing{feeler::Maker::virtuose, {}, "No cable."}) ==
             "virtuose: none. No cable.\n");
}

BOOST_AUTO_TEST_SUITE_END()
