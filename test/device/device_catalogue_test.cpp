// The drivers by name, and the words of a search that finds nothing or something.
#include <boost/test/unit_test.hpp>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "feeler/device/device_catalogue.hpp"
#include "stand_in/force_dimension_stand_in.hpp"
#include "stand_in/stand_in.hpp"
#include "stand_in/virtuose_stand_in.hpp"

BOOST_AUTO_TEST_SUITE(device_catalogue)

BOOST_AUTO_TEST_CASE(every_maker_has_a_name_that_leads_back_to_it_and_a_driver) {
  for (const feeler::Maker maker : feeler::all_makers) {
    const auto named = feeler::maker_named(feeler::name_of(maker));
    BOOST_REQUIRE(named.has_value());
    BOOST_TEST((*named == maker));
    if (maker == feeler::Maker::haply) continue;  // it has no library
    const auto device = feeler::make_device(maker, "/nowhere/library.so");
    BOOST_REQUIRE(device != nullptr);
    const auto opened = device->open();
    BOOST_TEST(!opened);
    BOOST_TEST(opened.problem.find("/nowhere/library.so: cannot open shared object file") != std::string::npos);
    BOOST_TEST(opened.problem.find("install") != std::string::npos);
  }
  BOOST_TEST(!feeler::maker_named("falcon"));
}

BOOST_AUTO_TEST_CASE(a_choice_reaches_the_driver) {
  auto& dhd = feeler_test::stand_in<feeler_test::ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN);
  dhd.device_count = 2;
  dhd.needs_calibration = true;
  feeler::DeviceChoice choice;
  choice.library = FEELER_FORCE_DIMENSION_STAND_IN;
  choice.serial_number = "1004";
  choice.index = 3;
  choice.initialises = true;
  {
    const auto device = feeler::make_device(feeler::Maker::force_dimension, choice);
    const auto opened = device->open();
    BOOST_TEST(bool(opened), opened.problem);
    BOOST_TEST(dhd.id == 4);  // of the serial number, which goes before the index
    BOOST_TEST(!dhd.needs_calibration);
  }
  dhd.reset();
  dhd.device_count = 2;
  choice.serial_number.clear();
  const auto device = feeler::make_device(feeler::Maker::force_dimension, choice);
  BOOST_TEST(bool(device->open()));
  BOOST_TEST(dhd.id == 3);

  feeler::DeviceChoice elsewhere;
  elsewhere.library = FEELER_VIRTUOSE_STAND_IN;
  elsewhere.address = "arm#5001";
  auto& controller = feeler_test::stand_in<feeler_test::VirtuoseStandIn>(FEELER_VIRTUOSE_STAND_IN);
  const auto virtuose = feeler::make_device(feeler::Maker::virtuose, elsewhere);
  BOOST_TEST(bool(virtuose->open()));
  BOOST_TEST(std::string(controller.address) == "arm#5001");
}

BOOST_AUTO_TEST_CASE(a_choice_that_a_maker_does_not_know_is_refused_with_a_sentence) {
  using feeler::DeviceChoice;
  using feeler::Maker;
  const std::pair<Maker, DeviceChoice> choices[] = {{Maker::haply, {.library = "libHD.so"}},
                                                    {Maker::force_dimension, {.address = "localhost:1"}},
                                                    {Maker::virtuose, {.serial_number = "5"}},
                                                    {Maker::open_haptics, {.index = 0}},
                                                    {Maker::force_dimension, {.serial_number = "A"}},
                                                    {Maker::force_dimension, {.serial_number = "99999999999"}},
                                                    {Maker::haply, {.initialises = true}},
                                                    {Maker::open_haptics, {.initialises = true}},
                                                    {Maker::haply, {.address = "localhost"}},
                                                    {Maker::haply, {.address = "localhost:0"}},
                                                    {Maker::haply, {.address = ":10001"}},
                                                    {Maker::haply, {.address = "localhost:70000"}},
                                                    {Maker::haply, {.period = 0}},
                                                    {Maker::haply, {.period = std::numeric_limits<double>::quiet_NaN()}}};
  for (const auto& [maker, choice] : choices) {
    const std::string reason = feeler::reason_against(maker, choice);
    BOOST_TEST_CONTEXT(feeler::name_of(maker) << ": " << reason) {
      BOOST_REQUIRE(!reason.empty());
      BOOST_TEST(reason.back() == '.');
      BOOST_CHECK_THROW(feeler::make_device(maker, choice), std::invalid_argument);
    }
  }
  for (const Maker maker : feeler::all_makers) BOOST_TEST(feeler::reason_against(maker, {}) == "");
}

BOOST_AUTO_TEST_CASE(a_listing_says_what_a_device_can_or_why_there_is_none) {
  feeler_test::stand_in<feeler_test::ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN);
  const auto device = feeler::make_device(feeler::Maker::force_dimension, FEELER_FORCE_DIMENSION_STAND_IN);
  BOOST_REQUIRE(bool(device->open()));
  BOOST_TEST(to_string(feeler::DeviceListing{feeler::Maker::force_dimension, device->specification(), ""}) ==
             "forcedimension: sigma.7, 12 N (3 N for ever), 0.2 N m, 2200 N/m\n");
  BOOST_TEST(to_string(feeler::DeviceListing{feeler::Maker::open_haptics, feeler::touch(), ""}) ==
             "openhaptics: Touch, 3.3 N (0.88 N for ever), force-only, 400 N/m\n");
  BOOST_TEST(to_string(feeler::DeviceListing{feeler::Maker::virtuose, {}, "No cable."}) == "virtuose: none. No cable.\n");
}

BOOST_AUTO_TEST_SUITE_END()
