// Vectors and symmetric matrices of six numbers, computed one number or one group at a time with the same bits.
#pragma once

#include <array>
#include <cstddef>

#include "feeler/core/lanes.hpp"

namespace feeler::detail {

/// Σ aⱼ·bⱼ over j < 6, in an order that is the same wherever it is computed.
template <class Group, class A, class B>
inline Group dot_of_six(const A& a, const B& b) noexcept {
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

template <class Scalar>
inline Scalar dot(const Six<Scalar>& a, const Six<Scalar>& b) noexcept {
  return dot_of_six<Scalar>(a, b);
}
/// D·v of a diagonal matrix.
template <class Scalar>
inline Six<Scalar> multiply(const Six<Scalar>& diagonal, const Six<Scalar>& v) noexcept {
  Six<Scalar> image;
  for (std::size_t j = 0; j < 6; ++j) image[j] = product(diagonal[j], v[j]);
  return image;
}
/// M·v of a symmetric matrix.
template <class Scalar>
inline Six<Scalar> multiply(const SixBySix<Scalar>& m, const Six<Scalar>& v) noexcept {
  Six<Scalar> image;
  for (std::size_t j = 0; j < 6; ++j) image[j] = dot(m[j], v);
  return image;
}

}  // namespace feeler::detail
