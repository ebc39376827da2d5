// Comparisons of groups, and one result of all lanes: their sum, the largest, whether all hold.
#pragma once

#include <bit>
#include <utility>

#if defined(__GNUC__) && defined(__SSE2__)
#include <immintrin.h>
#endif

#include "feeler/core/lanes.hpp"

namespace feeler::detail {

/// The sum of a group's numbers, in an order that is the same as that of several groups of fewer lanes, added up by halves.
template <class Scalar, int lanes>
inline Scalar sum_of_lanes(const Lanes<Scalar, lanes>& group) noexcept {
  if constexpr (lanes == 1) {
    return group;
  } else if constexpr (lanes == 2) {
    return group[0] + group[1];
  } else {
    return [&]<int... i>(std::integer_sequence<int, i...>) {
      constexpr int half = lanes / 2;
      return sum_of_lanes<Scalar, half>(Lanes<Scalar, half>{group[i]...} + Lanes<Scalar, half>{group[i + half]...});
    }(std::make_integer_sequence<int, lanes / 2>{});
  }
}

/// In each lane −1 where a ≤ b, else 0.
template <class Scalar, int lanes>
inline Lanes<LaneBits<Scalar>, lanes> at_most(const Lanes<Scalar, lanes>& a, const Lanes<Scalar, lanes>& b) noexcept {
  if constexpr (lanes == 1) {
    return a <= b ? LaneBits<Scalar>(-1) : LaneBits<Scalar>(0);
  } else {
    return a <= b;
  }
}

template <class Group>
inline Group greater(const Group& a, const Group& b) noexcept {
  return a > b ? a : b;
}

/// The largest number of a group, none of which is NaN.
template <class Scalar, int lanes>
inline Scalar largest_lane(const Lanes<Scalar, lanes>& group) noexcept {
  if constexpr (lanes == 1) {
    return group;
  } else {
    Lanes<Scalar, lanes> largest = group;
    const auto fold = [&]<int half, int... i>(std::integral_constant<int, half>, std::integer_sequence<int, i...>) {
      largest = greater(largest, Lanes<Scalar, lanes>{largest[i ^ half]...});
    };
    constexpr std::make_integer_sequence<int, lanes> all{};
    if constexpr (lanes > 8) fold(std::integral_constant<int, 8>{}, all);
    if constexpr (lanes > 4) fold(std::integral_constant<int, 4>{}, all);
    if constexpr (lanes > 2) fold(std::integral_constant<int, 2>{}, all);
    fold(std::integral_constant<int, 1>{}, all);
    return largest[0];
  }
}

/// Whether a comparison of groups holds in every lane.
template <class Scalar, int lanes, class Comparison>
inline bool in_all_lanes(const Comparison& comparison) noexcept {
  if constexpr (lanes == 1) {
    return comparison;
  } else {
    using Bits = Lanes<LaneBits<Scalar>, lanes>;
    const Bits bits = comparison;
    constexpr bool is_double = sizeof(Scalar) == 8;
#if defined(__GNUC__) && defined(__SSE2__)  // one instruction gathers the lanes' signs
    if constexpr (sizeof(Bits) == 16) {
      return is_double ? _mm_movemask_pd(std::bit_cast<__m128d>(bits)) == 3 : _mm_movemask_ps(std::bit_cast<__m128>(bits)) == 15;
    }
#if defined(__AVX__)
    if constexpr (sizeof(Bits) == 32) {
      return is_double ? _mm256_movemask_pd(std::bit_cast<__m256d>(bits)) == 15 : _mm256_movemask_ps(std::bit_cast<__m256>(bits)) == 255;
    }
#endif
#endif
    if constexpr (lanes == 2) {
      return (bits[0] & bits[1]) != 0;
    } else {
      return [&]<int... i>(std::integer_sequence<int, i...>) {
        constexpr int half = lanes / 2;
        using Half = Lanes<LaneBits<Scalar>, half>;
        return in_all_lanes<Scalar, half>(Half(Half{bits[i]...} & Half{bits[i + half]...}));
      }(std::make_integer_sequence<int, lanes / 2>{});
    }
  }
}

}  // namespace feeler::detail
