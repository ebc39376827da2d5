// The active rows of a problem of a few rows, by what the force of each does to every other.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/best_row.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/six.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// The dual active-set method of Goldfarb and Idnani on the table A·H⁻¹·Aᵀ of up to eight rows A.
///
/// An entry of the table is what the force of one row adds to another. Where a row becomes active it is swept: one outer product takes what its
/// force does from all others, and then the table tells how the forces of the active rows follow that of the next one, and how much every other
/// row is free to move. A step costs a row of the table and a division, where operators in six dimensions are a chain of sums; but the whole
/// table has to be made and followed, which pays where rows are few. Source: J. H. Goodnight, "A tutorial on the SWEEP operator", The American
/// Statistician 33 (1979); forces of active rows are kept in a unit in which the row's own column stays as it is.
///
/// Rows are chosen as by `RowScan`, and every lane computed alike, however many there are. Where a row all but depends on active ones, by an angle
/// below 3e-4 rad, the table has too few digits of it left, and its column is computed afresh; where it depends on them, the table gives up.
template <RealScalar Scalar, int lanes>
class DualTableau {
 public:
  static constexpr int row_capacity = 8;

  /// Looks for the rows that are active at the minimum; false where it gives up, with rows that are active at the minimum of some of the rows.
  /// @param problem    of at most `row_capacity` rows
  /// @param bounds     of the rows [m]
  /// @param hessian    factored, not inverted
  /// @param tolerance  violation of a row that is accepted [m]
  bool find(const QpProblem<Scalar>& problem, const Scalar* bounds, const InverseHessian<Scalar>& hessian, const Six<Scalar>& gradient,
            Scalar tolerance) noexcept {
    constexpr int most_steps = 3 * row_capacity;
    count_ = problem.row_count;
    active_.rows.clear();
    is_behind_ = false;
    int entering = start(problem, bounds, hessian, gradient, tolerance);
    if (entering >= 0) fill();
    Scalar multiplier(0);  // of the row that enters
    for (steps_ = 0; entering >= 0; ++steps_) {
      const std::size_t row = index(entering);
      const Values& column = table_[row];
      if (steps_ == most_steps || active_.rows.full()) return false;
      const Scalar whole = Scalar(1 / least_share) * least_weight_[row];
      if (!(weight_[row] > rough() * whole)) measure_again(entering, hessian.inverse_pivots());
      const Scalar slope = weight_[row];  // known before the row's own column
      if (!(slope > independent() * whole)) return false;
      Scalar step = violation_[row] / slope;
      const int leaving = first_to_leave(column, step);
      multiplier += step;
      push(column, step);
      if (leaving < 0) {
        const int next = advance(column, step, slope, tolerance);
        violation_[row] = -std::numeric_limits<Scalar>::infinity();
        multipliers_[index(active_.rows.size())] = multiplier;
        units_[index(active_.rows.size())] = Scalar(1) / column[row];
        active_.rows.push_back(entering);
        is_behind_ = next < 0;
        if (!is_behind_) sweep(entering, Scalar(1));
        entering = next;
        multiplier = Scalar(0);
      } else {
        release(leaving, column, step);
      }
    }
    return true;
  }

  /// After rows were found: the change of their multipliers that moves the tool off each of them by a distance.
  Six<Scalar> change_for(const Six<Scalar>& distances) noexcept {
    if (is_behind_) sweep(active_.rows.back(), Scalar(1));
    is_behind_ = false;
    Six<Scalar> change{};
    for (int k = 0; k < active_.rows.size(); ++k) {  // the table of the active rows is the inverse, negative
      const Values& column = table_[index(active_.rows[k])];
      const Scalar along = product(units_[index(k)], distances[index(k)]);
      for (int i = 0; i < active_.rows.size(); ++i) change[index(i)] -= product(share_of(i, column), along);
    }
    return change;
  }

  const WarmStart& active() const noexcept { return active_; }
  /// Of the active rows, none negative.
  const Six<Scalar>& multipliers() const noexcept { return multipliers_; }
  int steps() const noexcept { return steps_; }

 private:
  using Group = Lanes<Scalar, lanes>;
  using SixGroups = std::array<Group, 6>;
  using Best = BestRow<Scalar, lanes>;
  struct alignas(64) Values : std::array<Scalar, std::size_t(row_capacity)> {};  // a number a row
  static constexpr int groups = row_capacity / lanes;
  /// Share of its weight with nothing active that a row has to have left.
  static Scalar independent() noexcept { return dependent_angle<Scalar>() * dependent_angle<Scalar>(); }
  /// Share of which the table has too few digits.
  static Scalar rough() noexcept { return std::max(Scalar(1e-7), Scalar(1024 * std::numeric_limits<Scalar>::epsilon())); }

  static std::size_t index(int i) noexcept { return std::size_t(i); }
  static int whole_groups(int count) noexcept { return (count + lanes - 1) / lanes * lanes; }
  static Group at(const Values& values, int k) noexcept { return load<Group>(&values[index(k)]); }
  static void set(Values& values, int k, const Group& group) noexcept { store(&values[index(k)], group); }

  /// Violations and weights where nothing is active; returns the row to add, or −1.
  int start(const QpProblem<Scalar>& problem, const Scalar* bounds, const InverseHessian<Scalar>& hessian, const Six<Scalar>& gradient,
            Scalar tolerance) noexcept {
    const Six<Scalar>& d_inverse = hessian.inverse_pivots();
    const Six<Scalar> home = hessian.solve_lower(gradient);
    Best best;
    for (int k = 0; k < count_; k += lanes) {
      SixGroups y, scaled, homes;
#pragma GCC unroll 6
      for (int j = 0; j < 6; ++j) y[index(j)] = load<Group>(problem.rows.column(j) + k);
      if (!hessian.is_diagonal()) y = hessian.solve_lower(y);
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) {
        homes[j] = spread<Group>(home[j]);
        scaled[j] = product(spread<Group>(d_inverse[j]), y[j]);
        set(lower_[j], k, y[j]);
        set(scaled_[j], k, scaled[j]);
      }
      const Group violation = only_rows<Scalar, lanes>(load<Group>(bounds + k) + dot_of_six<Group>(scaled, homes), count_ - k);
      const Group weight = dot_of_six<Group>(scaled, y), least = spread<Group>(smallest_weight<Scalar>());
      set(violation_, k, violation);
      set(weight_, k, weight);
      set(least_weight_, k, product(spread<Group>(Scalar(least_share)), weight) + least);
      best.meet(violation, weight + least, spread<Group>(tolerance));
    }
    return best.row();
  }

  /// The whole table.
  void fill() noexcept {
    for (int i = 0; i < count_; ++i) {
      fill_row(i, [&](std::size_t j) -> const Scalar& { return scaled_[j][index(i)]; });
      for (int k = whole_groups(count_); k < row_capacity; k += lanes) set(table_[index(i)], k, Group{});
    }
  }
  /// @param scaled  of D⁻¹ times what is left of L⁻¹a of the row, number j
  template <class Scaled>
  [[gnu::always_inline]] inline void fill_row(int row, const Scaled& scaled) noexcept {
    SixGroups by;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) by[j] = spread<Group>(scaled(j));
    for (int k = 0; k < count_; k += lanes) {
      SixGroups y;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) y[j] = at(lower_[j], k);
      set(table_[index(row)], k, dot_of_six<Group>(y, by));
    }
  }

  /// Column and weight of a row that all but depends on the active ones, by what is left of it beside them.
  ///
  /// The table tells how far it is their sum; taken from the row itself twice (W. Kahan, in B. Parlett, "The Symmetric Eigenvalue Problem",
  /// section 6-9) that leaves as many digits of the rest as a scalar has.
  [[gnu::noinline]]
  void measure_again(int entering, const Six<Scalar>& d_inverse) noexcept {
    const int count = active_.rows.size();
    Values& column = table_[index(entering)];
    Six<Scalar> rest = row_of(lower_, entering), share{};
    for (int i = 0; i < count; ++i) share[index(i)] = share_of(i, column);
    take(share, rest);
    Six<Scalar> along{};
    for (int i = 0; i < count; ++i) along[index(i)] = dot(row_of(scaled_, active_.rows[i]), rest);
    const Six<Scalar> change = change_for(along);
    take(change, rest);
    const Six<Scalar> scaled = multiply(d_inverse, rest);
    fill_row(entering, [&](std::size_t j) -> const Scalar& { return scaled[j]; });
    for (int i = 0; i < count; ++i) column[index(active_.rows[i])] = (share[index(i)] + change[index(i)]) / units_[index(i)];
    weight_[index(entering)] = column[index(entering)] = dot(scaled, rest);
    for (int k = 0; k < count_; ++k) table_[index(k)][index(entering)] = column[index(k)];
  }
  static Six<Scalar> row_of(const std::array<Values, 6>& columns, int row) noexcept {
    Six<Scalar> numbers;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) numbers[j] = columns[j][index(row)];
    return numbers;
  }
  /// Takes shares of the active rows from one.
  void take(const Six<Scalar>& shares, Six<Scalar>& rest) const noexcept {
    for (int i = 0; i < active_.rows.size(); ++i) subtract(row_of(lower_, active_.rows[i]), shares[index(i)], rest);
  }

  /// The active row, by its place, whose force ends first within a step, which ends there; −1 if none does.
  int first_to_leave(const Values& column, Scalar& step) const noexcept {
    int leaving = -1;
    for (int i = 0; i < active_.rows.size(); ++i) {
      const Scalar share = share_of(i, column);
      if (share > Scalar(0) && multipliers_[index(i)] < product(step, share)) {
        step = multipliers_[index(i)] / share;
        leaving = i;
      }
    }
    return leaving;
  }
  void push(const Values& column, Scalar step) noexcept {
    for (int i = 0; i < active_.rows.size(); ++i)
      multipliers_[index(i)] = std::max(Scalar(0), multipliers_[index(i)] - product(step, share_of(i, column)));
  }
  Scalar share_of(int i, const Values& column) const noexcept { return product(column[index(active_.rows[i])], units_[index(i)]); }

  /// Violations after a step, weights after its row is active, and the row to add next, or −1.
  int advance(const Values& column, Scalar length, Scalar slope, Scalar tolerance) noexcept {
    const Group step = spread<Group>(length), factor = spread<Group>(Scalar(1) / slope);
    Best best;
    for (int k = 0; k < count_; k += lanes) {
      const Group c = at(column, k);
      const Group violation = at(violation_, k) - product(step, c);
      const Group weight = at(weight_, k) - product(product(factor, c), c);
      set(violation_, k, violation);
      set(weight_, k, weight);
      best.meet(violation, greater(weight, at(least_weight_, k)), spread<Group>(tolerance));
    }
    return best.row();
  }

  /// Ends the force of an active row after a step that another one ends.
  void release(int leaving, const Values& column, Scalar length) noexcept {
    const int row = active_.rows[leaving];
    const Values& own = table_[index(row)];
    const Scalar pivot = own[index(row)], unit = units_[index(leaving)];
    const Group step = spread<Group>(length), factor = spread<Group>(Scalar(1) / pivot);
    for (int k = 0; k < count_; k += lanes) {
      const Group c = at(own, k);
      set(violation_, k, at(violation_, k) - product(step, at(column, k)));
      set(weight_, k, at(weight_, k) - product(product(factor, c), c));
    }
    sweep(row, Scalar(-1) / product(unit, pivot));
    violation_[index(row)] = Scalar(0);
    weight_[index(row)] = table_[index(row)][index(row)];
    active_.rows.swap_remove(leaving);
    multipliers_[index(leaving)] = multipliers_[index(active_.rows.size())];
    units_[index(leaving)] = units_[index(active_.rows.size())];
  }

  /// Exchanges the force of a row and what the tool moves off it.
  /// @param scale  of its column afterwards
  void sweep(int row, Scalar scale) noexcept {
    const Scalar pivot = table_[index(row)][index(row)];
    const Group factor = spread<Group>(Scalar(1) / pivot);
    std::array<Group, std::size_t(groups)> entries;
    Values shares;
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      const Group c = at(table_[index(row)], g * lanes);
      set(shares, g * lanes, product(c, factor));
      entries[index(g)] = with_lane<Scalar, lanes>(c, row - g * lanes, pivot - product(pivot, scale));
    }
    for (int i = 0; i < count_; ++i) {
      const Group share = spread<Group>(shares[index(i)]);
#pragma GCC unroll 8
      for (int g = 0; g < groups; ++g)
        set(table_[index(i)], g * lanes, at(table_[index(i)], g * lanes) - product(share, entries[index(g)]));
    }
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      const Group c = product(entries[index(g)], spread<Group>(scale));
      set(table_[index(row)], g * lanes, with_lane<Scalar, lanes>(c, row - g * lanes, -product(product(pivot, scale), scale)));
    }
  }

  std::array<Values, std::size_t(row_capacity)> table_;
  std::array<Values, 6> lower_, scaled_;  // L⁻¹aₖ and D⁻¹L⁻¹aₖ, by columns
  Values violation_, weight_, least_weight_;  // as in `RowScan`
  WarmStart active_;
  Six<Scalar> multipliers_{}, units_{};  // of the active rows, and what makes shares of their multipliers of their columns
  int count_ = 0, steps_ = 0;
  bool is_behind_ = false;  // the table, by the last row, which became active when nothing was left to follow
};

}  // namespace feeler::detail
