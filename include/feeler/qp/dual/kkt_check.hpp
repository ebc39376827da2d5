// Whether what a QP solver found meets the conditions of an optimum, or proves that there is none: from the problem alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/problem_rows.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler::detail {

/// A length that no step to a row a that lacks `violation` at x has, in all reason.
template <RealScalar Scalar>
Scalar far_away(const Six<Scalar>& a, const Six<Scalar>& x, const Scalar& violation) noexcept {
  return Scalar(1e6) * (norm_inf(x) + violation / norm1(a));
}
/// What rounding leaves of a row that is a sum of others.
template <RealScalar Scalar>
Scalar allowed_rest(const Six<Scalar>& a) noexcept {
  return (std::max)(Scalar(1e-12), Scalar(64 * std::numeric_limits<Scalar>::epsilon())) * norm1(a);
}

/// The conditions of Karush, Kuhn and Tucker at x with rows that are said to be active there, and the certificate of Farkas.
template <RealScalar Scalar>
class KktCheck {
 public:
  /// @param bounds    of the rows of the problem [m]
  /// @param accepted  by how much x may lie beside a row [m]
  KktCheck(const QpProblem<Scalar>& problem, const Scalar* bounds, const Scalar& accepted) noexcept
      : problem_(problem), bounds_(bounds), accepted_(accepted) {}

  /// Whether the active rows or the gradient are off.
  /// @param rows      that are active
  /// @param force     of them, the sum of their normals by their multipliers
  /// @param lacking   by how much x falls short of each of them
  /// @param beside    and lies beside one at most
  /// @param residual  of the gradient, to be found
  template <class Rows, class Multipliers, class Distances>
  [[gnu::always_inline]] inline bool fails(const InverseHessian<Scalar>& hessian, const Six<Scalar>& gradient, const Six<Scalar>& x, const Rows& rows,
                                           const Multipliers& multipliers, const Six<Scalar>& force, const Distances& lacking, const Scalar& beside,
                                           Six<Scalar>& residual) const noexcept {
    const Six<Scalar> bent = hessian.hessian_times(x);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) residual[j] = (bent[j] + gradient[j]) - force[j];
    const Scalar rounding_of_sum = 1024 * std::numeric_limits<Scalar>::epsilon(), off = norm1(residual);
    const Scalar size = norm1(bent) + norm1(gradient);
    if (beside <= accepted_ && off <= rounding_of_sum * size) return false;
    return fails_for_its_size(x, rows, multipliers, lacking, off / rounding_of_sum - size);
  }

  /// Whether row p and active rows, whose sum it is but for a rest, contradict each other; then they are the conflict of the solution.
  ///
  /// They do not where a step could use the rest, or where all of them together agree within what each is allowed.
  /// @param a        row p
  /// @param is_sum   whether the rest is what rounding leaves
  /// @param rows     active at x
  /// @param shares   of each in row p, none positive
  /// @param allowed  what a row may lack but for rounding [m]; nothing, and no rounding, where it is negative
  template <class Rows>
  bool is_contradiction(int p, const Six<Scalar>& a, const Six<Scalar>& rest, bool is_sum, const Six<Scalar>& x, const Rows& rows,
                        const Six<Scalar>& shares, const Scalar& allowed, QpSolution<Scalar>& solution) const noexcept {
    const bool is_strict = allowed < Scalar(0);
    const Scalar rounding = rounding_at(x);
    const auto allowed_of = [&](const Six<Scalar>& row) { return is_strict ? Scalar(0) : Scalar(allowed + product(rounding, norm1(row))); };
    Scalar slack = allowed_of(a), violation = bounds_[p] - dot(a, x);
    for (int i = 0; i < rows.size(); ++i) {
      const Six<Scalar> normal = row_of(problem_, rows[i]);
      const Scalar& share = shares[std::size_t(i)];
      slack -= product(share, allowed_of(normal));
      const Scalar drift = bounds_[rows[i]] - dot(normal, x);  // of x off this row
      violation -= product(share, drift);
    }
    // A step some times as long as this one could use the rest; where that is more than rounding leaves, a far longer one.
    const Scalar reach = is_sum || is_strict ? Scalar(16 * norm_inf(x)) : far_away(a, x, violation);
    if (!(violation > slack + norm1(rest) * reach)) return false;
    solution.conflict.push_back(p);
    for (int i = 0; i < rows.size(); ++i) {
      if (shares[std::size_t(i)] < -Scalar(1e-9)) solution.conflict.push_back(rows[i]);
    }
    return true;
  }

 private:
  /// What the sizes of the rows excuse is seldom needed.
  /// @param excess  of the residual, in units of its rounding
  template <class Rows, class Multipliers, class Distances>
  [[gnu::noinline]] bool fails_for_its_size(const Six<Scalar>& x, const Rows& rows, const Multipliers& multipliers, const Distances& lacking,
                                            Scalar excess) const noexcept {
    const Scalar rounding = rounding_at(x);
    for (int i = 0; i < rows.size(); ++i) {
      const auto slot = std::size_t(i);
      const Scalar row_size = norm1(row_of(problem_, rows[i]));
      excess -= product(multipliers[slot], row_size);
      if (magnitude(lacking[slot]) > accepted_ + product(rounding, row_size)) return true;
    }
    return excess > Scalar(0);
  }

  const QpProblem<Scalar>& problem_;
  const Scalar* bounds_;
  Scalar accepted_;
};

}  // namespace feeler::detail
