// What the closed surfaces of a mesh enclose, and whether a point is in there.
#pragma once

#include <cstdint>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/object/closed_surfaces.hpp"
#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// What is solid of a mesh: what its closed surfaces enclose, surface by surface, so that open ones among
/// them do not matter.
///
/// Normals say which side is solid. A closed surface whose normals point outwards is a solid. One whose
/// normals point inwards is the wall of a cavity where it lies in a solid, and else a room: what it encloses
/// is free. Where the triangles of a surface do not agree, it is a solid. Solids may overlap.
class MeshInterior {
 public:
  /// @cost  linear in the triangles, allocates; a tenth of what the mesh took, half where most edges have
  /// more than two triangles
  template <RealScalar Scalar>
  explicit MeshInterior(const TriangleMesh<Scalar>& mesh) : weights_(detail::ClosedSurfaces<Scalar>(mesh).weights()) {}

  /// Whether the mesh encloses anything.
  bool is_empty() const noexcept { return weights_.empty(); }

  /// Whether a point is in a solid. Decided exactly; a point on a triangle is on either side.
  /// @param mesh   that which it was made from
  /// @param point  world axes [m]
  /// @cost  noexcept, no allocation; the triangles that a ray meets
  template <RealScalar Scalar>
  bool contains(const TriangleMesh<Scalar>& mesh, const Vector3<double>& point) const noexcept {
    return !is_empty() && detail::ClosedSurfaces<Scalar>::winding(mesh, weights_, point) > 0;
  }

  /// Whether all is solid around a point: a point nearer to a flat surface than half a distance is not
  /// enclosed.
  /// @param distance  [m]
  template <RealScalar Scalar>
  bool encloses(const TriangleMesh<Scalar>& mesh, const Vector3<double>& point, double distance) const noexcept {
    for (int k = 0; k < 6; ++k) {
      const Vector3<double> beside = point + (k % 2 == 0 ? distance : -distance) * Vector3<double>::Unit(k / 2);
      if (!contains(mesh, beside)) return false;
    }
    return true;
  }

 private:
  std::vector<std::int8_t> weights_;  // of the triangles
};

}  // namespace feeler
