// What the force of each of some rows does to every other, computed when it is asked for.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/single_lanes.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/lower_rows.hpp"
#include "feeler/qp/dual/row_values.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// The table of `DualTableau`: a column is computed when it is asked for, from the rows and from all sweeps so far.
///
/// A column is Aᵀ's product with a row, less an outer product's share for every sweep, and a row that was swept itself begins with its own sweep.
/// The column of the row that may become active is written where its sweep is kept when it does.
/// Beyond 24 rows the operators in six dimensions are as fast, as they follow rows in single precision.
template <RealScalar Scalar, int lanes>
class TableByColumns {
 public:
  static constexpr int capacity = 24;
  using Values = RowValues<Scalar, lanes, capacity>;
  using Rows = LowerRows<Scalar, lanes, capacity>;
  using Group = Lanes<Scalar, lanes>;

  void start(int count) noexcept {
    count_ = count;
    sweep_count_ = 0;
    measured_ = 0;
    last_sweep_.fill(-1);
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
  /// Computes the column of a row that may become active.
  [[gnu::always_inline]] inline Values& column(const Rows& rows, int row) noexcept { return make(rows, row, next().entries); }
  /// Brings it up to the sweep of a row that left.
  Values& follow(int row) noexcept {
    Values& column = next().entries;
    write(column, row, sweep_count_ - 1, [&](int k) { return column.at(k); });
    return column;
  }
  /// It was written anew.
  void note_measured() noexcept { measured_ |= 1u << sweep_count_; }
  /// The shares of a group in the column that enters or leaves next: its numbers, divided by the row's own.
  [[gnu::always_inline]] void set_shares(int k, const Group& shares) noexcept { next().shares.set(k, shares); }
  /// Exchanges the force of the row and what the tool moves off it.
  void add(int row) noexcept {
    Sweep& sweep = next();
    sweep.pivot = sweep.entries[std::size_t(row)];
    sweep.scale = Scalar(1);
    finish(sweep, row, Scalar(0));
  }

  /// Computes the column of an active row.
  Values& active_column(const Rows& rows, int row) noexcept { return make(rows, row, leaving_); }
  /// Exchanges back its force and what the tool moves off it; the column of a row that may become active stays.
  /// @param scale  of the row's own column afterwards
  void drop(int row, const Scalar& scale) noexcept {
    Sweep& sweep = next();
    Values& entering = sweeps_[std::size_t(sweep_count_ + 1)].entries;
    for (int k = 0; k < count_; k += lanes) {
      entering.set(k, sweep.entries.at(k));
      sweep.entries.set(k, leaving_.at(k));
    }
    if (is_measured(sweep_count_)) measured_ ^= 3u << sweep_count_;
    sweep.pivot = leaving_[std::size_t(row)];
    sweep.scale = scale;
    finish(sweep, row, sweep.pivot - product(sweep.pivot, scale));
  }

 private:
  /// An outer product that was taken from the table, but for the row's own column.
  struct Sweep {
    Values entries, shares;
    Scalar pivot, scale;
    int row;
    Scalar diagonal() const noexcept { return -product(product(pivot, scale), scale); }  // afterwards
  };
  static constexpr int most_sweeps = 31;

  bool is_measured(int sweep) const noexcept { return (measured_ >> sweep & 1u) != 0; }
  Sweep& next() noexcept { return sweeps_[std::size_t(sweep_count_)]; }
  void finish(Sweep& sweep, int row, const Scalar& own_entry) noexcept {
    sweep.row = row;
    set_lane<lanes>(sweep.entries.data(), row, own_entry);
    last_sweep_[std::size_t(row)] = sweep_count_;
    ++sweep_count_;
  }

  /// A number of a row's column after the sweeps from one on.
  Scalar swept(Scalar number, int at, int row, int first) const noexcept {
    for (int t = first; t < sweep_count_; ++t) {
      const Sweep& sweep = sweeps_[std::size_t(t)];
      number -= product(sweep.entries[std::size_t(at)], sweep.shares[std::size_t(row)]);
    }
    return number;
  }
  /// Computes the column of a row.
  [[gnu::always_inline]] inline Values& make(const Rows& rows, int row, Values& column) const noexcept {
    const int last = last_sweep_[std::size_t(row)];
    if (last >= 0) {
      make_swept(row, last, column);
    } else {
      const auto by = rows.scaled_row(row);
      write(column, row, 0, [&](int k) { return dot_of_six<Group>(rows.at(k), by); });
    }
    if (measured_ != 0) repeat_measured(row, last + 1, column);
    return column;
  }
  /// Writes the column of a row: what it was before the sweeps from one on, and those; three groups at a time, which share what is the row's own.
  template <class Before>
  [[gnu::always_inline]] inline void write(Values& column, int row, int first, const Before& before) const noexcept {
    int k = 0;
    for (; k + 2 * lanes < count_; k += 3 * lanes) write_groups<3>(column, k, row, first, before);
    if (k + lanes < count_) {
      write_groups<2>(column, k, row, first, before);
    } else if (k < count_) {
      write_groups<1>(column, k, row, first, before);
    }
  }
  template <int count, class Before>
  [[gnu::always_inline]] inline void write_groups(Values& column, int k, int row, int first, const Before& before) const noexcept {
    std::array<Group, std::size_t(count)> groups;
#pragma GCC unroll 3
    for (int g = 0; g < count; ++g) groups[std::size_t(g)] = before(k + g * lanes);
    for (const Sweep *sweep = &sweeps_[std::size_t(first)], *end = &sweeps_[std::size_t(sweep_count_)]; sweep != end; ++sweep) {
      const Group share = spread<Group>(sweep->shares[std::size_t(row)]);
#pragma GCC unroll 3
      for (int g = 0; g < count; ++g) groups[std::size_t(g)] -= product(sweep->entries.at(k + g * lanes), share);
    }
#pragma GCC unroll 3
    for (int g = 0; g < count; ++g) column.set(k + g * lanes, groups[std::size_t(g)]);
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
      if (!is_measured(t)) continue;
      set_lane<lanes>(column.data(), own.row, swept(product(own.entries[std::size_t(row)], own.scale), own.row, row, t + 1));
    }
  }

  std::array<Sweep, std::size_t(most_sweeps + 1)> sweeps_;
  Values leaving_;                                     // the column of the row that leaves
  std::array<int, std::size_t(capacity)> last_sweep_;  // of each row; −1 where it never was swept
  int count_ = 0, sweep_count_ = 0;
  unsigned measured_ = 0;  // sweeps of columns that were written anew, by bits
};

}  // namespace feeler::detail
