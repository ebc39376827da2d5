// The certificate of a motion of the whole tool: every piece of it past every triangle, or what blocks.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "feeler/contact/working_set.hpp"
#include "feeler/proximity/plane_cache.hpp"
#include "feeler/proximity/sweep.hpp"
#include "feeler/render/rendered_scene.hpp"

namespace feeler {

/// Certifies motions in a scene, and keeps the planes that parted each piece of the tool from its surroundings for the next motion.
template <RigidTool ToolType>
class MotionCertificate {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using Piece = typename Scene::Piece;

  void clear() noexcept {
    for (auto& planes : planes_) planes.clear();
  }

  /// @param from    pose of the reference point
  /// @param work    grows by the work done
  /// @param limit   value of `work` at which it gives up
  /// @param pairs   what is known near the tool at `from`: looked at first, and exactly, but for those beyond `far` [m]
  template <int pair_capacity = 1>
  SweepResult<Scalar> certify(const Scene& scene, const Pose<Scalar>& from, const Twist<Scalar>& motion, int& work, int limit,
                              const WorkingSet<Scalar, pair_capacity>& pairs = {}, Scalar far = std::numeric_limits<Scalar>::infinity()) noexcept {
    SweepResult<Scalar> result;
    Scalar until = Scalar(1);
    for (int piece = 0; piece < scene.piece_count(); ++piece) {
      const MovingTool<Piece> moving = scene.moving(piece, from, motion);
      Clearance<Scalar> clearance = scene.clearance_for(moving);
      // A ball that slides in a fit comes as near to the next triangle of a wall as it is to this one. What to keep is safe to judge by the
      // nearest, because the core stays a radius away.
      if constexpr (SweptTool<Piece>) {
        for (int i = 0; i < pairs.size(); ++i) {
          if (pairs[i].piece == piece) clearance.kept = std::min(clearance.kept, clearance.required(pairs[i].slack));
        }
        clearance.kept_from_unknown = clearance.kept;
      }
      std::array<KnownTriangle<Scalar>, std::size_t(pair_capacity)> known;
      int known_count = 0;
      for (int i = 0; i < pairs.size(); ++i) {
        const auto& pair = pairs[i];
        if (pair.piece != piece || pair.is_beyond(far)) continue;
        known[std::size_t(known_count++)] = {
            pair.triangle, {pair.corners_world.colwise() - moving.origin(), pair.normal, pair.features, true}};
      }
      const auto passed = Sweep<Piece>(planes_[std::size_t(piece)], clearance)
                              .certify(scene.object(), moving, std::span(known).first(std::size_t(known_count)), work, limit, until);
      if constexpr (maximum_pieces<ToolType> == 1) return passed;
      for (const auto& blocker : passed.blockers) add({blocker.triangle, blocker.time, piece}, result);
      if (passed.is_exhausted) {
        result.is_exhausted = true;
        result.time = Scalar(0);
        break;
      }
      if (passed.blockers.empty()) continue;
      result.time = std::min(result.time, passed.time);
      const Scalar enough = worth_certifying(result.time, clearance, moving);
      if (2 * enough <= until) until = enough;
    }
    return result;
  }

 private:
  /// Keeps the earliest blockers.
  static void add(const Blocker<Scalar>& blocker, SweepResult<Scalar>& result) noexcept {
    if (result.blockers.push_back(blocker)) return;
    auto latest = std::max_element(result.blockers.begin(), result.blockers.end(),
                                   [](const auto& a, const auto& b) { return a.time < b.time; });
    if (blocker.time < latest->time) *latest = blocker;
  }

  std::array<PlaneCache<Scalar>, std::size_t(maximum_pieces<ToolType>)> planes_;
};

}  // namespace feeler
