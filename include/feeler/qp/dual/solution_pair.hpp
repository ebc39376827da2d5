// The solution pair of the dual method: a point, and the active rows on which it is the minimum.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/active_operators.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/kkt_check.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// The S-pair (x, A) of Goldfarb and Idnani, with the multipliers of A and its operators P and N* (`ActiveOperators`).
///
/// Source: D. Goldfarb, A. Idnani, Mathematical Programming 27 (1983), section 2. Between a step and the change of A that follows it, it is none.
template <RealScalar Scalar, int lanes>
class SolutionPair {
 public:
  using Operators = ActiveOperators<Scalar, lanes>;
  using Six = detail::Six<Scalar>;
  using Rows = FixedVector<int, Operators::slot_count>;
  using Multipliers = typename Operators::Column;

  /// The unconstrained minimum, −H⁻¹g, with nothing active.
  /// @param inverse     of the Hessian, kept by reference
  /// @param is_careful  whether operators are made anew, from an orthogonal factor, after each change
  void reset(const InverseHessian<Scalar>& inverse, const Six& gradient, bool is_careful) noexcept {
    inverse_ = &inverse;
    is_careful_ = is_careful;
    operators_.reset(inverse);
    rows_.clear();
    x_ = inverse.inverse_times(gradient);
    for (Scalar& coordinate : x_) coordinate = -coordinate;
  }

  const Six& x() const noexcept { return x_; }
  /// In the order of the operators' slots.
  const Rows& rows() const noexcept { return rows_; }
  /// One number for each active row; behind them is some number.
  const Multipliers& multipliers() const noexcept { return multipliers_; }
  Operators& operators() noexcept { return operators_; }
  const Operators& operators() const noexcept { return operators_; }
  bool has(int row) const noexcept { return std::find(rows_.begin(), rows_.end(), row) != rows_.end(); }

  bool is_finite() const noexcept {
    using std::abs;
    using std::isfinite;
    Scalar sum(0);
    for (const Scalar& coordinate : x_) sum += abs(coordinate);
    for (int i = 0; i < rows_.size(); ++i) sum += multipliers_[as_index(i)];
    return isfinite(sum);
  }

  /// a·P·a, after the operators were applied to a.
  Scalar slope_along(const Six& a) const noexcept { return dot_of_six<Scalar>(a, operators_.image().step); }

  /// A step along P·a, and what it does to the multipliers.
  void move(const Scalar& step) noexcept {
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += product(step, operators_.image().step[j]);
    move_multipliers(step);
  }
  void move_multipliers(const Scalar& step) noexcept {
    using Group = Lanes<Scalar, lanes>;
    const Group by = spread<Group>(step);
    for (std::size_t g = 0; g < as_index(rows_.size()); g += std::size_t(lanes)) {
      const Group change = product<Group>(by, load<Group>(&operators_.image().share[g]));
      store(&multipliers_[g], Group(load<Group>(&multipliers_[g]) - change));
    }
  }
  void clamp_multipliers() noexcept {
    using Group = Lanes<Scalar, lanes>;
    for (std::size_t g = 0; g < as_index(rows_.size()); g += std::size_t(lanes))
      store(&multipliers_[g], greater<Group>(load<Group>(&multipliers_[g]), Group{}));
  }

  /// The active row, by its slot, whose multiplier a step along P·a brings to zero first, or −1; then the step is no longer than that (ratio test).
  int first_to_leave(Scalar& step) const noexcept {
    int leaving = -1;
    for (int i = 0; i < rows_.size(); ++i) {
      const Scalar& share = operators_.image().share[as_index(i)];
      if (multipliers_[as_index(i)] < step * share && share > Scalar(0)) {  // in this order, which a processor foresees
        step = multipliers_[as_index(i)] / share;
        leaving = i;
      }
    }
    return leaving;
  }

  /// The shares of the active rows in row a, none of them positive, and the rest; whether that is what rounding leaves.
  /// @param a       last applied to
  /// @param shares  0
  bool expand(const Six& a, Six& shares, Six& rest) noexcept {
    for (int round = 0; round < 2; ++round) {  // what rounding left of it is in the span as well
      if (round > 0) operators_.apply(rest);
      rest = a;
      for (int i = 0; i < rows_.size(); ++i) {
        Scalar& share = shares[as_index(i)];
        share = (std::min)(Scalar(share + operators_.image().share[as_index(i)]), Scalar(0));
        subtract(operators_.normal(i), share, rest);
      }
      if (!(norm1(rest) > allowed_rest(a))) return true;
    }
    return false;
  }

  /// Applies the operators to H·dual and returns dual·H·dual.
  Scalar curve(const Six& dual) noexcept {
    const Six curved = inverse_->hessian_times(dual);
    operators_.apply(curved);
    return dot(dual, curved);
  }

  /// @param a      the row, last applied to
  /// @param slope  `slope_along(a)`
  void add(int row, const Six& a, const Scalar& multiplier, const Scalar& slope) noexcept {
    multipliers_[as_index(rows_.size())] = multiplier;
    rows_.push_back(row);
    operators_.add(a, slope);
    if (is_careful_) operators_.rebuild(*inverse_);
  }

  /// @param dual       of the slot
  /// @param curvature  `curve(dual)`
  void drop(int slot, const Six& dual, const Scalar& curvature) noexcept {
    operators_.drop(slot, *inverse_, dual, curvature);
    rows_.swap_remove(slot);
    multipliers_[as_index(slot)] = multipliers_[as_index(rows_.size())];
    if (is_careful_) operators_.rebuild(*inverse_);
  }

  /// Drops active rows until no multiplier is negative.
  void drop_negative() noexcept {
    while (!rows_.empty()) {
      const auto least = std::min_element(multipliers_.begin(), multipliers_.begin() + rows_.size());
      if (!(*least < Scalar(0))) return;
      const int slot = int(least - multipliers_.begin());
      const Six dual = operators_.dual(slot);
      const Scalar curvature = curve(dual);
      const Scalar step = -*least / curvature;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) x_[j] += product(step, dual[j]);
      move_multipliers(-step);
      drop(slot, dual, curvature);
    }
  }

  /// One step of Newton's method for the active rows as equations.
  /// @param lacking   by how much x falls short of each active row
  /// @param residual  of the gradient, less the force of the rows
  void correct(const Six& lacking, Six residual) noexcept {
    const Six across = operators_.step_of(lacking);
    const Six pulled = inverse_->hessian_times(across);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) residual[j] += pulled[j];
    operators_.apply(residual);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += across[j] - operators_.image().step[j];
    move_multipliers(Scalar(-1));
    drop_negative();
  }

 private:
  const InverseHessian<Scalar>* inverse_ = nullptr;
  Operators operators_;
  Six x_{};
  Multipliers multipliers_{};
  Rows rows_;
  bool is_careful_ = false;
};

}  // namespace feeler::detail
