// The certificate of a motion of the whole tool: every piece of it past every triangle, or what blocks.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/proximity/plane_cache.hpp"
#include "feeler/proximity/sweep.hpp"
#include "feeler/render/constraints/working_set.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/tool/piece_tree.hpp"

namespace feeler {

/// Certifies motions in a scene, and keeps the planes that parted the tool from its surroundings for the next motion: those of each piece,
/// and those of the groups that the pieces of a compound tool are in.
template <RigidTool ToolType>
class MotionCertificate {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using Piece = typename Scene::Piece;

  explicit MotionCertificate(const Scene& scene)
      : planes_(std::size_t(scene.piece_count())), walls_(scene.object().walls().count() > 0), groups_(std::size_t(scene.piece_count() - 1)) {}

  void clear() noexcept {
    for (auto& planes : planes_) planes.clear();
    for (auto& group : groups_) group.clear();
    walls_.clear();
  }

  /// Planes that parted a piece from its surroundings.
  const PlaneCache<Scalar>& planes(int piece) const noexcept { return planes_[std::size_t(piece)]; }

  /// How far a motion is free; of one that turns by more than 3 rad only as much is looked at.
  /// @param from    pose of the reference point
  /// @param work    grows by the work done
  /// @param limit   value of `work` at which it gives up
  /// @param pairs   what is known near the tool at `from`: looked at first, and exactly, but for those beyond `reach` [m]
  template <int pair_capacity = 1>
  SweepResult<Scalar> certify(const Scene& scene, const Pose<Scalar>& from, const Twist<Scalar>& motion, int& work, int limit,
                              const WorkingSet<Scalar, pair_capacity>& pairs = {}, Scalar reach = std::numeric_limits<Scalar>::infinity()) noexcept {
    const Scalar turn = motion.angular.norm();
    Scalar until = turn > longest_turn ? longest_turn / turn : Scalar(1);
    if constexpr (!CompoundShape<ToolType>) {
      return certify_piece(0, scene, scene.moving(0, from, motion), work, limit, pairs, reach, until, std::numeric_limits<Scalar>::infinity());
    } else {
      is_near_ = find_near_pieces(scene, from, motion, work, limit);
      SweepResult<Scalar> result;
      result.time = until;
      Scalar first_blocked = std::numeric_limits<Scalar>::infinity();
      for (int piece = 0; piece < scene.piece_count(); ++piece) {
        if (!is_near_[std::size_t(piece)]) continue;
        const MovingTool<Piece> moving = scene.moving(piece, from, motion);
        const auto passed = certify_piece(piece, scene, moving, work, limit, pairs, reach, until, first_blocked);
        for (Blocker<Scalar> blocker : passed.blockers) {
          blocker.piece = piece;
          first_blocked = (std::min)(first_blocked, blocker.time);
          result.add(blocker);
        }
        if (passed.is_exhausted) {
          result.is_exhausted = true;
          result.time = Scalar(0);
          break;
        }
        result.time = (std::min)(result.time, passed.time);
        if (passed.blockers.empty()) {
          until = passed.time;
          continue;
        }
        until = (std::min)(until, worth_certifying(result.time, scene.clearance(), moving));
      }
      return result;
    }
  }

  /// Triangles that are no pairs and that are nearer than the margin where the last motion certified ended; what rests at the margin is not.
  /// Without clearance all walls touch, the certificate tells which of them hold, and nothing is noticed.
  /// @param pairs  with the planes that parted them there
  template <int pair_capacity>
  NoticedTriangles notice(const Scene& scene, const Pose<Scalar>& at, int& work, int limit, const WorkingSet<Scalar, pair_capacity>& pairs,
                          Scalar reach) noexcept {
    NoticedTriangles result;
    if (pairs.has_no_clearance(scene.clearance().none())) return result;
    for (int piece = 0; piece < scene.piece_count(); ++piece) {
      if constexpr (CompoundShape<ToolType>) {
        if (!is_near_[std::size_t(piece)]) continue;
      }
      const MovingTool<Piece> standing = scene.moving(piece, at, {});
      Clearance<Scalar> clearance = scene.clearance_for(standing);
      clearance.kept = (std::max)(clearance.kept, scene.noticed());
      FixedVector<KnownTriangle<Scalar>, pair_capacity> known;
      for (int i = 0; i < pairs.size(); ++i) {
        const auto& pair = pairs[i];
        if (pair.piece != piece || pair.is_beyond(reach)) continue;
        const Vector3<Scalar>& normal = pair.last_normal.isZero(Scalar(0)) ? pair.normal : pair.last_normal;
        known.push_back({pair.triangle, {.corners = pair.corners_world.colwise() - standing.origin(), .normal = normal, .features = pair.features}});
      }
      const NoticedTriangles noticed = Sweep<Piece, Order>(planes_[std::size_t(piece)], clearance, &walls_, piece)
                                           .notice(scene.object(), standing, {known.begin(), std::size_t(known.size())}, work, limit);
      result.is_all = result.is_all && noticed.is_all;
      for (const Noticed& triangle : noticed) result.push_back({triangle.triangle, piece, triangle.features});
    }
    return result;
  }

 private:
  /// Pieces of a compound tool are few and fit tightly: there it matters more which triangle is met first.
  using Order = std::conditional_t<CompoundShape<ToolType>, NearestFirst, InBatches>;

  /// What is known of a group of pieces.
  struct Group {
    PlaneCache<Scalar> planes;
    int rest = 0;  // motions for which it is not tried

    void clear() noexcept {
      planes.clear();
      rest = 0;
    }
  };
  static constexpr int rest_after_failure = 64;
  /// Of half a turn the poses at its ends do not tell which way round it went [rad].
  static constexpr Scalar longest_turn = Scalar(3);

  /// The pieces that no group shows to pass everything.
  std::bitset<std::size_t(maximum_pieces<ToolType>)> find_near_pieces(const Scene& scene, const Pose<Scalar>& from, const Twist<Scalar>& motion,
                                                                      int& work, int limit) noexcept
    requires CompoundShape<ToolType>
  {
    std::bitset<std::size_t(maximum_pieces<ToolType>)> is_near;
    const auto nodes = scene.piece_groups();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto& node = nodes[i];
      if (node.is_single()) {
        is_near.set(std::size_t(node.index));
      } else if (passes(groups_[std::size_t(node.index)], scene, scene.moving(node, from, motion), work, limit)) {
        i += std::size_t(node.subtree_size() - 1);
      }
    }
    return is_near;
  }

  static bool passes(Group& group, const Scene& scene, const MovingTool<Box<Scalar>>& moving, int& work, int limit) noexcept {
    if (group.rest > 0) {
      --group.rest;
      return false;
    }
    Clearance<Scalar> clearance = scene.clearance_for(moving);
    clearance.kept = (std::max)(clearance.kept, scene.noticed());
    const bool is_clear = Sweep<Box<Scalar>>(group.planes, clearance).parts(scene.object(), moving, work, limit);
    if (!is_clear) group.rest = rest_after_failure;
    return is_clear;
  }

  /// As `certify`, for one piece and the times up to `until`; of those before it one is blocked at `first_blocked`.
  template <int pair_capacity>
  SweepResult<Scalar> certify_piece(int piece, const Scene& scene, const MovingTool<Piece>& moving, int& work, int limit,
                                    const WorkingSet<Scalar, pair_capacity>& pairs, Scalar reach, Scalar until,
                                    Scalar first_blocked) noexcept {
    Clearance<Scalar> clearance = scene.clearance_for(moving);
    // A ball that slides in a fit comes as near to the next triangle of a wall as it is to this one. What to keep is safe to judge by the
    // nearest, because the core stays a radius away.
    if constexpr (SweptTool<Piece>) {
      for (int i = 0; i < pairs.size(); ++i) {
        if (pairs[i].piece == piece) clearance.kept = (std::min)(clearance.kept, clearance.required(pairs[i].slack));
      }
    }
    FixedVector<KnownTriangle<Scalar>, pair_capacity> known;
    for (int i = 0; i < pairs.size(); ++i) {
      const auto& pair = pairs[i];
      if (pair.piece != piece || pair.is_beyond(reach)) continue;
      known.push_back({pair.triangle, {pair.corners_world.colwise() - moving.origin(), pair.normal, pair.features, true, pair.last_normal}});
    }
    return Sweep<Piece, Order>(planes_[std::size_t(piece)], clearance, &walls_, piece)
        .certify(scene.object(), moving, {known.begin(), std::size_t(known.size())}, work, limit, until, first_blocked);
  }

  std::vector<PlaneCache<Scalar>> planes_;  // of the pieces
  std::bitset<std::size_t(maximum_pieces<ToolType>)> is_near_;  // pieces, on the last motion
  WallPlanes<Scalar> walls_;
  std::vector<Group> groups_;
};

}  // namespace feeler
