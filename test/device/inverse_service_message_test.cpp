// What the driver of Haply reads from texts, good ones and broken ones.
#ifdef FEELER_DEVICE_HAPLY
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

#include "inverse_service_message.hpp"

BOOST_AUTO_TEST_SUITE(inverse_service_message)

namespace {

// As the maker's documentation of version 3.5 shows it, shortened.
const std::string inventory = R"({"session_id": 7, "inverse3": [{"device_id": "049D",
  "config": {"type": "inverse3", "handedness": "right"},
  "state": {"cursor_position": {"x": 0.5, "y": -0.125, "z": 0.25}, "control_mode": "idle"},
  "status": {"calibrated": true, "in_use": false, "power_supply": false, "ready": true, "started": true}}],
  "wireless_verse_grip": [{"device_id": "61548", "state": {"orientation": {"w": 0, "x": 1, "y": 0, "z": 0}, "buttons": {"a": false, "b": true, "c": false},
  "battery_level": 0.9}, "status": {"connected": true, "awake": false}}], "verse_grip": []})";

}  // namespace

BOOST_AUTO_TEST_CASE(a_list_of_devices_is_read_as_it_is) {
  const auto message = feeler::read_service_message(inventory);
  BOOST_REQUIRE(message.has_value());
  BOOST_REQUIRE(message->arms.size() == 1u);
  const auto& arm = message->arms.front();
  BOOST_TEST(arm.id == "049D");
  BOOST_TEST(arm.type == "inverse3");
  BOOST_TEST(arm.is_calibrated.value());
  BOOST_TEST(!arm.has_power.value());
  BOOST_TEST(arm.has_position);
  BOOST_TEST(arm.position[1] == -0.125);
  BOOST_REQUIRE(message->grips.size() == 1u);
  const auto& grip = message->grips.front();
  BOOST_TEST(grip.orientation[1] == 1);
  BOOST_TEST(grip.buttons == 2u);
  BOOST_TEST(!grip.is_awake.value());
}

BOOST_AUTO_TEST_CASE(what_is_not_told_stays_open_and_what_is_no_number_is_a_nan) {
  const auto message =
      feeler::read_service_message(R"({"inverse3": [{"device_id": 5, "status": 7, "state": {"cursor_position": {"x": null, "y": "1"}}}, [], 3]})");
  BOOST_REQUIRE(message.has_value());
  BOOST_REQUIRE(message->arms.size() == 3u);
  const auto& arm = message->arms.front();
  BOOST_TEST(arm.id == "");
  BOOST_TEST(!arm.is_calibrated.has_value());
  BOOST_TEST(arm.has_position);
  for (const double component : arm.position) BOOST_TEST(std::isnan(component));
  BOOST_TEST(!message->arms[1].has_position);
}

BOOST_AUTO_TEST_CASE(every_text_that_is_cut_off_is_none_and_no_changed_byte_does_harm) {
  for (std::size_t size = 0; size < inventory.size(); ++size) BOOST_TEST(!feeler::read_service_message(inventory.substr(0, size)).has_value());
  int read = 0;
  for (std::size_t at = 0; at < inventory.size(); ++at) {
    for (const char byte : {'\0', '"', '{', ']', '9', '\xff'}) {
      std::string changed = inventory;
      changed[at] = byte;
      read += feeler::read_service_message(changed).has_value() ? 1 : 0;
    }
  }
  BOOST_TEST(read > 0);
  for (const char* const text : {"", "null", "[]", "NaN", "{\"inverse3\": {}}", "{\"inverse3\": [{\"state\": {\"cursor_position\": {\"x\": NaN}}}]}",
                                 "{\"inverse3\": [{\"state\": {\"cursor_position\": {\"x\": 1e999}}}]}"})
    BOOST_TEST(!feeler::read_service_message(text).has_value(), text);
  BOOST_TEST(!feeler::read_service_message(std::string(100'000, '[')).has_value());
}

BOOST_AUTO_TEST_CASE(a_force_is_told_as_the_public_clients_do) {
  BOOST_TEST(feeler::force_message("049D", {1, -0.5, 0}) ==
             R"({"inverse3":[{"commands":{"set_cursor_force":{"values":{"x":1.0,"y":-0.5,"z":0.0}}},"device_id":"049D"}]})");
}

BOOST_AUTO_TEST_SUITE_END()
#endif
