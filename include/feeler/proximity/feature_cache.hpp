// The features on which the last queries of single triangles ended, to start the next ones from.
#pragma once

#include <array>

#include "feeler/proximity/gjk.hpp"

namespace feeler {

/// Witness features by triangle, of one tool. A triangle takes the place of another one whose number has the same remainder.
class FeatureCache {
 public:
  static constexpr int capacity = 64;

  void clear() noexcept { entries_.fill({}); }
  void remember(int triangle, const WitnessFeatures& features) noexcept { entries_[place_of(triangle)] = {triangle, features}; }
  /// The features of a triangle, or none.
  WitnessFeatures recall(int triangle) const noexcept {
    const Entry& entry = entries_[place_of(triangle)];
    return entry.triangle == triangle ? entry.features : WitnessFeatures{};
  }

 private:
  struct Entry {
    int triangle = -1;
    WitnessFeatures features;
  };
  static std::size_t place_of(int triangle) noexcept { return std::size_t(triangle) % capacity; }

  std::array<Entry, std::size_t(capacity)> entries_;
};

}  // namespace feeler
