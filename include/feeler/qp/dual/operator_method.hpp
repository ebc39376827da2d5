// The dual active-set method of Goldfarb and Idnani, in operator form.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/dual/active_operators.hpp"
#include "feeler/qp/dual/best_row.hpp"
#include "feeler/qp/dual/fresh_look.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/problem_rows.hpp"
#include "feeler/qp/dual/row_scan.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/solution.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// Starts at the unconstrained minimum, or where known rows hold, and adds the row that maximises violation²/(aᵀPa) until none is violated.
///
/// Source: D. Goldfarb, A. Idnani, "A numerically stable dual method for solving strictly convex quadratic programs", Mathematical Programming 27
/// (1983), in the operators of its section 3, `ActiveOperators`, kept by rank-one updates; a row that is nearly dependent on the active ones is
/// projected twice. An answer is optimal once a fresh look at all rows and at the gradient agrees, and infeasible once rows in conflict cancel; where
/// rounding prevents both, everything is done again with operators from an orthogonal factor.
template <RealScalar Scalar, int lanes>
class OperatorMethod {
 public:
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// @param known      rows to start from, which may not exist
  /// @param inverse    of the Hessian, inverted
  /// @param tolerance  violation of a row that is accepted [m]
  /// @param solution   with no rows, and a step of zero
  QpStatus solve(const Problem& problem, const WarmStart& known, const InverseHessian<Scalar>& inverse, const Six<Scalar>& gradient,
                 const Scalar& tolerance, Solution& solution) noexcept {
    inverse_ = &inverse;
    gradient_ = &gradient;
    tolerance_ = accepted_ = tolerance;
    bounds_ = problem.bounds.data();
    is_careful_ = false;
    dependent_angle_ = dependent_angle<Scalar>();
    Outcome outcome = run(problem, known, solution);
    if (outcome == Outcome::in_doubt) outcome = run_with_care(problem, solution);
    if (!is_finite()) {  // nor was the input: no step is the only one that is sure to be finite
      solution.conflict.clear();
      return QpStatus::iteration_limit;
    }
    copy_six(x_.data(), solution.step.data());
    for (int i = 0; i < rows_.size(); ++i) solution.active.push_back({rows_[i], multipliers_[index(i)]});
    if (outcome == Outcome::optimal) return QpStatus::optimal;
    return outcome == Outcome::infeasible ? QpStatus::infeasible : QpStatus::iteration_limit;
  }

 private:
  using Operators = ActiveOperators<Scalar, lanes>;
  using Six = detail::Six<Scalar>;

  enum class Outcome { optimal, infeasible, in_doubt };
  enum class Entry { done, refused, infeasible, in_doubt };

  /// Of a row's weight with nothing active: where active rows leave less, rounding shows in it.
  static constexpr double clear_share = 1e-3;

  static std::size_t index(int i) noexcept { return std::size_t(i); }

  /// Starts again with operators from an orthogonal factor, and uses up most of the tolerance, so that rows
  /// that agree within it meet in more than a point.
  Outcome run_with_care(const Problem& problem, Solution& solution) noexcept {
    is_careful_ = true;
    const Scalar smallest_angle = 128 * std::numeric_limits<Scalar>::epsilon();
    Scalar rounding = (std::min)(rounding_at(x_), rounding_at(inverse_->inverse_times(*gradient_)));
    for (const double coarseness : {1.0, 1.0, 30.0, 1e6}) {
      relax_bounds(problem, rounding);
      dependent_angle_ = Scalar(coarseness) * smallest_angle;
      const Outcome outcome = run(problem, WarmStart{}, solution);
      rounding = rounding_at(x_);
      if (outcome == Outcome::infeasible) return outcome;
      if (outcome == Outcome::optimal && !scan_.is_violated(problem, problem.bounds.data(), x_, tolerance_, 2 * rounding)) return outcome;
    }
    return Outcome::in_doubt;
  }

  void relax_bounds(const Problem& problem, Scalar rounding) noexcept {
    constexpr double share = 0.875;
    for (int k = 0; k < problem.row_count; ++k) {
      const Scalar allowed = tolerance_ + product(rounding, size_of(row_of(problem, k)));
      relaxed_bounds_[index(k)] = problem.bounds[index(k)] - product(Scalar(share), allowed);
    }
    bounds_ = relaxed_bounds_.data();
    accepted_ = Scalar(1 - share) * tolerance_;
  }

  Outcome run(const Problem& problem, const WarmStart& start, Solution& solution) noexcept {
    operators_.reset(*inverse_);
    rows_.clear();
    x_ = inverse_->inverse_times(*gradient_);
    for (Scalar& coordinate : x_) coordinate = -coordinate;
    for (const int row : start.rows) assume(problem, row);
    drop_negative();

    bool is_weighed = rows_.size() == 0, is_measured = true, is_strict = false;
    int entering = -1;
    if (is_weighed) {
      entering = scan_.start(problem, bounds_, *inverse_, x_, accepted_);
      if (entering < 0 && !scan_.is_violated(problem, bounds_, x_, accepted_)) return Outcome::optimal;
    }
    const int limit = (is_careful_ ? 16 : 8) * (problem.row_count + 8);
    while (solution.iterations <= limit) {
      while (entering >= 0) {
        const Entry entry = enter(problem, limit, solution, entering);
        if (entry == Entry::infeasible) return Outcome::infeasible;
        if (entry == Entry::in_doubt) return Outcome::in_doubt;
        is_strict = is_strict || (is_measured && entry == Entry::refused);
        is_measured = false;
      }
      ++solution.iterations;
      const Scalar rounding = is_strict ? rounding_at(x_) : Scalar(0);
      const bool is_violated =
          is_strict ? scan_.is_violated(problem, bounds_, x_, accepted_, rounding) : scan_.is_violated(problem, bounds_, x_, accepted_);
      if (is_violated) {
        scan_.measure(problem, bounds_, x_, rounding);
        mark_active();
        if (!is_weighed) scan_.weigh(problem, *inverse_, operators_.projector());
        is_weighed = is_measured = true;
        entering = scan_.select(problem, accepted_);
        if (entering < 0) entering = most_violated(problem, rounding);
      }
      if (entering < 0 && (rows_.size() == 0 || !refine(problem))) {
        const bool are_numbers = !is_violated || !scan_.is_violated(problem, bounds_, x_, std::numeric_limits<Scalar>::infinity());
        return are_numbers ? Outcome::optimal : Outcome::in_doubt;
      }
    }
    return Outcome::in_doubt;
  }

  /// Of the rows that are not active; −1 if none is violated.
  ///
  /// Chosen by more digits than the scan has, as is needed where lengths or the Hessian are out of all proportion.
  int most_violated(const Problem& problem, Scalar rounding) const noexcept {
    int row = -1;
    Scalar most = accepted_;
    for (int k = 0; k < problem.row_count; ++k) {
      const Six a = row_of(problem, k);
      const Scalar violation = bounds_[k] - dot(a, x_) - product(rounding, size_of(a));
      if (violation > most && std::find(rows_.begin(), rows_.end(), k) == rows_.end()) row = k, most = violation;
    }
    return row;
  }

  bool is_finite() const noexcept {
    using std::abs;
    using std::isfinite;
    Scalar sum(0);
    for (const Scalar& coordinate : x_) sum += abs(coordinate);
    for (int i = 0; i < rows_.size(); ++i) sum += multipliers_[index(i)];
    return isfinite(sum);
  }

  /// Whether no step along P·a meets the row that lacks `violation`: where its angle with the span of the
  /// active rows is too small or, with care, where the step leads far off.
  bool is_dependent(const Six& a, const Scalar& whole, const Scalar& violation, const Scalar& slope) const noexcept {
    if (rows_.full()) return true;
    if (!(slope > dependent_angle_ * dependent_angle_ * whole)) return true;
    const Scalar clear = Scalar(1e-12);
    if (!is_careful_ || slope > clear * whole) return false;
    return violation / slope * largest_of(operators_.image().step) > far_away(a, x_, violation);
  }

  /// a·H⁻¹·a, to all digits.
  Scalar whole_weight(const Six& a) const noexcept { return dot(a, inverse_->inverse_times(a)); }
  Scalar slope_along(const Six& a) const noexcept { return dot_of_six<Scalar>(a, operators_.image().step); }

  void mark_active() noexcept {
    for (int i = 0; i < rows_.size(); ++i) scan_.set_active(rows_[i]);
  }

  /// Makes a row active with equality, whatever the sign of its multiplier; leaves out rows that depend on
  /// others.
  void assume(const Problem& problem, int row) noexcept {
    if (row < 0 || row >= problem.row_count || rows_.full()) return;
    if (std::find(rows_.begin(), rows_.end(), row) != rows_.end()) return;
    const Six a = row_of(problem, row);
    const Scalar whole = whole_weight(a);
    operators_.apply(a);
    const Scalar slope = slope_along(a);
    if (!(slope > Scalar(clear_share) * whole)) return;
    const Scalar step = (bounds_[row] - dot(a, x_)) / slope;
    move(step);
    activate(row, a, step, slope);
  }

  /// Drops active rows until no multiplier is negative.
  void drop_negative() noexcept {
    while (rows_.size() > 0) {
      const auto least = std::min_element(multipliers_.begin(), multipliers_.begin() + rows_.size());
      if (!(*least < Scalar(0))) return;
      const int slot = int(least - multipliers_.begin());
      const Six dual = operators_.dual(slot);
      const Scalar curvature = curve(dual);
      const Scalar step = -*least / curvature;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) x_[j] += product(step, dual[j]);
      move_multipliers(-step);
      release(slot, dual, curvature);
    }
  }

  /// Where the active rows or the gradient are off, takes one step of Newton's method and returns true.
  bool refine(const Problem& problem) noexcept {
    Six residual, lacking{}, force{};
    Scalar beside(0);
    for (int i = 0; i < rows_.size(); ++i) {
      lacking[index(i)] = bounds_[rows_[i]] - dot(operators_.normal(i), x_);
      beside = (std::max)(beside, magnitude(lacking[index(i)]));
      subtract(operators_.normal(i), Scalar(-multipliers_[index(i)]), force);
    }
    if (!look(problem).is_off(*inverse_, *gradient_, x_, rows_, multipliers_, force, lacking, beside, residual)) return false;

    const Six across = operators_.step_of(lacking);
    const Six pulled = inverse_->hessian_times(across);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) residual[j] += pulled[j];
    operators_.apply(residual);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += across[j] - operators_.image().step[j];
    move_multipliers(Scalar(-1));
    drop_negative();
    return true;
  }

  /// Makes row p satisfied with equality, dropping rows whose multiplier would turn negative.
  /// @param p  afterwards the next row to add, or −1
  [[gnu::always_inline]] inline Entry enter(const Problem& problem, int limit, Solution& solution, int& p) noexcept {
    const int row = p;
    const Six a = row_of(problem, row);
    const Scalar excused = rounding_of_dot(a, x_);
    const auto lacking = [&] { return bounds_[row] - dot(a, x_); };
    Scalar violation = lacking();
    p = -1;
    if (!(violation > accepted_ + excused)) return Entry::refused;  // a fresh look says that it is met
    Scalar whole = scan_.whole_weight(row);
    Scalar multiplier(0);
    while (++solution.iterations <= limit) {
      operators_.apply(a);
      Scalar slope = slope_along(a);
      if (!(slope >= Scalar(clear_share) * whole)) {
        whole = whole_weight(a);
        operators_.project_again();
        slope = slope_along(a);
      }
      const bool has_no_step = is_dependent(a, whole, violation, slope);

      Scalar step = has_no_step ? std::numeric_limits<Scalar>::infinity() : Scalar(violation / slope);
      int leaving = -1;
      for (int i = 0; i < rows_.size(); ++i) {
        const Scalar& share = operators_.image().share[index(i)];
        if (multipliers_[index(i)] < step * share && share > Scalar(0)) {  // in this order, which a processor foresees
          step = multipliers_[index(i)] / share;
          leaving = i;
        }
      }
      const bool is_full = leaving < 0;
      if (has_no_step && is_full) return conclude_conflict(problem, row, a, solution);
      if (!has_no_step) move(step);
      multiplier += step;
      if (is_full) {
        clamp_multipliers();
        p = scan_.add(problem, operators_.image().step, step, slope, accepted_);
        scan_.set_active(row);
        if (p == row) p = -1;  // all others are violated by less than rounding leaves of this one, if at all
        activate(row, a, multiplier, slope);
        if (is_careful_) refine(problem);
        return Entry::done;
      }
      if (has_no_step) move_multipliers(step);
      clamp_multipliers();
      const auto z = operators_.image().step;
      const Six dual = operators_.dual(leaving);
      const Scalar curvature = curve(dual);
      scan_.drop(problem, z, has_no_step ? Scalar(0) : step, dual, curvature);
      scan_.set_violation(rows_[leaving], Scalar(0));
      release(leaving, dual, curvature);
      violation = lacking();
    }
    return Entry::in_doubt;
  }

  /// No step meets row p, as it is a sum of active ones with negative shares: then these rows contradict each
  /// other.
  [[gnu::noinline]]
  Entry conclude_conflict(const Problem& problem, int p, const Six& a, Solution& solution) noexcept {
    Six shares{}, rest = a;
    bool is_sum = false;
    for (int round = 0; round < 2 && !is_sum; ++round) {  // what rounding left of it is in the span as well
      if (round > 0) operators_.apply(rest);
      rest = a;
      for (int i = 0; i < rows_.size(); ++i) {
        Scalar& share = shares[index(i)];
        share = (std::min)(Scalar(share + operators_.image().share[index(i)]), Scalar(0));
        subtract(operators_.normal(i), share, rest);
      }
      is_sum = !(size_of(rest) > allowed_rest(a));
    }
    const Scalar allowed = is_careful_ ? Scalar(-1) : tolerance_;  // with care the bounds are relaxed
    return look(problem).is_contradiction(p, a, rest, is_sum, x_, rows_, shares, allowed, solution) ? Entry::infeasible : Entry::in_doubt;
  }

  /// A step along P·a, and what it does to the multipliers.
  void move(const Scalar& step) noexcept {
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += product(step, operators_.image().step[j]);
    move_multipliers(step);
  }
  void move_multipliers(const Scalar& step) noexcept {
    using Group = Lanes<Scalar, lanes>;
    const Group by = spread<Group>(step);
    for (std::size_t g = 0; g < index(rows_.size()); g += std::size_t(lanes)) {
      const Group change = product<Group>(by, load<Group>(&operators_.image().share[g]));
      store(&multipliers_[g], Group(load<Group>(&multipliers_[g]) - change));
    }
  }
  void clamp_multipliers() noexcept {
    using Group = Lanes<Scalar, lanes>;
    for (std::size_t g = 0; g < index(rows_.size()); g += std::size_t(lanes))
      store(&multipliers_[g], greater<Group>(load<Group>(&multipliers_[g]), Group{}));
  }

  /// Applies the operators to H·dual and returns dual·H·dual.
  Scalar curve(const Six& dual) noexcept {
    const Six curved = inverse_->hessian_times(dual);
    operators_.apply(curved);
    return dot(dual, curved);
  }

  void activate(int row, const Six& a, const Scalar& multiplier, const Scalar& slope) noexcept {
    multipliers_[index(rows_.size())] = multiplier;
    rows_.push_back(row);
    operators_.add(a, slope);
    if (is_careful_) operators_.rebuild(*inverse_);
  }

  void release(int slot, const Six& dual, const Scalar& curvature) noexcept {
    operators_.drop(slot, *inverse_, dual, curvature);
    rows_.swap_remove(slot);
    multipliers_[index(slot)] = multipliers_[index(rows_.size())];
    if (is_careful_) operators_.rebuild(*inverse_);
  }

  FreshLook<Scalar> look(const Problem& problem) const noexcept { return FreshLook<Scalar>(problem, bounds_, accepted_); }

  const InverseHessian<Scalar>* inverse_ = nullptr;
  const Six* gradient_ = nullptr;
  Operators operators_;
  RowScan<Scalar, lanes> scan_;
  const Scalar* bounds_ = nullptr;  // of the rows, and the violation of them that is accepted
  Scalar accepted_ = Scalar(0), tolerance_ = Scalar(0);
  alignas(64) std::array<Scalar, std::size_t(Problem::row_capacity)> relaxed_bounds_{};
  Six x_{};
  typename Operators::Column multipliers_{};  // a number an active row
  FixedVector<int, Operators::slot_count> rows_;  // active, in the order of the operators' slots
  Scalar dependent_angle_ = Scalar(0);  // of a row with the span of others, in the metric of H⁻¹ [rad]
  bool is_careful_ = false;
};

}  // namespace feeler::detail
