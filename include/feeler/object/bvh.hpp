// A bounding volume hierarchy over the triangles of a mesh.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh_builder.hpp"

namespace feeler {

/// Axis-aligned boxes around triangles, in a tree. Node 0 is the root; a node with count 0 has the children
/// first and first + 1.
///
/// Boxes are single-precision, relative to `origin()`, the middle of the mesh, and rounded outward: for every
/// corner p in a node, lower ≤ p − origin ≤ upper, also after p − origin is rounded to any type no narrower
/// than float.
template <RealScalar Scalar>
class Bvh {
 public:
  static constexpr int max_leaf_size = BvhBuilder::max_leaf_size;
  static constexpr int max_depth =
      BvhBuilder::max_depth;  ///< nodes on a path: the bound of a traversal's stack

  Bvh() = default;
  /// @param vertices   3-vectors [m], finite
  /// @param triangles  at least one; indices into `vertices`
  /// @cost  O(n log n), allocates; half a microsecond a triangle
  template <class Vertices, class TriangleList>
  Bvh(const Vertices& vertices, const TriangleList& triangles, const Vector3<Scalar>& origin)
      : origin_(origin) {
    std::vector<BvhItem> items(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      BvhItem& item = items[t];
      item.index = std::int32_t(t);
      for (int k = 0; k < 3; ++k) {
        const Scalar a = vertices[std::size_t(triangles[t][0])][k],
                     b = vertices[std::size_t(triangles[t][1])][k],
                     c = vertices[std::size_t(triangles[t][2])][k];
        using std::max;
        using std::min;
        const auto from = static_cast<Working>(origin[k]);
        item.lower[k] = rounded_down(Working(Working(min(a, min(b, c))) - from));
        item.upper[k] = rounded_up(Working(Working(max(a, max(b, c))) - from));
      }
    }
    nodes_ = std::move(BvhBuilder(items).nodes());
    triangle_order_.reserve(items.size());
    for (const BvhItem& item : items) triangle_order_.push_back(item.index);
  }

  /// The point that boxes are relative to [m].
  const Vector3<Scalar>& origin() const noexcept { return origin_; }
  std::span<const BvhNode> nodes() const noexcept { return nodes_; }
  /// The triangles of a leaf are `triangle_order()[first .. first + count)`.
  std::span<const std::int32_t> triangle_order() const noexcept { return triangle_order_; }

 private:
  using Working = WorkingScalar<Scalar>;

  // The nearest float is up to half a step off on either side, so one step more is outside, whatever the
  // rounding of the difference was.
  static float rounded_down(const Working& x) noexcept {
    return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
  }
  static float rounded_up(const Working& x) noexcept {
    return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
  }

  Vector3<Scalar> origin_ = Vector3<Scalar>::Zero();
  std::vector<BvhNode> nodes_;
  std::vector<std::int32_t> triangle_order_;
};

}  // namespace feeler
