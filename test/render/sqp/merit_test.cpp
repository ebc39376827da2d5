#include "feeler/render/sqp/merit.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(merit)

namespace {

using Twist = feeler::Twist<double>;

constexpr double margin = 1e-6;                    // [m]
const feeler::TurnedMetric<double> metric = feeler::Metric<double>();  // a metre of translation weighs one
Twist off(double x) { return {{x, 0, 0}, {0, 0, 0}}; }  // [m]

}  // namespace

BOOST_AUTO_TEST_CASE(a_step_may_lead_away_from_the_hand_by_a_margin_and_not_by_two) {
  for (const double from : {1e-5, 1e-3, 0.1}) {
    BOOST_TEST(descends(metric, off(from), off(from - margin), margin, 0.0));
    BOOST_TEST(descends(metric, off(from), off(from + margin), margin, 0.0));
    BOOST_TEST(!descends(metric, off(from), off(from + 2 * margin), margin, 0.0));
  }
}

BOOST_AUTO_TEST_CASE(to_win_the_margin_back_may_cost_what_that_is_worth) {
  const double from = 1e-3, farther = from + 10 * margin;
  const double cost = (farther * farther - from * from) / 2;
  BOOST_TEST(descends(metric, off(from), off(farther), margin, cost));
  BOOST_TEST(!descends(metric, off(from), off(farther), margin, cost / 2));
}

BOOST_AUTO_TEST_CASE(a_step_is_worth_it_that_leads_nearer_by_more_than_a_tenth_of_the_margin) {
  for (const double from : {1e-5, 1e-3, 0.1}) {
    BOOST_TEST(!descends_clearly(metric, off(from), off(from - 0.099 * margin), margin));
    BOOST_TEST(descends_clearly(metric, off(from), off(from - 0.102 * margin), margin));
  }
}

BOOST_AUTO_TEST_SUITE_END()
