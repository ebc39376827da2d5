// The part of a triangle that is near a tool: of a large one the rest costs a query its digits.
#pragma once

#include <array>

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

/// What of a triangle lies in the box around a tool, grown by a distance on all sides: a convex polygon, empty where there is none of it.
///
/// The closest points of a tool and a triangle are in that box where they are no farther apart than the distance. Corners that cutting makes lie on
/// edges and in the face to rounding of the box, not of the triangle.
/// @param triangle  a corner a column, in the tool frame [m]
/// Source: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", Communications of the ACM 17 (1974).
template <ConvexTool Tool>
FixedVector<PartCorner<typename Tool::Scalar>, 9> near_part(const Tool& tool, const Matrix3<typename Tool::Scalar>& triangle,
                                                            typename Tool::Scalar distance) noexcept {
  using Scalar = typename Tool::Scalar;
  using Part = FixedVector<PartCorner<Scalar>, 9>;
  Part part;
  for (int k = 0; k < 3; ++k) part.push_back({triangle.col(k), 1U << unsigned(k)});
  for (int axis = 0; axis < 3; ++axis) {
    for (const Scalar& sign : {Scalar(1), Scalar(-1)}) {
      const Vector3<Scalar> outward = sign * Vector3<Scalar>::Unit(axis);
      const Scalar limit = highest_along(tool, outward) + distance;
      const auto beyond = [&](const PartCorner<Scalar>& corner) { return sign * corner.point[axis] - limit; };
      Part cut;
      for (int i = 0; i < part.size(); ++i) {
        const PartCorner<Scalar>&a = part[i], &b = part[(i + 1) % part.size()];
        const Scalar from = beyond(a), to = beyond(b);
        if (!(from > Scalar(0))) cut.push_back(a);
        if ((from > Scalar(0)) == (to > Scalar(0))) continue;
        // From the end that is nearer to the cut, so that the new corner is no less exact than that.
        const bool is_first_nearer = from * from < to * to;
        const PartCorner<Scalar>&inner = is_first_nearer ? a : b, &outer = is_first_nearer ? b : a;
        const Scalar share = (is_first_nearer ? from : to) / (is_first_nearer ? from - to : to - from);
        PartCorner<Scalar> corner{inner.point + share * (outer.point - inner.point), a.corners | b.corners};
        corner.point[axis] = sign * limit;
        cut.push_back(corner);
      }
      part = cut;
    }
  }
  return part;
}

}  // namespace feeler
