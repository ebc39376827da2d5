// Limits of a wrench: length cut, direction kept, nonsense silenced.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "feeler/device/wrench_limit.hpp"

BOOST_AUTO_TEST_SUITE(wrench_limit)

namespace {

double length(const double (&v)[3]) { return std::hypot(v[0], v[1], v[2]); }

/// Sine of the angle between two vectors.
double deviation(const double (&a)[3], const double (&b)[3]) {
  const double cross = std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  return cross / (length(a) * length(b));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_long_wrench_is_shortened_to_the_maximum_and_keeps_its_direction) {
  std::mt19937 bits(7);
  const auto unit = [&bits] { return double(bits()) / 2147483648.0 - 1; };
  for (const double scale : {100.0, 1e8, 1e150}) {
    const feeler::DeviceWrench wrench{{unit() * scale, unit() * scale, unit() * scale}, {unit(), unit(), unit()}};
    const auto cut = feeler::limited(wrench, 22, 0.188);
    BOOST_TEST(length(cut.force) == 22, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(length(cut.torque) == 0.188, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(deviation(cut.torque, wrench.torque) < 1e-15);
    for (int i = 0; i < 3; ++i) {
      BOOST_TEST(cut.force[i] / 22 == wrench.force[i] / length(wrench.force), boost::test_tools::tolerance(1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wrench_within_the_maximum_is_left_alone) {
  const feeler::DeviceWrench wrench{{1, -2, 3}, {0.01, 0.02, -0.1}};
  const auto same = feeler::limited(wrench, 22, 0.188);
  for (int i = 0; i < 3; ++i) {
    BOOST_TEST(same.force[i] == wrench.force[i]);
    BOOST_TEST(same.torque[i] == wrench.torque[i]);
  }
}

BOOST_AUTO_TEST_CASE(a_wrench_that_is_not_finite_becomes_no_push) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const feeler::DeviceWrench wrench{{1, bad, 3}, {0.01, 0.02, 0.03}};
    BOOST_TEST(!feeler::is_finite(wrench));
    const auto cut = feeler::limited(wrench, 22, 0.188);
    BOOST_TEST(length(cut.force) == 0);
    BOOST_TEST(cut.torque[1] == 0.02);
  }
}

BOOST_AUTO_TEST_CASE(the_longest_doubles_are_shortened_too) {
  const double huge = std::numeric_limits<double>::max();
  const auto cut = feeler::limited({{huge, huge, 0}, {0, 0, 0}}, 22, 1);
  BOOST_TEST(cut.force[0] == 22 / std::sqrt(2.0), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(cut.force[1] == cut.force[0]);
}

BOOST_AUTO_TEST_SUITE_END()
