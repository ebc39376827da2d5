// The unit normal of a triangle, or zero where rounding leaves none.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"

namespace feeler {

/// Unit normal by the right-hand rule over the corners a, b, c; zero if the area is zero to rounding.
///
/// Uses the two shorter sides, whose cross product loses least, scaled so that neither tiny nor huge
/// triangles under- or overflow.
/// @cost  noexcept, no allocation; two square roots
template <RealScalar Scalar>
Vector3<Scalar> triangle_normal(const Vector3<Scalar>& a, const Vector3<Scalar>& b, const Vector3<Scalar>& c) noexcept {
  using std::sqrt;
  using Working = WorkingScalar<Scalar>;
  using Wide = Vector3<Working>;
  const Wide sides[3] = {b.template cast<Working>() - a.template cast<Working>(), c.template cast<Working>() - b.template cast<Working>(),
                         a.template cast<Working>() - c.template cast<Working>()};
  Working lengths[3];
  int longest = 0;
  for (int k = 0; k < 3; ++k) {
    lengths[k] = sides[k].cwiseAbs().maxCoeff();
    if (lengths[k] > lengths[longest]) longest = k;
  }
  const int first = (longest + 1) % 3, second = (longest + 2) % 3;
  if (!(lengths[first] > Working(0)) || !(lengths[second] > Working(0))) return Vector3<Scalar>::Zero();
  const Wide cross = (sides[first] / lengths[first]).cross(sides[second] / lengths[second]);
  const Working length = sqrt(cross.squaredNorm());
  if (!(length > 8 * std::numeric_limits<Working>::epsilon())) return Vector3<Scalar>::Zero();
  return (cross / length).template cast<Scalar>();
}

}  // namespace feeler
