// What the force of each of a few rows does to every other, all of it kept.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/single_lanes.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/lower_rows.hpp"
#include "feeler/qp/dual/row_values.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// The table of `DualTableau` where rows are few: all of it is kept, and swept as a whole.
///
/// The next row's column is at hand when the row is chosen; but the whole table has to be made and followed, which pays up to eight rows.
template <RealScalar Scalar, int lanes>
class WholeTable {
 public:
  static constexpr bool is_whole = true;
  static constexpr int capacity = 8;
  using Values = RowValues<Scalar, lanes, capacity>;
  using Rows = LowerRows<Scalar, lanes, capacity>;
  using Group = Lanes<Scalar, lanes>;

  void start(const Rows& rows, int count) noexcept {
    count_ = count;
    sweeps_ = 0;
    for (int i = 0; i < count; ++i) {
      const auto by = rows.scaled_row(i);
      for (int k = 0; k < count; k += lanes) at(i).set(k, dot_of_six<Group>(rows.at(k), by));
    }
    for (int k = (count + lanes - 1) / lanes * lanes; k < (count <= half ? half : capacity); k += lanes) {
      for (int i = 0; i < count; ++i) at(i).set(k, Group{});
    }
  }
  /// Whether there were so many sweeps that no more are worth it.
  bool is_full() const noexcept { return sweeps_ == 3 * capacity; }

  /// A number of the table.
  const Scalar& number_of_swept(int row, int other) const noexcept { return columns_[std::size_t(other)][std::size_t(row)]; }
  /// The column of a row, which stays up to date.
  Values& column(const Rows&, int row) noexcept { return at(row); }
  Values& active_column(const Rows&, int row) noexcept { return at(row); }
  Values& follow(int row) noexcept { return at(row); }
  /// It was written anew: so are the row's numbers in all others.
  void replace(int row) noexcept {
    for (int k = 0; k < count_; ++k) at(k)[std::size_t(row)] = at(row)[std::size_t(k)];
  }
  void set_shares(int, const Group&) const noexcept {}
  /// Exchanges the force of a row and what the tool moves off it.
  void enter(int row, const Scalar& inverse_pivot) noexcept { exchange(row, inverse_pivot, Scalar(1)); }
  /// Exchanges them back.
  /// @param scale  of the row's column afterwards
  void leave(int row, const Scalar& inverse_pivot, const Scalar& scale) noexcept { exchange(row, inverse_pivot, scale); }

 private:
  static constexpr int half = (std::max)(lanes, capacity / 2);

  Values& at(int row) noexcept { return columns_[std::size_t(row)]; }

  void exchange(int row, const Scalar& inverse_pivot, const Scalar& scale) noexcept {
    ++sweeps_;
    if (count_ <= half) {
      sweep<half / lanes>(row, inverse_pivot, scale);
    } else {
      sweep<capacity / lanes>(row, inverse_pivot, scale);
    }
  }
  template <int groups>
  [[gnu::always_inline]] inline void sweep(int row, const Scalar& inverse_pivot, const Scalar& scale) noexcept {
    Values& column = at(row);
    const Scalar pivot = column[std::size_t(row)];
    const Group factor = spread<Group>(inverse_pivot);
    std::array<Group, std::size_t(groups)> entries;
    Values shares;
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      const Group c = column.at(g * lanes);
      shares.set(g * lanes, product(c, factor));
      entries[std::size_t(g)] = with_lane<Scalar, lanes>(c, row - g * lanes, pivot - product(pivot, scale));
    }
    for (int i = 0; i < count_; ++i) {
      const Group share = spread<Group>(shares[std::size_t(i)]);
#pragma GCC unroll 8
      for (int g = 0; g < groups; ++g) at(i).set(g * lanes, at(i).at(g * lanes) - product(share, entries[std::size_t(g)]));
    }
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      const Group c = product(entries[std::size_t(g)], spread<Group>(scale));
      column.set(g * lanes, with_lane<Scalar, lanes>(c, row - g * lanes, -product(product(pivot, scale), scale)));
    }
  }

  std::array<Values, std::size_t(capacity)> columns_;
  int count_ = 0, sweeps_ = 0;
};

}  // namespace feeler::detail
