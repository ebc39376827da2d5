// The middle of a long turn: by the angle it is as far from one end as from the other, and short turns have none.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "feeler/spatial/half_way.hpp"
#include "scenes/motions.hpp"

BOOST_AUTO_TEST_SUITE(half_way)

using namespace feeler;

BOOST_AUTO_TEST_CASE(a_long_turn_has_a_middle_on_its_way_and_a_short_one_none) {
  scenes::RandomBits random(5);
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.5 + 1.2 * random.unit();  // beyond half a turn the other way round is the shorter
    const Vector3<double> axis = random.direction();
    const Pose<double> from{random.direction(), exp_rotation<double>(random.direction())};
    Pose<double> to{random.direction(), exp_rotation<double>(angle * axis) * from.rotation};
    if (i % 2 == 0) to.rotation.coeffs() = -to.rotation.coeffs();
    const double shorter = std::min(angle, 2 * std::numbers::pi - angle);
    const auto middle = half_way_of_long_turn(from, to);
    BOOST_TEST(middle.has_value() == (shorter > 2.9999));
    if (!middle) continue;
    const double signed_half = (angle <= std::numbers::pi ? shorter : -shorter) / 2;
    const Quaternion<double> expected(Eigen::AngleAxisd(signed_half, axis) * from.rotation);
    BOOST_TEST((middle->translation - (from.translation + to.translation) / 2).norm() <= 1e-15);
    BOOST_TEST(std::abs(middle->rotation.norm() - 1) <= 1e-15);
    BOOST_TEST(1 - std::abs(middle->rotation.dot(expected)) <= 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(exactly_half_a_turn_has_a_middle_too) {
  const Pose<double> from, to{{0, 0, 2}, Quaternion<double>(0, 1, 0, 0)};
  const auto middle = half_way_of_long_turn(from, to);
  BOOST_TEST_REQUIRE(middle.has_value());
  BOOST_TEST(std::abs(std::abs(middle->rotation.dot(from.rotation)) - std::sqrt(0.5)) <= 1e-15);
  BOOST_TEST(std::abs(std::abs(middle->rotation.dot(to.rotation)) - std::sqrt(0.5)) <= 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
