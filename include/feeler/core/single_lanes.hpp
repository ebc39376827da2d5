// Single lanes of a group: to mark, read, spread and replace them.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "feeler/core/lanes.hpp"

namespace feeler::detail {

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
/// Sets one of some numbers that are read in groups.
template <int lanes, class Scalar>
inline void set_lane(Scalar* numbers, int i, const Scalar& value) noexcept {
  const std::size_t lane = std::size_t(i) % std::size_t(lanes);
  Scalar* const group = numbers + (std::size_t(i) - lane);
  store(group, with_lane<Scalar, lanes>(load<Lanes<Scalar, lanes>>(group), int(lane), value));
}

}  // namespace feeler::detail
