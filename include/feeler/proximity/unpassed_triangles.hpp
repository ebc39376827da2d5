// The triangles of a hierarchy that no plane passes, box by box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "feeler/object/bvh.hpp"
#include "feeler/proximity/work_meter.hpp"

namespace feeler {

namespace detail {

/// Calls `visit` with arrays of what `find` gives for so many entries, and of one for each that is left.
template <std::size_t size, class Find, class Visit>
void in_groups_of(std::span<const std::int32_t> entries, const Find& find, const Visit& visit) noexcept {
  std::size_t i = 0;
  for (; i + size <= entries.size(); i += size) {
    std::array<decltype(find(0)), size> group;
    for (std::size_t j = 0; j < size; ++j) group[j] = find(entries[i + j]);
    visit(group);
  }
  for (; i < entries.size(); ++i) visit(std::array{find(entries[i])});
}

}  // namespace detail

/// Where a traversal has come to: it may go on later, as long as hierarchy and planes are the same.
template <class Order>
struct TraversalPlace {
  /// Before the root.
  /// @param order  with the root in it: `NearestFirst` or `InBatches`
  explicit TraversalPlace(const Order& order) noexcept : waiting(order) {}

  Order waiting;
  std::array<std::int32_t, std::size_t(Order::leaves_at_once* BvhLeaf::width + 1)>
      unpassed;  // places in leaves; one more is written, and not counted
  std::size_t unpassed_count = 0, next = 0;  // of them, and the first that was not visited
  WorkMeter<16> nodes;  // and leaves

  /// The nodes or leaves that are next in order.
  /// @param work  grows by the work done
  std::span<const std::int32_t> take(int& work) noexcept {
    const std::span<const std::int32_t> taken = waiting.take();
    nodes.add(int(taken.size()), work);
    return taken;
  }
};

namespace detail {

/// Puts those children of nodes in order that no plane passes.
template <class Scalar, class Planes, class PlaneCount, class Order, class Sift>
void open_nodes(const Bvh<Scalar>& bvh, std::span<const std::int32_t> entries, Planes& planes, const PlaneCount& plane_count, const Sift& sift,
                Order& waiting) noexcept {
  const auto node_of = [&](std::int32_t entry) { return &bvh.nodes()[std::size_t(entry)]; };
  in_groups_of<Order::side_by_side>(entries, node_of, [&](const auto& nodes) {
    auto passed = planes.passed(nodes, plane_count());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sift(int(nodes[i] - bvh.nodes().data()), passed[i]);
      waiting.push_children(*nodes[i], passed[i]);
    }
  });
}

/// Notes the triangles of leaves that no plane passes, to be visited next.
template <class Scalar, class Planes, class PlaneCount, class Order>
void open_leaves(const Bvh<Scalar>& bvh, std::span<const std::int32_t> entries, Planes& planes, const PlaneCount& plane_count,
                 TraversalPlace<Order>& place) noexcept {
  std::size_t count = 0;
  const auto leaf_of = [&](std::int32_t entry) { return &bvh.leaves()[std::size_t(~entry)]; };
  in_groups_of<Order::side_by_side>(entries, leaf_of, [&](const auto& leaves) {
    const auto passed = planes.passed(leaves, plane_count());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      for (std::size_t lane = 0; lane < passed[i].size(); ++lane) {
        place.unpassed[count] = std::int32_t((leaves[i] - bvh.leaves().data()) * BvhLeaf::width) + std::int32_t(lane);
        count += std::size_t(passed[i][lane] == 0) & std::size_t(leaves[i]->triangle[lane] >= 0);
      }
    }
  });
  place.unpassed_count = count;
  place.next = 0;
}

}  // namespace detail

/// Calls `visit(leaf, lane)` for every triangle that none of the planes passes, and `may_go_on()` before, until one call is false; true when it came
/// to the end. Both may change the planes. Called again with the same `place` it goes on there: with the triangle that it ended at.
/// @param sift         `sift(node, passed)` may mark more of a node's children as passed
/// @param planes       `CoarsePlanes`
/// @param plane_count  `plane_count()` is how many they are
/// @param work         grows by the work done
template <class Scalar, class Planes, class PlaneCount, class Order, class Sift, class Visit, class MayGoOn>
bool visit_unpassed(const Bvh<Scalar>& bvh, Planes& planes, const PlaneCount& plane_count, TraversalPlace<Order>& place, int& work, const Sift& sift,
                    const Visit& visit, const MayGoOn& may_go_on) noexcept {
  for (;;) {
    while (place.next < place.unpassed_count) {
      if (!may_go_on()) return false;
      const auto at = std::size_t(place.unpassed[place.next]);
      if (!visit(std::int32_t(at / BvhLeaf::width), at % BvhLeaf::width)) return false;
      ++place.next;
    }
    if (place.waiting.empty()) return true;
    if (!may_go_on()) return false;
    const std::span<const std::int32_t> next = place.take(work);
    if (BvhNode::is_leaf(next.front())) {
      detail::open_leaves(bvh, next, planes, plane_count, place);
    } else {
      detail::open_nodes(bvh, next, planes, plane_count, sift, place.waiting);
    }
  }
}

}  // namespace feeler
