// What the force of each of some rows does to every other, computed when it is asked for.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/lower_rows.hpp"
#include "feeler/qp/row_values.hpp"
#include "feeler/qp/six.hpp"

namespace feeler::detail {

/// The table of `DualTableau` where rows are some more: a column is computed when it is asked for, from the rows and from all sweeps so far.
///
/// A column is Aᵀ's product with a row, less an outer product's share for every sweep, and a row that was swept itself begins with its own sweep.
/// Beyond 24 rows the operators in six dimensions are as fast, as they follow rows in single precision.
template <RealScalar Scalar, int lanes>
class TableByColumns {
 public:
  static constexpr bool is_whole = false;
  static constexpr int capacity = 24;
  using Values = RowValues<Scalar, lanes, capacity>;
  using Rows = LowerRows<Scalar, lanes, capacity>;

  void start(const Rows&, int count) noexcept {
    count_ = count;
    sweep_count_ = 0;
    is_measured_ = are_some_measured_ = false;
    for (int k = 0; k < count; ++k) last_sweep_[std::size_t(k)] = -1;
  }
  /// Whether there were so many sweeps that no more are worth it.
  bool is_full() const noexcept { return sweep_count_ == most_sweeps; }

  /// A number of the table, of two rows that were swept: that of the column which was swept last, as the table is symmetric.
  Scalar number_of_swept(int row, int other) const noexcept {
    if (last_sweep_[std::size_t(row)] > last_sweep_[std::size_t(other)]) std::swap(row, other);
    const int last = last_sweep_[std::size_t(other)];
    const Sweep& own = sweeps_[std::size_t(last)];
    return swept(row == other ? own.diagonal() : product(own.entries[std::size_t(row)], own.scale), row, other, last + 1);
  }
  /// Computes the column of a row.
  [[gnu::always_inline]] inline Values& column(const Rows& rows, int row, Values& column) noexcept {
    const int last = last_sweep_[std::size_t(row)];
    if (last >= 0) {
      make_swept(row, last, column);
    } else {
      const auto by = rows.scaled_row(row);
      write(column, row, 0, [&](int k) { return dot_of_six<Group>(rows.at(k), by); });
    }
    if (are_some_measured_) repeat_measured(row, last + 1, column);
    return column;
  }
  /// Brings the column of a row up to the sweep of another one.
  void follow(int row, Values& column) noexcept {
    write(column, row, sweep_count_ - 1, [&](int k) { return column.at(k); });
  }
  /// Another column was written in the place of one, which is swept next.
  void replace(int, const Values&) noexcept { is_measured_ = true; }
  /// Exchanges the force of a row and what the tool moves off it.
  /// @param column  of the row
  /// @param scale   of it afterwards
  void sweep(int row, const Values& column, const Scalar& inverse_pivot, const Scalar& scale) noexcept {
    Sweep& sweep = sweeps_[std::size_t(sweep_count_)];
    const Group factor = spread<Group>(inverse_pivot);
    for (int k = 0; k < count_; k += lanes) {
      const Group c = column.at(k);
      sweep.entries.set(k, c);
      sweep.shares.set(k, product(factor, c));
    }
    sweep.row = row;
    sweep.is_measured = is_measured_;
    are_some_measured_ = are_some_measured_ || is_measured_;
    is_measured_ = false;
    sweep.pivot = column[std::size_t(row)];
    sweep.scale = scale;
    set_lane<lanes>(sweep.entries.data(), row, sweep.pivot - product(sweep.pivot, scale));
    last_sweep_[std::size_t(row)] = sweep_count_;
    ++sweep_count_;
  }

 private:
  using Group = Lanes<Scalar, lanes>;
  /// An outer product that was taken from the table, but for the row's own column.
  struct Sweep {
    Values entries, shares;
    Scalar pivot, scale;
    Scalar diagonal() const noexcept { return -product(product(pivot, scale), scale); }  // afterwards
    int row;
    bool is_measured;  // its column was not this table's
  };
  static constexpr int most_sweeps = 32;

  /// A number of a row's column after the sweeps from one on.
  Scalar swept(Scalar number, int at, int row, int first) const noexcept {
    for (int t = first; t < sweep_count_; ++t) {
      const Sweep& sweep = sweeps_[std::size_t(t)];
      number -= product(sweep.entries[std::size_t(at)], sweep.shares[std::size_t(row)]);
    }
    return number;
  }
  /// Writes the column of a row: what it was before the sweeps from one on, and those; two groups at a time, which share what is the row's own.
  template <class Before>
  [[gnu::always_inline]] inline void write(Values& column, int row, int first, const Before& before) const noexcept {
    int k = 0;
    for (; k + lanes < count_; k += 2 * lanes) {
      Group front = before(k), back = before(k + lanes);
      for (int t = first; t < sweep_count_; ++t) {
        const Sweep& sweep = sweeps_[std::size_t(t)];
        const Group share = spread<Group>(sweep.shares[std::size_t(row)]);
        front -= product(sweep.entries.at(k), share);
        back -= product(sweep.entries.at(k + lanes), share);
      }
      column.set(k, front);
      column.set(k + lanes, back);
    }
    if (k < count_) {
      Group group = before(k);
      for (int t = first; t < sweep_count_; ++t) {
        const Sweep& sweep = sweeps_[std::size_t(t)];
        group -= product(sweep.entries.at(k), spread<Group>(sweep.shares[std::size_t(row)]));
      }
      column.set(k, group);
    }
  }
  /// The column of a row that was swept itself.
  [[gnu::noinline]]
  void make_swept(int row, int last, Values& column) const noexcept {
    const Sweep& own = sweeps_[std::size_t(last)];
    const Group scale = spread<Group>(own.scale);
    write(column, row, last + 1, [&](int k) { return product(own.entries.at(k), scale); });
    set_lane<lanes>(column.data(), row, swept(own.diagonal(), row, row, last + 1));
  }

  /// The numbers of a column in rows whose own columns were measured are those of their columns in its row.
  [[gnu::noinline]]
  void repeat_measured(int row, int first, Values& column) const noexcept {
    for (int t = first; t < sweep_count_; ++t) {
      const Sweep& own = sweeps_[std::size_t(t)];
      if (!own.is_measured) continue;
      set_lane<lanes>(column.data(), own.row, swept(product(own.entries[std::size_t(row)], own.scale), own.row, row, t + 1));
    }
  }

  std::array<Sweep, std::size_t(most_sweeps)> sweeps_;
  std::array<int, std::size_t(capacity)> last_sweep_;  // of each row; −1 where it never was swept
  int count_ = 0, sweep_count_ = 0;
  bool is_measured_ = false, are_some_measured_ = false;  // what is swept next, and what was
};

}  // namespace feeler::detail
