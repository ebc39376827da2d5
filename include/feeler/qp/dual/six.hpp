// Vectors and symmetric matrices of six numbers, computed one number or one group at a time with the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/core/lanes.hpp"
#include "feeler/core/unfused_product.hpp"

namespace feeler::detail {

/// Σ aⱼ·bⱼ over j < 6, in an order that is the same wherever it is computed.
template <class Group, class A, class B>
[[gnu::always_inline]] inline Group dot_of_six(const A& a, const B& b) noexcept {
  const Group front = product<Group>(a[0], b[0]) + product<Group>(a[1], b[1]);
  const Group middle = product<Group>(a[2], b[2]) + product<Group>(a[3], b[3]);
  const Group back = product<Group>(a[4], b[4]) + product<Group>(a[5], b[5]);
  return (front + middle) + back;
}

/// Six numbers, and a matrix by columns.
template <class Scalar>
using Six = std::array<Scalar, 6>;
template <class Scalar>
using SixBySix = std::array<Six<Scalar>, 6>;

/// Copies six numbers, for which g++ calls the library where `std::copy_n` copies them.
template <class Scalar>
[[gnu::always_inline]] inline void copy_six(const Scalar* from, Scalar* to) noexcept {
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) to[j] = from[j];
}

/// Each number in every lane of a group.
template <class Group, class Scalar>
[[gnu::always_inline]] inline std::array<Group, 6> spread_six(const Six<Scalar>& v) noexcept {
  std::array<Group, 6> groups;
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) groups[j] = spread<Group>(v[j]);
  return groups;
}

template <class Scalar>
[[gnu::always_inline]] inline Scalar dot(const Six<Scalar>& a, const Six<Scalar>& b) noexcept {
  return dot_of_six<Scalar>(a, b);
}
/// D·v of a diagonal matrix.
template <class Scalar>
[[gnu::always_inline]] inline Six<Scalar> multiply(const Six<Scalar>& diagonal, const Six<Scalar>& v) noexcept {
  Six<Scalar> image;
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) image[j] = product(diagonal[j], v[j]);
  return image;
}
/// M·v of a symmetric matrix.
template <class Scalar>
inline Six<Scalar> multiply(const SixBySix<Scalar>& m, const Six<Scalar>& v) noexcept {
  Six<Scalar> image;
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) image[j] = dot(m[j], v);
  return image;
}

/// Takes a multiple of one vector from another.
template <class Scalar>
[[gnu::always_inline]] inline void subtract(const Six<Scalar>& a, const Scalar& multiple, Six<Scalar>& from) noexcept {
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) from[j] -= product(multiple, a[j]);
}

template <class Scalar>
inline Scalar magnitude(const Scalar& value) noexcept {
  using std::abs;
  return abs(value);
}
/// The largest |vⱼ| of the first six.
template <class Scalar, std::size_t size>
[[gnu::always_inline]] inline Scalar norm_inf(const std::array<Scalar, size>& v) noexcept {
  const auto larger = [&v](std::size_t j) { return (std::max)(magnitude(v[j]), magnitude(v[j + 1])); };
  return (std::max)((std::max)(larger(0), larger(2)), larger(4));
}
/// Σ |vⱼ|
template <class Scalar>
[[gnu::always_inline]] inline Scalar norm1(const Six<Scalar>& v) noexcept {
  return ((magnitude(v[0]) + magnitude(v[1])) + (magnitude(v[2]) + magnitude(v[3]))) + (magnitude(v[4]) + magnitude(v[5]));
}
/// Rounding of a row's value at x, for a row of size one.
template <class Scalar>
[[gnu::always_inline]] inline Scalar rounding_at(const Six<Scalar>& x) noexcept {
  return 8 * std::numeric_limits<Scalar>::epsilon() * norm_inf(x);
}
/// Rounding of a·x itself.
template <class Scalar>
inline Scalar rounding_of_dot(const Six<Scalar>& a, const Six<Scalar>& x) noexcept {
  return 8 * std::numeric_limits<Scalar>::epsilon() * norm1(multiply(a, x));
}

}  // namespace feeler::detail
