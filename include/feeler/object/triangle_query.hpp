// The triangles of a mesh near a box.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"

namespace feeler {

/// Calls `visit(triangle)` for each triangle whose bounding box meets a box, and for some more that share a leaf of the hierarchy with one,
/// until it returns false.
/// @param box  world axes [m]
/// @cost  noexcept, no allocation, O(log n) for each triangle visited
template <class Scalar, class MeshScalar, class Visit>
void visit_triangles_in(const TriangleMesh<MeshScalar>& mesh, const Eigen::AlignedBox<Scalar, 3>& box, const Visit& visit) noexcept {
  // Boxes of the hierarchy are float and relative to its origin.
  const Vector3<Scalar> origin = mesh.bvh().origin().template cast<Scalar>();
  std::array<float, 3> lower, upper;
  for (int k = 0; k < 3; ++k) {
    const Scalar from = (box.min)()[k] - origin[k], to = (box.max)()[k] - origin[k];
    lower[std::size_t(k)] = std::nextafter(float(from), -std::numeric_limits<float>::infinity());
    upper[std::size_t(k)] = std::nextafter(float(to), std::numeric_limits<float>::infinity());
  }
  const auto is_apart = [&](const std::array<float, 3>& from, const std::array<float, 3>& to) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (to[k] < lower[k] || from[k] > upper[k]) return true;
    }
    return false;
  };
  mesh.bvh().visit(is_apart, visit);
}

}  // namespace feeler
