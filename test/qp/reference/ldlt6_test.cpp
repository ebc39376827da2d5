#include "feeler/qp/reference/ldlt6.hpp"

#include <boost/test/unit_test.hpp>

#include <limits>
#include <random>

#include "support/multiprecision.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(ldlt6)

namespace {

using Matrix6 = feeler::Matrix6<double>;
using Vector6 = feeler::Vector6<double>;

Matrix6 random_definite(std::mt19937& bits) {
  Matrix6 root;
  for (int j = 0; j < 6; ++j) root.col(j) = feeler_test::random_six(bits);
  return root * root.transpose() + 0.1 * Matrix6::Identity();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_solution_in_fractions_gives_back_the_vector_without_rounding) {
  using Rational = feeler_test::Rational;
  constexpr unsigned seed = 121;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::Ldlt6<Rational> factor;
  for (int i = 0; i < 5; ++i) {
    const feeler::Matrix6<Rational> h = random_definite(bits).cast<float>().cast<Rational>();
    const feeler::Vector6<Rational> v = feeler_test::random_six(bits).cast<float>().cast<Rational>();
    BOOST_TEST_REQUIRE(factor.factor(h));
    const feeler::Vector6<Rational> x = factor.solve(v);
    BOOST_TEST((h.selfadjointView<Eigen::Lower>() * x == v));
  }
}

BOOST_AUTO_TEST_CASE(nothing_above_the_diagonal_is_read) {
  constexpr unsigned seed = 122;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  feeler::Ldlt6<double> whole, half;
  for (int i = 0; i < 100; ++i) {
    const Matrix6 h = random_definite(bits);
    Matrix6 lower = h;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());
    BOOST_TEST_REQUIRE(whole.factor(h));
    BOOST_TEST_REQUIRE(half.factor(lower));
    const Vector6 v = feeler_test::random_six(bits);
    BOOST_TEST((whole.solve(v) == half.solve(v)));
  }
}

BOOST_AUTO_TEST_CASE(a_pivot_that_is_zero_negative_infinite_or_no_number_is_refused_wherever_it_is) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  feeler::Ldlt6<double> factor;
  for (int j = 0; j < 6; ++j) {
    for (const double pivot : {0.0, -1.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
      Matrix6 h = Matrix6::Identity();
      h(j, j) = pivot;
      BOOST_TEST_INFO("pivot " << j << " is " << pivot);
      BOOST_TEST(!factor.factor(h));
    }
  }
  // Definite on the diagonal alone: the last pivot is 1 − 1.
  Matrix6 h = Matrix6::Identity();
  h(5, 0) = h(0, 5) = 1.0;
  BOOST_TEST(!factor.factor(h));
}

BOOST_AUTO_TEST_SUITE_END()
