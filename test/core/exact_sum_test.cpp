#include "feeler/core/exact_sum.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(exact_sum)

using namespace feeler_test;
using Exact = boost::multiprecision::cpp_rational;

namespace {
/// Numbers of any size from 2^-60 to 2^60.
double any_number(std::mt19937& bits) {
  const double number = unit(bits);
  return std::ldexp(number, below(bits, 120) - 60);
}
}  // namespace

BOOST_AUTO_TEST_CASE(a_sum_has_the_sign_of_a_sum_of_fractions_however_much_of_it_cancels) {
  std::mt19937 bits(1);
  int zeros = 0, positive = 0, negative = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<double> terms;
    const int count = 1 + below(bits, 10);
    for (int k = 0; k < count; ++k) terms.push_back(any_number(bits));
    for (int k = i % 3; k < count; ++k) terms.push_back(-terms[std::size_t(k)]);  // all cancels, or all but a term or two
    if (i % 4 == 0) terms.push_back(std::ldexp(any_number(bits), -300));
    for (std::size_t k = terms.size(); k > 1; --k) std::swap(terms[k - 1], terms[std::size_t(below(bits, int(k)))]);
    feeler::ExactSum<24> sum;
    Exact expected = 0;
    for (const double term : terms) {
      sum.add(term);
      expected += Exact(term);
      BOOST_TEST_REQUIRE(sum.sign() == (expected > 0 ? 1 : expected < 0 ? -1 : 0));
    }
    ++(expected == 0 ? zeros : expected > 0 ? positive : negative);
  }
  BOOST_TEST(zeros > 500);
  BOOST_TEST(positive > 500);
  BOOST_TEST(negative > 500);
}

BOOST_AUTO_TEST_CASE(differences_and_products_are_the_sums_of_two_parts) {
  std::mt19937 bits(2);
  for (int i = 0; i < 3000; ++i) {
    const double a = any_number(bits);
    const double b = i % 2 == 0 ? any_number(bits) : a * (1 + 1e-10 * unit(bits));
    const auto difference = feeler::TwoParts::difference(a, b), product = feeler::TwoParts::product(a, b);
    BOOST_TEST(bool(Exact(difference.high) + Exact(difference.low) == Exact(a) - Exact(b)));
    BOOST_TEST(bool(Exact(product.high) + Exact(product.low) == Exact(a) * Exact(b)));
    BOOST_TEST(difference.high == a - b);
    BOOST_TEST(product.high == a * b);
  }
}

BOOST_AUTO_TEST_SUITE_END()
