// What a QP solver returns.
#pragma once

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

/// How a QP solver ended; `QpSolution` says what each status leaves behind.
enum class QpStatus {
  optimal,                ///< KKT conditions hold to the solver's tolerance
  infeasible,             ///< no point meets the rows to seven eighths of the solver's tolerance; `conflict` names rows that prove it
  iteration_limit,        ///< the step is finite and may violate rows
  not_positive_definite,  ///< the Hessian has no Cholesky factor; the step is zero
};

/// A step and its multipliers. The step is finite and the multipliers are non-negative after every status.
template <RealScalar ScalarType>
struct QpSolution {
  using Scalar = ScalarType;
  static constexpr int active_capacity = 6;

  /// An active row and its multiplier: H d + g = Σ multiplier · row.
  struct ActiveRow {
    int row = -1;
    Scalar multiplier = Scalar(0);
  };

  Vector6<Scalar> step = Vector6<Scalar>::Zero();
  FixedVector<ActiveRow, active_capacity> active;  ///< at most six: linearly independent rows
  FixedVector<int, active_capacity + 1> conflict;  ///< rows of an infeasibility certificate
  int iterations = 0;
};

}  // namespace feeler
