// The minimum of a quadratic where known rows hold with equality.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/dual/held_rows.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/row_values.hpp"
#include "feeler/qp/dual/schur_complement.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// min ½ xᵀHx + gᵀx subject to aᵢ·x = bᵢ for up to six rows, with their multipliers.
///
/// The multipliers solve A·H⁻¹·Aᵀ·λ = b + A·H⁻¹·g, with A the rows: H needs no inverse, and the rows no operators. Where the terms of x all but
/// cancel, as those of a tool that is pinned, it lies beside its rows by more than ten digits of itself, and a step or two of iterative refinement
/// follow. The same bits with every number of lanes.
template <RealScalar Scalar, int lanes>
class HeldMinimum {
 public:
  /// A number of each row, in the order of the start; what lies behind the last one is some number.
  using Values = RowValues<Scalar, lanes, 8>;

  /// False, and nothing else is valid, where a row does not exist, where one all but depends on those before it, or where a multiplier is
  /// negative.
  /// @param bounds   of the rows of the problem [m]
  /// @param hessian  factored, not inverted
  bool find(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& start, const InverseHessian<Scalar>& hessian,
            const Six<Scalar>& gradient) noexcept {
    for (const int row : start.rows) {
      if (row < 0 || row >= problem.row_count) return false;
    }
    return with_rows(problem, bounds, start, [&](const auto& rows) {
      SchurComplement schur(rows, hessian);
      auto multipliers = schur.rows_times(hessian.solve_lower(gradient));
#pragma GCC unroll 8
      for (std::size_t g = 0; g < multipliers.size(); ++g) multipliers[g] = multipliers[g] + rows.bounds()[g];
      if (!schur.sweep_and_solve(multipliers)) return false;
      multipliers = rows.only_rows(multipliers);
      if (!rows.are_not_negative(multipliers)) return false;
      place(rows, multipliers, hessian, gradient);
      constexpr int most_refinements = 2;
      for (int i = 0; i < most_refinements && beside_ > rough() * norm_inf(x_); ++i)
        shift(rows, rows.only_rows(schur.solve(rows.values(lacking_))), hessian);
      return true;
    });
  }

  /// The same where the multipliers are known, with some steps of refinement.
  /// @param rows         of the problem, that exist
  /// @param multipliers  of them
  /// @param change_for   the change of the multipliers that moves x off each row by a distance
  /// @param accepted     by how much x may lie beside a row [m]
  template <class Numbers, class ChangeFor>
  void place(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& start, const Numbers& multipliers,
             const InverseHessian<Scalar>& hessian, const Six<Scalar>& gradient, const ChangeFor& change_for, const Scalar& accepted) noexcept {
    with_rows(problem, bounds, start, [&](const auto& rows) {
      place(rows, rows.values(multipliers), hessian, gradient);
      return true;
    });
    if (beside_ > accepted) refine(problem, bounds, start, hessian, change_for, accepted);
  }

  const Six<Scalar>& x() const noexcept { return x_; }
  const Values& multipliers() const noexcept { return multipliers_; }
  /// Aᵀλ
  const Six<Scalar>& force() const noexcept { return force_; }
  /// By how much x falls short of each row, and lies beside one at most [m].
  const Values& lacking() const noexcept { return lacking_; }
  const Scalar& beside() const noexcept { return beside_; }

 private:
  template <class ChangeFor>
  [[gnu::noinline]] void refine(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& start, const InverseHessian<Scalar>& hessian,
                                const ChangeFor& change_for, const Scalar& accepted) noexcept {
    constexpr int most_refinements = 5;
    with_rows(problem, bounds, start, [&](const auto& rows) {
      for (int i = 0; i < most_refinements && beside_ > accepted; ++i) shift(rows, rows.values(change_for(lacking_)), hessian);
      return true;
    });
  }

  /// Calls with as much room for rows as they need.
  template <class Do>
  static bool with_rows(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& rows, const Do& act) noexcept {
    const int count = rows.rows.size();
    if (count <= 1) return act(HeldRows<Scalar, 1, 1>(problem, bounds, rows));
    if (count <= 4) return act(HeldRows<Scalar, lanes, 4>(problem, bounds, rows));
    return act(HeldRows<Scalar, lanes, (lanes < 4 ? 6 : 8)>(problem, bounds, rows));
  }

  template <class Rows>
  static void keep(const typename Rows::Values& from, Values& to) noexcept {
#pragma GCC unroll 8
    for (std::size_t g = 0; g < from.size(); ++g) store(&to[g * std::size_t(Rows::lanes)], from[g]);
  }

  /// Goes where multipliers lead. Forces that cancel do so before they are scaled.
  template <class Rows>
  [[gnu::always_inline]] inline void place(const Rows& rows, const typename Rows::Values& multipliers, const InverseHessian<Scalar>& hessian,
                                           const Six<Scalar>& gradient) noexcept {
    keep<Rows>(multipliers, multipliers_);
    force_ = rows.sum(multipliers);
    Six<Scalar> rest;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) rest[j] = force_[j] - gradient[j];
    x_ = hessian.solve(rest);
    measure(rows);
  }
  /// Moves x by a change of the multipliers.
  template <class Rows>
  [[gnu::noinline]] void shift(const Rows& rows, const typename Rows::Values& change, const InverseHessian<Scalar>& hessian) noexcept {
    typename Rows::Values multipliers = rows.values(multipliers_);
#pragma GCC unroll 8
    for (std::size_t g = 0; g < change.size(); ++g)
      multipliers[g] = greater<typename Rows::Group>(multipliers[g] + change[g], typename Rows::Group{});
    keep<Rows>(multipliers, multipliers_);
    force_ = rows.sum(multipliers);
    const Six<Scalar> step = hessian.solve(rows.sum(change));
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += step[j];
    measure(rows);
  }
  template <class Rows>
  [[gnu::always_inline]] inline void measure(const Rows& rows) noexcept {
    using Group = typename Rows::Group;
    auto lacking = rows.lacking(x_);
    if constexpr (Rows::capacity == 1) lacking = rows.only_rows(lacking);  // what fills up more is one of them
    keep<Rows>(lacking, lacking_);
    Group most{};
#pragma GCC unroll 8
    for (std::size_t g = 0; g < lacking.size(); ++g) most = greater(greater<Group>(lacking[g], Group(-lacking[g])), most);
    beside_ = largest_lane<Scalar, Rows::lanes>(most);
  }

  /// Of x, by which it may lie beside a row.
  static Scalar rough() noexcept { return (std::min)(Scalar(0x1p17) * std::numeric_limits<Scalar>::epsilon(), Scalar(0x1p-35)); }

  Values multipliers_{}, lacking_{};
  Six<Scalar> x_{}, force_{};
  Scalar beside_{};
};

}  // namespace feeler::detail
