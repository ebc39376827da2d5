// The part of a triangle that is near a tool: of a large one the rest costs a query its digits.
#pragma once

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

/// A corner of a part of a triangle.
template <class Scalar>
struct PartCorner {
  Vector3<Scalar> point;
  unsigned corners;  ///< of the triangle that it lies between, a bit each: one of them, an edge, or the face
};

/// A triangle, or a polygon that it was cut to: each side of a box may add a corner.
template <class Scalar>
using CutTriangle = FixedVector<PartCorner<Scalar>, 9>;

namespace detail {

/// A side of a box along the axes, beyond which a polygon is cut off.
template <class Scalar>
struct BoxSide {
  int axis;
  Scalar sign;   ///< 1 where the axis leads out of the box, −1 where it leads in
  Scalar limit;  ///< height of the side along the outward normal [m]

  /// Height of a corner above the side [m].
  Scalar beyond(const PartCorner<Scalar>& corner) const noexcept { return sign * corner.point[axis] - limit; }

  /// What a polygon has on the inner side.
  CutTriangle<Scalar> cut(const CutTriangle<Scalar>& part) const noexcept {
    CutTriangle<Scalar> rest;
    for (int i = 0; i < part.size(); ++i) {
      const PartCorner<Scalar>&a = part[i], &b = part[(i + 1) % part.size()];
      const Scalar from = beyond(a), to = beyond(b);
      if (!(from > Scalar(0))) rest.push_back(a);
      if ((from > Scalar(0)) == (to > Scalar(0))) continue;
      // From the end that is nearer to the cut, so that the new corner is no less exact than that.
      rest.push_back(from * from < to * to ? crossing(a, from, b, to) : crossing(b, to, a, from));
    }
    return rest;
  }

 private:
  /// Where an edge meets the side, found from its start.
  /// @param from  height of the start above the side [m]
  /// @param to    height of the end [m]
  PartCorner<Scalar> crossing(const PartCorner<Scalar>& start, Scalar from, const PartCorner<Scalar>& end, Scalar to) const noexcept {
    const Scalar share = from / (from - to);
    PartCorner<Scalar> corner{start.point + share * (end.point - start.point), start.corners | end.corners};
    corner.point[axis] = sign * limit;
    return corner;
  }
};

}  // namespace detail

/// What of a triangle lies in the box around a tool, grown by a distance on all sides: a convex polygon, empty where there is none of it.
///
/// The closest points of a tool and a triangle are in that box where they are no farther apart than the distance. Corners that cutting makes lie on
/// edges and in the face to rounding of the box, not of the triangle.
/// @param triangle  one corner in each column, in the tool frame [m]
/// Source: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", Communications of the ACM 17 (1974).
template <ConvexTool Tool>
CutTriangle<typename Tool::Scalar> near_part(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                             typename Tool::Scalar distance) noexcept {
  using Scalar = typename Tool::Scalar;
  CutTriangle<Scalar> part;
  for (int k = 0; k < 3; ++k) part.push_back({triangle.col(k), 1U << unsigned(k)});
  for (int axis = 0; axis < 3; ++axis) {
    for (const Scalar& sign : {Scalar(1), Scalar(-1)}) {
      const Scalar limit = highest_along(tool, Vector3<Scalar>(sign * Vector3<Scalar>::Unit(axis))) + distance;
      part = detail::BoxSide<Scalar>{axis, sign, limit}.cut(part);
    }
  }
  return part;
}

}  // namespace feeler
