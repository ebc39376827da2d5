// A proof that rows can not be met together, from multipliers that grow without bound.
#pragma once

#include <array>
#include <limits>

#include "feeler/qp/gram_schmidt.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/reference/optimality.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Looks for weights y ≥ 0 with Σ y a = 0 and Σ y b > tolerance Σ y (Farkas), among the rows that carry a
/// diverging dual solution.
///
/// The weights are moved onto at most six independent rows, always so that Σ λ a stays and Σ λ b grows. Where
/// nothing bounds the move, its direction is the proof. Rows at an angle below about 1e-8 rad to the span of
/// the others count as dependent.
/// @param multipliers  the ray, or an iterate far out on it; weights below 1e-6 of the largest are ignored
/// @return whether there is a proof; `solution.conflict` then names its rows, and `active` is empty
/// Cost: about 300 multiplications a row with a weight; noexcept, no allocation.
template <RealScalar Scalar>
bool find_conflict(const QpProblem<Scalar>& problem, const QpMultipliers<Scalar>& multipliers, const Scalar& tolerance,
                   QpSolution<Scalar>& solution) noexcept {
  struct Carrying {
    int row = -1;
    Scalar weight = Scalar(0);
  };
  const auto at = [](int i) { return std::size_t(i); };
  const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
  const Scalar angle = rounding > Scalar(1e-8) ? rounding : Scalar(1e-8);
  const Scalar negligible = Scalar(1e-9);

  Scalar largest(0);
  for (int k = 0; k < problem.row_count; ++k) {
    if (multipliers[at(k)] > largest) largest = multipliers[at(k)];
  }
  std::array<Carrying, 6> carrying;
  int count = 0;
  GramSchmidt<Scalar> basis;
  for (int p = 0; p < problem.row_count; ++p) {
    if (!(multipliers[at(p)] > Scalar(1e-6) * largest) || !is_finite_number(multipliers[at(p)])) continue;
    const Vector6<Scalar> a = problem.rows[at(p)];
    const auto e = basis.expand(a, a);
    if (count < 6 && e.free_squared > angle * angle * e.squared) {
      basis.add(e);
      carrying[at(count++)] = {p, multipliers[at(p)]};
      continue;
    }
    Scalar gain = problem.bounds[at(p)], weights(1), sizes = problem.bounds[at(p)] < Scalar(0) ? Scalar(-gain) : gain;
    for (int i = 0; i < count; ++i) {
      const Scalar& share = e.coefficients[at(i)];
      const Scalar part = share * problem.bounds[at(carrying[at(i)].row)];
      gain -= part;
      sizes += part < Scalar(0) ? Scalar(-part) : part;
      weights += share < Scalar(0) ? Scalar(-share) : share;
    }
    const bool grows = gain > Scalar(0);
    Scalar way = grows ? Scalar(0) : multipliers[at(p)];  // of p's weight, up or down
    int leaving = -1;
    for (int i = 0; i < count; ++i) {
      const Scalar share = grows ? e.coefficients[at(i)] : Scalar(-e.coefficients[at(i)]);
      if (share > negligible && ((grows && leaving < 0) || carrying[at(i)].weight < way * share)) {
        way = carrying[at(i)].weight / share;
        leaving = i;
      }
    }
    if (grows && leaving < 0) {
      if (!(gain > tolerance * weights + rounding * sizes)) continue;
      solution.active.clear();
      solution.conflict.clear();
      solution.conflict.push_back(p);
      for (int i = 0; i < count; ++i) {
        if (e.coefficients[at(i)] < -negligible) solution.conflict.push_back(carrying[at(i)].row);
      }
      return true;
    }
    for (int i = 0; i < count; ++i) {
      const Scalar share = grows ? Scalar(-e.coefficients[at(i)]) : e.coefficients[at(i)];
      const Scalar weight = carrying[at(i)].weight + way * share;
      carrying[at(i)].weight = weight > Scalar(0) ? weight : Scalar(0);
    }
    if (leaving < 0) continue;
    carrying[at(leaving)] = {p, grows ? Scalar(multipliers[at(p)] + way) : Scalar(multipliers[at(p)] - way)};
    basis.clear();
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const Vector6<Scalar> row = problem.rows[at(carrying[at(i)].row)];
      const auto expansion = basis.expand(row, row);
      if (!(expansion.free_squared > angle * angle * expansion.squared)) continue;
      carrying[at(kept++)] = carrying[at(i)];
      basis.add(expansion);
    }
    count = kept;
  }
  return false;
}

}  // namespace feeler
