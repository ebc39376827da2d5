// Rows of a quadratic program, as the parts of a solver read them from its columns.
#pragma once

#include <array>
#include <cstddef>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"

namespace feeler::detail {

template <RealScalar Scalar>
Six<Scalar> row_of(const QpProblem<Scalar>& problem, int k) noexcept {
  Six<Scalar> a;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) a[std::size_t(j)] = problem.rows.column(j)[k];
  return a;
}

/// As many rows as a group has lanes, from row k on.
template <class Group, RealScalar Scalar>
[[gnu::always_inline]] inline std::array<Group, 6> rows_of(const QpProblem<Scalar>& problem, int k) noexcept {
  std::array<Group, 6> a;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) a[std::size_t(j)] = load<Group>(problem.rows.column(j) + k);
  return a;
}

}  // namespace feeler::detail
