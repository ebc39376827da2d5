// How high a triangle comes along a direction.
#pragma once

#include "feeler/core/scalar.hpp"

namespace feeler {

/// max n·y over the corners y of a triangle, in columns [m].
///
/// Number by number: of corners that were written one by one a moment ago a processor cannot read two at once, and waits.
template <class Scalar>
Scalar highest_corner(const Matrix3<Scalar>& corners, const Vector3<Scalar>& normal) noexcept {
  const auto height = [&](int k) { return Scalar(normal[0] * corners(0, k) + normal[1] * corners(1, k) + normal[2] * corners(2, k)); };
  const Scalar a = height(0), b = height(1), c = height(2), ab = a > b ? a : b;
  return ab > c ? ab : c;
}

}  // namespace feeler
