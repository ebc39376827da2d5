// The orders in which a sweep visits the boxes and the triangles of a hierarchy.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/bvh.hpp"

namespace feeler {

/// One after another, and of the children of a node first the one that a motion comes to first: an early blocker, and the plane of what was
/// measured, save work on all that lies behind it.
class NearestFirst {
 public:
  static constexpr int leaves_at_once = 1;
  static constexpr std::size_t side_by_side = 1;  ///< nodes, or leaves, that planes are held against at a time

  /// @param motion  of the tool, world [m]
  explicit NearestFirst(const Vector3<float>& motion) noexcept : motion_(motion) { waiting_.push_back(0); }

  bool empty() const noexcept { return waiting_.empty(); }
  /// What to visit next: nodes of the hierarchy as i, or leaves as ~i, not both.
  std::span<const std::int32_t> take() noexcept {
    taken_ = waiting_.back();
    waiting_.pop_back();
    return {&taken_, 1};
  }
  /// @param passed  what is not 0 need not be visited
  void push_children(const BvhNode& node, const std::array<std::int32_t, BvhNode::width>& passed) noexcept {
    std::array<float, BvhNode::width> ahead;  // of those pushed
    std::array<std::int32_t, BvhNode::width> children;
    std::size_t count = 0;
    for (std::size_t i = 0; i < passed.size(); ++i) {
      if (passed[i] != 0) continue;
      float along = 0.0F;
      for (std::size_t k = 0; k < 3; ++k) along += motion_[int(k)] * (node.lower[k][i] + node.upper[k][i]);
      std::size_t at = count++;
      for (; at > 0 && along > ahead[at - 1]; --at) {  // moved one by one: of two that are swapped g++ reads both at once, and waits for them
        ahead[at] = ahead[at - 1];
        children[at] = children[at - 1];
      }
      ahead[at] = along;
      children[at] = node.child[i];
    }
    for (std::size_t i = 0; i < count; ++i) waiting_.push_back(children[i]);
  }

 private:
  Vector3<float> motion_;
  std::int32_t taken_ = 0;
  FixedVector<std::int32_t, Bvh<float>::stack_capacity> waiting_;
};

/// Some at a time and in no order, without a branch that depends on a box: what is passed is as good as random, and a wrong guess at it makes a
/// processor wait for longer than the test takes.
class InBatches {
  static constexpr int batch = 8;
  static constexpr int pushed = batch * BvhNode::width;  // by a batch of nodes, at most
  static constexpr int roomy = 8 * pushed;

 public:
  static constexpr int leaves_at_once = batch + pushed;
  static constexpr std::size_t side_by_side = 4;

  explicit InBatches(const Vector3<float>& /*motion*/) noexcept { nodes_[0] = 0; }  // the root

  bool empty() const noexcept { return node_count_ == 0 && leaf_count_ == 0; }
  /// As in `NearestFirst`; valid until the next call.
  std::span<const std::int32_t> take() noexcept {
    if (leaf_count_ >= batch || node_count_ == 0) return {leaves_.data(), std::size_t(std::exchange(leaf_count_, 0))};
    const int count = node_count_ > roomy ? 1 : (std::min)(node_count_, batch);  // one by one they need no more room than a stack
    node_count_ -= count;
    std::copy_n(nodes_.begin() + node_count_, count, taken_.begin());
    return {taken_.data(), std::size_t(count)};
  }
  void push_children(const BvhNode& node, const std::array<std::int32_t, BvhNode::width>& passed) noexcept {
    int node_count = node_count_, leaf_count = leaf_count_;  // a compiler has to take members for overwritten by what is pushed
    for (std::size_t i = 0; i < passed.size(); ++i) {
      const std::int32_t child = node.child[i];
      const bool stays = passed[i] == 0, is_leaf = BvhNode::is_leaf(child);
      nodes_[std::size_t(node_count)] = leaves_[std::size_t(leaf_count)] = child;
      node_count += int(stays & !is_leaf);
      leaf_count += int(stays & is_leaf);
    }
    node_count_ = node_count;
    leaf_count_ = leaf_count;
  }

 private:
  std::array<std::int32_t, std::size_t(roomy + pushed + Bvh<float>::stack_capacity)> nodes_;
  std::array<std::int32_t, std::size_t(leaves_at_once)> leaves_;
  std::array<std::int32_t, std::size_t(batch)> taken_;
  int node_count_ = 1, leaf_count_ = 0;
};

}  // namespace feeler
