// The renderer: one call a tick from the haptic pose to the graphic pose and the wrench.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>

#include "feeler/contact/contact_patch.hpp"
#include "feeler/contact/working_set.hpp"
#include "feeler/core/status.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/sweep.hpp"
#include "feeler/qp/dual_active_set.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/render/step_problem.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/tool/convex_tool.hpp"

namespace feeler {

namespace detail {
/// The tool in the scalar that decides collisions.
template <class Working, ConvexTool Tool>
auto working_tool(const Tool& tool) {
  if constexpr (std::is_same_v<typename Tool::Scalar, Working>) {
    return tool;
  } else {
    return tool.template cast<Working>();
  }
}
}  // namespace detail

/// Renders rigid contact of a convex tool with a triangle mesh to the hand.
///
/// Each tick minimises the distance of the graphic pose to the haptic pose (paper, eq. 1 and 3) among the poses that do not penetrate the
/// object and that a collision-free path joins to the last pose. The path is certified triangle by triangle (`Sweep`), so whatever the
/// device does, a pose that is returned is free of collision and nothing thin is crossed.
///
/// The object must outlive the renderer. One renderer belongs to one thread at a time.
/// @tparam Tool    a `ConvexTool`; its scalar is the renderer's
/// @tparam Solver  a `QpSolver` on the working scalar
template <ConvexTool ToolType,
          QpSolver Solver = DualActiveSet<WorkingScalar<typename ToolType::Scalar>>>
class HapticRenderer {
 public:
  using Tool = ToolType;
  using Scalar = typename Tool::Scalar;
  using Working = WorkingScalar<Scalar>;

  HapticRenderer(const TriangleMesh<Scalar>& object, const Tool& tool, const Settings<Scalar>& settings = {})
      : object_(object),
        tool_(detail::working_tool<Working>(tool)),
        settings_(settings),
        reference_(settings.reference_point.template cast<Working>()),
        radius_(radius_about(tool_, reference_)),
        metric_((settings.metric ? *settings.metric : Metric<Scalar>::proportional_to(settings.stiffness))
                    .template cast<Working>()),
        margin_(Working(settings.margin)) {
    const Working size = std::max(radius_, Working(object.bounds().diagonal().norm()));
    const Working rounding = 256 * std::numeric_limits<Working>::epsilon() * size;
    clearance_.kept = margin_ / 10;
    clearance_.allowance = std::max(clearance_.allowance, rounding);
    clearance_.touching = touching_distance(radius_);
    clearance_.probe = Working(settings.trust_radius) / 4;
  }
  HapticRenderer(TriangleMesh<Scalar>&&, const Tool&, const Settings<Scalar>& = {}) = delete;

  const Settings<Scalar>& settings() const noexcept { return settings_; }

  /// Puts the graphic tool at a pose; `Status::penetrating` if it would overlap the object there, and then the renderer holds no pose.
  /// @cost  not bounded by the work budget: for use outside the loop
  Status reset(const Pose<Scalar>& pose) noexcept {
    is_reset_ = false;
    working_set_.clear();
    planes_.clear();
    tick_ = {};
    if (!pose.is_finite()) return tick_.status = Status::not_finite;
    pose_ = reference_pose(pose);
    reset_limits();
    int work = 0;
    const MovingTool moving(tool_, reference_, radius_, pose_, Twist<Working>{});
    const auto result = Sweep<WorkingTool>(planes_, clearance_).certify(object_, moving, {}, work, std::numeric_limits<int>::max());
    const bool is_free = result.blockers.empty();
    tick_.graphic_pose = pose.normalized();
    if (!is_free) return tick_.status = Status::penetrating;
    is_reset_ = true;
    return tick_.status = Status::converged;
  }

  /// One tick. The result stays valid until the next call.
  /// @param haptic_pose  pose of the tool frame that the device commands; its quaternion need not be unit
  /// @cost  noexcept; no allocation, lock, clock or I/O; bounded by `Settings::maximum_iterations` and `work_budget`
  const Tick<Scalar>& update(const Pose<Scalar>& haptic_pose) noexcept {
    if (!haptic_pose.is_finite()) {
      tick_.path.clear();
      tick_.status = Status::not_finite;
      return tick_;
    }
    if (!is_reset_) {
      tick_ = {};
      tick_.graphic_pose = haptic_pose.normalized();
      return tick_;
    }
    target_ = reference_pose(haptic_pose);
    const bool goes_on = tick_.status == Status::unconverged;
    working_set_.age(longest_idle, 4 * margin_, 4 * Working(settings_.trust_radius), goes_on);
    if (!goes_on) reset_limits();
    tick_.work = 0;
    tick_.path.clear();
    tick_.status = follow() ? Status::converged : Status::unconverged;
    report();
    return tick_;
  }

  /// The result of the last tick.
  const Tick<Scalar>& tick() const noexcept { return tick_; }

 private:
  using WorkingTool = std::remove_cvref_t<decltype(detail::working_tool<Working>(std::declval<const Tool&>()))>;
  using MovingTool = feeler::MovingTool<WorkingTool>;
  using Pair = WorkingPair<Working>;

  static constexpr int longest_idle = 8;

  /// A step proposed to the certificate.
  struct Proposal {
    Twist<Working> motion;     // from the certified pose
    bool is_settled = false;   // another linearisation would not change it
    bool is_capped = false;    // the trust region cut it
    bool is_free = false;      // no contact holds the tool
    Working restoration = 0;   // energy that it may cost to win the margin back [m²]
  };

  Pose<Working> reference_pose(const Pose<Scalar>& tool_pose) const noexcept {
    const Pose<Working> pose = tool_pose.template cast<Working>().normalized();
    return {pose * reference_, pose.rotation};
  }

  Pose<Scalar> tool_pose(const Pose<Working>& pose) const noexcept {
    const Pose<Working> tool{pose.translation - pose.rotation * reference_, pose.rotation};
    return tool.template cast<Scalar>();
  }

  void reset_limits() noexcept {
    trust_ = Working(settings_.trust_radius);
    flight_ = std::numeric_limits<Working>::infinity();
  }

  Working length_of(const Twist<Working>& motion) const noexcept {
    return motion.linear.norm() + radius_ * motion.angular.norm();
  }

  /// Moves the graphic pose towards the target; true when it arrived at a local minimum.
  bool follow() noexcept {
    constexpr Working resting = Working(1e-11);
    const int maximum_iterations = std::min(settings_.maximum_iterations, Tick<Scalar>::path_capacity);
    for (tick_.iterations = 0; tick_.iterations < maximum_iterations;) {
      ++tick_.iterations;
      const Proposal proposal = propose();
      const Working length = length_of(proposal.motion);
      if (length <= resting) return proposal.is_settled && !proposal.is_capped;
      const MovingTool moving(tool_, reference_, radius_, pose_, proposal.motion);
      if (!descends(moving.pose_at(Working(1)), proposal.restoration)) {
        trust_ = std::min(trust_, length) / 4;
        if (trust_ < resting) break;
        continue;
      }
      const auto result = certify(moving);
      if (result.is_exhausted) {
        (problem_.row_count() > 0 ? trust_ : flight_) = length / 8;
      } else {
        const bool is_done = result.blockers.empty() && proposal.is_settled && !proposal.is_capped;
        pose_ = is_done && proposal.is_free ? target_ : moving.pose_at(result.time);
        if (result.time > Working(0)) tick_.path.push_back(tool_pose(pose_));
        if (is_done) return true;
        if (result.blockers.empty()) {
          trust_ = std::min(Working(settings_.trust_radius), 2 * trust_);
          flight_ *= 2;
        } else if (!admit(result)) {
          trust_ = length * std::max(result.time, Working(1) / 4);
        }
      }
      if (tick_.work >= settings_.work_budget || trust_ < resting) break;
    }
    trust_ = std::max(trust_, Working(1e-7));
    return false;
  }

  /// Whether a pose is nearer to the target than the certified one, but for what it costs to win the margin back.
  bool descends(const Pose<Working>& pose, Working restoration) const noexcept {
    using std::sqrt;
    const Working before = metric_.energy(motion_between(target_, pose_));
    const Working after = metric_.energy(motion_between(target_, pose));
    return after <= before + 2 * restoration + margin_ * (sqrt(2 * before) + margin_);
  }

  /// Solves for the motion from the certified pose, linearising again where the first step ends.
  Proposal propose() noexcept {
    constexpr int maximum_rounds = 4;
    Proposal proposal;
    Pose<Working> pose = pose_;
    bool rests_on_assumption = false;
    Working previous(0);
    for (int round = 0; round < maximum_rounds; ++round) {
      linearise(pose, round == 0, !rests_on_assumption);
      const Twist<Working> e = motion_between(target_, pose);
      const Vector6<Working> step = proposal.is_capped ? problem_.restore(metric_, margin_) : problem_.solve(metric_, e, margin_);
      if (round == 0) proposal.restoration = problem_.cost_of_restoration();
      note_tight_pairs();
      pose = moved(pose, Twist<Working>::from_vector(step));
      proposal.motion = motion_between(pose_, pose);
      const Working last = length_of(Twist<Working>::from_vector(step));
      if (!proposal.is_capped) proposal.is_free = problem_.is_free();
      const Working length = length_of(proposal.motion);
      const Working limit = problem_.row_count() > 0 ? trust_ : flight_;
      if (length > limit && !proposal.is_capped) {
        proposal.is_capped = true;
        proposal.motion = proposal.motion * (limit / length);
        pose = moved(pose_, proposal.motion);
        if (proposal.is_free) return proposal;
        continue;
      }
      rests_on_assumption = problem_.rests_on_assumption();
      // A short step is the last one where steps shrink fast, or where it is very short.
      const Working tolerance = Working(settings_.step_tolerance);
      const bool is_short = last < tolerance && (last < previous / 10 || last < tolerance / 50);
      previous = last;
      proposal.is_settled = (is_short && !rests_on_assumption && problem_.keeps_features()) || proposal.is_free;
      if (proposal.is_settled || proposal.is_capped) return proposal;
    }
    return proposal;
  }

  /// Rows of the working set at a pose; at the certified pose also the planes that the certificate starts from.
  void linearise(const Pose<Working>& pose, bool is_certified, bool assumes_valleys) noexcept {
    problem_.clear();
    const Matrix3<Working> axes = pose.rotation.toRotationMatrix();
    const Working band = Working(settings_.trust_radius) / 4;
    ContactPatch<WorkingTool, Scalar> patch(tool_, object_, axes, reference_, band, assumes_valleys);
    PatchRows<Working> rows;
    for (int i = 0; i < working_set_.size(); ++i) {
      Pair& pair = working_set_[i];
      const Matrix3<Working> corners =
          (axes.transpose() * (pair.corners_world.colwise() - pose.translation)).colwise() + reference_;
      const auto closest = closest_points(corners, axes, pair, is_certified);
      pair.features = closest.features;
      if (is_certified) {
        pair.normal = axes * closest.normal;
        pair.slack = closest.distance;
      }
      pair.has_rows = patch.find(pair.triangle, corners, closest, pair.keeps_ghost, rows);
      for (ContactRow<Working>& row : rows) {
        row.triangle = pair.triangle;
        problem_.add(row, pair.slack, pair.is_tight);
      }
    }
    tick_.rows = problem_.row_count();
  }

  /// Remembers which pairs had no room for the margin.
  void note_tight_pairs() noexcept {
    for (int i = 0; i < working_set_.size(); ++i) working_set_[i].is_tight = false;
    for (int k = 0; k < problem_.row_count(); ++k) {
      if (problem_.is_relaxed(k)) working_set_[working_set_.find(problem_.row(k).triangle)].is_tight = true;
    }
  }

  /// Closest points of a pair. On the way the tool may overlap it; then the plane it had at the certified pose says which features meet.
  ClosestPoints<Working> closest_points(const Matrix3<Working>& corners, const Matrix3<Working>& axes, const Pair& pair,
                                        bool is_certified) noexcept {
    ++tick_.work;
    ClosestPoints<Working> closest = gjk(tool_, corners, pair.features, clearance_.touching);
    if (!closest.is_touching) return closest;
    if (is_certified || pair.slack < 2 * clearance_.touching) return separation_of_touching(tool_, corners, closest);
    closest.normal = axes.transpose() * pair.normal;
    closest.distance = separation_along(tool_, corners, closest.normal);
    closest.features = {};
    closest.tool_point = tool_.vertex(tool_.support(Vector3<Working>(-closest.normal)));
    return closest;
  }

  SweepResult<Working> certify(const MovingTool& moving) noexcept {
    std::array<KnownTriangle<Working>, std::size_t(WorkingSet<Working>::capacity)> known;
    for (int i = 0; i < working_set_.size(); ++i) {
      const Pair& pair = working_set_[i];
      known[std::size_t(i)] = {pair.triangle,
                               {pair.corners_world.colwise() - moving.origin(), pair.normal, pair.features, true}};
    }
    const int limit = tick_.work + std::max(settings_.work_budget / 2, settings_.work_budget - tick_.work);
    return Sweep<WorkingTool>(planes_, clearance_)
        .certify(object_, moving, std::span(known).first(std::size_t(working_set_.size())), tick_.work, limit);
  }

  /// Takes what blocked into the working set; false when all of it was there already with rows of its own.
  bool admit(const SweepResult<Working>& result) noexcept {
    bool is_new = false;
    for (const auto& blocker : result.blockers) {
      int i = working_set_.find(blocker.triangle);
      if (i < 0) {
        working_set_.add(blocker.triangle, object_.corners(blocker.triangle).template cast<Working>());
        is_new = true;
        continue;
      }
      Pair& pair = working_set_[i];
      pair.idle_ticks = 0;
      if (!pair.has_rows) {
        pair.keeps_ghost = true;
        is_new = true;
      }
    }
    return is_new;
  }

  /// Fills the tick from the certified pose and the last optimisation.
  void report() noexcept {
    tick_.graphic_pose = tool_pose(pose_);
    const Stiffness<Working> stiffness{settings_.stiffness.translational.template cast<Working>(),
                                       settings_.stiffness.rotational.template cast<Working>()};
    tick_.wrench = stiffness.wrench(motion_between(target_, pose_)).template cast<Scalar>();
    tick_.contacts.clear();
    const Working unit = stiffness.translational.maxCoeff();
    for (const auto& active : problem_.solution().active) {
      if (active.row >= problem_.row_count()) continue;
      const auto& row = problem_.row(active.row);
      const int pair = working_set_.find(row.triangle);
      if (pair >= 0) working_set_[pair].idle_ticks = 0;
      ActiveContact<Scalar> contact;
      contact.triangle = row.triangle;
      contact.point_world = (pose_.translation + row.arm).template cast<Scalar>();
      contact.normal_world = row.normal.template cast<Scalar>();
      contact.gap = Scalar(problem_.gap_after(active.row));
      contact.force = Scalar(active.multiplier * unit);
      tick_.contacts.push_back(contact);
    }
  }

  const TriangleMesh<Scalar>& object_;
  WorkingTool tool_;
  Settings<Scalar> settings_;
  Vector3<Working> reference_;
  Working radius_;
  Metric<Working> metric_;
  Working margin_;
  Clearance<Working> clearance_;

  bool is_reset_ = false;
  Pose<Working> pose_;    // the certified pose of the reference point
  Pose<Working> target_;  // the haptic pose of the reference point
  Working trust_;         // longest motion proposed near the object
  Working flight_;        // the same away from it, where only the work of the certificate limits it
  WorkingSet<Working> working_set_;
  PlaneCache<Working> planes_;
  StepProblem<Solver> problem_;
  Tick<Scalar> tick_;
};

template <ConvexTool Tool>
HapticRenderer(const TriangleMesh<typename Tool::Scalar>&, const Tool&) -> HapticRenderer<Tool>;
template <ConvexTool Tool>
HapticRenderer(const TriangleMesh<typename Tool::Scalar>&, const Tool&, const Settings<typename Tool::Scalar>&)
    -> HapticRenderer<Tool>;

}  // namespace feeler
