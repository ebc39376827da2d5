// What the forces of a few rows of a quadratic program do to each other.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/single_lanes.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/six.hpp"

namespace feeler::detail {

/// The Schur complement S = A·H⁻¹·Aᵀ of some rows A in the system of equations of a held minimum, and S⁻¹ as the product of its sweeps.
///
/// Two rows at a time are swept out of those behind them and out of the right side, which then is the solution. There is no back substitution as
/// after a triangular factor, and the chain of what waits for each other has one division, a product and a difference for two rows. No pivoting, as
/// S is positive definite; only its upper triangle, as it is symmetric. Every lane is computed alike, however many there are.
/// Sources: J. Nocedal, S. J. Wright, "Numerical Optimization" (2006), section 16.2, the Schur-complement method; G. H. Golub, C. F. Van Loan,
/// "Matrix Computations" (2013), section 3.2, for Gauss transformations, and 4.4, for pivots of two rows.
/// @tparam Rows  `HeldRows`
template <class Rows>
class SchurComplement {
 public:
  using Scalar = typename Rows::Scalar;
  using Values = typename Rows::Values;

  /// @param hessian  factored, not inverted
  [[gnu::always_inline]] SchurComplement(const Rows& rows, const InverseHessian<Scalar>& hessian) noexcept : count_(rows.count()) {
    const auto d_inverse = spread_six<Group>(hessian.inverse_pivots());
    std::array<Values, 6> y;  // L⁻¹a of each row, by columns
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) {
      const auto lower = hessian.solve_lower(rows.group(g));
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) y[j][g] = lower[j], scaled_[j][g] = product(d_inverse[j], lower[j]);
    }
    for_every_row([&]<std::size_t k>(Number<k>) {
      if (!has_row(k)) return false;
      std::array<Group, 6> by;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) by[j] = spread_lane<Scalar, lanes, int(k % width)>(y[j][k / width]);
      sweeps_[k] = Values{};
#pragma GCC unroll 8
      for (std::size_t g = k / width; g < groups; ++g) sweeps_[k][g] = dot_of_six<Group>(column(g), by);
      return true;
    });
  }

  /// a·H⁻¹·v of each row a.
  /// @param lower  L⁻¹·v
  [[gnu::always_inline]] Values rows_times(const Six<Scalar>& lower) const noexcept {
    const auto by = spread_six<Group>(lower);
    Values values{};
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) values[g] = dot_of_six<Group>(column(g), by);
    return values;
  }

  /// Sweeps S, and turns v into S⁻¹·v; false, and nothing else is valid, where a row all but depends on those before it.
  [[gnu::always_inline]] bool sweep_and_solve(Values& v) noexcept {
    Values unconstrained{}, pivots{};
    for_every_row([&]<std::size_t k>(Number<k>) {
      if (!has_row(k)) return false;
      replace<k>(unconstrained, sweeps_[k][k / width]);
      return true;
    });
    for_every_row<2>([&]<std::size_t k>(Number<k>) {
      if (int(k) >= count_) return false;
      sweep<k>(unconstrained, pivots);
      take_out<k>(v);
      return true;
    });
    auto is_independent = Group{} <= Group{};
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) {
      const Group least = product(spread<Group>(Scalar(independent)), unconstrained[g]);
      const auto is_row = first_lanes<Scalar, lanes>(count_ - int(g) * lanes);
      is_independent &= (is_row ? least : spread<Group>(Scalar(-1))) < pivots[g];
    }
    return in_all_lanes<Scalar, lanes>(is_independent);
  }
  /// S⁻¹·v, once S is swept.
  Values solve(Values v) const noexcept {
    for_every_row<2>([&]<std::size_t k>(Number<k>) {
      if (int(k) >= count_) return false;
      take_out<k>(v);
      return true;
    });
    return v;
  }

 private:
  template <std::size_t i>
  using Number = std::integral_constant<std::size_t, i>;
  using Group = typename Rows::Group;
  static constexpr int lanes = Rows::lanes;
  static constexpr std::size_t width = lanes, most = (std::min)(Rows::capacity, 6), groups = Rows::groups;

  /// Share of a row that has to be its own.
  static constexpr double independent = 1e-3;

  /// Whether row k is computed: in four lanes, and alone, one that is not there costs less than a branch.
  bool has_row(std::size_t k) const noexcept { return lanes >= 4 || most == 1 || int(k) < count_; }

  /// The number of row k in each lane, and another one in its place.
  template <std::size_t k>
  static Group number_of(const Values& values) noexcept {
    return spread_lane<Scalar, lanes, int(k % width)>(values[k / width]);
  }
  template <std::size_t k>
  static void replace(Values& values, const Group& number) noexcept {
    values[k / width] = with_lane_of<Scalar, lanes, int(k % width)>(values[k / width], number);
  }

  /// Sweeps rows k and k + 1, or the last row without another.
  template <std::size_t k>
  [[gnu::always_inline]] void sweep(Values& unconstrained, Values& pivots) noexcept {
    if constexpr (k + 1 < most) {
      if (int(k) + 1 < count_) return sweep_pair<k>(unconstrained, pivots);
      sweeps_[k + 1] = Values{};
    }
    inverses_[k / 2] = spread<Group>(Scalar(1)) / number_of<k>(sweeps_[k]);
    replace<k>(pivots, sweeps_[k][k / width]);
    replace<k>(sweeps_[k], spread<Group>(Scalar(-1)));
  }
  /// By the inverse of their block, ((c, −b), (−b, a)) over its determinant. What it makes of the rows is at hand when the division ends, so that
  /// little else stands between one pair and the next.
  template <std::size_t k>
  [[gnu::always_inline]] void sweep_pair(Values& unconstrained, Values& pivots) noexcept {
    const Values first = sweeps_[k], second = sweeps_[k + 1];
    const Group a = number_of<k>(first), b = number_of<k + 1>(first), c = number_of<k + 1>(second);
    const Group determinant = product(a, c) - product(b, b);
    inverses_[k / 2] = spread<Group>(Scalar(1)) / determinant;
    replace<k>(pivots, a);
    replace<k + 1>(pivots, determinant);
    replace<k + 1>(unconstrained, product(unconstrained[(k + 1) / width], a));
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) {
      sweeps_[k][g] = product(c, first[g]) - product(b, second[g]);
      sweeps_[k + 1][g] = product(a, second[g]) - product(b, first[g]);
    }
    replace<k>(sweeps_[k], -c);
    replace<k + 1>(sweeps_[k], b);
    replace<k>(sweeps_[k + 1], b);
    replace<k + 1>(sweeps_[k + 1], -a);
    for_every_row([&]<std::size_t i>(Number<i>) {
      if constexpr (i > k + 1) take_out<k, i / width>(number_of<i>(first), number_of<i>(second), sweeps_[i]);
      return has_row(i + 1);
    });
  }
  /// Takes what was swept with row k out of a right side.
  template <std::size_t k>
  [[gnu::always_inline]] void take_out(Values& v) const noexcept {
    if constexpr (k + 1 < most) {
      take_out<k, 0>(number_of<k>(v), number_of<k + 1>(v), v);
    } else {
      v[0] = product(inverses_[0], v[0]);
    }
  }
  /// Takes rows k and k + 1, by what a row has of them, out of it; what it has of rows that are to be swept, in groups before its own, nobody needs.
  template <std::size_t k, std::size_t own>
  [[gnu::always_inline]] void take_out(const Group& first, const Group& second, Values& row) const noexcept {
    replace<k>(row, Group{});
    replace<k + 1>(row, Group{});
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) {
      if (g > (k + 1) / width && g < own) continue;
      row[g] = row[g] - product(inverses_[k / 2], product(first, sweeps_[k][g]) + product(second, sweeps_[k + 1][g]));
    }
  }

  /// Or for the first of every so many; until one returns false.
  template <std::size_t step = 1, class Do>
  [[gnu::always_inline]] static void for_every_row(const Do& act) noexcept {
    constexpr std::size_t count = (most + step - 1) / step;
    [&]<std::size_t... k>(std::index_sequence<k...>) { (void)(act(Number<step * k>{}) && ...); }(std::make_index_sequence<count>{});
  }
  std::array<Group, 6> column(std::size_t g) const noexcept {
    std::array<Group, 6> scaled;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) scaled[j] = scaled_[j][g];
    return scaled;
  }

  std::array<Values, 6> scaled_;  // D⁻¹L⁻¹a of each row, by columns
  std::array<Values, most> sweeps_;  // rows of S, and of its sweeps
  std::array<Group, (most + 1) / 2> inverses_;  // of the determinants of pairs, by which their sweeps are to be multiplied
  int count_;
};

}  // namespace feeler::detail
