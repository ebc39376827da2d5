// The rows of a quadratic program in the coordinates in which its Hessian is diagonal.
#pragma once

#include <array>
#include <cstddef>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/problem_rows.hpp"
#include "feeler/qp/row_values.hpp"
#include "feeler/qp/six.hpp"

namespace feeler::detail {

/// yₖ = L⁻¹aₖ of rows aₖ, where the Hessian is LDLᵀ, by columns.
template <RealScalar Scalar, int lanes, int capacity>
class LowerRows {
 public:
  using Group = Lanes<Scalar, lanes>;
  using SixGroups = std::array<Group, 6>;

  /// @param hessian  factored, not inverted; in place until the last call, as are the rows
  void start(const QpProblem<Scalar>& problem, const InverseHessian<Scalar>& hessian) noexcept {
    hessian_ = &hessian;
    is_own_ = !hessian.is_diagonal();
    first_ = is_own_ ? columns_[0].data() : problem.rows.column(0);
    stride_ = is_own_ ? sizeof(Values) / sizeof(Scalar) : std::size_t(RowList<Scalar, QpProblem<Scalar>::row_capacity>::stride);
  }
  struct Taken {
    SixGroups y, scaled;  // and D⁻¹y
  };
  /// Computes the rows of a group, from row k on, and keeps them.
  Taken take(const QpProblem<Scalar>& problem, int k) noexcept {
    Taken rows;
    rows.y = rows_of<Group>(problem, k);
    if (is_own_) {
      rows.y = hessian_->solve_lower(rows.y);
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) columns_[j].set(k, rows.y[j]);
    }
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
      rows.scaled[j] = product(spread<Group>(hessian_->inverse_pivots()[j]), rows.y[j]);
      scaled_[j].set(k, rows.scaled[j]);
    }
    return rows;
  }

  /// Of the rows of a group, from row k on.
  SixGroups at(int k) const noexcept {
    SixGroups y;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) y[j] = load<Group>(first_ + j * stride_ + std::size_t(k));
    return y;
  }
  Six<Scalar> row(int k) const noexcept {
    Six<Scalar> y;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) y[j] = entry(k, j);
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

  const Scalar& entry(int k, std::size_t j) const noexcept { return first_[j * stride_ + std::size_t(k)]; }

  std::array<Values, 6> columns_, scaled_;
  const InverseHessian<Scalar>* hessian_ = nullptr;
  const Scalar* first_ = nullptr;
  std::size_t stride_ = 0;
  bool is_own_ = false;  // else they are the columns of the problem
};

}  // namespace feeler::detail
