// Builds a binary tree over boxes, from the top down, by the binned surface area heuristic.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace feeler {

/// A box and the index of what is in it.
struct BvhItem {
  float lower[3];
  float upper[3];
  std::int32_t index;
};

/// Binned top-down builder (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
///
/// Splits at the best of 15 planes on each axis. Where no plane separates the centres, and where the depth
/// bound comes near, it halves the list instead. Leaves hold up to `maximum_leaf_size` items.
/// @cost  O(n log n); 28 bytes of scratch per item, which the caller brings
class BvhBuilder {
 public:
  static constexpr int maximum_leaf_size = 4;
  static constexpr int maximum_depth = 64;  ///< nodes on a path from the root to a leaf

  /// A box, and its two children or its items.
  struct Node {
    float lower[3];
    float upper[3];
    std::int32_t first;  ///< inner: the children are the nodes first and first + 1; leaf: position in the items
    std::int32_t count;  ///< inner: 0; leaf: the number of items

    bool is_leaf() const noexcept { return count != 0; }
    float half_area() const noexcept { return BvhBuilder::half_area(lower, upper); }
  };

  /// @param items        at least one; reordered so that leaf items are `items[first..first+count)`
  /// @param depth_limit  nodes on a path; kept unless halving the list alone needs more
  explicit BvhBuilder(std::vector<BvhItem>& items, int depth_limit = maximum_depth) : items_(items), depth_limit_(depth_limit) {
    nodes_.reserve(items.size());
    nodes_.push_back({});
    std::vector<Task> tasks{{0, 0, std::int32_t(items.size()), 1}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      const Box centres = enclose(task);
      if (task.end - task.begin <= maximum_leaf_size) {
        nodes_[std::size_t(task.node)].first = task.begin;
        nodes_[std::size_t(task.node)].count = task.end - task.begin;
        continue;
      }
      const std::int32_t middle = split(task, centres);
      const auto child = std::int32_t(nodes_.size());
      nodes_[std::size_t(task.node)].first = child;
      nodes_[std::size_t(task.node)].count = 0;
      nodes_.resize(nodes_.size() + 2);
      tasks.push_back({child + 1, middle, task.end, task.depth + 1});
      tasks.push_back({child, task.begin, middle, task.depth + 1});
    }
  }

  /// The root comes first, children after their parent.
  const std::vector<Node>& nodes() const noexcept { return nodes_; }

 private:
  static constexpr int bin_count = 16;

  struct Task {
    std::int32_t node;
    std::int32_t begin;
    std::int32_t end;
    int depth;
  };
  struct Box {
    std::array<float, 3> lower{infinity, infinity, infinity};
    std::array<float, 3> upper{-infinity, -infinity, -infinity};

    void extend(const float* other_lower, const float* other_upper) noexcept {
      for (std::size_t k = 0; k < 3; ++k) {
        lower[k] = (std::min)(lower[k], other_lower[k]);
        upper[k] = (std::max)(upper[k], other_upper[k]);
      }
    }
    float half_area() const noexcept { return BvhBuilder::half_area(lower.data(), upper.data()); }
  };
  struct Bin {
    Box box;
    std::int32_t count = 0;
  };
  static float half_area(const float* lower, const float* upper) noexcept {
    const float x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x * y + y * z + z * x;
  }
  static constexpr float infinity = std::numeric_limits<float>::infinity();

  /// Twice the centre of an item; the factor does not matter to a split.
  static float centre(const BvhItem& item, std::size_t axis) noexcept { return item.lower[axis] + item.upper[axis]; }

  /// Writes the box of a node, and returns the box of the centres in it.
  Box enclose(const Task& task) noexcept {
    Box box, centres;
    for (std::int32_t i = task.begin; i < task.end; ++i) {
      const BvhItem& item = items_[std::size_t(i)];
      const std::array<float, 3> c{centre(item, 0), centre(item, 1), centre(item, 2)};
      box.extend(item.lower, item.upper);
      centres.extend(c.data(), c.data());
    }
    Node& node = nodes_[std::size_t(task.node)];
    std::copy(box.lower.begin(), box.lower.end(), node.lower);
    std::copy(box.upper.begin(), box.upper.end(), node.upper);
    return centres;
  }

  /// Reorders the items of a task into two lists, neither empty, and returns where the second begins.
  std::int32_t split(const Task& task, const Box& centres) {
    const std::int32_t count = task.end - task.begin;
    // Halving from here on needs this many more levels, and one for the leaves.
    const int levels_to_halve = int(std::bit_width(std::uint32_t(count - 1) / maximum_leaf_size)) + 1;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (centres.upper[k] - centres.lower[k] > centres.upper[axis] - centres.lower[axis]) axis = k;
    const bool is_spread = centres.upper[axis] > centres.lower[axis];
    if (is_spread && task.depth + levels_to_halve < depth_limit_) {
      const std::int32_t middle = split_at_best_plane(task, centres);
      if (middle > task.begin && middle < task.end) return middle;
    }
    const std::int32_t middle = task.begin + count / 2;
    if (is_spread)
      std::nth_element(items_.begin() + task.begin, items_.begin() + middle, items_.begin() + task.end,
                       [axis](const BvhItem& a, const BvhItem& b) { return centre(a, axis) < centre(b, axis); });
    return middle;
  }

  std::int32_t split_at_best_plane(const Task& task, const Box& centres) {
    std::array<std::array<Bin, bin_count>, 3> bins{};
    std::array<float, 3> scale{};
    for (std::size_t k = 0; k < 3; ++k) {
      const float side = centres.upper[k] - centres.lower[k];
      scale[k] = side > (std::numeric_limits<float>::min)() * bin_count ? float(bin_count) / side : 0.0F;
    }
    for (std::int32_t i = task.begin; i < task.end; ++i) {
      const BvhItem& item = items_[std::size_t(i)];
      for (std::size_t k = 0; k < 3; ++k) {
        Bin& bin = bins[k][bin_of(item, k, centres, scale)];
        bin.box.extend(item.lower, item.upper);
        ++bin.count;
      }
    }
    float best_cost = infinity;
    std::size_t best_axis = 0, best_bin = 0;  // the first bin of the right side
    for (std::size_t k = 0; k < 3; ++k) {
      if (scale[k] == 0.0F) continue;
      std::array<float, bin_count> right_cost{};
      Bin right;
      for (std::size_t b = bin_count - 1; b > 0; --b) {
        right.box.extend(bins[k][b].box.lower.data(), bins[k][b].box.upper.data());
        right.count += bins[k][b].count;
        right_cost[b] = right.count > 0 ? right.box.half_area() * float(right.count) : infinity;
      }
      Bin left;
      for (std::size_t b = 1; b < bin_count; ++b) {
        left.box.extend(bins[k][b - 1].box.lower.data(), bins[k][b - 1].box.upper.data());
        left.count += bins[k][b - 1].count;
        if (left.count == 0) continue;
        const float cost = left.box.half_area() * float(left.count) + right_cost[b];
        if (!(cost < best_cost)) continue;
        best_cost = cost;
        best_axis = k;
        best_bin = b;
      }
    }
    if (best_bin == 0) return task.begin;
    const auto middle = std::partition(items_.begin() + task.begin, items_.begin() + task.end,
                                       [&](const BvhItem& item) { return bin_of(item, best_axis, centres, scale) < best_bin; });
    return std::int32_t(middle - items_.begin());
  }

  static std::size_t bin_of(const BvhItem& item, std::size_t axis, const Box& centres, const std::array<float, 3>& scale) noexcept {
    const float position = (centre(item, axis) - centres.lower[axis]) * scale[axis];
    return (std::min)(std::size_t(position), std::size_t(bin_count - 1));
  }

  std::vector<BvhItem>& items_;
  int depth_limit_;
  std::vector<Node> nodes_;
};

}  // namespace feeler
