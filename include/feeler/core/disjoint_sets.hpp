// Disjoint sets of numbers, to be joined (union-find).
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

#include "feeler/core/index.hpp"

namespace feeler::detail {

/// The numbers from 0 on, each in a set of its own until that is joined to another. A set is known by one of its numbers, its root.
/// @cost  next to constant time for each; allocates where it grows
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Appends a number.
  void add() { parent_.push_back(int(parent_.size())); }
  int root(int i) noexcept {
    while (!is_root(i)) i = parent_[as_index(i)] = parent_[as_index(parent_[as_index(i)])];
    return i;
  }
  bool is_root(int i) const noexcept { return parent_[as_index(i)] == i; }
  /// The set of one number joins that of another, whose root stays.
  void join(int from, int to) noexcept { parent_[as_index(root(from))] = root(to); }

 private:
  std::vector<int> parent_;
};

}  // namespace feeler::detail
