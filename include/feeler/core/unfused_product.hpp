// A product that is rounded before anything is added to it, whatever the compiler may fuse.
#pragma once

#include <cstddef>
#include <type_traits>

#include "feeler/core/lanes.hpp"

namespace feeler::detail {

template <class Group>
constexpr bool is_register_of_float = false;
template <class Group>
  requires(!std::is_arithmetic_v<Group> && sizeof(Group) <= std::size_t(vector_bytes)) &&
              requires(Group g) { requires sizeof(g[0]) == sizeof(float); }
constexpr bool is_register_of_float<Group> = true;

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
