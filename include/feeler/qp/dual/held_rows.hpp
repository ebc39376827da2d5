// A few rows of a quadratic program, side by side.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/single_lanes.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// Up to six rows of a problem, by columns in registers; what fills the last group is one of them once more, or row 0 where there is none.
/// @tparam capacity_  1, 4, 6 or 8: how many there may be, in whole groups
template <RealScalar ScalarType, int lanes_, int capacity_>
class HeldRows {
 public:
  using Scalar = ScalarType;
  static constexpr int lanes = lanes_, capacity = capacity_, groups = capacity / lanes;
  using Group = Lanes<Scalar, lanes>;
  /// One number for each row.
  using Values = std::array<Group, std::size_t(groups)>;

  /// @param rows  of the problem, that exist
  [[gnu::always_inline]] HeldRows(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& rows) noexcept : count_(rows.rows.size()) {
    std::array<std::size_t, std::size_t(capacity)> at;
#pragma GCC unroll 8
    for (int i = 0; i < capacity; ++i) {
      const int row = i < 6 ? i : i - 2;  // the last group's own once more need no load
      at[std::size_t(i)] = row < count_ ? std::size_t(rows.rows[row]) : count_ > 0 ? std::size_t(rows.rows[0]) : 0;
    }
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) columns_[std::size_t(j)] = in_groups([&at, from = problem.rows.column(j)](std::size_t i) { return from[at[i]]; });
    bounds_ = in_groups([&](std::size_t i) { return bounds[at[i]]; });
  }

  int count() const noexcept { return count_; }
  const Values& bounds() const noexcept { return bounds_; }
  /// The rows of a group.
  [[gnu::always_inline]] std::array<Group, 6> group(std::size_t g) const noexcept {
    std::array<Group, 6> a;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) a[j] = columns_[j][g];
    return a;
  }

  /// Of as many numbers as there are rows; 0 behind them.
  template <class Numbers>
  [[gnu::always_inline]] Values values(const Numbers& numbers) const noexcept {
    return only_rows(in_groups([&](std::size_t i) { return i < 6 ? read_alone<lanes>(numbers[i < 6 ? i : 0]) : Scalar(0); }));
  }
  /// The values, and 0 behind them.
  [[gnu::always_inline]] Values only_rows(Values values) const noexcept {
#pragma GCC unroll 8
    for (int g = 0; g < groups; ++g) {
      Group& group = values[std::size_t(g)];
      group = first_lanes<Scalar, lanes>(count_ - g * lanes) ? group : Group{};
    }
    return values;
  }

  /// Whether no value is negative or NaN.
  [[gnu::always_inline]] static bool are_not_negative(const Values& values) noexcept {
    auto are = Group{} <= Group{};
    for (const Group& group : values) are &= Group{} <= group;
    return in_all_lanes<Scalar, lanes>(are);
  }

  /// Σ valueᵢ·aᵢ, in an order that is the same whatever the number of lanes.
  /// @param values  0 behind the last row
  [[gnu::always_inline]] Six<Scalar> sum(const Values& values) const noexcept {
    Six<Scalar> sums;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) {
      Values terms;
#pragma GCC unroll 8
      for (std::size_t g = 0; g < std::size_t(groups); ++g) terms[g] = product(columns_[j][g], values[g]);
      if constexpr (groups == 6) terms[0] = terms[0] + terms[4], terms[1] = terms[1] + terms[5];
      if constexpr (groups >= 3) terms[0] = terms[0] + terms[2];
      if constexpr (groups >= 4) terms[1] = terms[1] + terms[3];
      if constexpr (groups >= 2) terms[0] = terms[0] + terms[1];
      sums[j] = sum_of_lanes<Scalar, lanes>(terms[0]);
    }
    return sums;
  }
  /// By how much x falls short of each.
  [[gnu::always_inline]] Values lacking(const Six<Scalar>& x) const noexcept {
    const auto by = spread_six<Group>(x);
    Values values;
#pragma GCC unroll 8
    for (std::size_t g = 0; g < std::size_t(groups); ++g) values[g] = bounds_[g] - dot_of_six<Group>(group(g), by);
    return values;
  }

 private:
  template <class NumberOf>
  [[gnu::always_inline]] static Values in_groups(const NumberOf& number_of) noexcept {
    return [&]<std::size_t... g>(std::index_sequence<g...>) {
      return Values{in_group<g * std::size_t(lanes)>(number_of, std::make_index_sequence<std::size_t(lanes)>{})...};
    }(std::make_index_sequence<std::size_t(groups)>{});
  }
  template <std::size_t first, class NumberOf, std::size_t... i>
  static Group in_group(const NumberOf& number_of, std::index_sequence<i...>) noexcept {
    return Group{number_of(first + i)...};
  }

  std::array<Values, 6> columns_;
  Values bounds_;
  int count_;
};

}  // namespace feeler::detail
