// The certificate of a motion of the whole tool: every piece of it past every triangle, or what blocks.
#pragma once

#include <algorithm>
#include <bitset>
#include <limits>
#include <optional>
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
/// and those of the groups that the pieces of a compound tool are in. What a tick has no work for the next may go on with.
template <RigidTool ToolType>
class MotionCertificate {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using Piece = typename Scene::Piece;

  explicit MotionCertificate(const Scene& scene) : walls_(scene.object().walls().count() > 0), groups_(std::size_t(scene.piece_count() - 1)) {
    planes_.reserve(std::size_t(scene.piece_count()));
    for (int i = 0; i < scene.piece_count(); ++i) planes_.emplace_back(scene.piece_count() == 1 ? leaves_of_one : leaves_of_many);
  }

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
  /// @param limit   value of `work` at which it stops: `go_on` does the rest
  /// @param pairs   what is known near the tool at `from`: looked at first, and exactly, but for those beyond `reach` [m]
  template <int pair_capacity = 1>
  SweepResult<Scalar> certify(const Scene& scene, const Pose<Scalar>& from, const Twist<Scalar>& motion, int& work, int limit,
                              const WorkingSet<Scalar, pair_capacity>& pairs = {}, Scalar reach = std::numeric_limits<Scalar>::infinity()) noexcept {
    const Scalar turn = motion.angular.norm();
    begin(from, motion, reach);
    until_ = turn > longest_turn ? longest_turn / turn : Scalar(1);
    result_.time = until_;
    if constexpr (CompoundShape<ToolType>) {
      is_near_.reset();
      next_group_ = 0;
    }
    return run(scene, work, limit, pairs, false);
  }
  /// After `certify`, or this, was exhausted: the rest of it.
  /// @param pairs  the same
  template <int pair_capacity>
  SweepResult<Scalar> go_on(const Scene& scene, int& work, int limit, const WorkingSet<Scalar, pair_capacity>& pairs) noexcept {
    return run(scene, work, limit, pairs, true);
  }

  /// Triangles that are no pairs and that are nearer than a distance where the last motion certified ended.
  /// Without clearance all walls touch, the certificate tells which of them hold, and nothing is noticed.
  /// @param distance  `RenderedScene::noticed`, or less [m]
  /// @param pairs     with the planes that parted them there
  template <int pair_capacity>
  NoticedTriangles notice(const Scene& scene, const Pose<Scalar>& at, Scalar distance, int& work, int limit,
                          const WorkingSet<Scalar, pair_capacity>& pairs, Scalar reach) noexcept {
    begin(at, {}, reach);
    noticed_distance_ = distance;
    noticed_ = {};
    return go_on_noticing(scene, work, limit, pairs);
  }
  /// After `notice`, or this, was exhausted: the rest of it, with what came before.
  /// @param pairs  the same
  template <int pair_capacity>
  NoticedTriangles go_on_noticing(const Scene& scene, int& work, int limit, const WorkingSet<Scalar, pair_capacity>& pairs) noexcept {
    noticed_.is_exhausted = false;
    if (pairs.has_no_clearance(scene.clearance().none())) return noticed_;
    for (; piece_ < scene.piece_count(); ++piece_) {
      if constexpr (CompoundShape<ToolType>) {
        if (!is_near_[std::size_t(piece_)]) continue;
      }
      const MovingTool<Piece> standing = scene.moving(piece_, from_, {});
      const auto known = known_triangles(pairs, standing.origin(), true);
      const std::span<const KnownTriangle<Scalar>> all{known.begin(), std::size_t(known.size())};
      NoticedTriangles noticed;
      if (is_in_piece_) {
        sweep_->work_with(planes_[std::size_t(piece_)], &walls_);
        noticed = sweep_->go_on_noticing(scene.object(), standing, all, work, limit);
      } else {
        sweep_.emplace(planes_[std::size_t(piece_)], noticing_clearance(scene, standing, noticed_distance_), &walls_, piece_);
        noticed = sweep_->notice(scene.object(), standing, all, work, limit);
      }
      is_in_piece_ = noticed.is_exhausted;
      if (is_in_piece_) {
        noticed_.is_exhausted = true;
        break;
      }
      for (const Noticed& triangle : noticed) noticed_.push_back({triangle.triangle, piece_, triangle.features});
    }
    return noticed_;
  }

 private:
  static constexpr int leaves_of_one = 512, leaves_of_many = 128;  // that are remembered, of a single piece and of each of many

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
  inline static const Scalar longest_turn = Scalar(3);

  void begin(const Pose<Scalar>& from, const Twist<Scalar>& motion, Scalar reach) noexcept {
    from_ = from;
    motion_ = motion;
    reach_ = reach;
    result_ = {};
    first_blocked_ = std::numeric_limits<Scalar>::infinity();
    piece_ = 0;
    is_in_piece_ = false;
  }

  /// @param is_resumed  what the work did not suffice for is begun again
  template <int pair_capacity>
  SweepResult<Scalar> run(const Scene& scene, int& work, int limit, const WorkingSet<Scalar, pair_capacity>& pairs, bool is_resumed) noexcept {
    if constexpr (CompoundShape<ToolType>) {
      if (!find_near_pieces(scene, work, limit, is_resumed)) return exhausted();
    }
    for (; piece_ < scene.piece_count(); ++piece_) {
      if constexpr (CompoundShape<ToolType>) {
        if (!is_near_[std::size_t(piece_)]) continue;
      }
      const MovingTool<Piece> moving = scene.moving(piece_, from_, motion_);
      const auto passed = certify_piece(scene, moving, work, limit, pairs);
      is_in_piece_ = passed.is_exhausted;
      if (is_in_piece_) return exhausted(passed);
      take(passed);
      if (result_.is_over()) break;
      until_ = passed.blockers.empty() ? passed.time : (std::min)(until_, worth_certifying(result_, scene.clearance(), moving));
    }
    return result_;
  }

  /// Adds the blockers of the piece at hand.
  void add_blockers(const SweepResult<Scalar>& passed, SweepResult<Scalar>& result) const noexcept {
    for (Blocker<Scalar> blocker : passed.blockers) {
      blocker.piece = piece_;
      result.add(blocker);
    }
  }

  /// Adds the result of a piece.
  void take(const SweepResult<Scalar>& passed) noexcept {
    add_blockers(passed, result_);
    for (const Blocker<Scalar>& blocker : passed.blockers) first_blocked_ = (std::min)(first_blocked_, blocker.time);
    result_.time = (std::min)(result_.time, passed.time);
  }

  /// The result so far.
  /// @param passed  of the piece at hand
  SweepResult<Scalar> exhausted(const SweepResult<Scalar>& passed = {}) const noexcept {
    SweepResult<Scalar> result = result_;
    add_blockers(passed, result);
    result.time = Scalar(0);
    result.is_exhausted = true;
    return result;
  }

  /// Finds the pieces that no group shows to pass everything; false where the work ran out.
  bool find_near_pieces(const Scene& scene, int& work, int limit, bool is_resumed) noexcept
    requires CompoundShape<ToolType>
  {
    const auto nodes = scene.piece_groups();
    for (; next_group_ < nodes.size(); ++next_group_) {
      const auto& node = nodes[next_group_];
      if (node.is_single()) {
        is_near_.set(std::size_t(node.index));
        continue;
      }
      Group& group = groups_[std::size_t(node.index)];
      if (group.rest > 0) {
        --group.rest;
        continue;
      }
      if (work >= limit) return false;
      const bool is_clear = passes(group, scene, scene.moving(node, from_, motion_), work, limit);
      if (!is_clear && work >= limit && !is_resumed) return false;
      is_resumed = false;
      if (is_clear) next_group_ += std::size_t(node.subtree_size() - 1);
      else group.rest = rest_after_failure;
    }
    return true;
  }

  /// That of what is to be noticed.
  template <class Moving>
  static Clearance<Scalar> noticing_clearance(const Scene& scene, const Moving& moving, Scalar distance) noexcept {
    Clearance<Scalar> clearance = scene.clearance_for(moving);
    clearance.kept = distance;
    return clearance;
  }

  /// What is known near the piece at hand, relative to the origin of a motion.
  /// @param is_standing  where a motion ended: a plane found there is the better one, and a ghost has none
  template <int pair_capacity>
  FixedVector<KnownTriangle<Scalar>, pair_capacity> known_triangles(const WorkingSet<Scalar, pair_capacity>& pairs, const Vector3<Scalar>& origin,
                                                                    bool is_standing) const noexcept {
    FixedVector<KnownTriangle<Scalar>, pair_capacity> known;
    for (const auto& pair : pairs) {
      if (pair.piece != piece_ || pair.is_beyond(reach_)) continue;
      Vector3<Scalar> normal = is_standing && !pair.last_normal.isZero(Scalar(0)) ? pair.last_normal : pair.normal;
      if (is_standing && pair.state == PairState::ghost) normal.setZero();  // without rows it hides nothing
      known.push_back({pair.triangle, {pair.corners_world.colwise() - origin, normal, pair.features, true, pair.last_normal}});
    }
    return known;
  }

  static bool passes(Group& group, const Scene& scene, const MovingTool<Box<Scalar>>& moving, int& work, int limit) noexcept {
    return Sweep<Box<Scalar>>(group.planes, noticing_clearance(scene, moving, scene.noticed())).parts(scene.object(), moving, work, limit);
  }

  /// Certifies the piece at hand, or goes on with it.
  template <int pair_capacity>
  SweepResult<Scalar> certify_piece(const Scene& scene, const MovingTool<Piece>& moving, int& work, int limit,
                                    const WorkingSet<Scalar, pair_capacity>& pairs) noexcept {
    const auto known = known_triangles(pairs, moving.origin(), false);
    const std::span<const KnownTriangle<Scalar>> all{known.begin(), std::size_t(known.size())};
    if (is_in_piece_) {
      sweep_->work_with(planes_[std::size_t(piece_)], &walls_);
      return sweep_->go_on(scene.object(), moving, all, work, limit);
    }
    Clearance<Scalar> clearance = scene.clearance_for(moving);
    // A ball that slides in a fit comes as near to the next triangle of a wall as it is to this one. What to keep is safe to judge by the
    // nearest, because the core stays a radius away.
    if constexpr (SweptTool<Piece>) {
      for (int i = 0; i < pairs.size(); ++i) {
        if (pairs[i].piece == piece_) clearance.kept = (std::min)(clearance.kept, clearance.required(pairs[i].slack));
      }
    }
    sweep_.emplace(planes_[std::size_t(piece_)], clearance, &walls_, piece_);
    return sweep_->certify(scene.object(), moving, all, work, limit, until_, first_blocked_);
  }

  std::vector<PlaneCache<Scalar>> planes_;  // of the pieces
  std::bitset<std::size_t(maximum_pieces<ToolType>)> is_near_;  // pieces, on the last motion
  WallPlanes<Scalar> walls_;
  std::vector<Group> groups_;

  // The motion at hand, and how far it has been looked at.
  Pose<Scalar> from_;
  Twist<Scalar> motion_;
  Scalar reach_ = Scalar(0);
  Scalar until_ = Scalar(1);          // time that is still of interest
  Scalar first_blocked_ = Scalar(0);  // time
  SweepResult<Scalar> result_;        // of the pieces before
  NoticedTriangles noticed_;          // likewise
  Scalar noticed_distance_ = Scalar(0);  // what is nearer is noticed
  std::size_t next_group_ = 0;
  int piece_ = 0;
  bool is_in_piece_ = false;  // it is begun
  std::optional<Sweep<Piece, Order>> sweep_;
};

}  // namespace feeler
