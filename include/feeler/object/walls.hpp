// The walls of a surface: triangles that hang together in one plane, however finely it is cut.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh.hpp"
#include "feeler/object/mesh_topology.hpp"
#include "feeler/object/triangle_normal.hpp"

namespace feeler {

/// A planar patch of two triangles or more.
struct Wall {
  std::int32_t triangle;  ///< in whose plane it lies: one of the largest
  float flatness;         ///< no vertex of the patch is farther from that plane [m]
  float radius;           ///< nor from the first corner of that triangle [m]
};

/// The planar patches of a mesh, and the boxes of its hierarchy that hold nothing else.
///
/// A patch grows from one of its largest triangles over edges to all that lie within 2^-23 of the mesh's size of that plane and face the same way;
/// so coordinates rounded to `float` leave a plane whole. A triangle without such a neighbour is in no patch.
template <RealScalar Scalar_>
class Walls {
 public:
  using Scalar = Scalar_;
  /// Walls of the children of a node.
  using OfChildren = std::array<std::int32_t, std::size_t(BvhNode::width)>;
  static constexpr int none = -1;

  Walls() = default;
  /// @param size  of the mesh, its longest side [m]
  /// @cost  linear in the triangles, allocates
  Walls(const std::vector<Vector3<Scalar>>& vertices, const std::vector<std::array<int, 3>>& triangles, const MeshTopology& topology,
        const Bvh<Scalar>& bvh, Scalar size) {
    using std::ldexp;
    const Surface surface{vertices, triangles, topology, ldexp(size, -23)};
    if (!(surface.tolerance < (std::numeric_limits<Scalar>::max)())) return;
    of_triangle_.assign(triangles.size(), std::int32_t(none));
    std::vector<std::int32_t> open;
    for (const std::int32_t seed : largest_first(surface)) {
      if (of_triangle_[std::size_t(seed)] == none) grow(surface, seed, open);
    }
    walls_.shrink_to_fit();
    if (walls_.empty()) {
      of_triangle_ = {};
      return;
    }
    mark_vertices(surface);
    mark_boxes(surface, bvh);
  }

  int count() const noexcept { return int(walls_.size()); }
  const Wall& operator[](int wall) const noexcept { return walls_[std::size_t(wall)]; }
  /// The wall of a triangle, or `none`.
  int of_triangle(int triangle) const noexcept { return walls_.empty() ? none : of_triangle_[std::size_t(triangle)]; }
  /// Whether a vertex of the mesh lies inside of a wall: all its triangles belong to that, and it is no corner of the surface.
  bool is_inside(int vertex) const noexcept { return !walls_.empty() && is_inside_[std::size_t(vertex)]; }
  /// Of each child of a node of the hierarchy, the wall that all triangles in its box belong to, or `none`. There are walls.
  const OfChildren& under(int node) const noexcept { return under_[std::size_t(node)]; }
  /// Whether none of the triangles in the box of a child is at the rim of its wall.
  bool is_inside(int node, std::size_t child) const noexcept { return ((inside_[std::size_t(node)] >> child) & 1U) != 0; }

 private:
  struct Surface {
    const std::vector<Vector3<Scalar>>& vertices;
    const std::vector<std::array<int, 3>>& triangles;
    const MeshTopology& topology;
    Scalar tolerance;

    const Vector3<Scalar>& corner(int triangle, std::size_t k) const noexcept { return vertices[std::size_t(triangles[std::size_t(triangle)][k])]; }
    Vector3<Scalar> normal(int triangle) const noexcept {
      return triangle_normal<Scalar>(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
    }
    /// Binary exponent of the square of an area, less for smaller ones.
    int magnitude(int triangle) const noexcept {
      const Vector3<Scalar> a = corner(triangle, 1) - corner(triangle, 0), b = corner(triangle, 2) - corner(triangle, 0);
      const auto area = static_cast<double>(a.cross(b).squaredNorm());
      return area > 0 ? std::ilogb(area) : least_magnitude;
    }
  };
  static constexpr int least_magnitude = -1100, most_magnitude = 1100;

  /// The triangles by size, to a factor.
  static std::vector<std::int32_t> largest_first(const Surface& surface) {
    const auto bucket_of = [&](int triangle) {
      return std::size_t(most_magnitude - std::clamp(surface.magnitude(triangle), least_magnitude, most_magnitude));
    };
    std::vector<std::int32_t> begin(std::size_t(most_magnitude - least_magnitude + 2), 0);
    const int count = int(surface.triangles.size());
    for (int i = 0; i < count; ++i) ++begin[bucket_of(i) + 1];
    for (std::size_t b = 1; b < begin.size(); ++b) begin[b] += begin[b - 1];
    std::vector<std::int32_t> order(surface.triangles.size());
    for (int i = 0; i < count; ++i) order[std::size_t(begin[bucket_of(i)]++)] = i;
    return order;
  }

  /// @param open  scratch
  void grow(const Surface& surface, std::int32_t seed, std::vector<std::int32_t>& open) {
    using std::sqrt;
    const Vector3<Scalar> normal = surface.normal(seed);
    if (normal.isZero()) return;
    const Vector3<Scalar>& point = surface.corner(seed, 0);
    const auto wall = std::int32_t(walls_.size());
    Scalar flatness(0), squared_radius(0);
    open.assign(1, seed);
    of_triangle_[std::size_t(seed)] = wall;
    for (std::size_t i = 0; i < open.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const int next = surface.topology.neighbour(open[i], k);
        if (next < 0 || of_triangle_[std::size_t(next)] != none) continue;
        Scalar farthest(0);
        for (std::size_t c = 0; c < 3; ++c) {
          const Scalar height = normal.dot(surface.corner(next, c) - point);
          farthest = (std::max)({farthest, height, Scalar(-height)});
        }
        if (!(farthest <= surface.tolerance) || !(normal.dot(surface.normal(next)) > Scalar(0))) continue;
        flatness = (std::max)(flatness, farthest);
        for (std::size_t c = 0; c < 3; ++c) squared_radius = (std::max)(squared_radius, Scalar((surface.corner(next, c) - point).squaredNorm()));
        of_triangle_[std::size_t(next)] = wall;
        open.push_back(next);
      }
    }
    const auto above = [](const Scalar& length) { return std::nextafter(static_cast<float>(length), std::numeric_limits<float>::infinity()); };
    if (open.size() > 1) walls_.push_back({seed, above(flatness), above(sqrt(squared_radius))});
    else of_triangle_[std::size_t(seed)] = none;
  }

  void mark_vertices(const Surface& surface) {
    constexpr std::int32_t unknown = -2;
    std::vector<std::int32_t> wall_of(surface.vertices.size(), unknown);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const bool ends = surface.topology.neighbour(int(t), int(k)) < 0 || surface.topology.neighbour(int(t), int((k + 2) % 3)) < 0;
        std::int32_t& wall = wall_of[std::size_t(surface.triangles[t][k])];
        if (ends || (wall != unknown && wall != of_triangle_[t])) wall = none;
        else wall = of_triangle_[t];
      }
    }
    is_inside_.resize(wall_of.size());
    for (std::size_t v = 0; v < wall_of.size(); ++v) is_inside_[v] = wall_of[v] >= 0;
  }

  void mark_boxes(const Surface& surface, const Bvh<Scalar>& bvh) {
    const auto nodes = bvh.nodes();
    under_.resize(nodes.size());
    inside_.resize(nodes.size());
    const auto has_no_rim = [&](std::int32_t triangle) {
      const auto& corners = surface.triangles[std::size_t((std::max)(triangle, std::int32_t(0)))];
      return triangle < 0 || std::all_of(corners.begin(), corners.end(), [&](int vertex) { return is_inside(vertex); });
    };
    for (std::size_t n = nodes.size(); n-- > 0;) {  // children come after their parent
      for (std::size_t i = 0; i < under_[n].size(); ++i) {
        const std::int32_t child = nodes[n].child[i];
        bool is_inside = false;
        if (child == 0) {
          under_[n][i] = none;
        } else if (BvhNode::is_leaf(child)) {
          const auto& leaf = bvh.leaves()[std::size_t(~child)];
          under_[n][i] = wall_in(leaf);
          is_inside = std::all_of(std::begin(leaf.triangle), std::end(leaf.triangle), has_no_rim);
        } else {
          const BvhNode& node = nodes[std::size_t(child)];
          under_[n][i] = wall_in(node, under_[std::size_t(child)]);
          is_inside = true;
          for (std::size_t k = 0; k < under_[n].size(); ++k) is_inside = is_inside && (node.child[k] == 0 || this->is_inside(int(child), k));
        }
        if (is_inside) inside_[n] |= std::uint8_t(1U << i);
      }
    }
  }
  std::int32_t wall_in(const BvhLeaf& leaf) const noexcept {
    const std::int32_t wall = of_triangle_[std::size_t(leaf.triangle[0])];
    for (const std::int32_t triangle : leaf.triangle) {
      if (triangle >= 0 && of_triangle_[std::size_t(triangle)] != wall) return none;
    }
    return wall;
  }
  static std::int32_t wall_in(const BvhNode& node, const OfChildren& under) noexcept {
    for (std::size_t i = 1; i < under.size(); ++i) {
      if (node.child[i] != 0 && under[i] != under[0]) return none;
    }
    return under[0];
  }

  std::vector<Wall> walls_;
  std::vector<std::int32_t> of_triangle_;
  std::vector<OfChildren> under_;  // by node
  std::vector<bool> is_inside_;       // by vertex
  std::vector<std::uint8_t> inside_;  // by node, a bit a child
};

}  // namespace feeler
