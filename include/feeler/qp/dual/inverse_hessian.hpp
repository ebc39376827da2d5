// The Hessian of a quadratic program, and its inverse.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// H = LDLᵀ with L unit lower triangular, and H⁻¹ = L⁻ᵀD⁻¹L⁻¹; no square roots.
///
/// In two steps, as what is held by known rows needs L alone: `factor`, after which L⁻¹ and its transpose can be applied, and `invert`, after
/// which H⁻¹ can.
template <RealScalar Scalar>
class InverseHessian {
 public:
  /// False, and nothing else is valid, unless H is positive definite.
  /// @param h  in place until the last call
  bool factor(const Matrix6<Scalar>& h) noexcept {
    hessian_ = h.data();
    is_diagonal_ = has_zeros_below();
    return is_diagonal_ ? invert_diagonal() : factorise();
  }
  /// After `factor`: from here on H⁻¹ is known, and L no longer.
  void invert() noexcept {
    if (!is_diagonal_) multiply_out();
  }

  bool is_diagonal() const noexcept { return is_diagonal_; }
  /// D⁻¹; where H is diagonal, H⁻¹.
  const Six<Scalar>& inverse_pivots() const noexcept { return d_inverse_; }
  /// L⁻¹·v
  template <class Group>
  std::array<Group, 6> solve_lower(std::array<Group, 6> v) const noexcept {
    if (is_diagonal_) return v;
#pragma GCC unroll 6
    for (std::size_t i = 1; i < 6; ++i) {
#pragma GCC unroll 6
      for (std::size_t k = 0; k < i; ++k) v[i] -= product(spread<Group>(lower_[i][k]), v[k]);
    }
    return v;
  }
  /// H⁻¹·v, by L.
  [[gnu::always_inline]] inline Six<Scalar> solve(const Six<Scalar>& v) const noexcept {
    return is_diagonal_ ? multiply(d_inverse_, v) : solve_by_factor(v);
  }
  /// L⁻ᵀ·v
  Six<Scalar> solve_upper(Six<Scalar> v) const noexcept {
    if (is_diagonal_) return v;
#pragma GCC unroll 6
    for (std::size_t below = 1; below < 6; ++below) {
      const std::size_t i = 5 - below;
#pragma GCC unroll 6
      for (std::size_t k = i + 1; k < 6; ++k) v[i] -= product(lower_[k][i], v[k]);
    }
    return v;
  }
  /// H⁻¹ where it is not diagonal.
  const SixBySix<Scalar>& matrix() const noexcept { return inverse_; }
  /// H⁻¹·v
  Six<Scalar> inverse_times(const Six<Scalar>& v) const noexcept { return is_diagonal_ ? multiply(d_inverse_, v) : multiply(inverse_, v); }
  /// H·v
  [[gnu::always_inline]] inline Six<Scalar> hessian_times(const Six<Scalar>& v) const noexcept {
    if (!is_diagonal_) return full_hessian_times(v);
    Six<Scalar> image;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) image[j] = product(entry(j, j), v[j]);
    return image;
  }
  /// Rows of W = D^(−½)L⁻¹: H⁻¹ = WᵀW.
  SixBySix<Scalar> root() const noexcept {
    using std::sqrt;
    SixBySix<Scalar> w;
    for (std::size_t j = 0; j < 6; ++j) {
      const Scalar scale = sqrt(d_inverse_[j]);
      for (std::size_t k = 0; k < 6; ++k) w[j][k] = k < j && !is_diagonal_ ? Scalar(scale * lower_[j][k]) : Scalar(k == j ? scale : Scalar(0));
    }
    return w;
  }

 private:
  const Scalar& entry(std::size_t i, std::size_t j) const noexcept { return hessian_[6 * j + i]; }
  static bool is_pivot(const Scalar& pivot) noexcept { return pivot > Scalar(0) && pivot < (std::numeric_limits<Scalar>::max)(); }

  /// Whether all below the diagonal is 0; by the bits of the numbers where that is cheaper.
  bool has_zeros_below() const noexcept {
    if constexpr (has_lanes<Scalar>) {
      using Bits = std::make_unsigned_t<LaneBits<Scalar>>;
      Bits set = 0;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) {
#pragma GCC unroll 6
        for (std::size_t i = j + 1; i < 6; ++i) set |= std::bit_cast<Bits>(entry(i, j));
      }
      return Bits(set << 1) == 0;  // but for signs
    } else {
      bool are_zeros = true;
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t i = j + 1; i < 6; ++i) are_zeros = are_zeros && entry(i, j) == Scalar(0);
      }
      return are_zeros;
    }
  }

  [[gnu::noinline]] Six<Scalar> solve_by_factor(const Six<Scalar>& v) const noexcept { return solve_upper(multiply(d_inverse_, solve_lower(v))); }
  [[gnu::noinline]] Six<Scalar> full_hessian_times(const Six<Scalar>& v) const noexcept {
    Six<Scalar> image;
    for (std::size_t j = 0; j < 6; ++j) image[j] = dot_of_six<Scalar>(hessian_ + 6 * j, v);
    return image;
  }

  bool invert_diagonal() noexcept {
    constexpr int lanes = (std::min)(lanes_of<Scalar>, 2);
    using Group = Lanes<Scalar, lanes>;
    auto is_definite = Group{} <= Group{};
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; j += std::size_t(lanes)) {
      Group pivots;
      if constexpr (lanes == 1) pivots = entry(j, j);
      else pivots = Group{entry(j, j), entry(j + 1, j + 1)};
      is_definite &= Group{} < pivots;
      is_definite &= pivots < spread<Group>((std::numeric_limits<Scalar>::max)());
      store(&d_inverse_[j], Group(spread<Group>(Scalar(1)) / pivots));
    }
    return in_all_lanes<Scalar, lanes>(is_definite);
  }

  /// L and D. Compilers keep the factor in registers where they know every bound, and do not always unroll so far unasked.
  bool factorise() noexcept {
    SixBySix<Scalar> l;  // rows, before the diagonal
    bool is_definite = true;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
      Scalar pivot = entry(j, j);
#pragma GCC unroll 6
      for (std::size_t k = 0; k < j; ++k) {
        const Scalar scaled = l[j][k];  // of LD
        l[j][k] *= d_inverse_[k];
        pivot -= product(scaled, l[j][k]);
        lower_[j][k] = l[j][k];
      }
      is_definite = is_definite & is_pivot(pivot);
      d_inverse_[j] = Scalar(1) / pivot;
#pragma GCC unroll 6
      for (std::size_t i = j + 1; i < 6; ++i) {  // below the diagonal LD for now
        Scalar sum = entry(i, j);
#pragma GCC unroll 6
        for (std::size_t k = 0; k < j; ++k) sum -= product(l[i][k], l[j][k]);
        l[i][j] = sum;
      }
    }
    return is_definite;
  }

  /// L⁻¹ in the place of L, and H⁻¹.
  void multiply_out() noexcept {
    const SixBySix<Scalar> l = lower_;
    SixBySix<Scalar> l_inverse;  // rows, before the diagonal
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
#pragma GCC unroll 6
      for (std::size_t i = j + 1; i < 6; ++i) {
        Scalar sum = -l[i][j];
#pragma GCC unroll 6
        for (std::size_t k = j + 1; k < i; ++k) sum -= product(l[i][k], l_inverse[k][j]);
        l_inverse[i][j] = lower_[i][j] = sum;
      }
    }
#pragma GCC unroll 6
    for (std::size_t i = 0; i < 6; ++i) {
      Six<Scalar> scaled;  // column i of D⁻¹L⁻¹
#pragma GCC unroll 6
      for (std::size_t k = i + 1; k < 6; ++k) scaled[k] = product(l_inverse[k][i], d_inverse_[k]);
#pragma GCC unroll 6
      for (std::size_t j = 0; j <= i; ++j) {
        Scalar sum = j == i ? d_inverse_[i] : product(d_inverse_[i], l_inverse[i][j]);
#pragma GCC unroll 6
        for (std::size_t k = i + 1; k < 6; ++k) sum += product(scaled[k], l_inverse[k][j]);
        inverse_[i][j] = inverse_[j][i] = sum;
      }
    }
  }

  const Scalar* hessian_ = nullptr;  // by columns
  SixBySix<Scalar> inverse_{};
  SixBySix<Scalar> lower_{};  // rows before the diagonal of L, then of L⁻¹; where H is not diagonal
  alignas(16) Six<Scalar> d_inverse_{};
  bool is_diagonal_ = false;
};

}  // namespace feeler::detail
