// The default way of modelling contact: planes between closest features, linearised again until they hold.
#pragma once

#include <algorithm>
#include <limits>

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
/// motion triangle by triangle. What blocks it joins the working set, and the pose advances as far as the motion is certified. Where the work of a
/// tick runs out, the next tick goes on at that stage, with the motion that was proposed as long as it still leads towards the hand.
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
    stage_ = Stage::starting;
    limits_.reset(scene.trust_radius());
  }

  /// The metric has turned since the last tick: what was settled in the old one is not in the new one.
  void metric_turned() noexcept { iteration_.aim.translation.setConstant(std::numeric_limits<Scalar>::quiet_NaN()); }

  TickStatus follow(const Scene& scene, const Pose<Scalar>& target, Tick<MeshScalar>& tick) noexcept {
    target_ = target;
    if (stage_ == Stage::starting) turn_idly(scene, tick);
    off_ = off_target(scene, pose_);
    if (!goes_on_) limits_.reset(scene.trust_radius());
    if (!aims_at_target()) judge_again(scene);
    if (stage_ == Stage::starting) {
      iteration_ = {};
      auto& pairs = linearisation_.pairs();
      pairs.age(linearisation_.touching(scene), pairs.has_no_clearance(scene.clearance().none()) ? Scalar(0) : scene.noticed(), goes_on_);
    }
    budget_.begin_tick(scene.settings().work_budget);
    goes_on_ = !advance(scene, tick);
    if (stage_ == Stage::starting) turn_idly(scene, tick);
    return goes_on_ ? TickStatus::unconverged : TickStatus::converged;
  }

  /// The active rows of the last optimisation.
  void report(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Scalar unit = Scalar(scene.settings().stiffness.translational.maxCoeff());
    auto& pairs = linearisation_.pairs();
    for (const auto& stop : linearisation_.stops()) {
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
    left,       ///< nothing more comes of it in this tick
  };

  /// The linearisations of one motion so far.
  struct Rounds {
    Pose<Scalar> pose;  // where the next one is
    int count = 0;
    bool is_measured = false;      // the last one was: not carried
    bool assumes_valleys = true;
    bool is_taken_back = false;    // the second step took back the first
    Scalar first = 0, previous = 0;  // lengths of steps [m]
  };

  /// What iterations tell each other, and the next tick where one is suspended.
  struct Iteration {
    Pose<Scalar> aim;              // where the hand was when it began
    bool came_to_nothing = false;  // the last one
    bool is_taken_back = false;    // its second step took back the first
    int known_pairs = 0;           // then
    Rounds rounds;
    Proposal proposal;
    Pose<Scalar> end;       // of its motion
    Scalar length = 0;      // of that [m]
    int work = 0;           // to certify it
    int ticks = 0;          // in which it was suspended
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

  bool aims_at_target() const noexcept {
    return iteration_.aim.translation == target_.translation && iteration_.aim.rotation.coeffs() == target_.rotation.coeffs();
  }

  /// The hand has moved since the iteration at hand began: its motion is gone on with as long as it leads nearer, and is not the last.
  void judge_again(const Scene& scene) noexcept {
    Proposal& proposal = iteration_.proposal;
    proposal.is_settled = proposal.is_home = false;
    const bool is_worthwhile = stage_ == Stage::certifying && descends(scene, off_target(scene, iteration_.end), proposal.restoration);
    if (stage_ == Stage::noticing || (stage_ == Stage::certifying && !is_worthwhile)) stage_ = Stage::starting;
  }

  /// Whether it arrived.
  bool advance(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const int maximum_iterations =
        (std::min)(scene.settings().maximum_iterations, Tick<MeshScalar>::path_capacity - IdleTurns<typename Scene::Tool>::legs);
    Outcome outcome = Outcome::another;
    tick.iterations = 0;
    do {
      ++tick.iterations;
      budget_.begin_iteration(tick.work);
      outcome = iterate(scene, tick);
      if (outcome == Outcome::arrived && !aims_at_target()) outcome = Outcome::another;
    } while (outcome == Outcome::another && tick.iterations < maximum_iterations && budget_.allows_another(tick.work) &&
             !(limits_.trust() < resting(scene)));
    if (outcome == Outcome::suspended) ++iteration_.ticks;
    else stage_ = Stage::starting;
    if (outcome == Outcome::another || outcome == Outcome::suspended) limits_.carry_over();
    return outcome == Outcome::arrived;
  }

  /// Goes on with an iteration, or begins one.
  Outcome iterate(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Stage stage = stage_;
    if (stage == Stage::starting || stage == Stage::measuring) {
      if (stage == Stage::starting) {
        iteration_.aim = target_;
        iteration_.work = iteration_.ticks = 0;
      }
      const Outcome outcome = choose(scene, tick);
      if (outcome != Outcome::proposed) return outcome;
      if (!aims_at_target()) judge_again(scene);
    }
    return stage == Stage::noticing ? look_around(scene, true, tick) : go(scene, stage == Stage::certifying, tick);
  }

  /// Chooses a motion.
  Outcome choose(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    Iteration& it = iteration_;
    const bool is_first_alone = it.came_to_nothing || takes_first_alone_;
    if (!propose(scene, is_first_alone ? 1 : maximum_rounds, tick)) return Outcome::suspended;
    const Proposal& proposal = it.proposal;
    takes_first_alone_ = proposal.goes_back;
    it.length = scene.length_of(proposal.motion, pose_);
    if (!proposal.is_settled && !it.came_to_nothing && it.length < very_short(scene)) {
      // One linearisation takes back what another asks for, as a triangle is missing from both: the first alone will meet it.
      it.came_to_nothing = true;
      it.is_taken_back = proposal.is_taken_back;
      it.known_pairs = linearisation_.pairs().size();
      return Outcome::another;
    }
    const bool is_held = it.is_taken_back && linearisation_.pairs().size() == it.known_pairs;  // one linearisation alone knows no more than the two
    if (it.came_to_nothing && (is_held || proposal.is_at_rest) && !is_worth_it(scene, proposal.motion)) return Outcome::arrived;
    if (it.length <= resting(scene)) return proposal.is_settled && !proposal.is_capped ? Outcome::arrived : Outcome::left;
    it.came_to_nothing = false;
    it.end = scene.idle_turns().moved(pose_, proposal.motion);
    if (descends(scene, off_target(scene, it.end), proposal.restoration)) return Outcome::proposed;
    limits_.narrow((std::min)(limits_.trust(), it.length) / 4);
    return Outcome::another;
  }

  /// Certifies the motion chosen, or goes on with it, and moves as far as that is.
  Outcome go(const Scene& scene, bool goes_on, Tick<MeshScalar>& tick) noexcept {
    Iteration& it = iteration_;
    stage_ = Stage::certifying;
    const int begun = tick.work;
    const auto result =
        goes_on ? certificate_.go_on(scene, tick.work, budget_.limit(), linearisation_.pairs())
                : certificate_.certify(scene, pose_, it.proposal.motion, tick.work, budget_.limit(), linearisation_.pairs(), reach_of_step(scene));
    it.work += tick.work - begun;
    if (result.is_exhausted) return Outcome::suspended;
    stage_ = Stage::starting;
    if (result.is_whole() && it.proposal.is_settled && !it.proposal.is_capped) return look_around(scene, false, tick);
    if (result.time > Scalar(0))
      move_to(scene, result.time < Scalar(1) ? scene.idle_turns().moved(pose_, it.proposal.motion * result.time) : it.end, it.length * result.time,
              tick);
    if (result.is_whole()) {
      widen(scene);
    } else if (result.blockers.empty()) {
      limits_.shorten(linearisation_.is_empty(), it.length * result.time);
    } else if (linearisation_.admit(scene, result)) {
      limits_.narrow_to_radius();
    } else {
      limits_.narrow((std::min)(limits_.trust(), it.length) * std::clamp(result.time, Scalar(1) / 4, Scalar(1) / 2));
    }
    return Outcome::another;
  }

  /// Ends a motion that was certified whole and is the last one, if nothing near where it ends is unknown; else what was not known is from now on.
  Outcome look_around(const Scene& scene, bool goes_on, Tick<MeshScalar>& tick) noexcept {
    Iteration& it = iteration_;
    const auto& pairs = linearisation_.pairs();
    const int begun = tick.work;
    const NoticedTriangles noticed = goes_on ? certificate_.go_on_noticing(scene, tick.work, budget_.limit(), pairs)
                                             : certificate_.notice(scene, it.end, tick.work, budget_.limit(), pairs, reach_of_step(scene));
    it.work += tick.work - begun;
    const bool is_done = !noticed.is_exhausted && !linearisation_.notice(scene, noticed);
    const bool is_home = is_done && it.proposal.is_home;
    if (!goes_on || is_home) move_to(scene, is_home ? target_ : it.end, it.length, tick);
    if (!goes_on && !is_done) widen(scene);
    stage_ = noticed.is_exhausted ? Stage::noticing : Stage::starting;
    return noticed.is_exhausted ? Outcome::suspended : is_done ? Outcome::arrived : Outcome::another;
  }

  void move_to(const Scene& scene, const Pose<Scalar>& pose, Scalar length, Tick<MeshScalar>& tick) noexcept {
    pose_ = pose;
    off_ = off_target(scene, pose_);
    tick.path.push_back(scene.tool_pose(pose_));
    linearisation_.pairs().approach(length);
  }

  /// After a motion that nothing stopped. One in flight that took some ticks had better been shorter.
  void widen(const Scene& scene) noexcept {
    const Iteration& it = iteration_;
    if (it.ticks > 0 && linearisation_.is_empty()) limits_.shorten(true, (std::max)(it.length / Scalar(it.ticks + 1), scene.trust_radius()));
    else limits_.widen(it.work);
  }

  /// A motion as short as this is none [m].
  static Scalar resting(const Scene& scene) noexcept { return Scalar(scene.settings().step_tolerance) / 500000; }

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

  /// Solves for the motion from the certified pose, linearising again where the first step ends; false where the work runs out: called again it goes
  /// on.
  bool propose(const Scene& scene, int most_rounds, Tick<MeshScalar>& tick) noexcept {
    Rounds& rounds = iteration_.rounds;
    Proposal& proposal = iteration_.proposal;
    if (stage_ == Stage::starting) {
      rounds = {.pose = pose_};
      proposal = {};
    }
    const auto& turns = scene.idle_turns();
    auto& problem = linearisation_.problem();
    for (; rounds.count < most_rounds; ++rounds.count) {
      if (!linearise(scene, most_rounds > 1, tick)) return false;
      const int begun = tick.work;
      const bool is_first = rounds.count == 0;
      const Pose<Scalar> linearised = rounds.pose;
      const Twist<Scalar> off = turns.motion_between(iteration_.aim, linearised);
      solve(scene, linearised, off, proposal.is_capped, tick);
      if (is_first) proposal.restoration = (std::max)(problem.worth_of_margin(), Scalar(0));
      Leg leg = leg_of(scene, linearised, solved_step());
      if (!is_first) keep_contacts(scene, linearised, off, proposal.is_capped, leg, tick);
      if (rounds.previous > very_short(scene) && !proposal.is_capped && reconcile(scene, off, tick)) {
        leg = leg_of(scene, linearised, solved_step());
        rounds.is_taken_back = rounds.is_taken_back || rounds.count == 1;
      }
      linearisation_.learn_passed(scene, tick, budget_.limit());
      budget_.note_step(tick.work - begun);
      const Scalar last = scene.length_of(leg.step, linearised);
      if (is_first) {
        rounds.first = last;
        proposal.is_at_rest = rounds.is_measured && last < very_short(scene) / 100;
      }
      const Scalar longest = limits_.longest(linearisation_.is_empty());
      // Where the optimum is flat a step may be of more than a turn, of which a pose would not know the direction.
      if (!proposal.is_capped && last > 2 * longest) leg = leg_of(scene, linearised, leg.step * (2 * longest / last));
      linearisation_.remember_stops(leg.step);
      rounds.pose = leg.end;
      proposal.motion = leg.motion;
      if (!proposal.is_capped) proposal.is_free = problem.is_free();
      const Scalar length = scene.length_of(proposal.motion, pose_);
      if (length > longest && !proposal.is_capped) {
        proposal.is_capped = true;
        proposal.motion = proposal.motion * (longest / length);
        rounds.pose = turns.moved(pose_, proposal.motion);
        if (proposal.is_free || problem.leaves_gaps(turns.motion_between(linearised, rounds.pose), scene.margin() / 2)) return true;
        continue;
      }
      if (proposal.is_capped && length > 2 * longest) {  // rows that all but contradict each other are met only far away
        proposal.motion = proposal.motion * (longest / length);
        return true;
      }
      const bool rests_on_assumption = problem.rests_on_assumption();
      rounds.assumes_valleys = rounds.assumes_valleys && !rests_on_assumption;  // with it again, two linearisations would take turns
      // A short step is the last one where steps shrink fast, and go on to, or where it is very short.
      const bool shrinks_fast = problem.is_newton() && last < rounds.previous / 10;
      const bool is_short = last < Scalar(scene.settings().step_tolerance) && (shrinks_fast || last < very_short(scene));
      rounds.previous = last;
      const bool rests_on_kept = problem.rests_on_kept();
      proposal.is_home = proposal.is_free && !proposal.is_capped && scene.has_led_to(iteration_.aim, rounds.pose, length);
      proposal.is_taken_back = rounds.is_taken_back && rests_on_kept && last < very_short(scene) && !proposal.is_capped;
      proposal.goes_back = rests_on_kept && length < rounds.first / 4 && !proposal.is_capped;
      proposal.is_settled =
          (is_short && rounds.is_measured && !rests_on_assumption && !rests_on_kept && problem.keeps_features()) || proposal.is_home;
      if (proposal.is_settled || proposal.is_capped || (is_short && rests_on_kept)) return true;
    }
    return true;
  }

  /// Rows where the motion starts, or where its last step ended; false where there is no work left to measure all pairs, and then to solve for a step.
  bool linearise(const Scene& scene, bool may_carry, Tick<MeshScalar>& tick) noexcept {
    Rounds& rounds = iteration_.rounds;
    const bool goes_on = stage_ == Stage::measuring;
    const bool has_worked = tick.work > 0;
    bool is_done;
    if (goes_on) {
      is_done = linearisation_.go_on(scene, tick, budget_.limit());
    } else if (rounds.count == 0) {
      const auto is_too_late = [&] { return has_worked && !budget_.allows_step(tick.work); };  // the next tick has work for it
      if (is_too_late()) return false;
      rounds.is_measured = !(may_carry && linearisation_.start_carried(scene, pose_, reach_of_step(scene), tick, budget_.limit()));
      if (is_too_late()) return false;
      is_done = !rounds.is_measured || linearisation_.start_measured(scene, pose_, reach_of_step(scene), tick, budget_.limit());
    } else {
      rounds.is_measured = !(iteration_.proposal.is_capped && linearisation_.carry_to(scene, rounds.pose, tick));
      is_done = !rounds.is_measured || linearisation_.move_to(scene, rounds.pose, rounds.assumes_valleys, tick, budget_.limit());
    }
    const bool may_solve = !rounds.is_measured || budget_.allows_step(tick.work) || (goes_on && tick.work == 0);
    stage_ = is_done && may_solve ? Stage::starting : Stage::measuring;
    return stage_ == Stage::starting;
  }

  /// Solves for a step, with the rows of what it would cross; where the work runs out with less than that.
  /// @param off  where the linearised pose is, from where the motion aims; here and below
  void solve(const Scene& scene, const Pose<Scalar>& pose, const Twist<Scalar>& off, bool is_capped, Tick<MeshScalar>& tick) noexcept {
    constexpr int most_additions = 3;
    if (!is_capped && bend_again(scene, pose, off, tick)) return;
    project(scene, off, is_capped, tick);
    for (int i = 0;
         i < most_additions && budget_.allows_solve(tick.work) && linearisation_.add_crossed(scene, trusted_step(scene, pose), tick, budget_.limit());
         ++i) {
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
    limit_solves(tick);
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
    limit_solves(tick);
    const Guess guess = linearisation_.problem().bend_again(scene.metric(), off, scene.margin());
    if (guess == Guess::none) return false;
    tick.work += problem().solves();
    if (guess == Guess::wrong || linearisation_.add_crossed(scene, trusted_step(scene, pose), tick, budget_.limit())) return false;
    if (guess == Guess::close) bend(scene, off, tick);
    return true;
  }

  /// Leaves half of the work to what follows.
  void limit_solves(const Tick<MeshScalar>& tick) noexcept { linearisation_.problem().limit_solves((budget_.limit() - tick.work) / 2); }

  void bend(const Scene& scene, const Twist<Scalar>& off, Tick<MeshScalar>& tick) noexcept {
    if (problem().is_free()) return;
    limit_solves(tick);
    linearisation_.problem().bend(scene.metric(), off);
    tick.work += problem().solves();
  }

  /// Solves again with the contacts of the certified pose that the motion would break; here and below, if there is work left.
  void keep_contacts(const Scene& scene, const Pose<Scalar>& pose, const Twist<Scalar>& off, bool is_capped, Leg& leg,
                     Tick<MeshScalar>& tick) noexcept {
    if (!linearisation_.may_break()) return;
    linearisation_.release_kept();
    for (int round = 0; round < 2 && budget_.allows_solve(tick.work) && linearisation_.keep_broken(scene, leg.motion); ++round) {
      project_again(scene, off, is_capped, tick);
      leg = leg_of(scene, pose, solved_step());
    }
  }

  /// Where a step goes back on the last one, each linearisation lacks what stopped the other: solves again with what stopped the last.
  bool reconcile(const Scene& scene, const Twist<Scalar>& off, Tick<MeshScalar>& tick) noexcept {
    const Twist<Scalar>& last_step = linearisation_.stopped();
    const TurnedMetric<Scalar>& metric = scene.metric();
    if (!(metric.product(solved_step(), last_step) < -metric.energy(last_step) / 2)) return false;
    if (!budget_.allows_solve(tick.work) || !linearisation_.keep_stops(scene)) return false;
    project_again(scene, off, false, tick);
    return true;
  }

  Pose<Scalar> pose_;  // the certified pose
  Pose<Scalar> target_;  // the haptic pose
  Twist<Scalar> off_;  // of the certified pose from it
  bool goes_on_ = false;  // the last tick left motion for this one
  bool takes_first_alone_ = false;  // the next motion, maybe in the next tick, is the first step: the last went back, as a triangle is missing
  Stage stage_ = Stage::starting;
  Iteration iteration_;
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
