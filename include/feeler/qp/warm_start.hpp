// Where a QP solver starts.
#pragma once

#include "feeler/core/fixed_vector.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Rows that were active in a problem like the one to solve, by their index in the new one: the caller knows
/// which row became which.
///
/// It is a guess and never changes the answer beyond rounding: rows that do not exist or do not fit are left
/// out.
struct WarmStart {
  static constexpr int capacity = 6;

  WarmStart() noexcept = default;
  /// The active rows of a solution, where rows have kept their index.
  template <RealScalar Scalar>
  explicit WarmStart(const QpSolution<Scalar>& solution) noexcept {
    for (const auto& active : solution.active) rows.push_back(active.row);
  }

  FixedVector<int, capacity> rows;
};

}  // namespace feeler
