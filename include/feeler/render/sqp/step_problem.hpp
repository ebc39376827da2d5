// The optimisation of one step: rows that keep a margin where they can, and the Newton step on the Lagrangian.
#pragma once

#include <algorithm>
#include <optional>

#include "feeler/contact/contact_row.hpp"
#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/unit_of_length.hpp"
#include "feeler/qp/warm_start.hpp"
#include "feeler/render/sqp/elastic_rows.hpp"
#include "feeler/render/sqp/lagrangian_hessian.hpp"
#include "feeler/render/sqp/last_forces.hpp"
#include "feeler/spatial/turned_metric.hpp"

namespace feeler {

/// Solves for one step d of the tool: min f(d) + price · ξ subject to gapₖ + Jₖ d ≥ max(leastₖ, margin − ξ).
///
/// ξ is what is missing of the margin where most is missing (`ElasticRows`). Its price is a multiple of the pull of the hand (`set_price`), so no step
/// goes away from the hand for more than the margin is worth. `leastₖ` is what a step is to leave of the separation of the pair at the last certified pose
/// (`Clearance::to_leave`), or a fifth of the margin where that is less. That pose meets it, so a step exists. Without clearance it is 0. Many rows ask
/// the same then, and chance would tell which of them hold the tool: those that have not held it lately are asked for a hair less, so that the
/// same few hold it.
/// @tparam RowType  a `ContactRow`, or one with another curvature
template <QpSolver Solver, int rows = 128, class RowType = ContactRow<typename Solver::Scalar>>
class StepProblem {
 public:
  using Scalar = typename Solver::Scalar;
  using Row = RowType;
  static constexpr int row_capacity = rows;
  static_assert(row_capacity <= QpProblem<Scalar>::row_capacity);

  /// What is known of the pair that a row is of.
  struct Standing {
    Scalar required_gap;  ///< `Clearance::to_leave` of the separation at the last certified pose [m]
    bool is_spare = false;  ///< it has not held the tool lately: where there is no clearance others are to hold it
  };

  /// @param unit  of length, in which the solver is to work [m]; a power of two
  explicit StepProblem(Scalar unit = Scalar(1)) noexcept : unit_(unit) {}

  void clear() noexcept {
    rows_.clear();
    standings_.clear();
    kept_ = 0;
    is_solved_ = false;
  }
  /// Appends a row; false when there is no room.
  bool add(const Row& row, const Standing& standing) noexcept { return rows_.push_back(row) && standings_.push_back(standing); }
  /// Whether a row in the problem asks the same as another, which is left out for it.
  bool repeats(const Row& other) noexcept {
    const auto same = std::find_if(rows_.begin(), rows_.end(), [&other](const Row& row) { return other.repeats(row); });
    if (same == rows_.end()) return false;
    return same->is_repeated = true;
  }
  /// Moves the rows to where a motion from the pose of linearisation ends, less those kept and those for which `standing_of(row)` is empty.
  template <class StandingOf>
  void carry(const Displacement<Scalar>& motion, const StandingOf& standing_of) noexcept {
    const int count = rows_.size() - kept_;
    standings_.clear();
    for (int i = 0; i < count; ++i) {
      Row& row = rows_[standings_.size()];
      row = rows_[i].carried(motion);
      if (const std::optional<Standing> standing = standing_of(row)) standings_.push_back(*standing);
    }
    while (rows_.size() > standings_.size()) rows_.pop_back();
    kept_ = 0;
    is_solved_ = false;
  }
  /// Appends a row that held where the motion began, to hold where it ends; no other row may follow.
  bool keep(const Row& row, Scalar required_gap) noexcept {
    if (!add(row, {required_gap})) return false;
    ++kept_;
    return true;
  }
  /// How many QPs the next steps may take each; a few in any case.
  void limit_solves(int most) noexcept { allowed_solves_ = (std::max)(most, 3); }
  /// QPs that the last step took.
  int solves() const noexcept { return solves_; }
  /// Whether the rows are those of the last solution, and some kept or added since.
  bool is_solved() const noexcept { return is_solved_; }
  /// Whether the solver found the minimum of the last QP. Where it gave up the step is zero, or as far as it got, and proves nothing.
  bool is_optimal() const noexcept { return is_optimal_; }
  /// ξ of the last solution [m].
  Scalar relaxation() const noexcept { return elastic_.relaxation(); }
  /// Whether the work did not suffice to find the least ξ.
  bool is_cut_short() const noexcept { return elastic_.is_cut_short(); }
  /// Whether the last solution leaves some of the margin out.
  bool is_relaxed() const noexcept { return elastic_.relaxation() > Scalar(0); }
  /// What the margin that the last step wins is worth, to first order [m²].
  Scalar worth_of_margin() const noexcept { return price_ * (elastic_.relaxation_at_rest() - elastic_.relaxation()); }
  /// Whether an assumed row stopped the last step.
  bool rests_on_assumption() const noexcept {
    return std::any_of(solution_.active.begin(), solution_.active.end(), [this](const auto& active) { return rows_[active.row].is_assumed; });
  }
  /// Whether a kept row stopped the last step.
  bool rests_on_kept() const noexcept {
    return std::any_of(solution_.active.begin(), solution_.active.end(), [this](const auto& active) { return active.row >= rows_.size() - kept_; });
  }
  /// Whether a row stopped the last step at a hard bound farther away than `kept` [m]: the next step may pass it.
  bool rests_on_the_way(Scalar kept) const noexcept {
    return std::any_of(solution_.active.begin(), solution_.active.end(),
                       [&](const auto& active) { return elastic_.is_hard(active.row) && gap_after(active.row) > kept; });
  }
  /// Whether the contacts that stopped the last step are still between the same features after it.
  bool keeps_features() const noexcept {
    return std::all_of(solution_.active.begin(), solution_.active.end(),
                       [this](const auto& active) { return rows_[active.row].outlasts(solution_.step); });
  }
  /// Whether a motion from the pose of linearisation leaves every row a gap of at least `least` [m], as far as the same features meet.
  bool leaves_gaps(const Displacement<Scalar>& motion, Scalar least) const noexcept {
    return std::all_of(rows_.begin(), rows_.end(), [&](const Row& row) { return carried_gap(row, motion) >= least; });
  }
  int row_count() const noexcept { return rows_.size(); }
  const Row& row(int k) const noexcept { return rows_[k]; }
  const QpSolution<Scalar>& solution() const noexcept { return solution_; }
  /// Separation of a row after the step, to first order [m].
  Scalar gap_after(int k) const noexcept { return rows_[k].gap + problem_.rows[as_index(k)].dot(solution_.step); }
  /// Room that the last step left to a row before it would stop it, to first order [m]; 0 for an active one.
  Scalar room_after(int k) const noexcept { return problem_.rows[as_index(k)].dot(solution_.step) - problem_.bounds[as_index(k)]; }

  /// The step with the Hessian of f alone: the way home, where no row holds.
  const Vector6<Scalar>& solve_gauss_newton(const TurnedMetric<Scalar>& metric, const Twist<Scalar>& graphic_from_haptic, Scalar margin) noexcept {
    load_rows(margin);
    if (!metric.is_turned() && metric.along().is_isotropic()) {
      detail::set_symmetric(problem_.hessian, detail::diagonal_of(metric.along().diagonal()));
    } else {
      problem_.hessian = metric.homing_hessian(graphic_from_haptic);
    }
    problem_.gradient = metric.gradient(graphic_from_haptic);
    set_price(metric, graphic_from_haptic, margin);
    solve_elastic();
    is_free_ = solution_.active.empty();
    is_newton_ = true;
    if (is_free_) last_forces_.clear();
    return solution_.step;
  }
  /// After `solve_gauss_newton`, or a close guess: where contacts hold, the step with the Hessian of the Lagrangian.
  const Vector6<Scalar>& solve_newton(const TurnedMetric<Scalar>& metric, const Twist<Scalar>& graphic_from_haptic) noexcept {
    if (is_free_) return solution_.step;
    gauss_newton_ = solution_;
    is_newton_ = set_lagrangian(problem_, metric, graphic_from_haptic, rows_, gauss_newton_.active);
    solve_elastic(WarmStart(gauss_newton_));
    // Without its rows the curvature they were given means nothing.
    if (solution_.active.empty()) solution_ = gauss_newton_;
    remember_forces();
    return solution_.step;
  }
  /// What the forces of the last step are worth in the next one.
  enum class Guess {
    none,  ///< no contact held the tool, or one that did is gone: nothing was solved
    wrong,  ///< no contact holds it now, or not all rows can have the margin: `solve_gauss_newton` is to follow
    close,  ///< other contacts hold it, or with other forces: `solve_newton` is to follow
    right,  ///< the step is what `solve_newton` would find
  };
  /// Both at once, with the forces of the last step in place of those of a Gauss-Newton step (sequential quadratic programming).
  Guess solve_newton_by_guess(const TurnedMetric<Scalar>& metric, const Twist<Scalar>& graphic_from_haptic, Scalar margin) noexcept {
    if (last_forces_.empty() || !last_forces_.find(rows_, gauss_newton_.active)) return Guess::none;
    load_rows(margin);
    set_price(metric, graphic_from_haptic, margin);
    is_newton_ = set_lagrangian(problem_, metric, graphic_from_haptic, rows_, gauss_newton_.active);
    solve_elastic(WarmStart(gauss_newton_));
    if (solution_.active.empty() || is_relaxed()) return Guess::wrong;
    is_free_ = false;
    if (!has_forces_like(gauss_newton_)) return Guess::close;
    remember_forces();
    return Guess::right;
  }
  /// Knows nothing of earlier steps.
  void forget() noexcept { last_forces_.clear(); }
  /// Whether no contact holds the tool: the last Gauss-Newton step was not stopped by any row, nor a guess after it.
  bool is_free() const noexcept { return is_free_; }
  /// Whether the last Newton step had the Hessian of the Lagrangian whole: else steps shrink by a ratio only, and a short one is not the last.
  bool is_newton() const noexcept { return is_newton_; }

  /// The smallest step that meets the rows.
  const Vector6<Scalar>& restore(const TurnedMetric<Scalar>& metric, Scalar margin) noexcept {
    load_rows(margin);
    if (metric.is_turned()) problem_.hessian = metric.matrix();
    else detail::set_symmetric(problem_.hessian, detail::diagonal_of(metric.along().diagonal()));
    problem_.gradient.setZero();
    solve_elastic();
    return solution_.step;
  }

 private:
  /// Whether the last solution has the active rows of another, and their multipliers to an eighth of its largest.
  bool has_forces_like(const QpSolution<Scalar>& other) const noexcept {
    Scalar largest(0), change(0);
    for (const auto& active : solution_.active) {
      const auto before = std::find_if(other.active.begin(), other.active.end(), [&active](const auto& a) { return a.row == active.row; });
      if (before == other.active.end()) return false;
      largest = (std::max)(largest, active.multiplier);
      change = (std::max)({change, active.multiplier - before->multiplier, before->multiplier - active.multiplier});
    }
    return solution_.active.size() == other.active.size() && 8 * change <= largest;
  }

  /// Where rows have given up the margin only a Gauss-Newton step knows which.
  void remember_forces() noexcept {
    if (is_relaxed()) last_forces_.clear();
    else last_forces_.remember(solution_.active, rows_);
  }

  void load_rows(Scalar margin) noexcept {
    problem_.clear_rows();
    elastic_.clear();
    const Scalar hair = some_tolerances * unit_;
    for (int k = 0; k < rows_.size(); ++k) {
      const Row& row = rows_[k];
      const Standing& standing = standings_[k];
      const bool yields = standing.is_spare && !(standing.required_gap > Scalar(0));
      const Scalar soft = margin - row.gap - (yields ? hair : Scalar(0));
      problem_.add_row(row.gradient(), soft);
      elastic_.add(soft, (yields ? -hair : (std::min)(standing.required_gap, margin / 5)) - row.gap);
    }
  }

  /// Some times the force with which the hand pulls, as a translation of the tool; with next to no force still enough to win the margin back.
  void set_price(const TurnedMetric<Scalar>& metric, const Twist<Scalar>& graphic_from_haptic, Scalar margin) noexcept {
    using std::sqrt;
    price_ = price_per_force * (sqrt(2 * metric.energy(graphic_from_haptic)) + margin);
  }

  /// @param start  rows that are likely to be active
  void solve_elastic(const WarmStart& start = {}) noexcept {
    change_unit(unit_);
    solve_in_unit(start);
    change_unit(Scalar(1) / unit_);
    change_unit_of_length(solution_, Scalar(1) / unit_);
  }
  /// Of all that a solution depends on.
  void change_unit(Scalar unit) noexcept {
    if (unit_ == Scalar(1)) return;
    change_unit_of_length(problem_, unit);
    elastic_.change_unit(unit);
    price_ /= unit;
  }
  void solve_in_unit(const WarmStart& start) noexcept {
    is_solved_ = is_optimal_ = true;
    solves_ = elastic_.solve(solver_, problem_, price_, some_tolerances, allowed_solves_, start, solution_);
    if (solves_ > 0 && !goes_too_far()) return;
    ++solves_;
    // Rounding or curvature may leave a row short of its hard bound by a hair, which rows that all but contradict each other win back far away or
    // nowhere: stay where rows allow it.
    for (int k = 0; k < problem_.row_count; ++k) problem_.bounds[as_index(k)] = (std::min)(problem_.bounds[as_index(k)], Scalar(0));
    is_optimal_ = solver_.solve(problem_, solution_) == QpStatus::optimal;
    if (!is_optimal_) {
      solution_.step.setZero();
      solution_.active.clear();
    }
  }

  /// Whether the last step costs more than all the margin that is missing is worth.
  bool goes_too_far() const noexcept {
    if (!is_relaxed()) return false;
    const Vector6<Scalar>& step = solution_.step;
    const Vector6<Scalar> change = problem_.hessian.template selfadjointView<Eigen::Lower>() * step;
    return step.dot(change / 2 + problem_.gradient) > price_ * elastic_.relaxation_at_rest();
  }

  inline static const Scalar price_per_force = Scalar(24);
  inline static const Scalar some_tolerances = Scalar(1e-12);  // of a solver, in its unit

  Solver solver_;
  QpProblem<Scalar> problem_;
  QpSolution<Scalar> solution_;
  QpSolution<Scalar> gauss_newton_;  // or what is taken for one
  LastForces<Row> last_forces_;
  bool is_free_ = true;
  bool is_newton_ = true;
  FixedVector<Row, row_capacity> rows_;
  int kept_ = 0;  // of them, at the end
  FixedVector<Standing, row_capacity> standings_;  // of each row
  ElasticRows<Scalar, row_capacity> elastic_;
  Scalar unit_;
  Scalar price_ = Scalar(0);  // of the margin, in the unit of multipliers
  int allowed_solves_ = ElasticRows<Scalar, row_capacity>::most_solves, solves_ = 0;
  bool is_solved_ = false;  // since the rows were last cleared
  bool is_optimal_ = true;  // as the solver says of the last QP
};

}  // namespace feeler
