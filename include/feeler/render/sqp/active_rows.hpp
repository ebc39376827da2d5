// The active rows of a step: what stopped it, and with what force.
#pragma once

#include "feeler/core/fixed_vector.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// The active set of a step, with its rows as they were where the step began. Where the next step goes back on it, each linearisation lacks what
/// stopped the other, and these rows are cuts.
template <class RowType, int capacity>
class ActiveRows {
 public:
  using Row = RowType;
  using Scalar = typename Row::Scalar;

  struct Stop {
    Row row;  ///< where the step began
    Scalar multiplier;  ///< of the metric [m]
    Scalar gap;  ///< after the step [m]
  };

  void clear() noexcept { stops_.clear(); }
  /// @param step     from the pose of linearisation, of which what was solved for may be more
  /// @param problem  `StepProblem`, solved
  template <class Problem>
  void remember(const Twist<Scalar>& step, const Problem& problem) noexcept {
    stops_.clear();
    step_ = step;
    for (const auto& active : problem.solution().active)
      stops_.push_back({problem.row(active.row), active.multiplier, problem.gap_after(active.row)});
  }

  const Stop* begin() const noexcept { return stops_.begin(); }
  const Stop* end() const noexcept { return stops_.end(); }
  /// The step that they stopped.
  const Twist<Scalar>& step() const noexcept { return step_; }

  /// Adds the rows, but for those assumed, to a problem that is linearised where the step ended; false if it has them all.
  /// @param required_gap_of  `StepProblem::Standing::required_gap` of a row [m]
  template <class Problem, class RequiredGapOf>
  bool keep_in(Problem& problem, const RequiredGapOf& required_gap_of) const noexcept {
    bool adds = false;
    const Displacement<Scalar> motion = step_;
    for (const Stop& stop : stops_) {
      const Row row = stop.row.carried(motion);
      if (row.is_assumed || problem.repeats(row)) continue;
      adds = problem.keep(row, required_gap_of(row)) || adds;
    }
    return adds;
  }

 private:
  FixedVector<Stop, capacity> stops_;
  Twist<Scalar> step_;
};

}  // namespace feeler
