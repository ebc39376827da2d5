// Groups of numbers that are computed side by side, and arithmetic whose bits do not depend on how many they
// are.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__GNUC__) && defined(__SSE2__)
#include <immintrin.h>
#endif

namespace feeler::detail {

/// Bytes of the vector registers that the compiler may use; 0 where it may use none.
constexpr int vector_bytes =
#if !defined(__GNUC__)  // and those that speak its dialect
    0;
#elif defined(__AVX512F__)
    64;
#elif defined(__AVX__)
    32;
#elif defined(__SSE2__) || defined(__aarch64__)
    16;
#else
    0;
#endif

template <class Scalar>
constexpr bool has_lanes = std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>;

/// How many numbers a vector kernel computes side by side: 2, 4 or 8, or 1 for plain loops.
template <class Scalar>
constexpr int lanes_of = has_lanes<Scalar> ? std::clamp(vector_bytes / int(sizeof(Scalar)), 1, 8) : 1;

/// Of a group: of `float` in the widest registers.
constexpr int most_lanes = 16;

template <class Scalar, int lanes>
struct LaneGroup {
#if defined(__GNUC__)
  static_assert(lanes == 2 || lanes == 4 || lanes == 8 || lanes == most_lanes);
  using type [[gnu::vector_size(sizeof(Scalar) * std::size_t(lanes))]] = Scalar;
#endif
};
template <class Scalar>
struct LaneGroup<Scalar, 1> {
  using type = Scalar;
};
/// A vector of `lanes` scalars, or the scalar itself.
template <class Scalar, int lanes>
using Lanes = typename LaneGroup<Scalar, lanes>::type;

/// An integer as wide as the scalar: what a comparison of vectors sets in each lane.
template <class Scalar>
using LaneBits = std::conditional_t<sizeof(Scalar) == 8, std::int64_t, std::int32_t>;

/// From an address that is a multiple of the group's size.
///
/// Compilers that have groups let one lie over its numbers, and nothing else. Bytes that are copied may be anything: after each such store they read
/// again whatever else is in memory, as counts and addresses.
template <class Group, class Scalar>
inline Group load(const Scalar* from) noexcept {
  if constexpr (std::is_same_v<Group, Scalar>) {
    return *from;
  } else {
    return *reinterpret_cast<const Group*>(from);
  }
}
template <class Group, class Scalar>
inline void store(Scalar* to, const Group& group) noexcept {
  if constexpr (std::is_same_v<Group, Scalar>) {
    *to = group;
  } else {
    *reinterpret_cast<Group*>(to) = group;
  }
}
/// The same number in every lane.
template <class Group, class Scalar>
inline Group spread(const Scalar& value) noexcept {
  if constexpr (std::is_same_v<Group, Scalar>) {
    return value;
  } else {
    return value - Group{};
  }
}

/// The numbers of a group, or of one behind another, each rounded to a number of `Rounded`.
template <class Rounded, class Group>
inline Rounded rounded(const Group& group) noexcept {
  if constexpr (std::is_same_v<Rounded, Group>) {
    return group;
  } else if constexpr (std::is_arithmetic_v<Rounded>) {
    return Rounded(group);
  } else {
#if defined(__GNUC__)
    return __builtin_convertvector(group, Rounded);
#endif
  }
}
template <class Rounded, class Group>
inline Rounded rounded(const Group& front, const Group& back) noexcept {
  using Scalar = std::remove_cvref_t<decltype(front[0])>;
  using Number = std::remove_cvref_t<decltype(Rounded{}[0])>;
  constexpr int lanes = int(sizeof(Group) / sizeof(Scalar));
  return [&]<int... i>(std::integer_sequence<int, i...>) {
    if constexpr (lanes == 2) {
      return rounded<Rounded>(Lanes<Scalar, 4>{front[i]..., back[i]...});
    } else {
      const auto a = rounded<Lanes<Number, lanes>>(front), b = rounded<Lanes<Number, lanes>>(back);
      return Rounded{a[i]..., b[i]...};
    }
  }(std::make_integer_sequence<int, lanes>{});
}

/// The numbers of a group, one by one.
///
/// By way of memory: of a `bit_cast` g++ 12 makes, where registers are scarce, MMX instructions, which leave the processor unable to compute in
/// `long double`.
template <class Number, class Group>
inline std::array<Number, sizeof(Group) / sizeof(Number)> in_lanes(const Group& group) noexcept {
  alignas(Group) std::array<Number, sizeof(Group) / sizeof(Number)> numbers;
  store(numbers.data(), group);
  return numbers;
}

/// In one lane −1, else 0; nothing but 0 where there is no such lane.
/// @param lane  from −16 to 16
///
/// A window on a row of numbers: of a comparison with the lane's number g++ 12 makes branches where registers have no comparison of wide integers.
template <class Scalar, int lanes>
inline Lanes<LaneBits<Scalar>, lanes> only_lane(int lane) noexcept {
  static constexpr auto marks = [] {
    std::array<LaneBits<Scalar>, std::size_t(3 * most_lanes)> zeros_and_one{};
    zeros_and_one[most_lanes] = -1;
    return zeros_and_one;
  }();
  Lanes<LaneBits<Scalar>, lanes> group;
  std::memcpy(&group, &marks[std::size_t(most_lanes - lane)], sizeof(group));
  return group;
}

/// In the first lanes −1, in the others 0.
/// @param count  of the first, from 0 to 16
template <class Scalar, int lanes>
inline Lanes<LaneBits<Scalar>, lanes> first_lanes(int count) noexcept {
  if constexpr (lanes == 1) return LaneBits<Scalar>(-(count > 0));
  static constexpr auto marks = [] {
    std::array<LaneBits<Scalar>, std::size_t(2 * most_lanes)> ones_and_zeros{};
    for (int i = 0; i < most_lanes; ++i) ones_and_zeros[std::size_t(i)] = -1;
    return ones_and_zeros;
  }();
  Lanes<LaneBits<Scalar>, lanes> group;
  std::memcpy(&group, &marks[std::size_t(most_lanes - count)], sizeof(group));
  return group;
}

/// The group with another number in one lane; unchanged where there is no such lane.
///
/// A number that is written alone and read in a group soon after makes processors wait; so does a group of which some lanes are written, as
/// compilers like to do where registers have masks.
template <class Scalar, int lanes>
inline Lanes<Scalar, lanes> with_lane(const Lanes<Scalar, lanes>& group, int lane, const Scalar& value) noexcept {
  if constexpr (lanes == 1) {
    return lane == 0 ? value : group;
  } else {
    Lanes<Scalar, lanes> changed = only_lane<Scalar, lanes>(lane) ? spread<Lanes<Scalar, lanes>>(value) : group;
#if defined(__GNUC__) && defined(__AVX__)  // all lanes are written
    if constexpr (sizeof(changed) <= std::size_t(vector_bytes)) __asm__("" : "+v"(changed));
#endif
    return changed;
  }
}

/// A number that was written alone a moment ago and goes into a group of so many: of neighbours compilers make one load, which waits until memory has
/// all of them.
template <int lanes, class Scalar>
[[gnu::always_inline]] inline Scalar read_alone(Scalar number) noexcept {
#if defined(__GNUC__) && defined(__AVX__)
  if constexpr (has_lanes<Scalar> && lanes > 2) __asm__("" : "+x"(number));
#endif
  return number;
}

/// The number of one lane in every lane.
template <class Scalar, int lanes, int lane>
inline Lanes<Scalar, lanes> spread_lane(const Lanes<Scalar, lanes>& group) noexcept {
  if constexpr (lanes == 1) {
    return group;
  } else {
    return [&]<int... i>(std::integer_sequence<int, i...>) {
      return Lanes<Scalar, lanes>{group[lane + 0 * i]...};
    }(std::make_integer_sequence<int, lanes>{});
  }
}
/// The group with one lane of another.
template <class Scalar, int lanes, int lane>
inline Lanes<Scalar, lanes> with_lane_of(const Lanes<Scalar, lanes>& group, const Lanes<Scalar, lanes>& other) noexcept {
  if constexpr (lanes == 1) {
    return other;
  } else {
    return [&]<int... i>(std::integer_sequence<int, i...>) {
      return Lanes<Scalar, lanes>{(i == lane ? other : group)[i]...};
    }(std::make_integer_sequence<int, lanes>{});
  }
}
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

/// Sets one of some numbers that are read in groups.
template <int lanes, class Scalar>
inline void set_lane(Scalar* numbers, int i, const Scalar& value) noexcept {
  const std::size_t lane = std::size_t(i) % std::size_t(lanes);
  Scalar* const group = numbers + (std::size_t(i) - lane);
  store(group, with_lane<Scalar, lanes>(load<Lanes<Scalar, lanes>>(group), int(lane), value));
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

template <class Group>
constexpr bool is_register_of_float = false;
template <class Group>
  requires(!std::is_arithmetic_v<Group> && sizeof(Group) <= std::size_t(vector_bytes)) &&
              requires(Group g) { requires sizeof(g[0]) == sizeof(float); }
constexpr bool is_register_of_float<Group> = true;

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

/// a·b, rounded before anything is added to it.
///
/// Compilers like to fuse a product and a sum where the processor can, so that the bits of a result change
/// with their flags.
template <class Group>
inline Group product(const Group& a, const Group& b) noexcept {
#if defined(__clang__)
#pragma clang fp contract(off)
  return a * b;
#elif !defined(__GNUC__) || __GNUC__ < 12 || (defined(__x86_64__) && !defined(__FMA__))  // without a way, or without need
  return a * b;
#else
  if constexpr (std::is_class_v<Group>) {
    return a * b;
  } else {
#if defined(__x86_64__)  // the compiler's own barrier takes vectors of float apart, and does not outlive the vectorising of plain code
    if constexpr (has_lanes<Group> || is_register_of_float<Group>) {
      Group rounded = a * b;
      __asm__("" : "+v"(rounded));
      return rounded;
    }
#endif
    return __builtin_assoc_barrier(a * b);
  }
#endif
}

}  // namespace feeler::detail
