#include "feeler/render/sqp/step_limits.hpp"

#include <boost/test/unit_test.hpp>

#include <limits>

BOOST_AUTO_TEST_SUITE(step_limits)

using Limits = feeler::StepLimits<double>;

namespace {
constexpr int little = 2, more = 3;  // work to certify a motion

Limits with_radius(double radius) {
  Limits limits;
  limits.reset(radius);
  return limits;
}
}  // namespace

BOOST_AUTO_TEST_CASE(the_trust_region_outgrows_its_radius_after_four_motions_that_nothing_stopped) {
  Limits limits = with_radius(1);
  for (int i = 0; i < 3; ++i) {
    limits.widen(more);
    BOOST_TEST(limits.trust() == 1);
  }
  for (const double expected : {2, 4, 8, 8}) {
    limits.widen(more);
    BOOST_TEST(limits.trust() == expected);
  }
  BOOST_TEST(limits.longest(false) == 8);
}

BOOST_AUTO_TEST_CASE(it_outgrows_it_at_once_where_little_is_near) {
  Limits limits = with_radius(1);
  limits.widen(little);
  BOOST_TEST(limits.trust() == 2);
  limits.narrow(0.25);
  for (const double expected : {0.5, 1.0, 2.0}) {  // what fills less than the radius tells nothing of what is around
    limits.widen(little);
    BOOST_TEST(limits.trust() == expected);
  }
}

BOOST_AUTO_TEST_CASE(a_motion_that_meets_something_new_ends_a_long_slide) {
  Limits limits = with_radius(1);
  for (int i = 0; i < 3; ++i) limits.widen(little);
  BOOST_TEST(limits.trust() == 8);
  limits.narrow_to_radius();
  BOOST_TEST(limits.trust() == 1);
  limits.widen(more);
  BOOST_TEST(limits.trust() == 1);
}

BOOST_AUTO_TEST_CASE(the_next_tick_goes_on_half_as_fast_again_with_a_long_slide) {
  Limits limits = with_radius(1);
  limits.widen(little);
  limits.widen(little);
  limits.carry_over();
  BOOST_TEST(limits.trust() == 1.5);
  limits.narrow_to_radius();
  limits.carry_over();
  BOOST_TEST(limits.trust() == 1);
  limits.narrow(0);
  limits.carry_over();
  BOOST_TEST(limits.trust() == 1 / 4000.0);
}

BOOST_AUTO_TEST_CASE(in_flight_only_the_work_of_the_certificate_limits_a_motion) {
  Limits limits = with_radius(1);
  BOOST_TEST(limits.longest(true) == std::numeric_limits<double>::infinity());
  limits.shorten(true, 3);
  BOOST_TEST(limits.longest(true) == 3);
  BOOST_TEST(limits.longest(false) == 1);
  limits.widen(little);
  BOOST_TEST(limits.longest(true) == 6);
}

BOOST_AUTO_TEST_CASE(a_flight_that_there_was_no_work_for_at_all_is_a_short_one_in_the_next_tick) {
  Limits limits = with_radius(1);
  limits.shorten(true, 0);
  limits.carry_over();
  BOOST_TEST(limits.longest(true) == 1 / 4000.0);
}

BOOST_AUTO_TEST_CASE(after_a_reset_nothing_is_left_of_a_long_slide) {
  Limits limits = with_radius(1);
  for (int i = 0; i < 3; ++i) limits.widen(little);
  limits.shorten(true, 3);
  limits.reset(1);
  BOOST_TEST(limits.trust() == 1);
  BOOST_TEST(limits.longest(true) == std::numeric_limits<double>::infinity());
  limits.widen(more);
  BOOST_TEST(limits.trust() == 1);
}

BOOST_AUTO_TEST_CASE(motions_shorter_than_the_radius_are_no_part_of_a_long_slide) {
  for (const int work : {little, more}) {
    Limits limits = with_radius(1);
    limits.narrow(1 / 16.0);
    for (const double expected : {1 / 8.0, 1 / 4.0, 1 / 2.0, 1.0}) {
      limits.widen(work);
      BOOST_TEST(limits.trust() == expected);
    }
    for (int i = 0; i < (work == little ? 0 : 3); ++i) {
      limits.widen(work);
      BOOST_TEST(limits.trust() == 1);
    }
    limits.widen(work);
    BOOST_TEST(limits.trust() == 2);
  }
}

BOOST_AUTO_TEST_SUITE_END()
