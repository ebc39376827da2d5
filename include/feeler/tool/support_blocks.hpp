// The coordinates of a tool's vertices, laid out so that a compiler answers support queries with SIMD
// instructions, and boxes around them, so that of many vertices few are looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

/// Points, one by one and in blocks of eight. Of more than a few a block holds neighbours, and a tree of boxes, eight in each node, tells which
/// blocks may hold the highest (branch and bound).
template <RealScalar Scalar>
class SupportBlocks {
 public:
  SupportBlocks() = default;
  /// @param points  at least 1 row
  explicit SupportBlocks(const Points<Scalar>& points) {
    for (int i = 0; i < int(points.rows()); ++i) points_.push_back(points.row(i));
    numbers_.resize(points_.size());
    std::iota(numbers_.begin(), numbers_.end(), 0);
    if (count() > few) gather_neighbours(0, count());
    for (int i = 0; i < count(); i += width) add_block(i);
    if (count() > few) make_boxes();
  }

  int count() const noexcept { return int(points_.size()); }
  const Vector3<Scalar>& operator[](int i) const noexcept { return points_[std::size_t(i)]; }

  /// Index of a point farthest along a direction, to rounding; of a few equal ones, the first of its block. A direction with a NaN gives a
  /// valid index.
  /// @cost  of a few points all dot products, eight at a time, and no branch depends on them; of a thousand some dozen blocks
  int support(const Vector3<Scalar>& direction) const noexcept { return count() <= few ? support_of_few(direction) : search(direction).point; }

  /// max direction · point: the support function of their hull.
  Scalar highest(const Vector3<Scalar>& direction) const noexcept {
    if (count() > few) return search(direction).height;
    Lanes best = heights(0, direction);
    for (int b = 1; b < block_count(); ++b) best = (best.max)(heights(b, direction));
    return best.maxCoeff();
  }

 private:
  static constexpr int width = 8;  // points of a block, and children of a node
  static constexpr int few = 128;  // points that are looked at in less time than the boxes
  using Lanes = Eigen::Array<Scalar, width, 1>;
  using Coordinates = std::array<Scalar, std::size_t(3 * width)>;  // all x, all y, all z

  /// Boxes around blocks, or around the boxes of nodes.
  struct Node {
    Coordinates centres, half_extents;
  };
  struct Limits {
    Vector3<Scalar> lower, upper;
  };
  struct Search {
    Vector3<Scalar> direction, extents;  // extents: absolute values of the direction
    Scalar slack{};                      // by how much a box must promise more than is found
    Scalar height = std::numeric_limits<Scalar>::lowest();
    int point = 0;
  };

  int block_count() const noexcept { return int(blocks_.size()); }
  Vector3<Scalar> point_of(int place) const { return points_[as_index(numbers_[as_index((std::min)(place, count() - 1))])]; }

  /// Orders a range of the points so that each eight of them are neighbours: halves it across its longest side.
  void gather_neighbours(int begin, int end) {
    if (end - begin <= width) return;
    const Limits all = limits_of(begin, end, [this](int i) { return Limits{point_of(i), point_of(i)}; });
    Eigen::Index side;
    (all.upper - all.lower).maxCoeff(&side);
    const int middle = begin + ((end - begin + width - 1) / width + 1) / 2 * width;
    const auto is_lower = [&](int a, int b) { return points_[as_index(a)][side] < points_[as_index(b)][side]; };
    std::nth_element(numbers_.begin() + begin, numbers_.begin() + middle, numbers_.begin() + end, is_lower);
    gather_neighbours(begin, middle);
    gather_neighbours(middle, end);
  }
  /// The last point fills up the last block.
  void add_block(int begin) {
    Coordinates block;
    for (int j = 0; j < width; ++j) put(block, j, point_of(begin + j));
    blocks_.push_back(block);
  }
  static void put(Coordinates& coordinates, int lane, const Vector3<Scalar>& point) {
    for (int k = 0; k < 3; ++k) coordinates[as_index(k * width + lane)] = point[k];
  }
  /// Levels of boxes, the lowest around blocks, until one node is left.
  void make_boxes() {
    std::vector<Limits> limits;
    for (int i = 0; i < count(); i += width)
      limits.push_back(limits_of(i, i + width, [this](int place) { return Limits{point_of(place), point_of(place)}; }));
    while (limits.size() > 1) {
      std::vector<Node> nodes;
      std::vector<Limits> above;
      const int size = int(limits.size());
      const auto child = [&](int i) { return limits[as_index((std::min)(i, size - 1))]; };
      for (int i = 0; i < size; i += width) {
        Node node;
        for (int j = 0; j < width; ++j) {
          put(node.centres, j, (child(i + j).lower + child(i + j).upper) / 2);
          put(node.half_extents, j, (child(i + j).upper - child(i + j).lower) / 2);
        }
        nodes.push_back(node);
        above.push_back(limits_of(i, i + width, child));
      }
      levels_.push_back(nodes);
      limits = above;
    }
    size_ = (std::max)(limits[0].lower.cwiseAbs().maxCoeff(), limits[0].upper.cwiseAbs().maxCoeff());
  }
  template <class At>
  static Limits limits_of(int begin, int end, const At& at) {
    Limits all = at(begin);
    for (int i = begin + 1; i < end; ++i) {
      all.lower = all.lower.cwiseMin(at(i).lower);
      all.upper = all.upper.cwiseMax(at(i).upper);
    }
    return all;
  }

  int support_of_few(const Vector3<Scalar>& direction) const noexcept {
    alignas(64) Scalar dots[few];
    Scalar best{};
    int best_block = 0;
    for (int b = 0; b < block_count(); ++b) {
      Eigen::Map<Lanes, Eigen::Aligned64> block(dots + b * width);
      block = heights(b, direction);
      const Scalar block_best = block.maxCoeff();
      const bool is_better = b == 0 || block_best > best;
      best = is_better ? block_best : best;
      best_block = is_better ? b : best_block;
    }
    return best_block * width + first_at(dots + best_block * width, best);
  }

  Search search(const Vector3<Scalar>& direction) const noexcept {
    Search search{.direction = direction, .extents = direction.cwiseAbs()};
    search.slack = 4 * std::numeric_limits<Scalar>::epsilon() * size_ * search.extents.sum();
    look_into(int(levels_.size()) - 1, 0, search);
    return search;
  }
  /// Looks into the boxes of a node that may hold more than is found, the highest first.
  void look_into(int level, int number, Search& search) const noexcept {
    if (level < 0) return look_at(number, search);
    const Node& node = levels_[as_index(level)][as_index(number)];
    alignas(64) Scalar bounds[width];
    Eigen::Map<Lanes, Eigen::Aligned64> all(bounds);
    all = along(node.centres, search.direction) + along(node.half_extents, search.extents);
    const Scalar highest = all.maxCoeff();
    const int first = first_at(bounds, highest);
    const int last = int(level > 0 ? levels_[as_index(level - 1)].size() : blocks_.size()) - 1;
    const auto is_worth_it = [&](int i) { return bounds[i] > search.height + search.slack; };
    if (is_worth_it(first)) look_into(level - 1, (std::min)(number * width + first, last), search);
    for (int i = 0; i < width && number * width + i <= last; ++i) {
      if (i != first && is_worth_it(i)) look_into(level - 1, number * width + i, search);
    }
  }
  void look_at(int block, Search& search) const noexcept {
    alignas(64) Scalar dots[width];
    Eigen::Map<Lanes, Eigen::Aligned64> all(dots);
    all = heights(block, search.direction);
    const Scalar highest = all.maxCoeff();
    if (!(highest > search.height)) return;
    search.height = highest;
    search.point = numbers_[as_index((std::min)(block * width + first_at(dots, highest), count() - 1))];
  }

  /// The first of eight that has a value; 0 if none has.
  static int first_at(const Scalar* values, const Scalar& value) noexcept {
    int lane = 0;
    for (int j = width - 1; j > 0; --j) lane = values[j] == value ? j : lane;
    return values[0] == value ? 0 : lane;
  }
  /// The dot products of a block.
  Lanes heights(int block, const Vector3<Scalar>& direction) const noexcept { return along(blocks_[as_index(block)], direction); }
  static Lanes along(const Coordinates& c, const Vector3<Scalar>& direction) noexcept {
    using Map = Eigen::Map<const Lanes>;
    return Map(c.data()) * direction.x() + Map(c.data() + width) * direction.y() + Map(c.data() + 2 * width) * direction.z();
  }

  std::vector<Vector3<Scalar>> points_;
  std::vector<int> numbers_;  // of the points in the order of the blocks
  std::vector<Coordinates> blocks_;
  std::vector<std::vector<Node>> levels_;
  Scalar size_ = Scalar(0);  // largest coordinate
};

}  // namespace feeler
