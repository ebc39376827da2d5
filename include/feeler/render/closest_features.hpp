// The default way of modelling contact: planes between closest features, linearised again until they hold.
#pragma once

#include <algorithm>
#include <utility>

#include "feeler/core/status.hpp"
#include "feeler/render/constraints/working_set_growth.hpp"
#include "feeler/render/contact_method.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/sqp/merit.hpp"
#include "feeler/render/sqp/step_limits.hpp"
#include "feeler/render/sqp/trial_motion.hpp"
#include "feeler/render/sqp/work_budget.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/half_way.hpp"

namespace feeler {

/// Follows the haptic pose with a working set of triangles and a certificate.
///
/// Each iteration linearises the rows of the working set, solves for a step, linearises again where it ends, and certifies the whole motion. What
/// blocks it joins the working set, and the pose advances as far as is certified. Where the work of a tick runs out, the next one goes on there.
template <RigidTool ToolType, QpSolver Solver>
class ClosestFeaturesFollower {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Piece = typename Scene::Piece;
  using Search = TrialMotionSearch<ToolType, Solver>;

  explicit ClosestFeaturesFollower(const Scene& scene) : search_(scene), certificate_(scene) {}

  const Pose<Scalar>& pose() const noexcept { return pose_; }
  /// Of the last tick: where the hand was, and the last step that was solved for.
  const Pose<Scalar>& target() const noexcept { return target_; }
  const auto& problem() const noexcept { return search_.linearisation().problem(); }

  void reset(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    pose_ = pose;
    linearisation().clear();
    certificate_.clear();
    is_motion_left_ = takes_first_alone_ = has_metric_turned_ = is_at_rest_ = false;
    stage_ = Stage::starting;
    limits_.reset(scene.trust_radius());
  }

  /// The metric has turned since the last tick: what was settled in the old one is not in the new one.
  void metric_turned() noexcept { has_metric_turned_ = true; }

  TickStatus follow(const Scene& scene, const Pose<Scalar>& target, Tick<MeshScalar>& tick) noexcept {
    tick.iterations = 0;
    if (is_at_rest_ && !has_metric_turned_ && target == target_) return TickStatus::converged;
    target_ = target;
    if (stage_ == Stage::starting) turn_idly(scene, tick);
    off_ = off_target(scene, pose_);
    if (!is_motion_left_) limits_.reset(scene.trust_radius());
    const bool is_new_task = std::exchange(has_metric_turned_, false) || !aims_at_target();
    if (is_new_task) judge_again(scene);
    if (stage_ == Stage::starting) {
      if (is_new_task || !is_motion_left_) iteration_ = {};  // else what the last iteration told counts in the next tick too
      auto& pairs = linearisation().pairs();
      pairs.age(scene.contact_distance(), pairs.has_no_clearance(scene.clearance().none()) ? Scalar(0) : scene.noticed(), is_motion_left_);
    }
    budget_.begin_tick(scene.settings().work_budget);
    is_motion_left_ = !advance(scene, tick);
    if (stage_ == Stage::starting) turn_idly(scene, tick);
    is_at_rest_ = !is_motion_left_ && tick.path.empty();
    return is_motion_left_ ? TickStatus::unconverged : TickStatus::converged;
  }

  /// The active rows of the last optimisation.
  void report(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Scalar unit = Scalar(scene.settings().stiffness.translational.maxCoeff());
    auto& pairs = linearisation().pairs();
    for (const auto& stop : linearisation().stops()) {
      const auto& row = stop.row;
      const int pair = pairs.find(row.piece, row.triangle);
      if (pair >= 0) pairs[pair].note_use();
      ActiveContact<MeshScalar> contact;
      contact.piece = row.piece;
      contact.triangle = row.triangle;
      Vector3<Scalar> point = pose_.translation + row.arm;
      // Of a swept tool the arm ends on the core, but for a corner of the object on a face.
      if constexpr (SweptTool<Piece>) {
        if (row.kind != FeaturePair::face_vertex) point -= swept_radius(scene.piece(row.piece)) * row.normal;
      }
      contact.point_world = point.template cast<MeshScalar>();
      contact.normal_world = row.normal.normalized().template cast<MeshScalar>();  // one that was carried far has lost a bit
      contact.gap = MeshScalar(stop.gap);
      contact.force = MeshScalar(stop.multiplier * unit);
      tick.contacts.push_back(contact);
    }
  }

 private:
  /// What an iteration is at. The next tick goes on there.
  enum class Stage : unsigned char {
    starting,
    measuring,   ///< pairs where the motion starts, or where its last step ended
    certifying,  ///< the motion
    noticing,    ///< what is near where it ended
  };

  /// What came of an iteration, or of a part of it.
  enum class Outcome : unsigned char {
    proposed,   ///< a motion, to be certified
    another,    ///< another iteration may do more
    suspended,  ///< the work ran out in it
    arrived,    ///< the pose is a local minimum, or what two linearisations that contradict each other hold it at
    stalled,    ///< nothing more comes of it in this tick
  };

  /// What iterations tell each other, and the next tick where one is suspended.
  struct Iteration {
    bool came_to_nothing = false;  // the last one
    bool is_taken_back = false;    // its second step took back the first
    int known_pairs = 0;           // then
    Pose<Scalar> end;       // of its motion
    Scalar length = 0;      // of that [m]
    int work = 0;           // to certify it
    int ticks = 0;          // in which it was suspended
  };

  auto& linearisation() noexcept { return search_.linearisation(); }

  /// Turns that do not matter follow the device at once.
  void turn_idly(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    if constexpr (IdleTurns<typename Scene::Tool>::legs > 0) {
      const Pose<Scalar> turned = scene.idle_turns().following(pose_, target_);
      if (turned.rotation.coeffs() == pose_.rotation.coeffs()) return;
      if (const auto middle = half_way_of_long_turn(pose_, turned)) tick.path.push_back(scene.tool_pose(*middle));
      pose_ = turned;
      tick.path.push_back(scene.tool_pose(pose_));
    }
  }

  bool aims_at_target() const noexcept { return search_.aim() == target_; }

  /// The hand has moved since the iteration at hand began: its motion is gone on with as long as it leads nearer, and is not the last.
  void judge_again(const Scene& scene) noexcept {
    search_.motion().is_settled = search_.motion().is_home = false;
    if (stage_ == Stage::noticing || (stage_ == Stage::certifying && !is_descent(scene))) stage_ = Stage::starting;
  }

  /// Whether it arrived.
  bool advance(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const int maximum_iterations =
        (std::min)(scene.settings().maximum_iterations, Tick<MeshScalar>::path_capacity - IdleTurns<typename Scene::Tool>::legs);
    Outcome outcome = Outcome::another;
    do {
      ++tick.iterations;
      budget_.begin_iteration(tick.work);
      outcome = iterate(scene, tick);
      if (outcome == Outcome::arrived && !aims_at_target()) outcome = Outcome::another;
      if (outcome == Outcome::arrived && !problem().is_optimal()) outcome = Outcome::stalled;
    } while (outcome == Outcome::another && tick.iterations < maximum_iterations && budget_.allows_another(tick.work) &&
             !(limits_.trust() < scene.no_motion()));
    if (outcome == Outcome::suspended) ++iteration_.ticks;
    else stage_ = Stage::starting;
    if (outcome == Outcome::stalled) iteration_ = {};
    if (outcome == Outcome::another || outcome == Outcome::suspended) limits_.carry_over();
    return outcome == Outcome::arrived;
  }

  /// Goes on with an iteration, or begins one.
  Outcome iterate(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    switch (stage_) {
      case Stage::starting:
        search_.begin(pose_, target_);
        iteration_.work = iteration_.ticks = 0;
        [[fallthrough]];
      case Stage::measuring:
        if (const Outcome outcome = choose(scene, tick); outcome != Outcome::proposed) return outcome;
        if (!aims_at_target()) judge_again(scene);
        return certify(scene, false, tick);
      case Stage::certifying: return certify(scene, true, tick);
      case Stage::noticing: break;
    }
    return look_around(scene, true, tick);
  }

  /// Chooses a motion.
  Outcome choose(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    Iteration& it = iteration_;
    const bool is_first_alone = it.came_to_nothing || takes_first_alone_;
    const bool is_found = search_.find(scene, is_first_alone ? 1 : Search::most_rounds, limits_, budget_, tick);
    stage_ = search_.is_measuring() ? Stage::measuring : Stage::starting;
    if (!is_found) return Outcome::suspended;
    const TrialMotion<Scalar>& trial = search_.motion();
    takes_first_alone_ = trial.goes_back;
    it.length = scene.length_of(trial.motion, pose_);
    if (!trial.is_settled && !it.came_to_nothing && it.length < scene.very_short()) {
      // One linearisation takes back what another asks for, as a triangle is missing from both: the first alone will meet it.
      it.came_to_nothing = true;
      it.is_taken_back = trial.is_taken_back;
      it.known_pairs = linearisation().pairs().size();
      return Outcome::another;
    }
    const bool is_held = it.is_taken_back && linearisation().pairs().size() == it.known_pairs;  // one linearisation alone knows no more than the two
    const Pose<Scalar> end = scene.idle_turns().moved(pose_, trial.motion);
    if (it.came_to_nothing && (is_held || trial.is_at_rest) && !descends_clearly(scene.metric(), off_, off_target(scene, end), scene.margin()))
      return Outcome::arrived;
    if (it.length <= search_.no_motion(scene)) return trial.is_settled && !trial.is_capped ? Outcome::arrived : Outcome::stalled;
    it.came_to_nothing = false;
    it.end = end;
    if (is_descent(scene)) return Outcome::proposed;
    limits_.narrow((std::min)(limits_.trust(), it.length) / 4);
    return Outcome::another;
  }

  /// Certifies the motion chosen, or goes on with it, and moves as far as that is.
  Outcome certify(const Scene& scene, bool is_resumed, Tick<MeshScalar>& tick) noexcept {
    Iteration& it = iteration_;
    stage_ = Stage::certifying;
    const int begun = tick.work;
    const auto result = is_resumed ? certificate_.go_on(scene, tick.work, budget_.limit(), linearisation().pairs())
                                   : certificate_.certify(scene, pose_, search_.motion().motion, tick.work, budget_.limit(), linearisation().pairs(),
                                                          Search::reach_of_step(scene, limits_));
    it.work += tick.work - begun;
    if (result.is_exhausted) return Outcome::suspended;
    stage_ = Stage::starting;
    if (result.is_whole() && search_.motion().is_settled && !search_.motion().is_capped) return look_around(scene, false, tick);
    if (result.time > Scalar(0))
      move_to(scene, result.time < Scalar(1) ? scene.idle_turns().moved(pose_, search_.motion().motion * result.time) : it.end,
              it.length * result.time, tick);
    if (result.is_whole()) {
      widen(scene);
    } else if (result.blockers.empty()) {
      limits_.shorten(linearisation().is_empty(), it.length * result.time);
    } else if (take_in_blockers(linearisation().pairs(), scene, result)) {
      limits_.narrow_to_radius();
    } else {
      limits_.narrow((std::min)(limits_.trust(), it.length) * std::clamp(result.time, Scalar(1) / 4, Scalar(1) / 2));
    }
    return Outcome::another;
  }

  /// Ends a motion that was certified whole and is the last one, if nothing near where it ends is unknown; else what was not known is from now on.
  Outcome look_around(const Scene& scene, bool is_resumed, Tick<MeshScalar>& tick) noexcept {
    Iteration& it = iteration_;
    const auto& pairs = linearisation().pairs();
    const int begun = tick.work;
    const NoticedTriangles noticed = is_resumed ? certificate_.go_on_noticing(scene, tick.work, budget_.limit(), pairs)
                                                : certificate_.notice(scene, it.end, search_.holding_distance(scene), tick.work, budget_.limit(),
                                                                      pairs, Search::reach_of_step(scene, limits_));
    it.work += tick.work - begun;
    const bool is_done = !noticed.is_exhausted && !take_in_noticed(linearisation().pairs(), scene, noticed);
    const bool is_home = is_done && search_.motion().is_home;
    if (!is_resumed || is_home) move_to(scene, is_home ? target_ : it.end, it.length, tick);
    if (!is_resumed && !is_done) widen(scene);
    stage_ = noticed.is_exhausted ? Stage::noticing : Stage::starting;
    return noticed.is_exhausted ? Outcome::suspended : is_done ? Outcome::arrived : Outcome::another;
  }

  void move_to(const Scene& scene, const Pose<Scalar>& pose, Scalar length, Tick<MeshScalar>& tick) noexcept {
    pose_ = pose;
    off_ = off_target(scene, pose_);
    tick.path.push_back(scene.tool_pose(pose_));
    linearisation().pairs().approach(length);
  }

  /// After a motion that nothing stopped. One in flight that took some ticks had better been shorter.
  void widen(const Scene& scene) noexcept {
    const Iteration& it = iteration_;
    if (it.ticks > 0 && linearisation().is_empty()) limits_.shorten(true, (std::max)(it.length / Scalar(it.ticks + 1), scene.trust_radius()));
    else limits_.widen(it.work);
  }

  Twist<Scalar> off_target(const Scene& scene, const Pose<Scalar>& pose) const noexcept { return scene.idle_turns().motion_between(target_, pose); }

  /// Whether the motion at hand is to be made, by what it leads to.
  bool is_descent(const Scene& scene) noexcept {
    return descends(scene.metric(), off_, off_target(scene, iteration_.end), scene.margin(), search_.motion().restoration);
  }

  Pose<Scalar> pose_;  // the certified pose
  Pose<Scalar> target_;  // the haptic pose
  Twist<Scalar> off_;  // of the certified pose from it
  bool is_motion_left_ = false;  // the last tick left motion for this one
  bool has_metric_turned_ = false;  // since the last tick
  bool is_at_rest_ = false;  // the last tick moved nothing, as the pose is the minimum: nor does the next, until the hand moves
  bool takes_first_alone_ = false;  // the next motion, maybe in the next tick, is the first step: the last went back, as a triangle is missing
  Stage stage_ = Stage::starting;
  Iteration iteration_;
  WorkBudget budget_;
  StepLimits<Scalar> limits_;
  Search search_;
  MotionCertificate<ToolType> certificate_;
};

/// The default contact method: constraint planes between the closest features of the tool and the triangles in its way.
struct ClosestFeatures {
  template <RigidTool Tool, QpSolver Solver>
  using Follower = ClosestFeaturesFollower<Tool, Solver>;
};

}  // namespace feeler
