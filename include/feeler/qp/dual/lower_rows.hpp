// The rows of a quadratic program in the coordinates in which its Hessian is diagonal.
#pragma once

#include <array>
#include <cstddef>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/problem_rows.hpp"
#include "feeler/qp/dual/row_values.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"

namespace feeler::detail {

/// yₖ = L⁻¹aₖ of rows aₖ, where the Hessian is LDLᵀ, by columns.
template <RealScalar Scalar, int lanes, int capacity>
class LowerRows {
 public:
  using Group = Lanes<Scalar, lanes>;
  using SixGroups = std::array<Group, 6>;

  /// @param hessian  factored, not inverted; in place until the last call
  [[gnu::always_inline]] void start(const QpProblem<Scalar>& problem, const InverseHessian<Scalar>& hessian) noexcept {
    hessian_ = &hessian;
    if (hessian.is_diagonal()) {
      keep(problem, [](const SixGroups& a) { return a; });
    } else {
      keep_lower(problem);
    }
  }
  /// Computes and keeps D⁻¹y of a group, from row k on.
  /// @param inverse_pivots  D⁻¹
  [[gnu::always_inline]] SixGroups scale(int k, const SixGroups& inverse_pivots) noexcept {
    SixGroups scaled;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
      scaled[j] = product(inverse_pivots[j], columns_[j].at(k));
      scaled_[j].set(k, scaled[j]);
    }
    return scaled;
  }

  /// Of the rows of a group, from row k on.
  SixGroups at(int k) const noexcept {
    SixGroups y;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) y[j] = columns_[j].at(k);
    return y;
  }
  Six<Scalar> row(int k) const noexcept {
    Six<Scalar> y;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) y[j] = columns_[j][std::size_t(k)];
    return y;
  }
  /// D⁻¹y
  Six<Scalar> scaled(const Six<Scalar>& y) const noexcept { return multiply(hessian_->inverse_pivots(), y); }
  /// D⁻¹yₖ, in every lane.
  SixGroups scaled_row(int k) const noexcept {
    SixGroups image;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) image[j] = spread<Group>(scaled_[j][std::size_t(k)]);
    return image;
  }

 private:
  using Values = RowValues<Scalar, lanes, capacity>;

  template <class LowerOf>
  [[gnu::always_inline]] void keep(const QpProblem<Scalar>& problem, const LowerOf& lower_of) noexcept {
    for (int k = 0; k < problem.row_count; k += lanes) {
      const SixGroups y = lower_of(rows_of<Group>(problem, k));
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) columns_[j].set(k, y[j]);
    }
  }
  [[gnu::noinline]] void keep_lower(const QpProblem<Scalar>& problem) noexcept {
    keep(problem, [&](const SixGroups& a) { return hessian_->solve_lower(a); });
  }

  std::array<Values, 6> columns_, scaled_;
  const InverseHessian<Scalar>* hessian_ = nullptr;
};

}  // namespace feeler::detail
