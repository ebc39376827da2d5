// The best of many rows, looked at side by side.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/single_lanes.hpp"
#include "feeler/core/unfused_product.hpp"

namespace feeler::detail {

/// The least weight of a row, as a share of its weight with nothing active: active rows may leave less of it free to move.
///
/// Rows around the rim of a peg all but depend on their active neighbour: with a smaller share each takes its neighbour's place, one by one; with a
/// larger one pricing forgets how far a step leads.
constexpr double least_share = 5e-3;

/// Angle that a row makes with the span of active ones, in the metric of H⁻¹, below which it depends on them: rounding leaves no more of one that is
/// projected twice [rad].
template <RealScalar Scalar>
Scalar dependent_angle() noexcept {
  return (std::max)(Scalar(1e-8), Scalar(16 * std::numeric_limits<Scalar>::epsilon()));
}

/// Keeps the score of a row of zeros finite.
template <RealScalar Scalar>
Scalar smallest_weight() noexcept {
  return (std::numeric_limits<Scalar>::min)() / std::numeric_limits<Scalar>::epsilon();
}

/// A group of violations of which what lies behind the last row is none, however it is followed.
/// @param count  of rows, from the first of the group on
template <class Scalar, int lanes>
Lanes<Scalar, lanes> only_rows(const Lanes<Scalar, lanes>& violation, int count) noexcept {
  if constexpr (lanes > 1) {
    if (count < lanes) return first_lanes<Scalar, lanes>(count) ? violation : spread<Lanes<Scalar, lanes>>(-std::numeric_limits<Scalar>::infinity());
  }
  return violation;
}

/// Meets the rows in order, `lanes` at a time, and keeps the one with the largest violation²/weight among
/// those above a threshold.
template <RealScalar Scalar, int lanes>
class BestRow {
 public:
  using Group = Lanes<Scalar, lanes>;

  [[gnu::always_inline]] void meet(const Group& violation, const Group& weight, const Group& threshold) noexcept {
    const Group score = product(violation, violation) / weight;
    if (violation > threshold && score > score_) row_ = current_, score_ = score;
    ++current_;
  }
  /// −1 if there is none, or if no score is a number.
  int row() const noexcept { return row_; }

 private:
  Scalar score_ = Scalar(-1);
  int row_ = -1, current_ = 0;
};

/// The score is up to an eighth too large: a difference of two numbers' bits is about that of their
/// logarithms, and costs no division. Source: J. N. Mitchell, "Computer multiplication and division using
/// binary logarithms", IRE Transactions on Electronic Computers EC-11 (1962). The number of a row takes the
/// last nine bits of its score. So one maximum finds both, whatever the order in which rows are met; scores
/// that agree in all other bits count as equal, and the last such row wins.
template <RealScalar Scalar, int lanes>
  requires has_lanes<Scalar>
class BestRow<Scalar, lanes> {
 public:
  using Group = Lanes<Scalar, lanes>;
  using BitGroup = Lanes<LaneBits<Scalar>, lanes>;

  BestRow() noexcept {
    std::array<Logarithm, std::size_t(lanes)> numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = logarithm_of_one + Logarithm(i + 1);
    number_ = std::bit_cast<Logarithms>(numbers);
  }

  [[gnu::always_inline]] void meet(const Group& violation, const Group& weight, const Group& threshold) noexcept {
    const Group square = product(violation, violation);
    const Logarithms score = std::bit_cast<Logarithms>(square) - std::bit_cast<Logarithms>(weight);
    const BitGroup is_above = mask(violation > threshold);
    const BitGroup numbered = std::bit_cast<BitGroup>(Logarithms((score & ~number_bits) + number_)) & is_above;
    best_ = greater(std::bit_cast<Group>(numbered), best_);
    number_ += Logarithm(lanes);
  }
  int row() const noexcept { return static_cast<int>(std::bit_cast<Logarithm>(largest_lane<Scalar, lanes>(best_)) & number_bits) - 1; }

 private:
  using Bits = LaneBits<Scalar>;
  using Logarithm = std::make_unsigned_t<Bits>;  // to the base of two, but for a factor and an offset
  using Logarithms = Lanes<Logarithm, lanes>;
  static constexpr Logarithm number_bits = 0x1ff;
  static constexpr Logarithm logarithm_of_one = std::bit_cast<Logarithm>(Scalar(1));

  template <class Comparison>
  static BitGroup mask(const Comparison& comparison) noexcept {
    if constexpr (lanes == 1) {
      return -Bits(comparison);
    } else {
      return comparison;
    }
  }

  Group best_{};
  Logarithms number_;  // and the logarithm of one, to which a score is relative
};

}  // namespace feeler::detail
