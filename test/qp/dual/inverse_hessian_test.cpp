#include "feeler/qp/dual/inverse_hessian.hpp"

#include <boost/test/unit_test.hpp>

#include <limits>
#include <random>
#include <tuple>

#include <Eigen/Dense>

#include "support/general_problem.hpp"
#include "support/random_geometry.hpp"

BOOST_AUTO_TEST_SUITE(inverse_hessian)

namespace {

using Inverse = feeler::detail::InverseHessian<double>;
using Six = feeler::detail::Six<double>;
using feeler_test::in_six;
using Matrix6 = feeler::Matrix6<double>;
using Vector6 = feeler::Vector6<double>;
using Scalars = std::tuple<float, double, long double>;

Vector6 in_vector(const Six& v) { return Eigen::Map<const Vector6>(v.data()); }

void check_near(const Vector6& found, const Vector6& expected, double tolerance = 1e-11) {
  BOOST_TEST((found - expected).norm() <= tolerance * (1 + expected.norm()));
}

}  // namespace

// One object for all of them: nothing of a Hessian is left for the next.
BOOST_AUTO_TEST_CASE(full_and_diagonal_hessians_in_turn_have_the_factors_and_the_inverse_of_eigen) {
  constexpr unsigned seed = 102;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 bits(seed);
  Inverse inverse;
  for (int i = 0; i < 300; ++i) {
    const bool is_diagonal = i % 2 == 1;
    const Matrix6 h = feeler_test::general_problem(bits, 0, is_diagonal).hessian;
    const Vector6 v = feeler_test::random_six(bits);
    const Eigen::LLT<Matrix6> expected(h);  // H = CCᵀ, L = C·diag(C)⁻¹
    const Matrix6 c = expected.matrixL();
    const Matrix6 l = c * c.diagonal().cwiseInverse().asDiagonal();
    BOOST_TEST_REQUIRE(inverse.factor(h));
    BOOST_TEST(inverse.is_diagonal() == is_diagonal);
    check_near(in_vector(inverse.inverse_pivots()), c.diagonal().cwiseAbs2().cwiseInverse());
    check_near(in_vector(inverse.solve_lower(in_six(v))), l.triangularView<Eigen::UnitLower>().solve(v));
    check_near(in_vector(inverse.solve_upper(in_six(v))), l.transpose().triangularView<Eigen::UnitUpper>().solve(v));
    check_near(in_vector(inverse.solve(in_six(v))), expected.solve(v));
    check_near(in_vector(inverse.hessian_times(in_six(v))), h * v);
    inverse.invert();
    const Matrix6 h_inverse = expected.solve(Matrix6::Identity());
    check_near(in_vector(inverse.inverse_times(in_six(v))), h_inverse * v);
    check_near(in_vector(inverse.hessian_times(in_six(v))), h * v);
    const auto root = inverse.root();
    Matrix6 w;
    for (int j = 0; j < 6; ++j) w.row(j) = in_vector(root[std::size_t(j)]).transpose();
    for (int j = 0; j < 6; ++j) {
      check_near((w.transpose() * w).col(j), h_inverse.col(j));
      if (!is_diagonal) check_near(in_vector(inverse.matrix()[std::size_t(j)]), h_inverse.col(j));
    }
  }
}

BOOST_AUTO_TEST_CASE(zeros_below_the_diagonal_are_zeros_whatever_their_sign_and_anything_else_is_not) {
  Inverse inverse;
  for (int j = 0; j < 6; ++j) {
    for (int i = j + 1; i < 6; ++i) {
      for (const double entry : {0.0, -0.0, std::numeric_limits<double>::denorm_min(), 1e-3}) {
        Matrix6 h = 2 * Matrix6::Identity();
        h(i, j) = h(j, i) = entry;
        BOOST_TEST(inverse.factor(h));
        BOOST_TEST(inverse.is_diagonal() == (entry == 0));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_pivot_that_is_zero_negative_infinite_or_no_number_is_refused_wherever_it_is, Scalar, Scalars) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  feeler::detail::InverseHessian<Scalar> inverse;
  for (const Scalar beside : {Scalar(0), Scalar(0.125)}) {
    for (int j = 0; j < 6; ++j) {
      for (const Scalar pivot : {Scalar(0), Scalar(-1), infinity, -infinity, std::numeric_limits<Scalar>::quiet_NaN()}) {
        feeler::Matrix6<Scalar> h = feeler::Matrix6<Scalar>::Identity();
        h(5, 0) = h(0, 5) = beside;
        BOOST_TEST(inverse.factor(h));
        h(j, j) = pivot;
        BOOST_TEST_INFO("pivot " << j << " is " << pivot << " with " << beside << " in a corner");
        BOOST_TEST(!inverse.factor(h));
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
