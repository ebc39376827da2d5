// What the forces of a few rows of a quadratic program do to each other.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "feeler/core/lanes.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/six.hpp"

namespace feeler::detail {

/// The Schur complement S = A·H⁻¹·Aᵀ of some rows A in the system of equations of a held minimum, and S⁻¹ as the product of its sweeps.
///
/// Row after row is swept out of those behind it and out of the right side, which then is the solution: there is no way back as after a triangular
/// factor, and a row costs the chain one division, a product and a difference, in registers. Without pivoting, as S is positive definite. Every lane
/// is computed alike, however many there are.
/// Sources: J. Nocedal, S. J. Wright, "Numerical Optimization" (2006), section 16.2, the Schur-complement method; G. H. Golub, C. F. Van Loan,
/// "Matrix Computations" (2013), section 3.2, for the Gauss transformations of one row.
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
#pragma GCC unroll 8
      for (std::size_t g = 0; g < groups; ++g) sweeps_[k][g] = dot_of_six<Group>(column(g), by);
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
    Values whole{}, pivots{};
    for_every_row([&]<std::size_t k>(Number<k>) {
      if (!has_row(k)) return false;
      whole[k / width] = with_lane_of<Scalar, lanes, int(k % width)>(whole[k / width], sweeps_[k][k / width]);
      return true;
    });
    for_every_row([&]<std::size_t k>(Number<k>) {
      constexpr std::size_t at = k / width;
      constexpr int lane = int(k % width);
      if (int(k) >= count_) return false;
      Row& own = sweeps_[k];
      const Group inverse = spread<Group>(Scalar(1)) / spread_lane<Scalar, lanes, lane>(own[at]);
      pivots[at] = with_lane_of<Scalar, lanes, lane>(pivots[at], own[at]);
#pragma GCC unroll 8
      for (std::size_t g = 0; g < groups; ++g) own[g] = product(own[g], inverse);
      own[at] = with_lane_of<Scalar, lanes, lane>(own[at], inverse);
      for_every_row([&]<std::size_t i>(Number<i>) {
        if constexpr (i > k) sweep_out<k>(sweeps_[i]);
        return has_row(i + 1);
      });
      sweep_out<k>(v);
      return true;
    });
    negate(v);
    auto is_independent = Group{} <= Group{};
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) {
      const Group least = product(spread<Group>(Scalar(independent)), whole[g]);
      const auto is_row = first_lanes<Scalar, lanes>(count_ - int(g) * lanes);
      is_independent &= (is_row ? least : spread<Group>(Scalar(-1))) < pivots[g];
    }
    return in_all_lanes<Scalar, lanes>(is_independent);
  }
  /// S⁻¹·v, once S is swept.
  Values solve(Values v) const noexcept {
    for_every_row([&]<std::size_t k>(Number<k>) {
      if (int(k) >= count_) return false;
      sweep_out<k>(v);
      return true;
    });
    negate(v);
    return v;
  }

 private:
  template <std::size_t i>
  using Number = std::integral_constant<std::size_t, i>;
  using Group = typename Rows::Group;
  static constexpr int lanes = Rows::lanes;
  static constexpr std::size_t width = lanes, most = std::min(Rows::capacity, 6), groups = (most + width - 1) / width;
  using Row = std::array<Group, groups>;

  /// Share of a row that has to be its own.
  static constexpr double independent = 1e-3;

  /// Whether row k is computed: in four lanes one that is not there costs less than a branch.
  bool has_row(std::size_t k) const noexcept { return lanes >= 4 || int(k) < count_; }

  /// Takes row k out of another one, or of a right side.
  template <std::size_t k>
  [[gnu::always_inline]] void sweep_out(auto& row) const noexcept {
    constexpr std::size_t at = k / width;
    constexpr int lane = int(k % width);
    const Group factor = spread_lane<Scalar, lanes, lane>(row[at]);
    row[at] = with_lane_of<Scalar, lanes, lane>(row[at], Group{});
#pragma GCC unroll 8
    for (std::size_t g = 0; g < groups; ++g) row[g] = row[g] - product(factor, sweeps_[k][g]);
  }

  static void negate(Values& v) noexcept {
    for (Group& group : v) group = -group;
  }
  /// Until one returns false.
  template <class Do>
  [[gnu::always_inline]] static void for_every_row(const Do& act) noexcept {
    [&]<std::size_t... k>(std::index_sequence<k...>) { (void)(act(Number<k>{}) && ...); }(std::make_index_sequence<most>{});
  }
  std::array<Group, 6> column(std::size_t g) const noexcept {
    std::array<Group, 6> scaled;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) scaled[j] = scaled_[j][g];
    return scaled;
  }

  std::array<Row, 6> scaled_;      // D⁻¹L⁻¹a of each row, by columns
  std::array<Row, most> sweeps_;   // rows of S, and of its sweeps
  int count_;
};

}  // namespace feeler::detail
