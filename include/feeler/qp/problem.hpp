// A strictly convex quadratic program in six variables with inequality rows, at fixed capacity.
#pragma once

#include <array>

#include "feeler/core/scalar.hpp"
#include "feeler/qp/row_list.hpp"

namespace feeler {

/// min ½ dᵀ H d + gᵀ d  subject to  aₖᵀ d ≥ bₖ, k < row_count.
///
/// H must be positive definite. Rows come from unit normals, so bₖ and the violation of a row are lengths [m]. The tolerances of solvers are made for
/// steps of 0.4 mm; a renderer states problems with others in a unit of length in which they are about as long (`change_unit_of_length`).
template <RealScalar ScalarType>
struct QpProblem {
  using Scalar = ScalarType;
  static constexpr int row_capacity = 256;

  Matrix6<Scalar> hessian = Matrix6<Scalar>::Identity();
  Vector6<Scalar> gradient = Vector6<Scalar>::Zero();
  int row_count = 0;
  RowList<Scalar, row_capacity> rows;
  alignas(64) std::array<Scalar, row_capacity> bounds{};

  void clear_rows() noexcept { row_count = 0; }
  /// Appends a row; false when there is no room.
  bool add_row(const Vector6<Scalar>& row, Scalar bound) noexcept {
    if (row_count == row_capacity) return false;
    rows[std::size_t(row_count)] = row;
    bounds[std::size_t(row_count)] = bound;
    ++row_count;
    return true;
  }
};

}  // namespace feeler
