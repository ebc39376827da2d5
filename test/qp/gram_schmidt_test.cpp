// An orthogonal basis of vectors that nearly depend on each other, in a metric of its own.
#include "feeler/qp/gram_schmidt.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(gram_schmidt)

using namespace feeler;
using Vector = Vector6<double>;

namespace {
Vector random_six(std::mt19937& bits) {
  Vector v;
  v << feeler_test::random_vector(bits), feeler_test::random_vector(bits);
  return v;
}
}  // namespace

BOOST_AUTO_TEST_CASE(what_is_free_of_a_vector_is_orthogonal_to_the_others_to_rounding_however_little_it_is) {
  constexpr unsigned seed = 3;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  for (const double apart : {1.0, 1e-3, 1e-6, 1e-9}) {
    double worst_angle = 0, worst_rest = 0, worst_answer = 0;
    for (int i = 0; i < 200; ++i) {
      const Vector metric = random_six(bits).cwiseAbs() + Vector::Constant(0.5), first = random_six(bits);
      const auto product = [&](const Vector& a, const Vector& b) { return a.dot(metric.cwiseProduct(b)); };
      GramSchmidt<double> basis;
      std::vector<Vector> vectors;
      for (int k = 0; k < 4; ++k) {
        const Vector a = k == 0 ? first : Vector(first + apart * random_six(bits));
        const auto expansion = basis.expand(a, metric.cwiseProduct(a));
        Vector rest = a - expansion.free;
        for (int j = 0; j < k; ++j) {
          const Vector& other = vectors[std::size_t(j)];
          const double sizes = std::sqrt(product(expansion.free, expansion.free) * product(other, other));
          worst_angle = std::max(worst_angle, std::abs(product(expansion.free, other)) / sizes);
          rest -= expansion.coefficients[std::size_t(j)] * other;
        }
        worst_rest = std::max(worst_rest, rest.norm());
        basis.add(expansion);
        vectors.push_back(a);
      }
      if (apart < 1) continue;  // the answer is as large as the vectors are near each other
      const std::array<double, 6> wanted{0.3, -0.2, 0.5, 0.1, 0, 0};
      const auto shares = basis.solve(wanted);
      Vector sum = Vector::Zero();
      for (std::size_t j = 0; j < 4; ++j) sum += shares[j] * vectors[j];
      for (std::size_t j = 0; j < 4; ++j) worst_answer = std::max(worst_answer, std::abs(product(sum, vectors[j]) - wanted[j]));
    }
    BOOST_TEST_CONTEXT("apart by " << apart) {
      BOOST_TEST(worst_angle < 1e-12);
      BOOST_TEST(worst_rest < 1e-11);
      BOOST_TEST(worst_answer < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
