// What pages may say, and what is refused with a sentence.
#include <boost/test/unit_test.hpp>

#include <random>
#include <string>

#include "feeler/viewer/page_message.hpp"

BOOST_AUTO_TEST_SUITE(page_message)

using feeler::viewer::CancelRequest;
using feeler::viewer::HandMode;
using feeler::viewer::HandRequest;
using feeler::viewer::parse_page_message;
using feeler::viewer::SceneRequest;

BOOST_AUTO_TEST_CASE(a_hand_is_read_and_its_quaternion_made_unit) {
  const auto parsed = parse_page_message(R"({"type":"hand","stage":3,"position":[0.1,0,-0.2],"orientation":[0,0,0,2]})");
  BOOST_REQUIRE(parsed.message.has_value());
  const auto& hand = std::get<HandRequest>(*parsed.message);
  BOOST_TEST((hand.mode == HandMode::person));
  BOOST_TEST(hand.stage == 3);
  BOOST_TEST(hand.pose.position[2] == -0.2);
  BOOST_TEST(hand.pose.orientation[3] == 1.0);
}

BOOST_AUTO_TEST_CASE(a_scene_is_read_with_what_it_says_and_no_more) {
  const auto parsed = parse_page_message(R"({"type":"scene","scene":"cavity","clearance":1e-5,"tool":"needle","method":"paper"})");
  BOOST_REQUIRE(parsed.message.has_value());
  const auto& scene = std::get<SceneRequest>(*parsed.message);
  BOOST_TEST(scene.scene == "cavity");
  BOOST_TEST(scene.clearance.value() == 1e-5);
  BOOST_TEST(!scene.stiffness.has_value());
  BOOST_TEST(scene.method == "paper");
  BOOST_TEST(scene.tool == "needle");
  BOOST_TEST(scene.scalar.empty());
}

BOOST_AUTO_TEST_CASE(a_cancelled_choice_is_read) {
  BOOST_TEST(std::holds_alternative<CancelRequest>(parse_page_message(R"({"type":"cancel"})").message.value()));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_refused_with_a_sentence) {
  const char* const messages[] = {
      "",
      "{",
      "[]",
      "null",
      "12",
      "{}",
      R"({"type":5})",
      R"({"type":"force","newton":1000})",
      R"({"type":"hand"})",
      R"({"type":"hand","stage":1,"position":[0,0],"orientation":[1,0,0,0]})",
      R"({"type":"hand","stage":1,"position":[0,0,"a"],"orientation":[1,0,0,0]})",
      R"({"type":"hand","stage":1,"position":[0,0,1e300],"orientation":[1,0,0,0]})",
      R"({"type":"hand","stage":1,"position":[0,0,1e999],"orientation":[1,0,0,0]})",
      R"({"type":"hand","stage":1,"position":[0,0,0],"orientation":[0,0,0,0]})",
      R"({"type":"hand","stage":-1,"position":[0,0,0],"orientation":[1,0,0,0]})",
      R"({"type":"hand","stage":"1","position":[0,0,0],"orientation":[1,0,0,0]})",
      R"({"type":"still"})",
      R"({"type":"scene"})",
      R"({"type":"scene","scene":7})",
      R"({"type":"scene","scene":"cavity","clearance":-1})",
      R"({"type":"scene","scene":"cavity","stiffness":1e9})",
      R"({"type":"scene","scene":"cavity","margin":0})",
      R"({"type":"scene","scene":"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"})",
  };
  for (const char* message : messages) {
    const auto parsed = parse_page_message(message);
    BOOST_TEST(!parsed.message.has_value(), message);
    BOOST_TEST(parsed.refusal.size() > 10, message);
    BOOST_TEST(parsed.refusal.back() == '.', message);
  }
}

BOOST_AUTO_TEST_CASE(random_bytes_and_deep_nesting_are_refused_too) {
  std::mt19937 bits(1);
  for (int i = 0; i < 2000; ++i) {
    std::string text;
    for (auto k = bits() % 60; k > 0; --k) text += char(bits() & 255u);
    BOOST_TEST(!parse_page_message(text).message.has_value());
  }
  BOOST_TEST(!parse_page_message(std::string(4000, '[')).message.has_value());
}

BOOST_AUTO_TEST_SUITE_END()
