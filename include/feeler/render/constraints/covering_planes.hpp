// The planes of pairs that were measured, to know which others need not be.
#pragma once

#include <optional>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/proximity/highest_corner.hpp"

namespace feeler {

/// Separating planes between a convex tool and triangles at one pose. What lies below the plane of one triangle is no nearer to the tool than that
/// one, as seen along its normal: around a corner of a mesh that a face of the tool touches, one triangle of six stands for all.
///
/// Corners and heights are relative to a point that is the same for all [m], in world axes. Where more planes are added than there is room for,
/// the last are dropped, and more is measured.
template <class ScalarType>
class CoveringPlanes {
 public:
  using Scalar = ScalarType;
  static constexpr int capacity = 16;

  /// A plane that parts a triangle from the tool.
  struct Cover {
    Vector3<Scalar> normal;
    Scalar distance;  ///< separation along it [m]
  };

  void clear() noexcept { planes_.clear(); }
  /// @param normal    unit, from the triangle to the tool
  /// @param distance  separation of the two along it [m]
  void add(const Vector3<Scalar>& normal, const Matrix3<Scalar>& corners, Scalar distance) noexcept {
    planes_.push_back({normal, highest_corner(corners, normal), distance});
  }
  /// A plane that a triangle is below, but for `tolerance`, and leaves by more than `depth` [m]; with the distance of the tool along it. A
  /// triangle that lies in the plane may be what holds another corner of the tool.
  std::optional<Cover> above(const Matrix3<Scalar>& corners, Scalar tolerance, Scalar depth) const noexcept {
    for (const Plane& plane : planes_) {
      const Vector3<Scalar> below = plane.height - (corners.transpose() * plane.normal).array();
      if (below.minCoeff() >= -tolerance && below.maxCoeff() > depth) return Cover{plane.normal, plane.distance + below.minCoeff()};
    }
    return {};
  }

 private:
  struct Plane {
    Vector3<Scalar> normal;
    Scalar height;  // of the triangle along it
    Scalar distance;
  };

  FixedVector<Plane, capacity> planes_;
};

}  // namespace feeler
