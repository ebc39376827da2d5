// The optimisations of the paper's method: one for each combination of candidates over the regions of contact.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/index.hpp"
#include "feeler/paper/candidate_constraint.hpp"
#include "feeler/paper/candidate_options.hpp"
#include "feeler/paper/contact_regions.hpp"
#include "feeler/paper/local_search.hpp"
#include "feeler/paper/step_coordinates.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/solution.hpp"
#include "feeler/qp/unit_of_length.hpp"
#include "feeler/render/rendered_scene.hpp"
#include "feeler/render/tick.hpp"

namespace feeler {

/// Finds the candidates of every region, optimises for each combination of them, and keeps the best solutions (paper, sections III.C and
/// IV, steps 2.2 to 4).
template <ConvexTool ToolType, QpSolver Solver, CandidateOptions options>
class CombinationSearch {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Tool = typename Scene::Tool;
  using Regions = ContactRegions<ToolType, options.maximum_regions>;

  /// A constraint and, where it held the tool, its multiplier.
  struct Active {
    CandidateConstraint constraint;
    Scalar multiplier = Scalar(0);
    int region = 0;
  };
  using ActiveList = FixedVector<Active, QpSolution<Scalar>::active_capacity>;

  /// The solution of one combination.
  struct Solution {
    Pose<Scalar> pose;
    Scalar energy = Scalar(0);  ///< [m²]
    ActiveList active;
    bool is_capped = false;     ///< short of the optimum by the trust region
    bool is_on_features = true; ///< its contacts lie on the features that they are between

    /// Those on their features first, and of them the nearest to the haptic pose.
    bool operator<(const Solution& other) const noexcept { return is_on_features != other.is_on_features ? is_on_features : energy < other.energy; }
  };

  /// Between which poses solutions are looked for.
  struct Reach {
    Pose<Scalar> pose;    ///< where the graphic tool is
    Pose<Scalar> start;   ///< where it was when the tick began
    Pose<Scalar> target;  ///< the haptic pose
    Scalar distance;      ///< pieces of the free space farther away than that are left out [m]
    Scalar trust;         ///< longest motion proposed to the certificate [m]
  };

  explicit CombinationSearch(const Scene& scene) : near_vertices_(scene.tool().vertex_count()) {}

  /// Of the last search, the best first.
  const auto& solutions() const noexcept { return solutions_; }
  /// Combinations optimised since the tick began.
  int combinations() const noexcept { return combinations_; }
  /// Combinations, candidates and constraints left out since then because a bound was reached.
  int dropped() const noexcept { return dropped_; }

  void begin_tick() noexcept { combinations_ = dropped_ = 0; }

  static ContactRow<Scalar> row_at(const Scene& scene, const CandidateConstraint& constraint, const Pose<Scalar>& pose) noexcept {
    return row_of(constraint, scene.tool(), scene.object(), scene.tool_frame(pose), pose.translation);
  }

  /// Leaves the best solutions in `solutions`, none where no combination has one.
  /// @param tick  learns how many rows an optimisation had at most
  void solve(const Scene& scene, const Regions& regions, const Reach& reach, Tick<MeshScalar>& tick) noexcept {
    reach_ = reach;
    LocalSearch<Tool, MeshScalar> search(scene.tool(), scene.object(), scene.tool_frame(reach.pose), reach.distance, near_vertices_);
    for (int i = 0; i < regions.size(); ++i) {
      search.find(regions[i], found_[as_index(i)]);
      dropped_ += found_[as_index(i)].dropped;
    }
    solutions_.clear();
    try_combinations(scene, regions.size(), tick);
    // A tool that got inside is let out wherever that is nearest.
    if (!options.is_certified() && solutions_.empty()) {
      reach_.distance = std::numeric_limits<Scalar>::infinity();
      try_combinations(scene, regions.size(), tick);
    }
  }

 private:
  using Coordinates = StepCoordinates<Scalar, options.increments>;
  using Choice = std::array<int, std::size_t(options.maximum_regions)>;  // a candidate of each region

  void try_combinations(const Scene& scene, int region_count, Tick<MeshScalar>& tick) noexcept {
    constexpr int most_counted = 1024;
    Choice choice{};
    for (int tried = 0; tried < most_counted; ++tried) {
      if (tried < options.maximum_combinations) {
        ++combinations_;
        try_combination(scene, choice, region_count, tick);
      } else {
        ++dropped_;
      }
      int i = 0;
      while (i < region_count && ++choice[as_index(i)] >= found_[as_index(i)].candidates.size()) choice[as_index(i++)] = 0;
      if (i == region_count) return;
    }
  }

  void try_combination(const Scene& scene, const Choice& choice, int region_count, Tick<MeshScalar>& tick) noexcept {
    if (!gather_constraints(scene, choice, region_count)) return;
    Pose<Scalar> pose = reach_.pose;
    ActiveList active;
    bool is_capped = false;
    for (int round = 0; round < options.linearisations; ++round) {
      const Coordinates coordinates(pose);
      load(scene, coordinates, pose);
      if (is_capped) problem_.gradient.setZero();  // the smallest step that meets the rows
      tick.rows = (std::max)(tick.rows, problem_.row_count);
      if (!solve_or_relax(scene, pose)) return;
      if (!is_capped) note_active(active);
      pose = coordinates.pose_at(qp_solution_.step);
      if (scene.length_of(Twist<Scalar>::from_vector(qp_solution_.step)) < scene.very_short()) break;
      if constexpr (options.is_certified()) {
        const Twist<Scalar> motion = motion_between(reach_.pose, pose);
        const Scalar length = scene.length_of(motion);
        if (is_capped || !(length > reach_.trust)) continue;
        is_capped = true;
        pose = moved(reach_.pose, motion * (reach_.trust / length));
      }
    }
    const bool is_on_features = lies_on_features(scene, pose);
    // Where there is a certificate, it decides what lies beyond them: a feature that goes on with the next triangle may hold the tool.
    if (!is_chosen_by_box(scene, pose) || !(options.is_certified() || is_on_features)) return;
    keep({pose, scene.metric().energy(motion_between(reach_.target, pose)), active, is_capped, is_on_features});
  }

  /// The constraints of one candidate a region; false where they bound a piece of the free space that the tool cannot enter within a tick.
  bool gather_constraints(const Scene& scene, const Choice& choice, int region_count) noexcept {
    constraints_.clear();
    for (int i = 0; i < region_count; ++i) {
      if (found_[as_index(i)].candidates.empty()) continue;
      for (const CandidateConstraint& constraint : found_[as_index(i)].candidates[choice[as_index(i)]].constraints) {
        if (!constraints_.push_back({constraint, Scalar(0), i})) ++dropped_;
        if (row_at(scene, constraint, reach_.pose).gap < -reach_.distance) return false;
      }
    }
    return true;
  }

  /// Solves, where there is a certificate without the margin if need be; false where there is no solution.
  bool solve_or_relax(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    QpStatus status = optimise(scene.unit_of_solver());
    if (options.is_certified() && status == QpStatus::infeasible) {
      relax(scene, pose);
      status = optimise(scene.unit_of_solver());
    }
    return status == QpStatus::optimal;
  }
  QpStatus optimise(Scalar unit) noexcept {
    change_unit_of_length(problem_, unit);
    const QpStatus status = solver_.solve(problem_, qp_solution_);
    change_unit_of_length(problem_, Scalar(1) / unit);
    change_unit_of_length(qp_solution_, Scalar(1) / unit);
    return status;
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
    problem_.hessian = coordinates.hessian(scene.metric().along(), reach_.target);
    problem_.gradient = coordinates.gradient(scene.metric().along(), reach_.target);
    const Scalar margin = options.is_certified() ? scene.margin() : Scalar(0);
    for (const Active& active : constraints_) {
      const auto row = row_at(scene, active.constraint, pose);
      problem_.add_row(coordinates.row(row.gradient()), margin - row.gap);
    }
    if constexpr (options.local_solution == LocalSolution::inside_box) {
      const Vector6<Scalar> last = coordinates.of(reach_.start), goal = coordinates.of(reach_.target);
      for (int k = 0; k < 6; ++k) {
        const Vector6<Scalar> axis = Vector6<Scalar>::Unit(k);
        problem_.add_row(axis, (std::min)(last[k], goal[k]));
        problem_.add_row(-axis, -(std::max)(last[k], goal[k]));
      }
    }
  }

  /// Where there is no room for the margin: no closer than at the certified pose.
  void relax(const Scene& scene, const Pose<Scalar>& pose) noexcept {
    for (int i = 0; i < constraints_.size() && i < problem_.row_count; ++i) {
      const CandidateConstraint& constraint = constraints_[i].constraint;
      const Scalar certified = (std::max)(row_at(scene, constraint, reach_.pose).gap, Scalar(0));
      const Scalar wanted = (std::min)(scene.margin(), certified) - row_at(scene, constraint, pose).gap;
      problem_.bounds[as_index(i)] = (std::min)(problem_.bounds[as_index(i)], wanted);
    }
  }

  bool lies_on_features(const Scene& scene, const Pose<Scalar>& pose) const noexcept {
    const Scalar tolerance = scene.margin() / 1000;
    return std::none_of(constraints_.begin(), constraints_.end(), [&](const Active& active) {
      return active.constraint.kind != FeaturePair::vertex_face && row_at(scene, active.constraint, pose).room < -tolerance;
    });
  }

  /// Whether eq. 5 lets a solution be chosen, where it selects.
  bool is_chosen_by_box([[maybe_unused]] const Scene& scene, [[maybe_unused]] const Pose<Scalar>& pose) const noexcept {
    if constexpr (options.local_solution == LocalSolution::selected_by_box) {
      const Coordinates coordinates(reach_.start);
      const Vector6<Scalar> reached = coordinates.of(pose), goal = coordinates.of(reach_.target);
      for (int k = 0; k < 6; ++k) {
        // Coordinates that meet to rounding, as both angles of a tool that does not turn, are no reason to refuse.
        const Scalar slack = k < 3 ? scene.margin() / 1000 : Scalar(1e-9);
        if (reached[k] < (std::min)(Scalar(0), goal[k]) - slack || reached[k] > (std::max)(Scalar(0), goal[k]) + slack) return false;
      }
    }
    return true;
  }

  Reach reach_;
  std::array<RegionCandidates, std::size_t(options.maximum_regions)> found_;
  FixedVector<Active, 128> constraints_;  // of the combination at hand
  FixedVector<Solution, options.is_certified() ? 4 : 1> solutions_;
  Solver solver_;
  QpProblem<Scalar> problem_;
  QpSolution<Scalar> qp_solution_;
  int combinations_ = 0;
  int dropped_ = 0;
  VertexSet near_vertices_;  // of the region at hand
};

}  // namespace feeler
