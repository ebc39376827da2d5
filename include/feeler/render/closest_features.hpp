// The default way of modelling contact: planes between closest features, linearised again until they hold.
#pragma once

#include <algorithm>

#include "feeler/core/status.hpp"
#include "feeler/render/contact_method.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/sqp/linearisation.hpp"
#include "feeler/render/sqp/step_limits.hpp"
#include "feeler/render/sqp/work_budget.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/half_way.hpp"

namespace feeler {

/// Follows the haptic pose with a working set of triangles and a certificate.
///
/// Each iteration linearises the rows of the working set, solves for a step, linearises again where it ends, and then certifies the whole
/// motion triangle by triangle. What blocks it joins the working set, and the pose advances as far as the motion is certified.
template <RigidTool ToolType, QpSolver Solver>
class ClosestFeaturesFollower {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Piece = typename Scene::Piece;

  explicit ClosestFeaturesFollower(const Scene& scene) : linearisation_(scene), certificate_(scene) {}

  const Pose<Scalar>& pose() const noexcept { return pose_; }
  /// Of the last tick: where the hand was, and the last step that was solved for.
  const Pose<Scalar>& target() const noexcept { return target_; }
  const auto& problem() const noexcept { return linearisation_.problem(); }

  void reset(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    pose_ = pose;
    linearisation_.clear();
    certificate_.clear();
    goes_on_ = takes_first_alone_ = false;
    budget_.reset();
    limits_.reset(scene.trust_radius());
  }

  TickStatus follow(const Scene& scene, const Pose<Scalar>& target, Tick<MeshScalar>& tick) noexcept {
    target_ = target;
    turn_idly(scene, tick);
    off_ = off_target(scene, pose_);
    const int idle_legs = tick.path.size();
    auto& pairs = linearisation_.pairs();
    pairs.age(linearisation_.touching(scene), pairs.has_no_clearance(scene.clearance().none()) ? Scalar(0) : scene.noticed(), goes_on_);
    if (!goes_on_) limits_.reset(scene.trust_radius());
    budget_.begin_tick(scene.settings().work_budget);
    goes_on_ = !advance(scene, tick);
    budget_.end_tick(tick.work, tick.path.size() > idle_legs);
    turn_idly(scene, tick);
    return goes_on_ ? TickStatus::unconverged : TickStatus::converged;
  }

  /// The active rows of the last optimisation.
  void report(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Scalar unit = Scalar(scene.settings().stiffness.translational.maxCoeff());
    auto& pairs = linearisation_.pairs();
    for (const auto& active : problem().solution().active) {
      if (active.row >= problem().row_count()) continue;
      const auto& row = problem().row(active.row);
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
      contact.gap = MeshScalar(problem().gap_after(active.row));
      contact.force = MeshScalar(active.multiplier * unit);
      tick.contacts.push_back(contact);
    }
  }

 private:
  static constexpr int maximum_rounds = 4;  // linearisations for one motion

  /// A step proposed to the certificate.
  struct Proposal {
    Twist<Scalar> motion;        // from the certified pose
    bool is_settled = false;     // another linearisation would not change it
    bool is_capped = false;      // the trust region cut it
    bool is_free = false;        // no contact holds the tool
    bool is_home = false;        // and it ends at the haptic pose
    bool is_at_rest = false;     // measured where it starts, the tool would stay
    bool is_taken_back = false;  // its second step took back the first, and what stopped the two holds the tool
    bool goes_back = false;      // with contacts kept from where it starts, its later steps took back most of the first
    Scalar restoration = 0;      // energy that it may cost to win the margin back [m²]
  };

  /// A step from the pose of linearisation.
  struct Leg {
    Twist<Scalar> step;
    Pose<Scalar> end;
    Twist<Scalar> motion;  // to the end, from the certified pose
  };

  /// What is farther away cannot stop the next step [m].
  Scalar reach_of_step(const Scene& scene) const noexcept { return limits_.trust() + scene.margin(); }

  /// A step that is short whatever the one before it was [m].
  static Scalar very_short(const Scene& scene) noexcept { return Scalar(scene.settings().step_tolerance) / 50; }

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

  /// True when it arrived at a local minimum, or at what two linearisations that contradict each other hold it at.
  bool advance(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Scalar resting = Scalar(scene.settings().step_tolerance) / 500000;
    const int maximum_iterations =
        (std::min)(scene.settings().maximum_iterations, Tick<MeshScalar>::path_capacity - IdleTurns<typename Scene::Tool>::legs);
    const auto& turns = scene.idle_turns();
    bool came_to_nothing = false, is_taken_back = false;
    int known_pairs = 0;
    tick.iterations = 0;
    do {
      ++tick.iterations;
      budget_.begin_iteration(tick.work);
      const bool is_first_alone = came_to_nothing || takes_first_alone_;
      const Proposal proposal = propose(scene, is_first_alone ? 1 : maximum_rounds, tick);
      takes_first_alone_ = proposal.goes_back;
      const Scalar length = scene.length_of(proposal.motion, pose_);
      if (!proposal.is_settled && !came_to_nothing && length < very_short(scene)) {
        // One linearisation takes back what another asks for, as a triangle is missing from both: the first alone will meet it.
        came_to_nothing = true;
        is_taken_back = proposal.is_taken_back;
        known_pairs = linearisation_.pairs().size();
        continue;
      }
      const bool is_held = is_taken_back && linearisation_.pairs().size() == known_pairs;  // one linearisation alone knows no more than the two
      if (came_to_nothing && (is_held || proposal.is_at_rest) && !is_worth_it(scene, proposal.motion)) return true;
      if (length <= resting) return proposal.is_settled && !proposal.is_capped;
      const Pose<Scalar> end = turns.moved(pose_, proposal.motion);
      const Twist<Scalar> off_at_end = off_target(scene, end);
      const bool is_nearer = descends(scene, off_at_end, proposal.restoration);
      came_to_nothing = false;
      if (!is_nearer) {
        limits_.narrow((std::min)(limits_.trust(), length) / 4);
        continue;
      }
      const int proposed = tick.work;
      const auto result = certify(scene, proposal.motion, tick);
      if (result.is_exhausted) {
        takes_first_alone_ = is_first_alone;
        // What was found to block is real, and saves work next time. Late in a tick it was work that lacked, not a shorter motion.
        if (!linearisation_.admit(scene, result) && budget_.is_first_iteration()) limits_.shorten(linearisation_.is_empty(), length / 8);
      } else {
        const bool is_done = result.is_whole() && proposal.is_settled && !proposal.is_capped && knows_all_near(scene, end, tick);
        if (result.time > Scalar(0)) {
          if (result.time < Scalar(1)) {
            pose_ = turns.moved(pose_, proposal.motion * result.time);
            off_ = off_target(scene, pose_);
          } else {
            pose_ = is_done && proposal.is_home ? target_ : end;
            off_ = off_at_end;
          }
          tick.path.push_back(scene.tool_pose(pose_));
          linearisation_.pairs().approach(length * result.time);
        }
        if (is_done) return true;
        if (result.is_whole()) {
          limits_.widen(tick.work - proposed);
        } else if (result.blockers.empty()) {
          limits_.shorten(linearisation_.is_empty(), length * result.time);
        } else if (linearisation_.admit(scene, result)) {
          limits_.narrow_to_radius();
        } else {
          limits_.narrow((std::min)(limits_.trust(), length) * std::clamp(result.time, Scalar(1) / 4, Scalar(1) / 2));
        }
      }
    } while (tick.iterations < maximum_iterations && budget_.allows_another(tick.work) && !(limits_.trust() < resting));
    limits_.carry_over();
    return false;
  }

  /// Whether nothing near where a motion ends is unknown; else what was not known is from now on.
  bool knows_all_near(const Scene& scene, const Pose<Scalar>& end, Tick<MeshScalar>& tick) noexcept {
    const NoticedTriangles noticed =
        certificate_.notice(scene, end, tick.work, budget_.limit_of_certificate(tick.work), linearisation_.pairs(), reach_of_step(scene));
    return !linearisation_.notice(scene, noticed) && noticed.is_all;
  }

  Twist<Scalar> off_target(const Scene& scene, const Pose<Scalar>& pose) const noexcept { return scene.idle_turns().motion_between(target_, pose); }

  /// Whether a pose `off` the target is nearer to it than the certified one, but for what the margin is worth that it wins or has to win yet.
  bool descends(const Scene& scene, const Twist<Scalar>& off, Scalar restoration) const noexcept {
    using std::sqrt;
    const Scalar before = scene.metric().energy(off_), after = scene.metric().energy(off);
    return after <= before + restoration + scene.margin() * (sqrt(2 * before) + scene.margin());
  }

  /// Whether a motion leads nearer to the target by more than a tenth of the margin is worth.
  bool is_worth_it(const Scene& scene, const Twist<Scalar>& motion) const noexcept {
    using std::sqrt;
    const Scalar before = scene.metric().energy(off_);
    const Scalar after = scene.metric().energy(off_target(scene, scene.idle_turns().moved(pose_, motion)));
    return after < before - scene.margin() / 10 * sqrt(2 * before);
  }

  /// Solves for the motion from the certified pose, linearising again where the first step ends.
  Proposal propose(const Scene& scene, int rounds, Tick<MeshScalar>& tick) noexcept {
    const auto& turns = scene.idle_turns();
    auto& problem = linearisation_.problem();
    Proposal proposal;
    Pose<Scalar> pose = pose_;
    bool assumes_valleys = true, is_taken_back = false;
    Scalar first(0), previous(0);
    for (int round = 0; round < rounds && !budget_.ends_motion(tick.work, round); ++round) {
      const bool is_measured = !(proposal.is_capped && linearisation_.carry_to(scene, pose, tick)) &&
                               linearise(scene, pose, round == 0, rounds > 1, assumes_valleys, tick);
      const Twist<Scalar> off = round == 0 ? off_ : off_target(scene, pose);
      solve(scene, pose, off, proposal.is_capped, tick);
      if (round == 0) proposal.restoration = (std::max)(problem.worth_of_margin(), Scalar(0));
      Leg leg = leg_of(scene, pose, solved_step());
      if (round > 0) keep_contacts(scene, pose, off, proposal.is_capped, leg, tick);
      if (previous > very_short(scene) && !proposal.is_capped && reconcile(scene, off, tick)) {
        leg = leg_of(scene, pose, solved_step());
        is_taken_back = is_taken_back || round == 1;
      }
      linearisation_.learn_passed(scene, tick);
      const Scalar last = scene.length_of(leg.step, pose);
      if (round == 0) {
        first = last;
        proposal.is_at_rest = is_measured && last < very_short(scene) / 100;
      }
      const Scalar longest = limits_.longest(linearisation_.is_empty());
      // Where the optimum is flat a step may be of more than a turn, of which a pose would not know the direction.
      if (!proposal.is_capped && last > 2 * longest) leg = leg_of(scene, pose, leg.step * (2 * longest / last));
      linearisation_.remember_stops(leg.step);
      const Pose<Scalar> linearised = pose;
      pose = leg.end;
      proposal.motion = leg.motion;
      if (!proposal.is_capped) proposal.is_free = problem.is_free();
      const Scalar length = scene.length_of(proposal.motion, pose_);
      if (length > longest && !proposal.is_capped) {
        proposal.is_capped = true;
        proposal.motion = proposal.motion * (longest / length);
        pose = turns.moved(pose_, proposal.motion);
        if (proposal.is_free || problem.leaves_gaps(turns.motion_between(linearised, pose), scene.margin() / 2)) return proposal;
        continue;
      }
      if (proposal.is_capped && length > 2 * longest) {  // rows that all but contradict each other are met only far away
        proposal.motion = proposal.motion * (longest / length);
        return proposal;
      }
      const bool rests_on_assumption = problem.rests_on_assumption();
      assumes_valleys = assumes_valleys && !rests_on_assumption;  // with it again, two linearisations would take turns
      // A short step is the last one where steps shrink fast, and go on to, or where it is very short.
      const bool shrinks_fast = problem.is_newton() && last < previous / 10;
      const bool is_short = last < Scalar(scene.settings().step_tolerance) && (shrinks_fast || last < very_short(scene));
      previous = last;
      const bool rests_on_kept = problem.rests_on_kept();
      proposal.is_home = proposal.is_free && !proposal.is_capped && scene.has_led_to(target_, pose, length);
      proposal.is_taken_back = is_taken_back && rests_on_kept && last < very_short(scene) && !proposal.is_capped;
      proposal.goes_back = rests_on_kept && length < first / 4 && !proposal.is_capped;
      proposal.is_settled =
          (is_short && is_measured && !rests_on_assumption && !rests_on_kept && problem.keeps_features()) || proposal.is_home;
      if (proposal.is_settled || proposal.is_capped || (is_short && rests_on_kept)) return proposal;
    }
    return proposal;
  }

  /// Rows at a pose, that where a motion starts or one on its way; false if they are carried there, and nothing is measured.
  bool linearise(const Scene& scene, const Pose<Scalar>& pose, bool is_start, bool may_carry, bool assumes_valleys, Tick<MeshScalar>& tick) noexcept {
    if (!is_start) {
      linearisation_.move_to(scene, pose, assumes_valleys, tick);
    } else if (may_carry && linearisation_.start_carried(scene, pose, reach_of_step(scene), tick)) {
      return false;
    } else {
      linearisation_.start_measured(scene, pose, reach_of_step(scene), tick);
    }
    return true;
  }

  /// Solves for a step, with the rows of what it would cross.
  /// @param off  where the linearised pose is, from the target; here and below
  void solve(const Scene& scene, const Pose<Scalar>& pose, const Twist<Scalar>& off, bool is_capped, Tick<MeshScalar>& tick) noexcept {
    constexpr int most_additions = 3;
    if (!is_capped && bend_again(scene, pose, off, tick)) return;
    project(scene, off, is_capped, tick);
    for (int i = 0; i < most_additions && linearisation_.add_crossed(scene, trusted_step(scene, pose), tick); ++i) {
      project(scene, off, is_capped, tick);
    }
    if (!is_capped) bend(scene, off, tick);
  }

  /// Solves again with rows that came late.
  void project_again(const Scene& scene, const Twist<Scalar>& off, bool is_capped, Tick<MeshScalar>& tick) noexcept {
    project(scene, off, is_capped, tick);
    if (!is_capped) bend(scene, off, tick);
  }

  Twist<Scalar> solved_step() const noexcept { return Twist<Scalar>::from_vector(problem().solution().step); }

  Leg leg_of(const Scene& scene, const Pose<Scalar>& pose, const Twist<Scalar>& step) const noexcept {
    const auto& turns = scene.idle_turns();
    const Pose<Scalar> end = turns.moved(pose, step);
    return {step, end, turns.motion_between(pose_, end)};
  }

  /// The step solved for, or as much of it as is trusted.
  Twist<Scalar> trusted_step(const Scene& scene, const Pose<Scalar>& pose) const noexcept {
    const Twist<Scalar> step = solved_step();
    const Scalar length = scene.length_of(step, pose);
    return length > limits_.trust() ? step * (limits_.trust() / length) : step;
  }

  void project(const Scene& scene, const Twist<Scalar>& off, bool is_capped, Tick<MeshScalar>& tick) noexcept {
    if (is_capped) {
      linearisation_.problem().restore(scene.metric(), scene.margin());
    } else {
      linearisation_.problem().project(scene.metric(), off, scene.margin());
    }
    tick.work += problem().solves();
  }

  /// Solves with the forces of the last step; false where a projection is to find others.
  bool bend_again(const Scene& scene, const Pose<Scalar>& pose, const Twist<Scalar>& off, Tick<MeshScalar>& tick) noexcept {
    using Guess = typename Linearisation<ToolType, Solver>::Problem::Guess;
    const Guess guess = linearisation_.problem().bend_again(scene.metric(), off, scene.margin());
    if (guess == Guess::none) return false;
    tick.work += problem().solves();
    if (guess == Guess::wrong || linearisation_.add_crossed(scene, trusted_step(scene, pose), tick)) return false;
    if (guess == Guess::close) bend(scene, off, tick);
    return true;
  }

  void bend(const Scene& scene, const Twist<Scalar>& off, Tick<MeshScalar>& tick) noexcept {
    if (problem().is_free()) return;
    linearisation_.problem().bend(scene.metric(), off);
    tick.work += problem().solves();
  }

  /// Solves again with the contacts of the certified pose that the motion would break.
  void keep_contacts(const Scene& scene, const Pose<Scalar>& pose, const Twist<Scalar>& off, bool is_capped, Leg& leg, Tick<MeshScalar>& tick) noexcept {
    if (!linearisation_.may_break()) return;
    linearisation_.release_kept();
    for (int round = 0; round < 2 && linearisation_.keep_broken(scene, leg.motion); ++round) {
      project_again(scene, off, is_capped, tick);
      leg = leg_of(scene, pose, solved_step());
    }
  }

  /// Where a step goes back on the last one, each linearisation lacks what stopped the other: solves again with what stopped the last.
  bool reconcile(const Scene& scene, const Twist<Scalar>& off, Tick<MeshScalar>& tick) noexcept {
    const Twist<Scalar>& last_step = linearisation_.stopped();
    const Metric<Scalar>& metric = scene.metric();
    if (!(metric.product(solved_step(), last_step) < -metric.energy(last_step) / 2)) return false;
    if (!linearisation_.keep_stops(scene)) return false;
    project_again(scene, off, false, tick);
    return true;
  }

  SweepResult<Scalar> certify(const Scene& scene, const Twist<Scalar>& motion, Tick<MeshScalar>& tick) noexcept {
    return certificate_.certify(scene, pose_, motion, tick.work, budget_.limit_of_certificate(tick.work), linearisation_.pairs(),
                                reach_of_step(scene));
  }

  Pose<Scalar> pose_;     // the certified pose
  Pose<Scalar> target_;   // the haptic pose
  Twist<Scalar> off_;     // of the certified pose from it
  bool goes_on_ = false;  // the last tick left motion for this one
  bool takes_first_alone_ = false;  // the next motion, maybe in the next tick, is the first step: the last went back, as a triangle is missing
  WorkBudget budget_;
  StepLimits<Scalar> limits_;
  Linearisation<ToolType, Solver> linearisation_;
  MotionCertificate<ToolType> certificate_;
};

/// The default contact method: constraint planes between the closest features of the tool and the triangles in its way.
struct ClosestFeatures {
  template <RigidTool Tool, QpSolver Solver>
  using Follower = ClosestFeaturesFollower<Tool, Solver>;
};

}  // namespace feeler
