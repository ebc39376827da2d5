// The paper's way of modelling contact: one optimisation for each combination of candidate principal contacts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "feeler/contact/first_contacts.hpp"
#include "feeler/contact/local_search.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/status.hpp"
#include "feeler/proximity/separation.hpp"
#include "feeler/render/contact_method.hpp"
#include "feeler/render/motion_certificate.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/step_coordinates.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// What becomes of eq. 5, by which each coordinate of the new pose lies between its last value and the haptic pose's.
enum class LocalSolution {
  inside_box,       ///< twelve more rows in every optimisation
  selected_by_box,  ///< solutions outside the box are not chosen
  free,             ///< not used
};

/// How first contacts are found, and what is known of the motion.
enum class CollisionDetection {
  tool_vertices,  ///< the paper's: vertices are tracked from free space, overlaps at the haptic pose are looked for in contact
  certificate,    ///< the motion to the solution is certified, and what blocks it is the next first contact
};

/// Choices of `CandidateContacts`; the defaults are the paper as written. They are fixed when compiling, and what is not chosen is not in
/// the program.
struct CandidateOptions {
  LocalSolution local_solution = LocalSolution::selected_by_box;
  CollisionDetection collision_detection = CollisionDetection::tool_vertices;
  Increments increments = Increments::euler_angles;
  int linearisations = 1;            ///< of the rows of one combination
  int maximum_combinations = 64;     ///< optimisations a round; the rest is dropped, and counted
  int maximum_regions = 4;           ///< contact regions followed at once
};

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
  using Tool = typename Scene::Tool;

  const Pose<Scalar>& pose() const noexcept { return pose_; }
  /// Combinations optimised in the last tick.
  int combinations() const noexcept { return combinations_; }
  /// Combinations, candidates, constraints, triangles and regions left out in the last tick because a bound was reached.
  int dropped() const noexcept { return dropped_; }
  /// The first contacts that the next tick starts from: the active principal contacts of the last.
  int region_count() const noexcept { return regions_.size(); }

  void reset(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    pose_ = target_ = pose;
    regions_.clear();
    active_.clear();
    solutions_.clear();
    if constexpr (is_certified) certificate_.clear();
    static_cast<void>(scene);
  }

  Status follow(const Scene& scene, const Pose<Scalar>& target, Tick<MeshScalar>& tick) noexcept {
    start_ = pose_;
    reach_ = 2 * scene.length_of(motion_between(target_, target)) + scene.trust_radius();
    target_ = target;
    combinations_ = dropped_ = 0;
    tick.iterations = 0;
    tick.rows = 0;
    track_regions(scene, tick);
    if constexpr (is_certified) {
      const bool has_arrived = follow_certified(scene, tick);
      keep_regions_in_contact(scene);
      return has_arrived ? Status::converged : Status::unconverged;
    } else {
      ++tick.iterations;
      find_first_contacts(scene);
      optimise(scene, tick);
      if (!solutions_.empty()) {  // else there is nothing to choose: stay
        pose_ = solutions_[0].pose;
        active_ = solutions_[0].active;
        keep_regions_in_contact(scene);
      }
      tick.path.push_back(scene.tool_pose(pose_));
      return Status::unverified;
    }
  }

  /// The active rows of the combination chosen, at the graphic pose.
  void report(const Scene& scene, Tick<MeshScalar>& tick) const noexcept {
    const Scalar unit = Scalar(scene.settings().stiffness.translational.maxCoeff());
    for (const Active& active : active_) {
      const auto row = row_at(scene, active.constraint, pose_);
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
  static constexpr bool is_certified = options.collision_detection == CollisionDetection::certificate;
  static constexpr std::size_t region_capacity = std::size_t(options.maximum_regions);
  using Coordinates = StepCoordinates<Scalar, options.increments>;
  using Row = ContactRow<Scalar>;
  using Contact = FirstContact<Scalar>;

  struct Active {
    CandidateConstraint constraint;
    Scalar multiplier = Scalar(0);
    int region = 0;
  };
  using ActiveList = FixedVector<Active, QpSolution<Scalar>::active_capacity>;

  /// The solution of one combination.
  struct Solution {
    Pose<Scalar> pose;
    Scalar energy = Scalar(0);  // [m²]
    ActiveList active;
    bool is_capped = false;     // short of the optimum by the trust region
    bool is_on_features = true; // its contacts lie on the features that they are between

    /// Those on their features first, and of them the nearest to the haptic pose.
    bool operator<(const Solution& other) const noexcept {
      return is_on_features != other.is_on_features ? is_on_features : energy < other.energy;
    }
  };

  /// How far the certificate lets the tool go towards a solution.
  struct Advance {
    const Solution* solution = nullptr;
    Pose<Scalar> pose;
    Scalar energy = Scalar(0);
    Scalar length = Scalar(0);  // of the way to the solution [m]
    Scalar moved = Scalar(0);   // of it certified [m]
    bool is_there = false;
  };

  static std::size_t index(int i) noexcept { return std::size_t(i); }

  static Pose<Scalar> tool_frame(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    return {pose.translation - pose.rotation * scene.reference(), pose.rotation};
  }
  static Row row_at(const Scene& scene, const CandidateConstraint& constraint, const Pose<Scalar>& pose) noexcept {
    return row_of(constraint, scene.tool(), scene.object(), tool_frame(scene, pose), pose.translation);
  }

  /// Each region follows the nearest triangle of its neighbourhood.
  void track_regions(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Pose<Scalar> frame = tool_frame(scene, pose_);
    const LocalSearch<Tool, MeshScalar> search(scene.tool(), scene.object(), frame, Scalar(0));
    for (Contact& region : regions_) {
      Contact nearest = region;
      Scalar least = std::numeric_limits<Scalar>::infinity();
      for (const int triangle : search.ring(region.triangle)) {
        ++tick.work;
        Contact contact;
        const Scalar separation = separation_from(scene, triangle, frame, contact);
        if (!(separation < least)) continue;
        least = separation;
        nearest = contact;
      }
      region = nearest;
    }
    for (int i = regions_.size() - 1; i > 0; --i) {
      for (int j = 0; j < i; ++j) {
        if (regions_[i].triangle != regions_[j].triangle) continue;
        regions_.swap_remove(i);
        break;
      }
    }
  }

  /// Separation of a triangle [m], and the contact it makes: between the tool vertices that are lowest over it and the triangle.
  static Scalar separation_from(const Scene& scene, int triangle, const Pose<Scalar>& frame, Contact& contact) noexcept {
    const Matrix3<Scalar> corners = scene.object().corners(triangle).template cast<Scalar>();
    const Matrix3<Scalar> in_tool = frame.rotation.toRotationMatrix().transpose() * (corners.colwise() - frame.translation);
    auto closest = gjk(scene.tool(), in_tool, {}, scene.clearance().touching);
    if (closest.is_touching) closest = separation_of_touching(scene.tool(), in_tool, closest);
    const Vector3<Scalar>& normal = closest.normal;
    const Scalar lowest = normal.dot(scene.tool().vertex(scene.tool().support(Vector3<Scalar>(-normal))));
    contact = {triangle, frame.rotation * normal, {}};
    auto& features = contact.features;
    for (int i = 0; i < scene.tool().vertex_count() && features.size < 3; ++i) {
      if (normal.dot(scene.tool().vertex(i)) > lowest + 2 * scene.margin()) continue;
      features.tool_vertices[index(features.size)] = short(i);
      features.corners[index(features.size)] = short(features.size);
      ++features.size;
    }
    return closest.distance;
  }

  /// Section IV, step 2.1: tracked vertices out of free space; in contact, regions overlapped at the haptic pose that are not yet followed.
  void find_first_contacts(const Scene& scene) noexcept {
    const Pose<Scalar> from = tool_frame(scene, pose_), to = tool_frame(scene, target_);
    if (regions_.empty()) {
      const Contact hit = first_vertex_hit(scene.tool(), scene.object(), from, to);
      if (hit.triangle >= 0) regions_.push_back(hit);
      if (regions_.empty()) return;
    }
    OverlappedTriangles overlapped = overlapped_triangles(scene.tool(), scene.object(), to, scene.clearance().touching);
    if (!overlapped.is_complete) ++dropped_;
    auto& left = overlapped.triangles;
    const LocalSearch<Tool, MeshScalar> search(scene.tool(), scene.object(), from, Scalar(0));
    for (const Contact& region : regions_) {
      const auto ring = search.ring(region.triangle);
      for (int i = left.size() - 1; i >= 0; --i) {
        if (std::find(ring.begin(), ring.end(), left[i]) != ring.end()) left.swap_remove(i);
      }
    }
    while (!left.empty()) {
      Contact first;
      Scalar least = std::numeric_limits<Scalar>::infinity();
      for (const int triangle : remove_connected(scene, left, left[0])) {
        Contact contact;
        const Scalar separation = separation_from(scene, triangle, from, contact);
        if (!(separation < least)) continue;
        least = separation;
        first = contact;
      }
      if (least < reach_ && !regions_.push_back(first)) ++dropped_;
    }
  }

  using TriangleList = FixedVector<int, OverlappedTriangles::capacity>;

  /// Takes a triangle and all that are joined to it out of a list, and returns them.
  static TriangleList remove_connected(const Scene& scene, TriangleList& list, int seed) noexcept {
    TriangleList group;
    const auto take = [&](int triangle) {
      for (int i = 0; i < list.size(); ++i) {
        if (list[i] != triangle) continue;
        list.swap_remove(i);
        group.push_back(triangle);
        return;
      }
    };
    take(seed);
    for (int i = 0; i < group.size(); ++i) {
      for (int k = 0; k < 3; ++k) take(scene.object().topology().neighbour(group[i], k));
    }
    return group;
  }

  /// Sections III.C and IV, steps 2.2 to 4: candidates, an optimisation for every combination of them, and the choice.
  void optimise(const Scene& scene, Tick<MeshScalar>& tick) noexcept {
    const Pose<Scalar> frame = tool_frame(scene, pose_);
    LocalSearch<Tool, MeshScalar> search(scene.tool(), scene.object(), frame, reach_);
    for (int i = 0; i < regions_.size(); ++i) {
      search.find(regions_[i], found_[index(i)]);
      dropped_ += found_[index(i)].dropped;
    }
    solutions_.clear();
    try_combinations(scene, reach_, tick);
    // A tool that got inside is let out wherever that is nearest.
    if (!is_certified && solutions_.empty()) try_combinations(scene, std::numeric_limits<Scalar>::infinity(), tick);
  }

  /// @param reach  pieces of the free space farther away than that are left out [m]
  void try_combinations(const Scene& scene, Scalar reach, Tick<MeshScalar>& tick) noexcept {
    constexpr int most_counted = 1024;
    std::array<int, region_capacity> choice{};
    for (int tried = 0; tried < most_counted; ++tried) {
      if (tried < options.maximum_combinations) {
        ++combinations_;
        try_combination(scene, choice, reach, tick);
      } else {
        ++dropped_;
      }
      int i = 0;
      while (i < regions_.size() && ++choice[index(i)] >= found_[index(i)].candidates.size()) choice[index(i++)] = 0;
      if (i == regions_.size()) return;
    }
  }

  void try_combination(const Scene& scene, const std::array<int, region_capacity>& choice, Scalar reach,
                       Tick<MeshScalar>& tick) noexcept {
    constraints_.clear();
    for (int i = 0; i < regions_.size(); ++i) {
      if (found_[index(i)].candidates.empty()) continue;
      for (const CandidateConstraint& constraint : found_[index(i)].candidates[choice[index(i)]].constraints) {
        if (!constraints_.push_back({constraint, Scalar(0), i})) ++dropped_;
        // A piece of the free space that the tool cannot enter within a tick is not near.
        if (row_at(scene, constraint, pose_).gap < -reach) return;
      }
    }
    Pose<Scalar> pose = pose_;
    ActiveList active;
    bool is_capped = false;
    for (int round = 0; round < options.linearisations; ++round) {
      const Coordinates coordinates(pose);
      load(scene, coordinates, pose);
      if (is_capped) problem_.gradient.setZero();  // the smallest step that meets the rows
      tick.rows = std::max(tick.rows, problem_.row_count);
      QpStatus status = solver_.solve(problem_, qp_solution_);
      if (is_certified && status == QpStatus::infeasible) {
        relax(scene, pose);
        status = solver_.solve(problem_, qp_solution_);
      }
      if (status != QpStatus::optimal) return;
      if (!is_capped) note_active(active);
      pose = coordinates.pose_at(qp_solution_.step);
      if (scene.length_of(Twist<Scalar>::from_vector(qp_solution_.step)) < Scalar(scene.settings().step_tolerance) / 50) break;
      if constexpr (is_certified) {
        const Twist<Scalar> motion = motion_between(pose_, pose);
        const Scalar length = scene.length_of(motion);
        if (is_capped || !(length > trust_)) continue;
        is_capped = true;
        pose = moved(pose_, motion * (trust_ / length));
      }
    }
    const bool is_on_features = lies_on_features(scene, pose);
    // Where there is a certificate, it decides what lies beyond them: a feature that goes on with the next triangle may hold the tool.
    if (!is_chosen_by_box(pose) || !(is_certified || is_on_features)) return;
    keep({pose, scene.metric().energy(motion_between(target_, pose)), active, is_capped, is_on_features});
  }

  /// The constraints that held the tool in the last optimisation, without the sides of the box.
  void note_active(ActiveList& active) const noexcept {
    active.clear();
    for (const auto& row : qp_solution_.active) {
      if (row.row >= constraints_.size()) continue;
      active.push_back(constraints_[row.row]);
      active[active.size() - 1].multiplier = row.multiplier;
    }
  }

  /// Keeps the best solutions, the best first.
  void keep(const Solution& solution) noexcept {
    if (solutions_.full() && !(solution < solutions_[solutions_.size() - 1])) return;
    if (solutions_.full()) solutions_.pop_back();
    solutions_.push_back(solution);
    for (int i = solutions_.size() - 1; i > 0 && solutions_[i] < solutions_[i - 1]; --i) {
      std::swap(solutions_[i], solutions_[i - 1]);
    }
  }

  void load(const Scene& scene, const Coordinates& coordinates, const Pose<Scalar>& pose) noexcept {
    problem_.clear_rows();
    problem_.hessian = coordinates.hessian(scene.metric());
    problem_.gradient = coordinates.gradient(scene.metric(), target_);
    const Scalar margin = is_certified ? scene.margin() : Scalar(0);
    for (const Active& active : constraints_) {
      const Row row = row_at(scene, active.constraint, pose);
      problem_.add_row(coordinates.row(row.gradient()), margin - row.gap);
    }
    if constexpr (options.local_solution == LocalSolution::inside_box) {
      const Vector6<Scalar> last = coordinates.of(start_), goal = coordinates.of(target_);
      for (int k = 0; k < 6; ++k) {
        const Vector6<Scalar> axis = Vector6<Scalar>::Unit(k);
        problem_.add_row(axis, std::min(last[k], goal[k]));
        problem_.add_row(-axis, -std::max(last[k], goal[k]));
      }
    }
  }

  /// Where there is no room for the margin: no closer than at the certified pose.
  void relax(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    for (int i = 0; i < constraints_.size() && i < problem_.row_count; ++i) {
      const CandidateConstraint& constraint = constraints_[i].constraint;
      const Scalar certified = std::max(row_at(scene, constraint, pose_).gap, Scalar(0));
      const Scalar wanted = std::min(scene.margin(), certified) - row_at(scene, constraint, pose).gap;
      problem_.bounds[index(i)] = std::min(problem_.bounds[index(i)], wanted);
    }
  }

  bool lies_on_features(const Scene& scene, const Pose<Scalar>& pose) const noexcept {
    constexpr Scalar tolerance = Scalar(1e-9);
    return std::none_of(constraints_.begin(), constraints_.end(), [&](const Active& active) {
      return active.constraint.kind != FeaturePair::vertex_face && row_at(scene, active.constraint, pose).room < -tolerance;
    });
  }

  /// Whether eq. 5 lets a solution be chosen, where it selects.
  bool is_chosen_by_box([[maybe_unused]] const Pose<Scalar>& pose) const noexcept {
    if constexpr (options.local_solution == LocalSolution::selected_by_box) {
      const Coordinates coordinates(start_);
      const Vector6<Scalar> reached = coordinates.of(pose), goal = coordinates.of(target_);
      for (int k = 0; k < 6; ++k) {
        // Coordinates that meet to rounding, as both angles of a tool that does not turn, are no reason to refuse.
        const Scalar slack = box_slack;
        if (reached[k] < std::min(Scalar(0), goal[k]) - slack || reached[k] > std::max(Scalar(0), goal[k]) + slack) return false;
      }
    }
    return true;
  }

  /// The regions that hold the tool or touch it are the first contacts of the next tick.
  void keep_regions_in_contact(const Scene& scene) noexcept {
    const Pose<Scalar> frame = tool_frame(scene, pose_);
    for (int i = regions_.size() - 1; i >= 0; --i) {
      if (std::any_of(active_.begin(), active_.end(), [i](const Active& active) { return active.region == i; })) continue;
      Contact contact;
      if (separation_from(scene, regions_[i].triangle, frame, contact) < scene.margin()) continue;
      regions_.swap_remove(i);
      for (Active& active : active_) {
        if (active.region == regions_.size()) active.region = i;
      }
    }
  }

  /// Optimises, certifies the motion to the best solution that can be reached, and takes what blocks it among the first contacts, until
  /// the tool arrives.
  bool follow_certified(const Scene& scene, Tick<MeshScalar>& tick) noexcept
    requires is_certified
  {
    constexpr Scalar resting = Scalar(1e-11);
    const int maximum_iterations = std::min(scene.settings().maximum_iterations, Tick<MeshScalar>::path_capacity);
    trust_ = regions_.empty() ? std::numeric_limits<Scalar>::infinity() : scene.trust_radius();
    while (tick.iterations < maximum_iterations && tick.work < scene.settings().work_budget) {
      ++tick.iterations;
      optimise(scene, tick);
      bool is_new = false;
      Advance best;
      for (const Solution& solution : solutions_) {
        const Twist<Scalar> motion = motion_between(pose_, solution.pose);
        const Scalar length = scene.length_of(motion);
        if (length <= resting) {
          active_ = solution.active;
          return true;
        }
        const auto result =
            certificate_.certify(scene, pose_, motion, tick.work, tick.work + scene.settings().work_budget);
        if (!result.blockers.empty()) is_new = admit(scene, result) || is_new;
        const Pose<Scalar> reached = moved(pose_, motion * (result.is_exhausted ? Scalar(0) : result.time));
        const bool is_there = result.is_whole();
        const Scalar energy = scene.metric().energy(motion_between(target_, reached));
        if (best.solution == nullptr || is_there || energy < best.energy) {
          best = {&solution, reached, energy, length, length * result.time, is_there};
        }
        if (is_there) break;
      }
      if (best.solution == nullptr) return false;
      if (is_new && !best.is_there) {  // with the new regions there are better solutions
        trust_ = scene.trust_radius();
        continue;
      }
      // Creeping up to what blocks would only use up the clearance.
      if (best.is_there || best.moved > best.length / 8) {
        if (best.is_there) active_ = best.solution->active;
        const bool is_whole = best.is_there && !best.solution->is_capped;
        pose_ = is_whole && active_.empty() ? target_ : best.pose;
        tick.path.push_back(scene.tool_pose(pose_));
        if (is_whole && (active_.empty() || best.length < Scalar(scene.settings().step_tolerance))) return true;
      }
      trust_ = best.is_there ? std::min(2 * trust_, scene.trust_radius()) : std::min(trust_, best.length) / 4;
      if (trust_ < resting) break;
    }
    return false;
  }

  /// Blockers near no region become regions; false when there were none.
  bool admit(const Scene& scene, const SweepResult<Scalar>& result) noexcept {
    const Pose<Scalar> frame = tool_frame(scene, pose_);
    const LocalSearch<Tool, MeshScalar> search(scene.tool(), scene.object(), frame, Scalar(0));
    bool is_new = false;
    for (const auto& blocker : result.blockers) {
      const bool is_known = std::any_of(regions_.begin(), regions_.end(), [&](const Contact& region) {
        const auto ring = search.ring(region.triangle);
        return std::find(ring.begin(), ring.end(), blocker.triangle) != ring.end();
      });
      if (is_known) continue;
      Contact contact;
      separation_from(scene, blocker.triangle, frame, contact);
      if (!regions_.push_back(contact)) ++dropped_;
      is_new = true;
    }
    return is_new;
  }

  static constexpr Scalar box_slack = Scalar(1e-9);

  struct Nothing {
    void clear() noexcept {}
  };

  Pose<Scalar> pose_;    // where the graphic tool is
  Pose<Scalar> start_;   // where it was when the tick began
  Pose<Scalar> target_;  // the haptic pose
  Scalar trust_ = Scalar(0);  // longest motion proposed to the certificate [m]
  Scalar reach_ = Scalar(0);  // bound on what any tool point moves within the tick, if no fold lets it jump [m]
  FixedVector<Contact, options.maximum_regions> regions_;
  std::array<RegionCandidates, region_capacity> found_;
  FixedVector<Active, 128> constraints_;  // of the combination at hand
  FixedVector<Solution, is_certified ? 4 : 1> solutions_;
  ActiveList active_;
  Solver solver_;
  QpProblem<Scalar> problem_;
  QpSolution<Scalar> qp_solution_;
  [[no_unique_address]] std::conditional_t<is_certified, MotionCertificate<ToolType>, Nothing> certificate_;
  int combinations_ = 0;
  int dropped_ = 0;
};

/// The contact method of the paper, with its choices: `HapticRenderer<Tool, Solver, CandidateContacts<>>`.
template <CandidateOptions options = CandidateOptions{}>
struct CandidateContacts {
  template <ConvexTool Tool, QpSolver Solver>
  using Follower = CandidateContactsFollower<Tool, Solver, options>;
};

}  // namespace feeler
