// The Hessian of a quadratic program, and its inverse.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/six.hpp"

namespace feeler::detail {

/// H = LDLᵀ with L unit lower triangular, and H⁻¹ = L⁻ᵀD⁻¹L⁻¹; no square roots.
template <RealScalar Scalar>
class InverseHessian {
 public:
  /// False, and nothing else is valid, unless H is positive definite.
  bool compute(const Matrix6<Scalar>& h) noexcept {
    is_diagonal_ = true;
    for (int j = 0; j < 6; ++j) {
      diagonal_[index(j)] = h(j, j);
      for (int i = j + 1; i < 6; ++i) is_diagonal_ = is_diagonal_ & (h(i, j) == Scalar(0));
    }
    if (is_diagonal_) return invert_diagonal();
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i < 6; ++i) hessian_[index(j)][index(i)] = h(i, j);
    }
    return factorise();
  }

  bool is_diagonal() const noexcept { return is_diagonal_; }
  /// H⁻¹ where it is diagonal, and where it is not.
  const Six<Scalar>& diagonal() const noexcept { return d_inverse_; }
  const SixBySix<Scalar>& matrix() const noexcept { return inverse_; }
  /// H⁻¹·v
  Six<Scalar> inverse_times(const Six<Scalar>& v) const noexcept {
    return is_diagonal_ ? multiply(d_inverse_, v) : multiply(inverse_, v);
  }
  /// H·v
  Six<Scalar> hessian_times(const Six<Scalar>& v) const noexcept {
    return is_diagonal_ ? multiply(diagonal_, v) : multiply(hessian_, v);
  }
  /// Rows of W = D^(−½)L⁻¹: H⁻¹ = WᵀW.
  SixBySix<Scalar> root() const noexcept {
    using std::sqrt;
    SixBySix<Scalar> w;
    for (std::size_t j = 0; j < 6; ++j) {
      const Scalar scale = sqrt(d_inverse_[j]);
      for (std::size_t k = 0; k < 6; ++k)
        w[j][k] = k < j && !is_diagonal_ ? Scalar(scale * l_inverse_[j][k]) : Scalar(k == j ? scale : Scalar(0));
    }
    return w;
  }

 private:
  static std::size_t index(int i) noexcept { return std::size_t(i); }
  static bool is_pivot(const Scalar& pivot) noexcept {
    return pivot > Scalar(0) && pivot < std::numeric_limits<Scalar>::max();
  }

  bool invert_diagonal() noexcept {
    bool is_definite = true;
    for (std::size_t j = 0; j < 6; ++j) {
      is_definite = is_definite & is_pivot(diagonal_[j]);
      d_inverse_[j] = Scalar(1) / diagonal_[j];
    }
    return is_definite;
  }

  /// Compilers keep the factor in registers where they know every bound, and do not always unroll so far unasked.
  bool factorise() noexcept {
    SixBySix<Scalar> l;  // rows, before the diagonal
    bool is_definite = true;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
      Scalar pivot = hessian_[j][j];
#pragma GCC unroll 6
      for (std::size_t k = 0; k < j; ++k) {
        const Scalar scaled = l[j][k];  // of LD
        l[j][k] *= d_inverse_[k];
        pivot -= product(scaled, l[j][k]);
      }
      is_definite = is_definite & is_pivot(pivot);
      d_inverse_[j] = Scalar(1) / pivot;
#pragma GCC unroll 6
      for (std::size_t i = j + 1; i < 6; ++i) {  // below the diagonal LD for now
        Scalar sum = hessian_[j][i];
#pragma GCC unroll 6
        for (std::size_t k = 0; k < j; ++k) sum -= product(l[i][k], l[j][k]);
        l[i][j] = sum;
      }
    }
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
#pragma GCC unroll 6
      for (std::size_t i = j + 1; i < 6; ++i) {
        Scalar sum = -l[i][j];
#pragma GCC unroll 6
        for (std::size_t k = j + 1; k < i; ++k) sum -= product(l[i][k], l_inverse_[k][j]);
        l_inverse_[i][j] = sum;
      }
    }
#pragma GCC unroll 6
    for (std::size_t i = 0; i < 6; ++i) {
      Six<Scalar> scaled;  // column i of D⁻¹L⁻¹
#pragma GCC unroll 6
      for (std::size_t k = i + 1; k < 6; ++k) scaled[k] = product(l_inverse_[k][i], d_inverse_[k]);
#pragma GCC unroll 6
      for (std::size_t j = 0; j <= i; ++j) {
        Scalar sum = j == i ? d_inverse_[i] : product(d_inverse_[i], l_inverse_[i][j]);
#pragma GCC unroll 6
        for (std::size_t k = i + 1; k < 6; ++k) sum += product(scaled[k], l_inverse_[k][j]);
        inverse_[i][j] = inverse_[j][i] = sum;
      }
    }
    return is_definite;
  }

  Six<Scalar> diagonal_{};
  SixBySix<Scalar> hessian_{};
  SixBySix<Scalar> inverse_{};
  SixBySix<Scalar> l_inverse_{};  // rows of L⁻¹ before the diagonal, as `hessian_` where H is not diagonal
  Six<Scalar> d_inverse_{};
  bool is_diagonal_ = false;
};

}  // namespace feeler::detail
