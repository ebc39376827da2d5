// The features on which the last queries of single triangles ended, to start the next ones from.
#pragma once

#include <array>

#include "feeler/proximity/gjk.hpp"

namespace feeler {

/// Witness features by triangle, of one tool. A triangle takes the place of another one whose number has the same remainder.
class FeatureCache {
 public:
  static constexpr int capacity = 64;

  void clear() noexcept {
    entries_.fill({});
    latest_ = {};
  }
  void remember(int triangle, const WitnessFeatures& features) noexcept {
    entries_[place_of(triangle)] = {triangle, features};
    latest_ = features;
  }
  /// The features of a triangle, or none.
  WitnessFeatures recall(int triangle) const noexcept {
    const Entry& entry = entries_[place_of(triangle)];
    return entry.triangle == triangle ? entry.features : WitnessFeatures{};
  }
  /// The same, or those remembered last: triangles that are met one after the other are near each other.
  WitnessFeatures recall_or_guess(int triangle) const noexcept {
    const WitnessFeatures features = recall(triangle);
    return features.size > 0 ? features : latest_;
  }

 private:
  struct Entry {
    int triangle = -1;
    WitnessFeatures features;
  };
  static std::size_t place_of(int triangle) noexcept { return std::size_t(triangle) % capacity; }

  std::array<Entry, std::size_t(capacity)> entries_;
  WitnessFeatures latest_;
};

}  // namespace feeler
