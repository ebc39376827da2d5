// The paper's way of modelling contact: one optimisation for each combination of candidate principal contacts.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "feeler/core/status.hpp"
#include "feeler/paper/candidate_options.hpp"
#include "feeler/paper/combination_search.hpp"
#include "feeler/paper/contact_regions.hpp"
#include "feeler/render/contact_method.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/half_way.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// Follows the haptic pose as the paper does (section IV): first contacts from collision detection, candidates from a local search, an
/// optimisation for each combination of them over the regions, and of the solutions the nearest to the haptic pose.
///
/// Without the certificate nothing proves that a pose is free of collision, and the status says `unverified`.
/// @cost  noexcept, no allocation; bounded by the options, but in contact a distance query for every triangle in the bounding box of the tool
template <ConvexTool ToolType, QpSolver Solver, CandidateOptions options>
class CandidateContactsFollower {
 public:
  static_assert(!SweptTool<ToolType>, "CandidateContacts knows vertices, edges and faces only: take ClosestFeatures for a swept tool");
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;

  explicit CandidateContactsFollower(const Scene& scene) : search_(scene), certificate_(scene) {}

  const Pose<Scalar>& pose() const noexcept { return pose_; }
  /// Combinations optimised in the last tick.
  int combinations() const noexcept { return search_.combinations(); }
  /// Combinations, candidates, constraints, triangles and regions left out in the last tick because a bound was reached.
  int dropped() const noexcept { return dropped_ + search_.dropped(); }
  /// The first contacts that the next tick starts from: the active principal contacts of the last.
  int region_count() const noexcept { return regions_.size(); }

  void reset(const Scene&, const Pose<Scalar>& pose) noexcept {
    pose_ = target_ = pose;
    regions_.clear();
    active_.clear();
    certificate_.clear();
  }

  TickStatus follow(const Scene& scene, const Pose<Scalar>& target, Tick<MeshScalar>& tick) noexcept {
    start_ = pose_;
    reach_ = 2 * scene.length_of(motion_between(target_, target)) + scene.trust_radius();
    target_ = target;
    search_.begin_tick();
    dropped_ = 0;
    tick.iterations = 0;
    tick.rows = 0;
    regions_.track(scene, pose_, tick.work);
    if constexpr (options.is_certified()) {
      const bool has_arrived = follow_certified(scene, tick);
      regions_.keep_in_contact(scene, pose_, active_);
      return has_arrived ? TickStatus::converged : TickStatus::unconverged;
    } else {
      ++tick.iterations;
      regions_.find(scene, pose_, target_, reach_, dropped_);
      optimise(scene, tick);
      const auto& solutions = search_.solutions();
      if (!solutions.empty()) {  // else there is nothing to choose: stay
        pose_ = solutions[0].pose;
        if (const auto middle = half_way_of_long_turn(start_, pose_)) tick.path.push_back(scene.tool_pose(*middle));
        active_ = solutions[0].active;
        regions_.keep_in_contact(scene, pose_, active_);
      }
      tick.path.push_back(scene.tool_pose(pose_));
      return TickStatus::unverified;
    }
  }

  /// The active rows of the combination chosen, at the graphic pose.
  void report(const Scene& scene, Tick<MeshScalar>& tick) const noexcept {
    const Scalar unit = Scalar(scene.settings().stiffness.translational.maxCoeff());
    for (const auto& active : active_) {
      const auto row = Search::row_at(scene, active.constraint, pose_);
      ActiveContact<MeshScalar> contact;
      contact.triangle = row.triangle;
      contact.point_world = (pose_.translation + row.arm).template cast<MeshScalar>();
      contact.normal_world = row.normal.template cast<MeshScalar>();
      contact.gap = MeshScalar(row.gap);
      contact.force = MeshScalar(active.multiplier * unit);
      tick.contacts.push_back(contact);
    }
  }

 private:
  using Search = CombinationSearch<ToolType, Solver, options>;
  using Solution = typename Search::Solution;

  /// How far the certificate lets the tool go towards a solution.
  struct Advance {
    const Solution* solution = nullptr;
    Pose<Scalar> pose;
    Scalar energy = Scalar(0);
    Scalar length = Scalar(0);  // of the way to the solution [m]
    Scalar moved = Scalar(0);   // of it certified [m]
    bool is_there = false;
  };

  /// A way as short as this is none [m].
  static Scalar resting(const Scene& scene) noexcept { return scene.clearance().negligible(); }

  void optimise(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    search_.solve(scene, regions_, {pose_, start_, target_, reach_, trust_}, tick);
  }

  /// Optimises, certifies the motion to the best solution that can be reached, and takes what blocks it among the first contacts, until
  /// the tool arrives.
  bool follow_certified(const Scene& scene, Tick<MeshScalar>& tick) noexcept
    requires(options.is_certified())
  {
    const int maximum_iterations = (std::min)(scene.settings().maximum_iterations, Tick<MeshScalar>::path_capacity);
    trust_ = regions_.empty() ? std::numeric_limits<Scalar>::infinity() : scene.trust_radius();
    while (tick.iterations < maximum_iterations && tick.work < scene.settings().work_budget) {
      ++tick.iterations;
      optimise(scene, tick);
      bool is_new = false;
      const Advance best = certify_solutions(scene, is_new, tick);
      if (best.solution == nullptr) return false;
      if (best.length <= resting(scene)) {
        active_ = best.solution->active;
        return true;
      }
      if (is_new && !best.is_there) {  // with the new regions there are better solutions
        trust_ = scene.trust_radius();
        continue;
      }
      // Creeping up to what blocks would only use up the clearance.
      if ((best.is_there || best.moved > best.length / 8) && advance(scene, best, tick)) return true;
      trust_ = best.is_there ? (std::min)(2 * trust_, scene.trust_radius()) : (std::min)(trust_, best.length) / 4;
      if (trust_ < resting(scene)) break;
    }
    return false;
  }

  /// Certifies the way to each solution, up to the first that can be reached whole, or that the tool is at; the one that leads nearest to the target.
  /// @param is_new  whether what blocks a way was not among the first contacts
  Advance certify_solutions(const Scene& scene, bool& is_new, Tick<MeshScalar>& tick) noexcept
    requires(options.is_certified())
  {
    Advance best;
    for (const Solution& solution : search_.solutions()) {
      const Twist<Scalar> motion = motion_between(pose_, solution.pose);
      const Scalar length = scene.length_of(motion);
      if (length <= resting(scene)) return {&solution, pose_, Scalar(0), length, Scalar(0), true};
      const auto result = certificate_.certify(scene, pose_, motion, tick.work, tick.work + scene.settings().work_budget);
      if (!result.blockers.empty()) is_new = regions_.admit(scene, pose_, result, dropped_) || is_new;
      const Pose<Scalar> reached = moved(pose_, motion * (result.is_exhausted ? Scalar(0) : result.time));
      const Scalar energy = scene.metric().energy(motion_between(target_, reached));
      if (best.solution == nullptr || result.is_whole() || energy < best.energy)
        best = {&solution, reached, energy, length, length * result.time, result.is_whole()};
      if (best.is_there) break;
    }
    return best;
  }

  /// Goes there; true where nothing more comes of it.
  bool advance(const Scene& scene, const Advance& best, Tick<MeshScalar>& tick) noexcept {
    if (best.is_there) active_ = best.solution->active;
    const bool is_whole = best.is_there && !best.solution->is_capped;
    const bool is_home = is_whole && active_.empty() && scene.has_led_to(target_, best.pose, best.length);
    pose_ = is_home ? target_ : best.pose;
    tick.path.push_back(scene.tool_pose(pose_));
    return is_whole && (is_home || best.length < scene.step_tolerance());
  }

  struct Nothing {
    explicit Nothing(const Scene&) noexcept {}
    void clear() noexcept {}
  };

  Pose<Scalar> pose_;  // where the graphic tool is
  Pose<Scalar> start_;  // where it was when the tick began
  Pose<Scalar> target_;  // the haptic pose
  Scalar trust_ = Scalar(0);  // longest motion proposed to the certificate [m]
  Scalar reach_ = Scalar(0);  // bound on what any tool point moves within the tick, if no fold lets it jump [m]
  typename Search::Regions regions_;
  Search search_;
  typename Search::ActiveList active_;  // what holds the tool
  [[no_unique_address]] std::conditional_t<options.is_certified(), MotionCertificate<ToolType>, Nothing> certificate_;
  int dropped_ = 0;
};

/// The contact method of the paper, with its choices: `HapticRenderer<Tool, Solver, CandidateContacts<>>`.
template <CandidateOptions options = CandidateOptions{}>
struct CandidateContacts {
  template <ConvexTool Tool, QpSolver Solver>
  using Follower = CandidateContactsFollower<Tool, Solver, options>;
};

}  // namespace feeler
