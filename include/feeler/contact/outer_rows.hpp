// Of the rows of many tool vertices on one face, the few that the tool stands on.
#pragma once

#include <algorithm>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

/// Rows of vertices on one face that are worth having: with more, another adds no more than a sliver to the polygon that the tool stands on.
inline constexpr int most_outer_rows = 16;

/// Appends the lowest of some rows with one normal, and those that a small tilt to any of sixteen sides would make the lowest; all where they are
/// few.
///
/// A round end of 128 vertices so stands on a polygon of 16, and tips where it would.
/// @param each_row  calls its argument with each of the rows, in the same order every time
/// @param rise      of the plane that tells who would be the lowest, across the rows [m]
/// @cost O(rows)
template <class Row, class EachRow, int most>
FEELER_FLATTEN void take_outer_rows(const EachRow& each_row, const typename Row::Scalar& rise, FixedVector<Row, most>& taken) noexcept {
  using Scalar = typename Row::Scalar;
  using Vector = Vector3<Scalar>;
  FixedVector<Row, most_outer_rows> few;
  int count = 0;
  Scalar extent(0);
  each_row([&](const Row& row) {
    few.push_back(row);
    extent = (std::max)(extent, (row.arm - few[0].arm).norm());
    ++count;
  });
  if (count <= most_outer_rows) {
    for (const Row& row : few) taken.push_back(row);
    return;
  }
  struct Side {
    Vector tilt = Vector::Zero();
    Scalar height = (std::numeric_limits<Scalar>::max)();
    int place = 0;
    Row lowest{};
  };
  static_assert(most_outer_rows == 16);
  const Scalar cosine = Scalar(0.923879532511286756128L), sine = Scalar(0.382683432365089771728L);  // of a sixteenth of a turn
  FixedVector<Side, most_outer_rows + 1> sides;
  sides.push_back({});
  Vector tilt = few[0].normal.unitOrthogonal() * (rise / extent), across = few[0].normal.cross(tilt);
  for (int i = 0; i < most_outer_rows; ++i) {
    sides.push_back({.tilt = tilt});
    const Vector turned = cosine * tilt + sine * across;
    across = cosine * across - sine * tilt;
    tilt = turned;
  }
  int place = 0;
  each_row([&](const Row& row) {
    for (Side& side : sides) {
      const Scalar height = row.gap - side.tilt.dot(row.arm);
      if (!(height < side.height)) continue;
      side.height = height;
      side.place = place;
    }
    ++place;
  });
  place = 0;
  each_row([&](const Row& row) {
    for (Side& side : sides) {
      if (side.place == place) side.lowest = row;
    }
    ++place;
  });
  for (int i = 0; i < sides.size(); ++i) {
    const auto is_same = [&](const Side& other) { return other.place == sides[i].place; };
    if (std::none_of(sides.begin(), sides.begin() + i, is_same)) taken.push_back(sides[i].lowest);
  }
}

}  // namespace feeler
