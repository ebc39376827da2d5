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
void visit_triangles_in(const TriangleMesh<MeshScalar>& mesh, const Eigen::AlignedBox<Scalar, 3>& box,
                        const Visit& visit) noexcept {
  const auto& bvh = mesh.bvh();
  const auto nodes = bvh.nodes();
  const auto order = bvh.triangle_order();
  // Boxes are float and relative to the hierarchy's origin.
  const Vector3<Scalar> origin = bvh.origin().template cast<Scalar>();
  std::array<float, 3> lower, upper;
  for (int k = 0; k < 3; ++k) {
    const Scalar from = box.min()[k] - origin[k], to = box.max()[k] - origin[k];
    lower[std::size_t(k)] = std::nextafter(float(from), -std::numeric_limits<float>::infinity());
    upper[std::size_t(k)] = std::nextafter(float(to), std::numeric_limits<float>::infinity());
  }
  const auto is_apart = [&](const auto& node) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (node.upper[k] < lower[k] || node.lower[k] > upper[k]) return true;
    }
    return false;
  };
  std::array<int, 128> stack;
  int depth = 0;
  if (!is_apart(nodes[0])) stack[std::size_t(depth++)] = 0;
  while (depth > 0) {
    const auto& node = nodes[std::size_t(stack[std::size_t(--depth)])];
    if (node.count == 0) {
      for (int child = node.first; child < node.first + 2; ++child) {
        if (!is_apart(nodes[std::size_t(child)])) stack[std::size_t(depth++)] = child;
      }
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      if (!visit(int(order[std::size_t(i)]))) return;
    }
  }
}

}  // namespace feeler
