// Groups of numbers that are computed side by side: vectors of a few lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

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

}  // namespace feeler::detail
