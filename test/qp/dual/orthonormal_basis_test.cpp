#include "feeler/qp/dual/orthonormal_basis.hpp"

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(orthonormal_basis)

namespace {

using Basis = feeler::detail::OrthonormalBasis<double>;
using Six = feeler::detail::Six<double>;

constexpr double rounding = 1e-15;

Six random_six(std::mt19937& bits) {
  Six v;
  for (double& number : v) number = feeler_test::unit(bits);
  return v;
}

void check_orthonormal(const Basis& basis, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k <= i; ++k) BOOST_TEST(std::abs(feeler::detail::dot(basis[i], basis[k]) - (i == k ? 1.0 : 0.0)) < rounding);
  }
}

}  // namespace

// Vectors that differ in their last digits alone: made orthogonal once they would keep what rounding left.
BOOST_AUTO_TEST_CASE(nearly_parallel_vectors_are_orthonormal_and_their_factor_gives_them_back) {
  constexpr unsigned seed = 61;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (int trial = 0; trial < 200; ++trial) {
    const Six first = random_six(bits);
    Basis basis;
    for (std::size_t size = 0; size < 4; ++size) {
      Six vector = first;
      const Six other = random_six(bits);
      for (std::size_t j = 0; j < 6; ++j) vector[j] += 1e-9 * other[j];
      Six rest = vector, coefficients{};
      coefficients[size] = basis.orthogonalise(rest, coefficients);
      basis.append(rest, coefficients[size]);
      check_orthonormal(basis, size + 1);
      for (std::size_t i = 0; i <= size; ++i) feeler::detail::subtract(basis[i], coefficients[i], vector);
      BOOST_TEST(feeler::detail::norm_inf(vector) < rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(axes_complete_it) {
  constexpr unsigned seed = 62;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (std::size_t given = 0; given <= 6; ++given) {
    Basis basis;
    for (std::size_t i = 0; i < given; ++i) {
      Six v = random_six(bits), unused{};
      const double length = basis.orthogonalise(v, unused);
      basis.append(v, length);
    }
    while (!basis.is_complete()) basis.append_farthest_axis();
    check_orthonormal(basis, 6);
  }
}

BOOST_AUTO_TEST_CASE(a_vector_without_length_is_appended_as_zeros) {
  Basis basis;
  basis.append(Six{}, 0.0);
  for (const double number : basis.last()) BOOST_TEST(number == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
