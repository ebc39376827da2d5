// The active rows of a problem of some rows, by what the force of each does to every other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "feeler/core/index.hpp"
#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/best_row.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/dual/table_by_columns.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// The dual active-set method of Goldfarb and Idnani on the table A·H⁻¹·Aᵀ of some rows A.
///
/// An entry of the table is what the force of one row adds to another. Where a row becomes active it is swept: one outer product takes what its
/// force does from all others. Then the table tells how the forces of the active rows follow that of the next one, and how much every other row is
/// free to move. A step costs a column of the table and a division, where operators in six dimensions are a chain of sums. Forces of active rows are
/// kept in a unit in which the row's own column stays as it is.
/// Source: J. H. Goodnight, "A tutorial on the SWEEP operator", The American Statistician 33 (1979).
///
/// Rows are chosen as by `RowScan`, and every lane computed alike, however many there are. Where a row all but depends on active ones, by an angle
/// below 3e-4 rad, the table has too few digits of it left, and its column is computed afresh.
template <RealScalar Scalar, int lanes>
class DualTableau {
  using Table = TableByColumns<Scalar, lanes>;

 public:
  static constexpr int row_capacity = Table::capacity;

  /// Looks for the rows that are active at the minimum; false where it gives up, with rows that are active at the minimum of some of the rows.
  /// @param problem    of at most `row_capacity` rows
  /// @param bounds     of the rows [m]
  /// @param hessian    factored, not inverted
  /// @param tolerance  violation of a row that is accepted [m]
  [[gnu::always_inline]] inline bool find(const QpProblem<Scalar>& problem, const Scalar* bounds, const InverseHessian<Scalar>& hessian,
                                          const Six<Scalar>& gradient, Scalar tolerance) noexcept {
    count_ = problem.row_count;
    active_.rows.clear();
    is_behind_ = is_inverted_ = false;
    steps_ = 0;
    refused_ = none;
    int entering = start(problem, bounds, hessian, gradient, tolerance);
    if (entering >= 0) table_.start(count_);
    while (entering >= 0) entering = add(entering, tolerance);
    return entering == none;
  }

  /// The change of the multipliers of the active rows that moves the tool off each of them by a distance.
  template <class Distances>
  Six<Scalar> change_for(const Distances& distances) noexcept {
    if (!is_inverted_) invert();
    Six<Scalar> change{};
    for (int k = 0; k < active_.rows.size(); ++k) {
      for (int i = 0; i < active_.rows.size(); ++i) change[as_index(i)] += product(inverse_[as_index(k)][as_index(i)], distances[as_index(k)]);
    }
    return change;
  }

  /// Where it gave up for want of a step: the row that no step meets, else −1. It is a sum of the active rows, by shares none of which is positive.
  int refused() const noexcept { return refused_; }
  const Six<Scalar>& shares() const noexcept { return shares_; }

  const WarmStart& active() const noexcept { return active_; }
  /// Of the active rows, none negative.
  const Six<Scalar>& multipliers() const noexcept { return multipliers_; }
  int steps() const noexcept { return steps_; }

 private:
  using Group = Lanes<Scalar, lanes>;
  using Best = BestRow<Scalar, lanes>;
  using Values = typename Table::Values;
  static constexpr int none = -1, given_up = -2;  // in place of a row
  /// Share of its weight with nothing active that a row has to have left.
  static Scalar independent() noexcept { return dependent_angle<Scalar>() * dependent_angle<Scalar>(); }
  /// Share of which the table has too few digits.
  static Scalar rough() noexcept { return (std::max)(Scalar(1e-7), Scalar(1024 * std::numeric_limits<Scalar>::epsilon())); }

  /// Violations and weights where nothing is active; returns the row to add, or −1.
  int start(const QpProblem<Scalar>& problem, const Scalar* bounds, const InverseHessian<Scalar>& hessian, const Six<Scalar>& gradient,
            Scalar tolerance) noexcept {
    rows_.start(problem, hessian);
    const auto homes = spread_six<Group>(hessian.solve_lower(gradient)), inverse_pivots = spread_six<Group>(hessian.inverse_pivots());
    Best best;
    for (int k = 0; k < count_; k += lanes) {
      const auto scaled = rows_.scale(k, inverse_pivots);
      const Group violation = only_rows<Scalar, lanes>(load<Group>(bounds + k) + dot_of_six<Group>(scaled, homes), count_ - k);
      const Group weight = dot_of_six<Group>(scaled, rows_.at(k)), least = spread<Group>(smallest_weight<Scalar>());
      violation_.set(k, violation);
      weight_.set(k, weight);
      least_weight_.set(k, product(spread<Group>(Scalar(least_share)), weight) + least);
      best.meet(violation, weight + least, spread<Group>(tolerance));
    }
    return best.row();
  }

  /// The inverse of the table of the active rows: what is there in its place, negative.
  [[gnu::noinline]]
  void invert() noexcept {
    if (is_behind_) sweep_last();
    is_behind_ = false;
    is_inverted_ = true;
    for (int k = 0; k < active_.rows.size(); ++k) {
      for (int i = 0; i <= k; ++i) {
        const Scalar share = product(table_.number_of_swept(active_.rows[i], active_.rows[k]), units_[as_index(i)]);
        inverse_[as_index(k)][as_index(i)] = inverse_[as_index(i)][as_index(k)] = -product(share, units_[as_index(k)]);
      }
    }
  }

  /// Makes a row active, whatever leaves for it; returns the row to add next, or `none`, or `given_up`.
  [[gnu::always_inline]] inline int add(int entering, Scalar tolerance) noexcept {
    const std::size_t row = as_index(entering);
    const Scalar unconstrained = Scalar(1 / least_share) * least_weight_[row];
    Values* column = &table_.column(rows_, entering);
    for (Scalar multiplier(0); !table_.is_full();) {
      ++steps_;
      const bool is_free = !active_.rows.full();
      if (is_free && !(weight_[row] > rough() * unconstrained)) measure_again(entering, unconstrained, *column);
      const bool has_step = is_free && weight_[row] > independent() * unconstrained;
      const Scalar inverse = Scalar(1) / weight_[row];
      Scalar step = has_step ? product(violation_[row], inverse) : std::numeric_limits<Scalar>::infinity();
      const int leaving = has_step ? first_to_leave(*column, step) : first_of_sum(entering, *column, step);
      if (leaving < 0 && !has_step) {
        refuse(entering, *column);
        return given_up;
      }
      multiplier += step;
      push(*column, step);
      if (leaving < 0) {
        const int next = advance(*column, step, inverse, tolerance);
        violation_[row] = -std::numeric_limits<Scalar>::infinity();
        multipliers_[as_index(active_.rows.size())] = multiplier;
        units_[as_index(active_.rows.size())] = inverse;
        active_.rows.push_back(entering);
        is_inverted_ = false;
        is_behind_ = next < 0;
        if (!is_behind_) sweep_last();
        return next;
      }
      drop(leaving, *column, step);
      column = &table_.follow(entering);
    }
    return given_up;
  }

  /// Column and weight of a row that all but depends on the active ones, by what is left of it beside them.
  ///
  /// The table tells how far it is their sum. Where that leaves more of it than rounding would, it is taken from the row itself twice (W. Kahan, in
  /// B. Parlett, "The Symmetric Eigenvalue Problem", section 6-9), so that the rest has as many digits as a scalar.
  /// @param unconstrained  its weight with nothing active
  [[gnu::noinline]]
  void measure_again(int entering, const Scalar& unconstrained, Values& column) noexcept {
    const int count = active_.rows.size();
    Six<Scalar> rest = rows_.row(entering), share{};
    for (int i = 0; i < count; ++i) share[as_index(i)] = share_of(i, column);
    take(share, rest);
    if (dot(rows_.scaled(rest), rest) > product(independent(), unconstrained)) {
      Six<Scalar> along{};
      for (int i = 0; i < count; ++i) along[as_index(i)] = dot(rows_.scaled(rows_.row(active_.rows[i])), rest);
      const Six<Scalar> change = change_for(along);
      take(change, rest);
      for (int i = 0; i < count; ++i) share[as_index(i)] += change[as_index(i)];
    }
    const Six<Scalar> scaled = rows_.scaled(rest);
    const auto by = spread_six<Group>(scaled);
    for (int k = 0; k < count_; k += lanes) column.set(k, dot_of_six<Group>(rows_.at(k), by));
    for (int i = 0; i < count; ++i) column[as_index(active_.rows[i])] = share[as_index(i)] / units_[as_index(i)];
    column[as_index(entering)] = dot(scaled, rest);
    weight_[as_index(entering)] = column[as_index(entering)];
    table_.note_measured();
  }
  /// Takes shares of the active rows from one.
  void take(const Six<Scalar>& shares, Six<Scalar>& rest) const noexcept {
    for (int i = 0; i < active_.rows.size(); ++i) subtract(rows_.row(active_.rows[i]), shares[as_index(i)], rest);
  }

  /// The active row, by its place, whose force ends first within a step, which ends there; −1 if none does.
  /// @param counts  whether a share of a row does, which is positive
  template <class Counts>
  int first_to_leave(const Values& column, Scalar& step, const Counts& counts) const noexcept {
    int leaving = -1;
    for (int i = 0; i < active_.rows.size(); ++i) {
      const Scalar share = share_of(i, column);
      // Seldom so: the sign of a share, looked at first, would be a branch that no processor foresees.
      if (multipliers_[as_index(i)] < product(step, share) && share > Scalar(0) && counts(active_.rows[i], share)) {
        step = multipliers_[as_index(i)] / share;
        leaving = i;
      }
    }
    return leaving;
  }
  int first_to_leave(const Values& column, Scalar& step) const noexcept {
    return first_to_leave(column, step, [](int, const Scalar&) { return true; });
  }
  /// The same of active rows whose sum a row is: shares that rounding makes do not count.
  int first_of_sum(int entering, const Values& column, Scalar& step) const noexcept {
    constexpr double rounding = 1e-10;
    const Scalar least = Scalar(rounding * rounding) * least_weight_[as_index(entering)];
    return first_to_leave(column, step, [&](int row, const Scalar& share) { return product(share, share) * least_weight_[as_index(row)] > least; });
  }
  void push(const Values& column, Scalar step) noexcept {
    for (int i = 0; i < active_.rows.size(); ++i)
      multipliers_[as_index(i)] = greater<Scalar>(multipliers_[as_index(i)] - product(step, share_of(i, column)), Scalar(0));
  }
  Scalar share_of(int i, const Values& column) const noexcept { return product(column[as_index(active_.rows[i])], units_[as_index(i)]); }

  /// Violations after a step, weights after its row is active, and the row to add next, or −1.
  /// @param inverse  of the row's weight
  int advance(const Values& column, Scalar length, Scalar inverse, Scalar tolerance) noexcept {
    const Group step = spread<Group>(length), factor = spread<Group>(inverse);
    Best best;
    for (int k = 0; k < count_; k += lanes) {
      const Group c = column.at(k);
      const Group violation = violation_.at(k) - product(step, c);
      const Group shares = product(factor, c);
      const Group weight = weight_.at(k) - product(shares, c);
      table_.set_shares(k, shares);
      violation_.set(k, violation);
      weight_.set(k, weight);
      best.meet(violation, greater(weight, least_weight_.at(k)), spread<Group>(tolerance));
    }
    return best.row();
  }
  /// No step meets a row, and no force that ends makes one.
  void refuse(int row, const Values& column) noexcept {
    refused_ = row;
    for (int i = 0; i < active_.rows.size(); ++i) shares_[as_index(i)] = (std::min)(Scalar(0), share_of(i, column));
  }
  /// Brings the table up to the row that became active last.
  void sweep_last() noexcept { table_.add(active_.rows.back()); }

  /// Ends the force of an active row after a step that another one ends.
  [[gnu::noinline]]
  void drop(int leaving, const Values& column, Scalar length) noexcept {
    const int row = active_.rows[leaving];
    Values& own = table_.active_column(rows_, row);
    const Scalar pivot = own[as_index(row)], inverse = Scalar(1) / pivot, scale = Scalar(-1) / product(units_[as_index(leaving)], pivot);
    const Group step = spread<Group>(length), factor = spread<Group>(inverse);
    for (int k = 0; k < count_; k += lanes) {
      const Group c = own.at(k), shares = product(factor, c);
      violation_.set(k, violation_.at(k) - product(step, column.at(k)));
      weight_.set(k, Group(weight_.at(k) - product(shares, c)));
      table_.set_shares(k, shares);
    }
    table_.drop(row, scale);
    violation_[as_index(row)] = Scalar(0);
    weight_[as_index(row)] = -product(product(pivot, scale), scale);
    active_.rows.swap_remove(leaving);
    is_inverted_ = false;
    multipliers_[as_index(leaving)] = multipliers_[as_index(active_.rows.size())];
    units_[as_index(leaving)] = units_[as_index(active_.rows.size())];
  }

  Table table_;
  typename Table::Rows rows_;
  Values violation_, weight_, least_weight_;  // as in `RowScan`
  WarmStart active_;
  Six<Scalar> multipliers_{}, units_{};  // of the active rows, and what makes shares of their multipliers of their columns
  Six<Scalar> shares_{};  // of the active rows in the one that is refused
  int count_ = 0, steps_ = 0, refused_ = none;
  SixBySix<Scalar> inverse_;  // of the table of the active rows, where it is known
  bool is_inverted_ = false;
  bool is_behind_ = false;  // the table, by the last row, which became active when nothing was left to follow
};

}  // namespace feeler::detail
