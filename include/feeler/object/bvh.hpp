// A bounding volume hierarchy over the triangles of a mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh_builder.hpp"

namespace feeler {

/// Up to four boxes side by side, each around a node or a leaf.
struct alignas(64) BvhNode {
  static constexpr int width = 4;

  float lower[3][width];      ///< by axis; +∞ where there is no box
  float upper[3][width];      ///< −∞ where there is none
  std::int32_t child[width];  ///< node i as i, leaf i as ~i; 0, which is the root, where there is none

  static constexpr bool is_leaf(std::int32_t child) noexcept { return child < 0; }
};
static_assert(sizeof(BvhNode) == 128, "two cache lines");

/// Up to four triangles side by side. Lanes without one repeat another.
struct alignas(16) BvhLeaf {
  static constexpr int width = BvhNode::width;

  float corner[3][3][width];     ///< by corner and axis; the nearest floats
  std::int32_t triangle[width];  ///< −1 where there is none
};
static_assert(BvhLeaf::width == BvhBuilder::maximum_leaf_size);

/// Axis-aligned boxes around triangles, in a tree of nodes with four children. Node 0 is the root.
///
/// Boxes and corners are single-precision, relative to `origin()`, the middle of the mesh. Boxes are rounded outward: for every
/// corner p in a box, lower ≤ p − origin ≤ upper, also after p − origin is rounded to any type no narrower than float.
///
/// A binary tree of which each node takes the place of those children whose boxes have the most area, until it has four
/// (Wald, Benthin, Boulos, "Getting rid of packets", 2008).
template <RealScalar Scalar>
class Bvh {
 public:
  static constexpr int maximum_depth = BvhBuilder::maximum_depth;  ///< nodes on a path
  static constexpr int stack_capacity = (BvhNode::width - 1) * maximum_depth + 1;  ///< children that a traversal has still to visit

  Bvh() = default;
  /// @param vertices   3-vectors [m], finite
  /// @param triangles  at least one; indices into `vertices`
  /// @cost  O(n log n), allocates; half a microsecond a triangle
  template <class Vertices, class TriangleList>
  Bvh(const Vertices& vertices, const TriangleList& triangles, const Vector3<Scalar>& origin) : origin_(origin) {
    const auto corner = [&](std::int32_t triangle, std::size_t c) -> decltype(auto) {
      return vertices[std::size_t(triangles[std::size_t(triangle)][c])];
    };
    std::vector<BvhItem> items(triangles.size());
    for (std::size_t t = 0; t < items.size(); ++t) {
      items[t].index = std::int32_t(t);
      for (int k = 0; k < 3; ++k) {
        const Scalar a = corner(items[t].index, 0)[k], b = corner(items[t].index, 1)[k], c = corner(items[t].index, 2)[k];
        items[t].lower[k] = rounded_down(from_origin((std::min)({a, b, c}), k));
        items[t].upper[k] = rounded_up(from_origin((std::max)({a, b, c}), k));
      }
    }
    const BvhBuilder builder(items);
    const auto make_leaf = [&](const BvhBuilder::Node& binary) {
      BvhLeaf leaf;
      for (int i = 0; i < BvhLeaf::width; ++i) {
        const std::int32_t triangle = items[std::size_t(binary.first + (std::min)(i, binary.count - 1))].index;
        leaf.triangle[i] = i < binary.count ? triangle : -1;
        for (std::size_t c = 0; c < 3; ++c)
          for (int k = 0; k < 3; ++k) leaf.corner[c][k][i] = static_cast<float>(from_origin(corner(triangle, c)[k], k));
      }
      return leaf;
    };
    widen(builder.nodes(), make_leaf);
  }

  /// The point that boxes and corners are relative to [m].
  const Vector3<Scalar>& origin() const noexcept { return origin_; }
  std::span<const BvhNode> nodes() const noexcept { return nodes_; }
  std::span<const BvhLeaf> leaves() const noexcept { return leaves_; }
  /// The leaves in the box of a child, from one to before another.
  std::array<std::int32_t, 2> leaves_under(std::int32_t child) const noexcept {
    return BvhNode::is_leaf(child) ? std::array<std::int32_t, 2>{~child, ~child + 1} : ranges_[std::size_t(child)];
  }

  /// Calls `visit(triangle)`, until it returns false, for the triangles of the leaves of which no box on the way is
  /// `is_apart(lower, upper)`, which are arrays of three floats.
  template <class IsApart, class Visit>
  void visit(const IsApart& is_apart, const Visit& visit) const noexcept {
    FixedVector<std::int32_t, stack_capacity> stack;
    stack.push_back(0);
    while (!stack.empty()) {
      const std::int32_t entry = stack.back();
      stack.pop_back();
      if (BvhNode::is_leaf(entry)) {
        for (const std::int32_t triangle : leaves_[std::size_t(~entry)].triangle) {
          if (triangle >= 0 && !visit(int(triangle))) return;
        }
        continue;
      }
      const BvhNode& node = nodes_[std::size_t(entry)];
      for (int i = BvhNode::width - 1; i >= 0; --i) {
        const std::array<float, 3> lower{node.lower[0][i], node.lower[1][i], node.lower[2][i]},
            upper{node.upper[0][i], node.upper[1][i], node.upper[2][i]};
        if (node.child[i] != 0 && !is_apart(lower, upper)) stack.push_back(node.child[i]);
      }
    }
  }

 private:
  using Working = WorkingScalar<Scalar>;

  Working from_origin(const Scalar& coordinate, int axis) const noexcept { return Working(coordinate) - static_cast<Working>(origin_[axis]); }
  // The nearest float is up to half a step off on either side, so one step more is outside, whatever the
  // rounding of the difference was.
  static float rounded_down(const Working& x) noexcept { return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity()); }
  static float rounded_up(const Working& x) noexcept { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

  /// Makes the nodes and leaves out of those of a binary tree.
  template <class MakeLeaf>
  void widen(std::span<const BvhBuilder::Node> binary, const MakeLeaf& make_leaf) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    struct Task {
      std::int32_t binary, node;
    };
    leaves_.reserve((binary.size() + 1) / 2);
    nodes_.emplace_back();
    std::vector<Task> tasks{{0, 0}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      const auto children = open(binary, task.binary);
      BvhNode node{};
      for (int k = 0; k < 3; ++k) {
        std::fill_n(node.lower[k], BvhNode::width, infinity);
        std::fill_n(node.upper[k], BvhNode::width, -infinity);
      }
      for (int i = 0; i < children.size(); ++i) {
        const BvhBuilder::Node& child = binary[std::size_t(children[i])];
        for (int k = 0; k < 3; ++k) {
          node.lower[k][i] = child.lower[k];
          node.upper[k][i] = child.upper[k];
        }
        if (child.is_leaf()) {
          node.child[i] = ~std::int32_t(leaves_.size());
          leaves_.push_back(make_leaf(child));
        } else {
          node.child[i] = std::int32_t(nodes_.size());
          tasks.push_back({children[i], node.child[i]});
          nodes_.emplace_back();
        }
      }
      nodes_[std::size_t(task.node)] = node;
    }
    nodes_.shrink_to_fit();
    find_ranges();
  }

  /// The leaves under a node come one after another: those that are its children, and those of each other child in turn.
  void find_ranges() {
    ranges_.assign(nodes_.size(), {(std::numeric_limits<std::int32_t>::max)(), 0});
    for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parent
      for (const std::int32_t child : nodes_[n].child) {
        if (child == 0) continue;
        const auto under = leaves_under(child);
        ranges_[n] = {(std::min)(ranges_[n][0], under[0]), (std::max)(ranges_[n][1], under[1])};
      }
    }
  }

  /// The nodes of a binary tree that take the place of one of them.
  static FixedVector<std::int32_t, BvhNode::width> open(std::span<const BvhBuilder::Node> binary, std::int32_t node) {
    FixedVector<std::int32_t, BvhNode::width> children;
    children.push_back(node);
    const auto area = [&](std::int32_t i) {
      const BvhBuilder::Node& box = binary[std::size_t(i)];
      return box.is_leaf() ? -1.0F : box.half_area();
    };
    while (!children.full()) {
      auto largest = std::max_element(children.begin(), children.end(), [&](std::int32_t a, std::int32_t b) { return area(a) < area(b); });
      const BvhBuilder::Node& opened = binary[std::size_t(*largest)];
      if (opened.is_leaf()) break;
      *largest = opened.first;
      children.push_back(opened.first + 1);
    }
    return children;
  }

  Vector3<Scalar> origin_ = Vector3<Scalar>::Zero();
  std::vector<BvhNode> nodes_;
  std::vector<BvhLeaf> leaves_;
  std::vector<std::array<std::int32_t, 2>> ranges_;  // of leaves, by node
};

}  // namespace feeler
