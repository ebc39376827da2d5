// Bounds of stiffness: against the criterion they come from, and against figures worked out by hand.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "feeler/device/stiffness_limits.hpp"

BOOST_AUTO_TEST_SUITE(stiffness_limits)

using namespace std::complex_literals;

BOOST_AUTO_TEST_CASE(a_passive_wall_meets_the_criterion_of_colgate_and_schenkel_at_every_frequency) {
  constexpr double period = 1e-3;
  constexpr double damping = 0.5;
  for (const int delay : {0, 1, 2}) {
    const double stiffness = feeler::passive_stiffness(damping, period, 0, delay);
    double most = 0;  // damping that the criterion asks for
    for (int i = 1; i < 20'000; ++i) {
      const double angle = std::numbers::pi * i / 20'000;  // ωT
      const auto wall = stiffness * std::exp(-1i * (delay * angle));
      most = std::max(most, period / 2 * std::real((1.0 - std::exp(-1i * angle)) * wall) / (1 - std::cos(angle)));
    }
    BOOST_TEST(most == damping, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(virtual_damping_takes_from_the_bound_whatever_its_sign) {
  BOOST_TEST(feeler::passive_stiffness(0.5, 1e-3, 0.2) == 600, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(feeler::passive_stiffness(0.5, 1e-3, -0.2) == 600, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(feeler::passive_stiffness(0.5, 1e-3, 0.6) == 0);
}

BOOST_AUTO_TEST_CASE(encoders_bound_what_friction_can_hold) {
  // Worked out by hand from the datasheets' friction and resolution [N/mm].
  const auto quantised = [](const feeler::DeviceSpecification& device) { return feeler::stiffness_limits_of(device, 1e-3).quantised / 1000; };
  BOOST_TEST(quantised(feeler::phantom_premium_3_0_6dof()) == 20, boost::test_tools::tolerance(0.01));
  BOOST_TEST(quantised(feeler::phantom_premium_1_5_6dof()) == 2.7, boost::test_tools::tolerance(0.02));
  BOOST_TEST(quantised(feeler::touch()) == 9.5, boost::test_tools::tolerance(0.01));
  BOOST_TEST(quantised(feeler::touch_x()) == 5.2, boost::test_tools::tolerance(0.01));
  BOOST_TEST(feeler::quantised_stiffness(0.1, 0) == std::numeric_limits<double>::infinity());
}

BOOST_AUTO_TEST_CASE(a_device_is_bound_by_the_smaller_of_the_two) {
  const auto limits = feeler::stiffness_limits_of(feeler::phantom_premium_1_5_6dof(), 1e-4);
  BOOST_TEST(limits.passive == 8000, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(limits.translational() == limits.quantised);
  BOOST_TEST(limits.rotational() == 4, boost::test_tools::tolerance(1e-12));
  const auto slow = feeler::stiffness_limits_of(feeler::phantom_premium_1_5_6dof(), 1e-3);
  BOOST_TEST(slow.translational() == slow.passive);
  BOOST_TEST(feeler::stiffness_limits_of(feeler::touch(), 1e-3).rotational() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
