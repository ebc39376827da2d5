#include "feeler/qp/dual/six.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(six)

namespace {

using Numbers = feeler::detail::Six<double>;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Numbers random_numbers(std::mt19937& bits) {
  Numbers v;
  for (double& number : v) number = feeler_test::unit(bits);
  return v;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_largest_number_and_the_sum_of_sizes_are_found_whichever_is_large_and_whatever_its_sign) {
  for (std::size_t j = 0; j < 6; ++j) {
    for (const double large : {-8.0, 8.0}) {
      Numbers v;
      v.fill(-0.5);
      v[j] = large;
      BOOST_TEST(feeler::detail::norm_inf(v) == 8.0);
      BOOST_TEST(feeler::detail::norm1(v) == 10.5);
      BOOST_TEST(feeler::detail::rounding_at(v) == 8 * epsilon * 8.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(rounding_of_a_sum_is_that_of_its_terms_also_where_they_cancel) {
  const Numbers ones{1, 1, 1, 1, 1, 1}, cancelling{1, -1, 2, -2, 4, -4};
  BOOST_TEST(feeler::detail::dot(ones, cancelling) == 0);
  BOOST_TEST(feeler::detail::rounding_of_dot(ones, cancelling) == 8 * epsilon * 14);
  BOOST_TEST(feeler::detail::rounding_of_dot(cancelling, cancelling) == 8 * epsilon * 42);
}

BOOST_AUTO_TEST_CASE(products_are_those_of_long_double_to_their_rounding) {
  constexpr unsigned seed = 101;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int i = 0; i < 200; ++i) {
    const Numbers a = random_numbers(bits), b = random_numbers(bits);
    feeler::detail::SixBySix<double> symmetric;
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t k = 0; k <= j; ++k) symmetric[j][k] = symmetric[k][j] = feeler_test::unit(bits);
    }
    const auto wide_dot = [](const Numbers& v, const Numbers& w) {
      long double sum = 0;
      for (std::size_t j = 0; j < 6; ++j) sum += static_cast<long double>(v[j]) * static_cast<long double>(w[j]);
      return sum;
    };
    const auto rounding = static_cast<long double>(feeler::detail::rounding_of_dot(a, b));
    BOOST_TEST(std::abs(static_cast<long double>(feeler::detail::dot(a, b)) - wide_dot(a, b)) <= rounding);
    const Numbers image = feeler::detail::multiply(symmetric, a), scaled = feeler::detail::multiply(a, b);
    Numbers rest = a;
    feeler::detail::subtract(b, 0.5, rest);
    for (std::size_t j = 0; j < 6; ++j) {
      BOOST_TEST(std::abs(static_cast<long double>(image[j]) - wide_dot(symmetric[j], a)) <= 1e-15L);
      BOOST_TEST(scaled[j] == a[j] * b[j]);
      BOOST_TEST(rest[j] == a[j] - 0.5 * b[j]);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
