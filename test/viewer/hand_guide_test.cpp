// The hand that a page moves: never faster or farther than a hand, and never with a jump.
#include <boost/test/unit_test.hpp>

#include "live/hand_guide.hpp"

BOOST_AUTO_TEST_SUITE(hand_guide)

using feeler::Pose;
using feeler::demo::HandGuide;
using feeler::viewer::HandMode;

namespace {

constexpr double period = 1e-3;

HandGuide guide_at_rest() {
  return {Pose<double>{}, [](double t) { return Pose<double>{{0.02 * t, 0, 0.01}, Eigen::Quaterniond::Identity()}; }, 0.1, period};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hand_that_nobody_moves_rests) {
  HandGuide guide = guide_at_rest();
  for (int i = 0; i < 1000; ++i) guide.advance();
  BOOST_TEST((guide.mode() == HandMode::still));
  BOOST_TEST(guide.pose().translation.norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(a_far_jump_of_a_page_is_followed_at_the_speed_of_a_hand_and_no_farther_than_its_reach) {
  HandGuide guide = guide_at_rest();
  guide.ask({HandMode::person, 0, {{50, 0, 0}, {0, 1, 0, 0}}});
  Pose<double> before = guide.pose();
  for (int i = 0; i < 3000; ++i) {
    guide.advance();
    const auto step = feeler::motion_between(before, guide.pose());
    BOOST_REQUIRE(step.linear.norm() <= HandGuide::fastest * period * (1 + 1e-9));
    BOOST_REQUIRE(step.angular.norm() <= HandGuide::fastest_turn * period * (1 + 1e-9));
    before = guide.pose();
  }
  BOOST_TEST(guide.pose().translation.x() == 0.1, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(std::abs(guide.pose().rotation.x()) == 1.0, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(the_motion_begins_where_the_hand_is_and_holding_still_ends_it_there) {
  HandGuide guide = guide_at_rest();
  guide.ask({HandMode::motion, 0, {}});
  Pose<double> before = guide.pose();
  for (int i = 0; i < 2000; ++i) {
    guide.advance();
    BOOST_REQUIRE((guide.pose().translation - before.translation).norm() < 1e-4);
    before = guide.pose();
  }
  BOOST_TEST(guide.pose().translation.x() == 0.04, boost::test_tools::tolerance(1e-6));
  guide.ask({HandMode::still, 0, {}});
  for (int i = 0; i < 100; ++i) guide.advance();
  BOOST_TEST(guide.pose().translation.x() == before.translation.x());
}

BOOST_AUTO_TEST_CASE(within_a_tick_the_hand_goes_straight_from_one_pose_to_the_next) {
  HandGuide guide = guide_at_rest();
  guide.ask({HandMode::person, 0, {{0.01, 0, 0}, {1, 0, 0, 0}}});
  guide.advance();
  const double there = guide.pose().translation.x();
  BOOST_TEST(guide.at(0).position[0] == 0.0);
  BOOST_TEST(guide.at(period / 2).position[0] == there / 2, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(guide.at(period).position[0] == there, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
