// The default way of modelling contact: planes between closest features, linearised again until they hold.
#pragma once

#include <algorithm>
#include <array>

#include "feeler/contact/contact_patch.hpp"
#include "feeler/contact/working_set.hpp"
#include "feeler/core/status.hpp"
#include "feeler/object/surface_walk.hpp"
#include "feeler/object/triangle_normal.hpp"
#include "feeler/render/contact_method.hpp"
#include "feeler/render/kept_contacts.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/step_limits.hpp"
#include "feeler/render/step_problem.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/render/work_budget.hpp"

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

  const Pose<Scalar>& pose() const noexcept { return pose_; }
  /// Of the last tick: where the hand was, and the last step that was solved for.
  const Pose<Scalar>& target() const noexcept { return target_; }
  const auto& problem() const noexcept { return problem_; }

  void reset(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    pose_ = pose;
    working_set_.clear();
    certificate_.clear();
    goes_on_ = false;
    budget_.reset();
    limits_.reset(scene.trust_radius());
  }

  Status follow(const Scene& scene, const Pose<Scalar>& target, Tick<MeshScalar>& tick) noexcept {
    target_ = target;
    turn_idly(scene, tick);
    const int idle_legs = tick.path.size();
    working_set_.age(longest_idle, 4 * scene.margin(), 4 * scene.trust_radius(), goes_on_);
    if (!goes_on_) limits_.reset(scene.trust_radius());
    budget_.begin_tick(scene.settings().work_budget);
    goes_on_ = !advance(scene, tick);
    budget_.end_tick(tick.work, tick.path.size() > idle_legs);
    turn_idly(scene, tick);
    return goes_on_ ? Status::unconverged : Status::converged;
  }

  /// The active rows of the last optimisation.
  void report(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Scalar unit = Scalar(scene.settings().stiffness.translational.maxCoeff());
    for (const auto& active : problem_.solution().active) {
      if (active.row >= problem_.row_count()) continue;
      const auto& row = problem_.row(active.row);
      const int pair = working_set_.find(row.piece, row.triangle);
      if (pair >= 0) working_set_[pair].idle_ticks = 0;
      ActiveContact<MeshScalar> contact;
      contact.piece = row.piece;
      contact.triangle = row.triangle;
      Vector3<Scalar> point = pose_.translation + row.arm;
      // Of a swept tool the arm ends on the core, but for a corner of the object on a face.
      if constexpr (SweptTool<Piece>) {
        if (row.kind != FeaturePair::face_vertex) point -= swept_radius(scene.piece(row.piece)) * row.normal;
      }
      contact.point_world = point.template cast<MeshScalar>();
      contact.normal_world = row.normal.template cast<MeshScalar>();
      contact.gap = MeshScalar(problem_.gap_after(active.row));
      contact.force = MeshScalar(active.multiplier * unit);
      tick.contacts.push_back(contact);
    }
  }

 private:
  static constexpr bool is_convex = maximum_pieces<ToolType> == 1;
  static constexpr int row_capacity = is_convex ? 128 : 256;
  using Pair = WorkingPair<Scalar>;
  using Pairs = WorkingSet<Scalar, is_convex ? 48 : 256>;

  using Row = ContactRowOf<Piece>;

  static constexpr int longest_idle = 8;
  static constexpr int maximum_rounds = 4;  // linearisations for one motion

  /// A step proposed to the certificate.
  struct Proposal {
    Twist<Scalar> motion;     // from the certified pose
    bool is_settled = false;   // another linearisation would not change it
    bool is_capped = false;    // the trust region cut it
    bool is_free = false;      // no contact holds the tool
    Scalar restoration = 0;   // energy that it may cost to win the margin back [m²]
  };

  /// What is farther away cannot stop the next step [m].
  Scalar reach_of_step(const Scene& scene) const noexcept { return limits_.trust() + scene.margin(); }

  /// Whether the last linearisation found nothing near.
  bool is_in_flight() const noexcept { return problem_.row_count() == 0 && !leaves_out_pairs_; }

  /// A step that is short whatever the one before it was [m].
  static Scalar very_short(const Scene& scene) noexcept { return Scalar(scene.settings().step_tolerance) / 50; }

  /// Turns that do not matter follow the device at once.
  void turn_idly(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    if constexpr (IdleTurns<typename Scene::Tool>::legs > 0) {
      const Pose<Scalar> turned = scene.idle_turns().following(pose_, target_);
      if (turned.rotation.coeffs() == pose_.rotation.coeffs()) return;
      pose_ = turned;
      tick.path.push_back(scene.tool_pose(pose_));
    }
  }

  /// True when it arrived at a local minimum.
  bool advance(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Scalar resting = Scalar(scene.settings().step_tolerance) / 500000;
    const int maximum_iterations =
        std::min(scene.settings().maximum_iterations, Tick<MeshScalar>::path_capacity - IdleTurns<typename Scene::Tool>::legs);
    const auto& turns = scene.idle_turns();
    bool came_to_nothing = false;
    tick.iterations = 0;
    do {
      ++tick.iterations;
      budget_.begin_iteration(tick.work);
      const Proposal proposal = propose(scene, came_to_nothing ? 1 : maximum_rounds, tick);
      const Scalar length = scene.length_of(proposal.motion, pose_);
      if (!proposal.is_settled && !came_to_nothing && length < very_short(scene)) {
        // One linearisation takes back what another asks for, as a triangle is missing from both: the first alone will meet it.
        came_to_nothing = true;
        continue;
      }
      if (length <= resting) return proposal.is_settled && !proposal.is_capped;
      const bool is_nearer = descends(scene, turns.moved(pose_, proposal.motion), proposal.restoration, came_to_nothing);
      came_to_nothing = false;
      if (!is_nearer) {
        limits_.narrow(std::min(limits_.trust(), length) / 4);
        continue;
      }
      const auto result = certify(scene, proposal.motion, tick);
      if (result.is_exhausted) {
        // What was found to block is real, and saves work next time.
        if (!admit(scene, result)) limits_.shorten(is_in_flight(), length / 8);
      } else {
        const bool is_done = result.blockers.empty() && proposal.is_settled && !proposal.is_capped;
        pose_ = is_done && proposal.is_free ? target_ : turns.moved(pose_, proposal.motion * result.time);
        if (result.time > Scalar(0)) {
          tick.path.push_back(scene.tool_pose(pose_));
          working_set_.approach(length * result.time);
        }
        if (is_done) return true;
        if (result.blockers.empty()) {
          limits_.widen();
        } else if (admit(scene, result)) {
          limits_.narrow_to_radius();
        } else {
          limits_.narrow(length * std::max(result.time, Scalar(1) / 4));
        }
      }
    } while (tick.iterations < maximum_iterations && !budget_.is_spent(tick.work) && !(limits_.trust() < resting));
    limits_.carry_over();
    return false;
  }

  /// Whether a pose is nearer to the target than the certified one: `strictly`, or but for what it costs to win the margin back.
  bool descends(const Scene& scene, const Pose<Scalar>& pose, Scalar restoration, bool strictly) const noexcept {
    using std::sqrt;
    const Scalar before = scene.metric().energy(scene.idle_turns().motion_between(target_, pose_));
    const Scalar after = scene.metric().energy(scene.idle_turns().motion_between(target_, pose));
    if (strictly) return after < before;
    return after <= before + 2 * restoration + scene.margin() * (sqrt(2 * before) + scene.margin());
  }

  /// Solves for the motion from the certified pose, linearising again where the first step ends.
  Proposal propose(const Scene& scene, int rounds, Tick<MeshScalar>& tick) noexcept {
    const auto& turns = scene.idle_turns();
    Proposal proposal;
    Pose<Scalar> pose = pose_;
    bool rests_on_assumption = false;
    Scalar previous(0);
    for (int round = 0; round < rounds && !budget_.ends_motion(tick.work, round); ++round) {
      linearise(scene, pose, round == 0, !rests_on_assumption, tick);
      solve(scene, pose, proposal.is_capped);
      if (round == 0) proposal.restoration = problem_.cost_of_restoration();
      if (round > 0) keep_contacts(scene, pose, proposal.is_capped);
      note_tight_pairs();
      learn_passed(scene, pose, tick);
      auto step = Twist<Scalar>::from_vector(problem_.solution().step);
      const Scalar last = scene.length_of(step, pose);
      const Scalar longest = limits_.longest(is_in_flight());
      // Where the optimum is flat a step may be of more than a turn, of which a pose would not know the direction.
      if (!proposal.is_capped && last > 2 * longest) step = step * (2 * longest / last);
      const Pose<Scalar> linearised = pose;
      pose = turns.moved(pose, step);
      proposal.motion = turns.motion_between(pose_, pose);
      if (!proposal.is_capped) proposal.is_free = problem_.is_free();
      const Scalar length = scene.length_of(proposal.motion, pose_);
      if (length > longest && !proposal.is_capped) {
        proposal.is_capped = true;
        proposal.motion = proposal.motion * (longest / length);
        pose = turns.moved(pose_, proposal.motion);
        if (proposal.is_free || problem_.leaves_gaps(turns.motion_between(linearised, pose), scene.margin() / 2)) return proposal;
        continue;
      }
      rests_on_assumption = problem_.rests_on_assumption();
      // A short step is the last one where steps shrink fast, and go on to, or where it is very short.
      const bool shrinks_fast = problem_.is_newton() && last < previous / 10;
      const bool is_short = last < Scalar(scene.settings().step_tolerance) && (shrinks_fast || last < very_short(scene));
      previous = last;
      const bool rests_on_kept = problem_.rests_on_kept();
      proposal.is_settled =
          (is_short && !rests_on_assumption && !rests_on_kept && problem_.keeps_features()) || proposal.is_free;
      if (proposal.is_settled || proposal.is_capped || (is_short && rests_on_kept)) return proposal;
    }
    return proposal;
  }

  void solve(const Scene& scene, const Pose<Scalar>& pose, bool is_capped) noexcept {
    if (is_capped) {
      problem_.restore(scene.metric(), scene.margin());
    } else {
      problem_.solve(scene.metric(), scene.idle_turns().motion_between(target_, pose), scene.margin());
    }
  }

  /// Whether a contact is close enough to be broken by any motion; where there is no clearance at all, rounding decides which is.
  static bool touches(const Scene& scene, Scalar gap) noexcept { return gap > scene.margin() / 1000 && gap < 4 * scene.margin(); }

  /// Solves again with the contacts of the certified pose that the motion would break.
  void keep_contacts(const Scene& scene, const Pose<Scalar>& pose, bool is_capped) noexcept {
    const auto& turns = scene.idle_turns();
    const Twist<Scalar> so_far = turns.motion_between(pose_, pose);
    const auto whole = [&] { return turns.motion_between(pose_, turns.moved(pose, Twist<Scalar>::from_vector(problem_.solution().step))); };
    kept_.release();
    for (int round = 0; round < 2 && kept_.keep_broken(so_far, whole(), scene.margin(), problem_); ++round) {
      solve(scene, pose, is_capped);
    }
  }

  /// Takes the triangles that the contacts of a solution pass over to into the working set: the row of one they have left hides them.
  void learn_passed(const Scene& scene, const Pose<Scalar>& pose, Tick<MeshScalar>& tick) noexcept {
    const auto step = Twist<Scalar>::from_vector(problem_.solution().step);
    for (const auto& active : problem_.solution().active) {
      const Row& row = problem_.row(active.row);
      if (row.kind != FeaturePair::vertex_face || problem_.is_relaxed(active.row) || working_set_.full()) continue;
      const Vector3<Scalar> point = pose.translation + step.linear + row.carried(step).arm;
      const int triangle = triangle_under(scene.object(), row.triangle, point);
      if (triangle < 0 || working_set_.find(row.piece, triangle) >= 0) continue;
      Pair& pair = take_in(scene, row.piece, triangle);
      const Matrix3<Scalar> axes = pose_.rotation.toRotationMatrix();
      measure(scene, scene.in_tool(pair.corners_world, pose_, axes), axes, pair, true, tick);
    }
  }

  /// Rows of the working set at a pose; at the certified pose also the planes that the certificate starts from.
  void linearise(const Scene& scene, const Pose<Scalar>& pose, bool is_certified, bool assumes_valleys,
                 Tick<MeshScalar>& tick) noexcept {
    problem_.clear();
    const Matrix3<Scalar> axes = pose.rotation.toRotationMatrix();
    const Scalar band = scene.trust_radius() / 4;
    const Scalar far = reach_of_step(scene);
    leaves_out_pairs_ = false;
    if (is_certified) kept_.clear();
    PatchRows<Scalar, Row> rows;
    for (int i = 0; i < working_set_.size(); ++i) {
      Pair& pair = working_set_[i];
      if (pair.is_beyond(far)) {
        pair.has_rows = false;
        leaves_out_pairs_ = true;
        continue;
      }
      const Matrix3<Scalar> corners = scene.in_tool(pair.corners_world, pose, axes);
      const auto closest = measure(scene, corners, axes, pair, is_certified, tick);
      ContactPatch<Piece, MeshScalar> patch(scene.piece(pair.piece), scene.incidence(pair.piece), scene.object(), axes, scene.reference(), band, assumes_valleys);
      pair.has_rows = patch.find(pair.triangle, corners, closest, pair.keeps_ghost, rows);
      if (is_certified) pair.is_ghost = !pair.has_rows;
      for (Row& row : rows) {
        row.piece = pair.piece;
        row.triangle = pair.triangle;
        problem_.add(row, pair.slack, pair.is_tight);
        if (is_certified && !pair.is_tight && !row.is_assumed && touches(scene, row.gap)) kept_.add(row, pair.slack);
      }
    }
    tick.rows = problem_.row_count();
  }

  /// Remembers which pairs had no room for the margin.
  void note_tight_pairs() noexcept {
    for (int i = 0; i < working_set_.size(); ++i) working_set_[i].is_tight = false;
    for (int k = 0; k < problem_.row_count(); ++k) {
      if (problem_.is_relaxed(k)) working_set_[working_set_.find(problem_.row(k).piece, problem_.row(k).triangle)].is_tight = true;
    }
  }

  /// The plane of a triangle, where it parts the tool from it but for a touch, and better than the one given.
  static void prefer_own_plane(const Piece& piece, const Matrix3<Scalar>& corners, Scalar touching, ClosestPoints<Scalar>& closest) noexcept {
    const Vector3<Scalar> normal = triangle_normal<Scalar>(corners.col(0), corners.col(1), corners.col(2));
    if (normal.isZero()) return;
    for (const Vector3<Scalar>& own : {normal, Vector3<Scalar>(-normal)}) {
      const Scalar distance = separation_along(piece, corners, own);
      if (!(distance > -touching) || !(distance > closest.distance)) continue;
      closest.normal = own;
      closest.distance = distance;
    }
  }

  /// Closest points of a pair, with the corners in the tool frame of a pose with the axes given; at the certified pose they are remembered.
  ClosestPoints<Scalar> measure(const Scene& scene, const Matrix3<Scalar>& corners, const Matrix3<Scalar>& axes, Pair& pair, bool is_certified,
                                Tick<MeshScalar>& tick) const noexcept {
    const auto closest = closest_points(scene, corners, axes, pair, is_certified);
    ++tick.work;
    pair.features = closest.features;
    if (is_certified) {
      pair.normal = axes * closest.normal;
      pair.slack = closest.distance;
      pair.moved = Scalar(0);
    }
    return closest;
  }

  /// Closest points of a pair. On the way the tool may overlap it; then the plane it had at the certified pose says which features meet.
  static ClosestPoints<Scalar> closest_points(const Scene& scene, const Matrix3<Scalar>& corners,
                                              const Matrix3<Scalar>& axes, const Pair& pair,
                                              [[maybe_unused]] bool is_certified) noexcept {
    const Piece& piece = scene.piece(pair.piece);
    ClosestPoints<Scalar> closest = gjk(piece, corners, pair.features, scene.clearance().touching);
    if (!closest.is_touching) return closest;
    if constexpr (!SweptTool<Piece>) {  // whose core touches nothing but on the way, and there by far
      if (is_certified || pair.slack < 2 * scene.clearance().touching) {
        return separation_of_touching(piece, corners, closest, scene.clearance().allowance);
      }
    }
    closest.normal = axes.transpose() * pair.normal;
    closest.distance = separation_along(piece, corners, closest.normal);
    if (pair.is_ghost) prefer_own_plane(piece, corners, scene.clearance().touching, closest);
    closest.features = {};
    closest.tool_point = piece.vertex(piece.support(Vector3<Scalar>(-closest.normal)));
    return closest;
  }

  SweepResult<Scalar> certify(const Scene& scene, const Twist<Scalar>& motion, Tick<MeshScalar>& tick) noexcept {
    return certificate_.certify(scene, pose_, motion, tick.work, budget_.limit_of_certificate(tick.work), working_set_, reach_of_step(scene));
  }

  Pair& take_in(const Scene& scene, int piece, int triangle) noexcept {
    return working_set_.add(piece, triangle, scene.object().corners(triangle).template cast<Scalar>());
  }

  /// Takes what blocked into the working set; false when all of it was there already with rows of its own.
  bool admit(const Scene& scene, const SweepResult<Scalar>& result) noexcept {
    bool is_new = false;
    for (const auto& blocker : result.blockers) {
      int i = working_set_.find(blocker.piece, blocker.triangle);
      if (i < 0) {
        take_in(scene, blocker.piece, blocker.triangle);
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

  Pose<Scalar> pose_;     // the certified pose
  Pose<Scalar> target_;   // the haptic pose
  bool goes_on_ = false;  // the last tick left motion for this one
  WorkBudget budget_;
  bool leaves_out_pairs_ = false;  // the last linearisation had pairs beyond its reach
  StepLimits<Scalar> limits_;
  Pairs working_set_;
  MotionCertificate<ToolType> certificate_;
  StepProblem<Solver, row_capacity, Row> problem_;
  KeptContacts<Row, row_capacity> kept_;
};

/// The default contact method: constraint planes between the closest features of the tool and the triangles in its way.
struct ClosestFeatures {
  template <RigidTool Tool, QpSolver Solver>
  using Follower = ClosestFeaturesFollower<Tool, Solver>;
};

}  // namespace feeler
