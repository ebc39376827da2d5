// The Cholesky factor of a symmetric 6×6 matrix, without square roots.
#pragma once

#include "feeler/core/scalar.hpp"

namespace feeler {

/// H = LDLᵀ, with L unit lower triangular: the metric of a problem, or the normal matrix of a Newton step.
///
/// Free of square roots, so that a rational scalar gives exact solutions. Not pivoted: a positive definite
/// matrix needs none. Cost: 56 multiplications for the factor and 42 for a solution.
template <RealScalar Scalar>
class Ldlt6 {
 public:
  /// Reads the lower triangle; false unless the matrix is positive definite and finite.
  bool factor(const Matrix6<Scalar>& h) noexcept {
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      Vector6<Scalar> scaled = Vector6<Scalar>::Zero();  // row j of LD
      Scalar pivot = h(j, j);
#pragma GCC unroll 6
      for (int k = 0; k < j; ++k) {
        scaled[k] = l_(j, k) * d_[k];
        pivot -= scaled[k] * l_(j, k);
      }
      if (!(pivot > Scalar(0)) || !(pivot - pivot == Scalar(0))) return false;
      d_[j] = pivot;
#pragma GCC unroll 6
      for (int i = j + 1; i < 6; ++i) {
        Scalar sum = h(i, j);
#pragma GCC unroll 6
        for (int k = 0; k < j; ++k) sum -= l_(i, k) * scaled[k];
        l_(i, j) = sum / pivot;
      }
    }
    return true;
  }

  /// H⁻¹v.
  Vector6<Scalar> solve(const Vector6<Scalar>& v) const noexcept {
    Vector6<Scalar> x = v;
    for (int i = 1; i < 6; ++i) {
      for (int k = 0; k < i; ++k) x[i] -= l_(i, k) * x[k];
    }
    for (int i = 0; i < 6; ++i) x[i] /= d_[i];
    for (int i = 4; i >= 0; --i) {
      for (int k = i + 1; k < 6; ++k) x[i] -= l_(k, i) * x[k];
    }
    return x;
  }

 private:
  Matrix6<Scalar> l_ = Matrix6<Scalar>::Identity();
  Vector6<Scalar> d_ = Vector6<Scalar>::Ones();
};

}  // namespace feeler
