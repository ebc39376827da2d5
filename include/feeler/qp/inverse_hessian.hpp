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
        w[j][k] = scale * (is_diagonal_ ? Scalar(j == k ? 1 : 0) : l_inverse_[j][k]);
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

  bool factorise() noexcept {
    SixBySix<Scalar> l{};  // rows
    for (std::size_t j = 0; j < 6; ++j) {
      Six<Scalar> scaled{};  // row j of LD
      Scalar pivot = hessian_[j][j];
      for (std::size_t k = 0; k < j; ++k) {
        scaled[k] = l[j][k];
        l[j][k] *= d_inverse_[k];
        pivot -= product(scaled[k], l[j][k]);
      }
      if (!is_pivot(pivot)) return false;
      d_inverse_[j] = Scalar(1) / pivot;
      for (std::size_t i = j + 1; i < 6; ++i) {  // below the diagonal LD for now
        Scalar sum = hessian_[j][i];
        for (std::size_t k = 0; k < j; ++k) sum -= product(l[i][k], l[j][k]);
        l[i][j] = sum;
      }
    }
    l_inverse_ = {};
    for (std::size_t j = 0; j < 6; ++j) {
      l_inverse_[j][j] = Scalar(1);
      for (std::size_t i = j + 1; i < 6; ++i) {
        Scalar sum = -l[i][j];
        for (std::size_t k = j + 1; k < i; ++k) sum -= product(l[i][k], l_inverse_[k][j]);
        l_inverse_[i][j] = sum;
      }
    }
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t i = j; i < 6; ++i) {
        Scalar sum(0);
        for (std::size_t k = i; k < 6; ++k) {
          sum += product(product(l_inverse_[k][i], d_inverse_[k]), l_inverse_[k][j]);
        }
        inverse_[i][j] = inverse_[j][i] = sum;
      }
    }
    return true;
  }

  Six<Scalar> diagonal_{};
  SixBySix<Scalar> hessian_{};
  SixBySix<Scalar> inverse_{};
  SixBySix<Scalar> l_inverse_{};  // rows of L⁻¹, as `hessian_` where H is not diagonal
  Six<Scalar> d_inverse_{};
  bool is_diagonal_ = false;
};

}  // namespace feeler::detail
