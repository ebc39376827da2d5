// Definiteness by minors, against eigenvalues in wider arithmetic.
#include "feeler/render/sqp/definiteness.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include "support/random_geometry.hpp"

using feeler::is_positive_definite;
using feeler_test::unit;
using Matrix = feeler::Matrix6<double>;
using Vector = feeler::Vector6<double>;
using WideMatrix = feeler::Matrix6<long double>;

namespace {

const Vector nothing = Vector::Zero();

WideMatrix random_turn(std::mt19937& bits) {
  WideMatrix m;
  for (int i = 0; i < 36; ++i) m.data()[i] = unit(bits);
  return m.householderQr().householderQ();
}

/// Smallest eigenvalue of the lower triangle less a diagonal, with rows and columns scaled so that it is a share of the largest.
long double least_share(const Matrix& h, const Vector& less) {
  WideMatrix m = h.cast<long double>().selfadjointView<Eigen::Lower>();
  m.diagonal() -= less.cast<long double>();
  const feeler::Vector6<long double> scale = m.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const WideMatrix scaled = scale.asDiagonal() * m * scale.asDiagonal();
  const auto values = Eigen::SelfAdjointEigenSolver<WideMatrix>(scaled).eigenvalues();
  return values.minCoeff() / values.cwiseAbs().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(definiteness)

BOOST_AUTO_TEST_CASE(it_is_what_the_eigenvalues_say) {
  const auto seed = std::random_device{}();
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  int definite = 0, indefinite = 0;
  for (int i = 0; i < 4000; ++i) {
    feeler::Vector6<long double> values;
    for (int k = 0; k < 6; ++k) values[k] = std::abs(unit(bits)) + 1e-3;
    if (i % 2 == 0) values[i / 2 % 6] = std::pow(10.0, -1 - i % 5) * unit(bits);
    const WideMatrix axes = random_turn(bits);
    Matrix h = (axes * values.asDiagonal() * axes.transpose()).cast<double>();
    // Metres beside radians.
    const double arm = i % 3 == 0 ? 1 : i % 3 == 1 ? 0.02 : 1e-4;
    Vector scale = Vector::Ones();
    scale.tail<3>().setConstant(arm);
    h = scale.asDiagonal() * h * scale.asDiagonal();
    Vector less = nothing;
    if (i % 4 < 2) less = h.diagonal().cwiseAbs() * std::abs(unit(bits)) / 10;
    const long double least = least_share(h, less);
    if (std::abs(least) < 1e-11L) continue;
    ++(least > 0 ? definite : indefinite);
    BOOST_TEST(is_positive_definite(h, less) == (least > 0));
    h.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());
    BOOST_TEST(is_positive_definite(h, less) == (least > 0));
  }
  BOOST_TEST(definite > 500);
  BOOST_TEST(indefinite > 500);
}

BOOST_AUTO_TEST_CASE(no_minor_makes_up_for_another) {
  for (int signs = 0; signs < 64; ++signs) {
    Matrix h = Matrix::Identity();
    for (int k = 0; k < 6; ++k) h(k, k) = (signs >> k & 1) != 0 ? -1 : 1;
    BOOST_TEST(is_positive_definite(h, nothing) == (signs == 0));
    BOOST_TEST(is_positive_definite(Matrix(Matrix::Identity()), Vector(Vector::Ones() - h.diagonal())) == (signs == 0));
  }
  for (int k = 0; k < 6; ++k) {
    Matrix h = Matrix::Identity();
    h(k, k) = 0;
    BOOST_TEST(!is_positive_definite(h, nothing));
  }
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_is_not_definite) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    for (int j = 0; j < 6; ++j) {
      for (int i = j; i < 6; ++i) {
        Matrix h = Matrix::Identity();
        h(i, j) = value;
        if (i == j && value == 1e200) continue;  // that is definite
        BOOST_TEST(!is_positive_definite(h, nothing));
      }
    }
  }
  BOOST_TEST(!is_positive_definite(Matrix(1e200 * Matrix::Identity()), nothing));
}

BOOST_AUTO_TEST_SUITE_END()
