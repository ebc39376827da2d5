// The neighbours of measured triangles that are to be measured as well.
#pragma once

#include <algorithm>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/proximity/gjk.hpp"
#include "feeler/render/constraints/working_set.hpp"

namespace feeler {

/// The triangles that are to hold the tool in place of a ghost, and those that continue a face that touches.
///
/// No motion has met these triangles yet, as the certificate allows less than the margin. Without their rows the tool would come too close, and then
/// turn back where the ghost has become a contact, or rest on one of its edges where it should lie flat on the face.
class NeighbourQueue {
 public:
  struct Neighbour {
    int piece, triangle;
    WitnessFeatures features;  ///< to start its first query from
  };

  bool empty() const noexcept { return next_ == waiting_.size(); }
  const Neighbour& front() const noexcept { return waiting_[next_]; }
  void pop() noexcept { ++next_; }
  void clear() noexcept {
    waiting_.clear();
    next_ = 0;
  }
  /// Before all pairs are measured: no wall was touched yet.
  void forget_all() noexcept {
    clear();
    walls_.clear();
  }

  /// Appends the neighbours of a pair just measured that are no pairs yet.
  /// @param scene    `RenderedScene`
  /// @param patch    `ContactPatch`, after `find`
  /// @param closest  points of the pair
  template <class Scene, class Pairs, class Patch>
  void append(const Scene& scene, const Pairs& pairs, const typename Pairs::Pair& pair, const Patch& patch,
              const ClosestPoints<typename Scene::Scalar>& closest) noexcept {
    const auto bring = [&](int triangle, const WitnessFeatures& features) {
      if (pairs.find(pair.piece, triangle) < 0) waiting_.push_back({pair.piece, triangle, features});
    };
    if (patch.is_ghost() && closest.distance < scene.contact_distance()) {
      const int nearer = patch.nearer_triangle(closest);
      if (nearer >= 0) bring(nearer, pair.features);
    }
    const auto too_near = scene.noticed();
    // Without clearance all walls touch, and the certificate tells which of them hold.
    const auto has_clearance = [&] { return !pairs.has_no_clearance(scene.clearance().none()); };
    if (closest.distance < too_near && has_clearance()) {
      patch.visit_continuations(too_near, [&](int triangle) { bring(triangle, {}); });
    }
    if (closest.distance < scene.contact_distance() && (pair.wants_rim || has_clearance()) && note_wall(scene, pair)) {
      patch.visit_rim([&](int triangle) { return pairs.find(pair.piece, triangle) >= 0; }, [&](int triangle) { bring(triangle, {}); });
    }
  }

 private:
  struct OnWall {
    int piece, wall;
  };

  /// Notes the wall of a pair; false where a pair of the same piece has done so since walls were last forgotten, or there is none.
  template <class Scene, class Pair>
  bool note_wall(const Scene& scene, const Pair& pair) noexcept {
    const OnWall at{pair.piece, scene.object().walls().of_triangle(pair.triangle)};
    if (at.wall < 0 ||
        std::any_of(walls_.begin(), walls_.end(), [&](const OnWall& other) { return other.piece == at.piece && other.wall == at.wall; }))
      return false;
    return walls_.push_back(at);
  }

  FixedVector<Neighbour, 16> waiting_;
  int next_ = 0;  // of them
  FixedVector<OnWall, 64> walls_;  // that pieces touch
};

}  // namespace feeler
