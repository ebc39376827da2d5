// Of the rows of many tool vertices on one face, the few that the tool stands on.
#pragma once

#include <algorithm>
#include <bitset>
#include <cstddef>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

/// Rows of vertices on one face that are worth having: with more, another adds no more than a sliver to the polygon that the tool stands on.
inline constexpr int most_outer_rows = 16;

/// Appends the lowest of some rows with one normal, and those that a small tilt to any of sixteen sides would make the lowest; all where they are
/// few.
///
/// A round end of 128 vertices so stands on a polygon of 16, and tips where it would.
/// @param rise  of the plane that tells who would be the lowest, across the rows [m]
/// @cost O(rows)
template <class Row, int capacity, int most>
[[gnu::flatten]]
void take_outer_rows(const FixedVector<Row, capacity>& rows, const typename Row::Scalar& rise, FixedVector<Row, most>& taken) noexcept {
  using Scalar = typename Row::Scalar;
  using Vector = Vector3<Scalar>;
  if (rows.size() <= most_outer_rows) {
    for (const Row& row : rows) taken.push_back(row);
    return;
  }
  std::bitset<std::size_t(capacity)> is_taken;
  const auto take_lowest = [&](const Vector& tilt) {
    const auto height = [&tilt](const Row& row) { return row.gap - tilt.dot(row.arm); };
    const Row* const lowest = std::min_element(rows.begin(), rows.end(), [&height](const Row& a, const Row& b) { return height(a) < height(b); });
    const auto place = std::size_t(lowest - rows.begin());
    if (!is_taken[place]) taken.push_back(*lowest);
    is_taken.set(place);
  };
  take_lowest(Vector::Zero());
  Scalar extent(0);
  for (const Row& row : rows) extent = (std::max)(extent, (row.arm - rows[0].arm).norm());
  static_assert(most_outer_rows == 16);
  constexpr Scalar cosine = Scalar(0.923879532511286756128L), sine = Scalar(0.382683432365089771728L);  // of a sixteenth of a turn
  Vector tilt = rows[0].normal.unitOrthogonal() * (rise / extent), across = rows[0].normal.cross(tilt);
  for (int side = 0; side < most_outer_rows; ++side) {
    take_lowest(tilt);
    const Vector turned = cosine * tilt + sine * across;
    across = cosine * across - sine * tilt;
    tilt = turned;
  }
}

}  // namespace feeler
