// Rotations out of matrices that are nearly ones: against the polar decomposition in wider arithmetic.
#include <boost/test/unit_test.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <limits>
#include <random>

#include "feeler/device/rotation_matrix.hpp"

BOOST_AUTO_TEST_SUITE(rotation_matrix)

namespace {

using WideMatrix = Eigen::Matrix<long double, 3, 3>;

struct Matrix {
  double rows[3][3];
};

Matrix plain(const WideMatrix& m) {
  Matrix result = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.rows[i][j] = double(m(i, j));
  }
  return result;
}

/// Largest difference of an entry.
double distance(const WideMatrix& rotation, const double (&q)[4]) {
  const Eigen::Quaternion<long double> quaternion(q[0], q[1], q[2], q[3]);
  return double((quaternion.toRotationMatrix() - rotation).cwiseAbs().maxCoeff());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_skewed_matrix_becomes_the_nearest_rotation) {
  std::mt19937 bits(11);
  const auto unit = [&bits] { return double(bits()) / 2147483648.0 - 1; };
  for (int trial = 0; trial < 1000; ++trial) {
    Eigen::Quaternion<long double> q(unit(), unit(), unit(), unit());
    q.normalize();
    WideMatrix skewed = q.toRotationMatrix();
    for (int i = 0; i < 9; ++i) skewed(i) += 0.01L * (long double)(unit());
    const Matrix given = plain(skewed);
    // The orthogonal factor of the polar decomposition: A (Aᵀ A)^(-1/2).
    const Eigen::SelfAdjointEigenSolver<WideMatrix> squared(skewed.transpose() * skewed);
    const WideMatrix nearest = skewed * squared.operatorInverseSqrt();
    double quaternion[4] = {0, 0, 0, 0};
    BOOST_REQUIRE(feeler::nearest_rotation(given.rows, quaternion));
    BOOST_TEST(distance(nearest, quaternion) < 1e-14);
    BOOST_TEST(quaternion[0] >= 0);
  }
}

BOOST_AUTO_TEST_CASE(half_turns_keep_all_their_digits) {
  for (int axis = 0; axis < 3; ++axis) {
    WideMatrix half_turn = -WideMatrix::Identity();
    half_turn(axis, axis) = 1;
    double quaternion[4] = {0, 0, 0, 0};
    BOOST_REQUIRE(feeler::nearest_rotation(plain(half_turn).rows, quaternion));
    for (int i = 0; i < 4; ++i) BOOST_TEST(std::abs(quaternion[i]) == (i == axis + 1 ? 1 : 0));
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_rotation_is_refused_and_changes_nothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Matrix bad[] = {
      {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}},  // what a device sends before its first pose
      {{{nan, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},  // a mirror
      {{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
  };
  for (const Matrix& matrix : bad) {
    double quaternion[4] = {0.5, 0.5, 0.5, 0.5};
    BOOST_TEST(!feeler::nearest_rotation(matrix.rows, quaternion));
    for (const double component : quaternion) BOOST_TEST(component == 0.5);
  }
}

BOOST_AUTO_TEST_SUITE_END()
