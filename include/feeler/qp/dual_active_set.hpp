// The default QP solver: the dual active-set method of Goldfarb and Idnani, in operator form.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "feeler/core/lanes.hpp"
#include "feeler/qp/active_operators.hpp"
#include "feeler/qp/best_row.hpp"
#include "feeler/qp/dual_tableau.hpp"
#include "feeler/qp/held_minimum.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/row_scan.hpp"
#include "feeler/qp/six.hpp"
#include "feeler/qp/solution.hpp"
#include "feeler/qp/table_by_columns.hpp"
#include "feeler/qp/warm_start.hpp"
#include "feeler/qp/whole_table.hpp"

namespace feeler {

/// Dual active set: starts at the unconstrained minimum and adds the most violated row until none is left.
///
/// Source: D. Goldfarb, A. Idnani, "A numerically stable dual method for solving strictly convex quadratic
/// programs", Mathematical Programming 27 (1983), in the operators of its section 3,
/// `detail::ActiveOperators`, kept by rank-one updates; a row that is nearly dependent on the active ones is
/// projected twice. The row to add maximises violation²/(aᵀPa) (dual steepest edge, `detail::RowScan`). An
/// answer is optimal once a fresh look at all rows and at the gradient agrees, and infeasible once rows in
/// conflict cancel; where rounding prevents both, everything is done again with operators from an orthogonal
/// factor. Where the rows to start from are the active ones, or the only row there is, the same look confirms the
/// minimum on them (`detail::HeldMinimum`), and no operator is made; nor where there are not many rows, of which a table
/// tells which are active, or which contradict each other (`detail::DualTableau`).
///
/// Rows are met to `tolerance` [m]. Rows that make an angle below about 1e-8 rad with the span of the active
/// ones count as dependent. The same input gives the same bits, with every number of lanes and,
/// on x86, with all flags of the compiler. Cost: two products with every row, and one more for each row
/// added; noexcept, no allocation.
/// @tparam lanes  rows computed side by side; by default what the compiler may use
template <RealScalar ScalarType, int lanes = detail::lanes_of<ScalarType>>
class DualActiveSet {
 public:
  using Scalar = ScalarType;
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// Violation of a row that is accepted [m].
  Scalar tolerance = Scalar(2e-13);

  QpStatus solve(const Problem& problem, Solution& solution) noexcept {
    return solve(problem, WarmStart{}, solution);
  }

  /// Starts from rows that are likely to be active.
  [[gnu::noinline]]
  QpStatus solve(const Problem& problem, const WarmStart& start, Solution& solution) noexcept {
    solution.active.clear();
    solution.conflict.clear();
    solution.iterations = 0;
    solution.step.setZero();
    if (!inverse_.factor(problem.hessian)) return QpStatus::not_positive_definite;
    std::copy_n(problem.gradient.data(), 6, gradient_.begin());

    is_careful_ = false;
    bounds_ = problem.bounds.data();
    accepted_ = tolerance;
    dependent_angle_ = detail::dependent_angle<Scalar>();
    WarmStart alone;  // a row alone is most likely active
    if (problem.row_count == 1) alone.rows.push_back(0);
    const WarmStart* known = start.rows.empty() ? &alone : &start;
    if ((!known->rows.empty() || problem.row_count == 0) && guess_.find(problem, bounds_, *known, inverse_, gradient_) &&
        is_right(problem, *known, 1, solution))
      return QpStatus::optimal;
    if (problem.row_count <= SomeRows::row_capacity) {
      const bool is_few = problem.row_count <= FewRows::row_capacity;
      const Outcome outcome = is_few ? solve_by_table(few_, problem, solution) : solve_by_table(some_, problem, solution);
      if (outcome != Outcome::in_doubt) return outcome == Outcome::optimal ? QpStatus::optimal : QpStatus::infeasible;
      known = is_few ? &few_.active() : &some_.active();
    }
    inverse_.invert();
    Outcome outcome = run(problem, *known, solution);
    if (outcome == Outcome::in_doubt) outcome = run_with_care(problem, solution);
    if (!is_finite()) {  // nor was the input: no step is the only one that is sure to be finite
      solution.conflict.clear();
      return QpStatus::iteration_limit;
    }
    std::copy_n(x_.begin(), 6, solution.step.data());
    for (int i = 0; i < operators_.used(); ++i)
      solution.active.push_back({slots_[index(i)], multipliers_[index(i)]});
    if (outcome == Outcome::optimal) return QpStatus::optimal;
    return outcome == Outcome::infeasible ? QpStatus::infeasible : QpStatus::iteration_limit;
  }

 private:
  using Six = detail::Six<Scalar>;
  using Operators = detail::ActiveOperators<Scalar, lanes>;
  static constexpr int table_lanes = std::min(lanes, 4);  // more make a few rows no quicker
  using FewRows = detail::DualTableau<Scalar, table_lanes, detail::WholeTable<Scalar, table_lanes>>;
  using SomeRows = detail::DualTableau<Scalar, table_lanes, detail::TableByColumns<Scalar, table_lanes>>;

  enum class Outcome { optimal, infeasible, in_doubt };
  enum class Entry { done, refused, infeasible, in_doubt };

  static std::size_t index(int i) noexcept { return std::size_t(i); }

  /// Whether the minimum on known rows is that of the problem: then that is all there is to do.
  [[gnu::always_inline]] inline bool is_right(const Problem& problem, const WarmStart& known, int iterations, Solution& solution) noexcept {
    using std::isfinite;
    const Six& x = guess_.x();
    if (!isfinite(detail::size_of(x)) || scan_.is_violated(problem, bounds_, x, accepted_)) return false;
    const int count = known.rows.size();
    const auto normal_of = [&](int i) { return row_of(problem, known.rows[i]); };
    if (Six residual; is_off(x, count, normal_of, guess_.multipliers(), guess_.force(), guess_.lacking(), guess_.beside(), residual)) return false;
    std::copy_n(x.begin(), 6, solution.step.data());
    for (int i = 0; i < count; ++i) solution.active.push_back({known.rows[i], guess_.multipliers()[index(i)]});
    solution.iterations = iterations;
    return true;
  }

  /// Has a table find the active rows of a problem of some rows, or rows that contradict each other, and looks at them afresh.
  template <class Tableau>
  [[gnu::noinline]]
  Outcome solve_by_table(Tableau& tableau, const Problem& problem, Solution& solution) noexcept {
    const bool is_found = tableau.find(problem, bounds_, inverse_, gradient_, accepted_);
    if (!is_found && tableau.refused() < 0) return Outcome::in_doubt;
    const WarmStart& active = tableau.active();
    const auto change_for = [&](const auto& distances) { return tableau.change_for(distances); };
    guess_.place(problem, bounds_, active, tableau.multipliers(), inverse_, gradient_, change_for, accepted_ / 2);
    if (is_found) return is_right(problem, active, 1 + tableau.steps(), solution) ? Outcome::optimal : Outcome::in_doubt;
    return is_contradicted(tableau, problem, solution) ? Outcome::infeasible : Outcome::in_doubt;
  }

  /// Whether the row that a table refuses contradicts the active ones.
  template <class Tableau>
  [[gnu::noinline]]
  bool is_contradicted(const Tableau& tableau, const Problem& problem, Solution& solution) noexcept {
    using std::isfinite;
    const Six a = row_of(problem, tableau.refused());
    const auto& rows = tableau.active().rows;
    Six rest = a;
    const auto normal_of = [&](int i) { return row_of(problem, rows[i]); };
    for (int i = 0; i < rows.size(); ++i) detail::subtract(normal_of(i), tableau.shares()[index(i)], rest);
    if (!isfinite(detail::size_of(guess_.x())) || detail::size_of(rest) > allowed_rest(a)) return false;
    if (!is_conflict(tableau.refused(), a, rest, true, guess_.x(), rows.begin(), rows.size(), normal_of, tableau.shares(), solution)) return false;
    std::copy_n(guess_.x().begin(), 6, solution.step.data());
    for (int i = 0; i < rows.size(); ++i) solution.active.push_back({rows[i], guess_.multipliers()[index(i)]});
    solution.iterations = tableau.steps();
    return true;
  }

  /// Starts again with operators from an orthogonal factor, and uses up most of the tolerance, so that rows
  /// that agree within it meet in more than a point.
  Outcome run_with_care(const Problem& problem, Solution& solution) noexcept {
    is_careful_ = true;
    const Scalar smallest_angle = 128 * std::numeric_limits<Scalar>::epsilon();
    Scalar rounding = std::min(detail::rounding_at(x_), detail::rounding_at(inverse_.inverse_times(gradient_)));
    for (const double coarseness : {1.0, 1.0, 30.0, 1e6}) {
      relax_bounds(problem, rounding);
      dependent_angle_ = Scalar(coarseness) * smallest_angle;
      const Outcome outcome = run(problem, WarmStart{}, solution);
      rounding = detail::rounding_at(x_);
      if (outcome == Outcome::infeasible) return outcome;
      if (outcome == Outcome::optimal &&
          !scan_.is_violated(problem, problem.bounds.data(), x_, tolerance, 2 * rounding))
        return outcome;
    }
    return Outcome::in_doubt;
  }

  void relax_bounds(const Problem& problem, Scalar rounding) noexcept {
    constexpr double share = 0.875;
    for (int k = 0; k < problem.row_count; ++k) {
      const Scalar allowed = tolerance + detail::product(rounding, detail::size_of(row_of(problem, k)));
      relaxed_bounds_[index(k)] = problem.bounds[index(k)] - detail::product(Scalar(share), allowed);
    }
    bounds_ = relaxed_bounds_.data();
    accepted_ = Scalar(1 - share) * tolerance;
  }

  Outcome run(const Problem& problem, const WarmStart& start, Solution& solution) noexcept {
    operators_.reset(inverse_);
    x_ = inverse_.inverse_times(gradient_);
    for (Scalar& coordinate : x_) coordinate = -coordinate;
    for (const int row : start.rows) assume(problem, row);
    drop_negative();

    bool is_weighed = operators_.used() == 0, is_measured = true, is_strict = false;
    int entering = -1;
    if (is_weighed) {
      entering = scan_.start(problem, bounds_, inverse_, x_, accepted_);
      if (entering < 0 && !scan_.is_violated(problem, bounds_, x_, accepted_)) return Outcome::optimal;
    }
    const int limit = (is_careful_ ? 16 : 8) * (problem.row_count + 8);
    while (solution.iterations <= limit) {
      while (entering >= 0) {
        const Entry entry = enter(problem, limit, solution, entering);
        if (entry == Entry::infeasible) return Outcome::infeasible;
        if (entry == Entry::in_doubt) return Outcome::in_doubt;
        is_strict = is_strict || (is_measured && entry == Entry::refused);
        is_measured = false;
      }
      ++solution.iterations;
      const Scalar rounding = is_strict ? detail::rounding_at(x_) : Scalar(0);
      const bool is_violated = is_strict ? scan_.is_violated(problem, bounds_, x_, accepted_, rounding)
                                         : scan_.is_violated(problem, bounds_, x_, accepted_);
      if (is_violated) {
        scan_.measure(problem, bounds_, x_, rounding);
        mark_active();
        if (!is_weighed) scan_.weigh(problem, inverse_, operators_.projector());
        is_weighed = is_measured = true;
        entering = scan_.select(problem, accepted_);
        if (entering < 0) entering = most_violated(problem, rounding);
      }
      if (entering < 0 && (operators_.used() == 0 || !refine())) {
        const bool are_numbers = !is_violated || !scan_.is_violated(problem, bounds_, x_, std::numeric_limits<Scalar>::infinity());
        return are_numbers ? Outcome::optimal : Outcome::in_doubt;
      }
    }
    return Outcome::in_doubt;
  }

  /// Of the rows that are not active; −1 if none is violated.
  ///
  /// Chosen by more digits than the scan has, as is needed where lengths or the Hessian are out of all proportion.
  int most_violated(const Problem& problem, Scalar rounding) const noexcept {
    int row = -1;
    Scalar most = accepted_;
    for (int k = 0; k < problem.row_count; ++k) {
      const Six a = row_of(problem, k);
      const Scalar violation = bounds_[k] - detail::dot(a, x_) - detail::product(rounding, detail::size_of(a));
      const auto slots = slots_.begin();
      if (violation > most && std::find(slots, slots + operators_.used(), k) == slots + operators_.used()) row = k, most = violation;
    }
    return row;
  }

  bool is_finite() const noexcept {
    using std::abs;
    using std::isfinite;
    Scalar sum(0);
    for (const Scalar& coordinate : x_) sum += abs(coordinate);
    for (int i = 0; i < operators_.used(); ++i) sum += multipliers_[index(i)];
    return isfinite(sum);
  }

  static Six row_of(const Problem& problem, int k) noexcept {
    Six a;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) a[index(j)] = problem.rows.column(j)[k];
    return a;
  }

  /// Whether no step along P·a meets the row that lacks `violation`: where its angle with the span of the
  /// active rows is too small or, with care, where the step leads far off.
  bool is_dependent(const Six& a, const Scalar& whole, const Scalar& violation,
                    const Scalar& slope) const noexcept {
    if (operators_.used() == Operators::slot_count) return true;
    if (!(slope > dependent_angle_ * dependent_angle_ * whole)) return true;
    const Scalar clear = Scalar(1e-12);
    if (!is_careful_ || slope > clear * whole) return false;
    return violation / slope * detail::largest_of(operators_.image().step) > far_away(a, x_, violation);
  }

  /// A length that no step to a row that lacks `violation` has, in all reason.
  static Scalar far_away(const Six& a, const Six& x, const Scalar& violation) noexcept {
    return Scalar(1e6) * (detail::largest_of(x) + violation / detail::size_of(a));
  }

  /// a·H⁻¹·a, to all digits.
  Scalar whole_weight(const Six& a) const noexcept { return detail::dot(a, inverse_.inverse_times(a)); }
  Scalar slope_along(const Six& a) const noexcept { return detail::dot_of_six<Scalar>(a, operators_.image().step); }

  void mark_active() noexcept {
    for (int i = 0; i < operators_.used(); ++i) scan_.set_active(slots_[index(i)]);
  }

  /// Makes a row active with equality, whatever the sign of its multiplier; leaves out rows that depend on
  /// others.
  void assume(const Problem& problem, int row) noexcept {
    if (row < 0 || row >= problem.row_count || operators_.used() == Operators::slot_count) return;
    for (int i = 0; i < operators_.used(); ++i) {
      if (slots_[index(i)] == row) return;
    }
    const Six a = row_of(problem, row);
    const Scalar whole = whole_weight(a);
    operators_.apply(a);
    const Scalar slope = slope_along(a);
    if (!(slope > Scalar(detail::least_share) * whole)) return;
    const Scalar step = (bounds_[row] - detail::dot(a, x_)) / slope;
    move(step);
    activate(row, a, step, slope);
  }

  /// Drops active rows until no multiplier is negative.
  void drop_negative() noexcept {
    while (operators_.used() > 0) {
      const auto least = std::min_element(multipliers_.begin(), multipliers_.begin() + operators_.used());
      if (!(*least < Scalar(0))) return;
      const int slot = int(least - multipliers_.begin());
      const Six dual = operators_.dual(slot);
      const Scalar curvature = curve(dual);
      const Scalar step = -*least / curvature;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) x_[j] += detail::product(step, dual[j]);
      move_multipliers(-step);
      release(slot, dual, curvature);
    }
  }

  /// Whether the active rows or the gradient are off.
  /// @param count     of active rows
  /// @param force     of them, the sum of their normals by their multipliers
  /// @param lacking   by how much x falls short of each of them
  /// @param beside    and lies beside one at most
  /// @param residual  of the gradient, to be found
  template <class NormalOf, class Multipliers, class Distances>
  [[gnu::always_inline]] inline bool is_off(const Six& x, int count, const NormalOf& normal_of, const Multipliers& multipliers, const Six& force,
                                            const Distances& lacking, const Scalar& beside, Six& residual) const noexcept {
    const Six bent = inverse_.hessian_times(x);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) residual[j] = (bent[j] + gradient_[j]) - force[j];
    const Scalar rounding_of_sum = 1024 * std::numeric_limits<Scalar>::epsilon(), off = detail::size_of(residual);
    const Scalar size = detail::size_of(bent) + detail::size_of(gradient_);
    if (beside <= accepted_ && off <= rounding_of_sum * size) return false;
    return is_off_for_its_size(x, count, normal_of, multipliers, lacking, off / rounding_of_sum - size);
  }
  /// What the sizes of the rows excuse is seldom needed.
  /// @param excess  of the residual, in units of its rounding
  template <class NormalOf, class Multipliers, class Distances>
  [[gnu::noinline]] bool is_off_for_its_size(const Six& x, int count, const NormalOf& normal_of, const Multipliers& multipliers,
                                             const Distances& lacking, Scalar excess) const noexcept {
    const Scalar rounding = detail::rounding_at(x);
    for (int i = 0; i < count; ++i) {
      const Scalar row_size = detail::size_of(normal_of(i));
      excess -= detail::product(multipliers[index(i)], row_size);
      if (detail::magnitude(lacking[index(i)]) > accepted_ + detail::product(rounding, row_size)) return true;
    }
    return excess > Scalar(0);
  }

  /// Where the active rows or the gradient are off, takes one step of Newton's method and returns true.
  bool refine() noexcept {
    const auto normal_of = [this](int i) -> const Six& { return operators_.normal(i); };
    Six residual, lacking{}, force{};
    Scalar beside(0);
    for (int i = 0; i < operators_.used(); ++i) {
      lacking[index(i)] = bounds_[slots_[index(i)]] - detail::dot(normal_of(i), x_);
      beside = std::max(beside, detail::magnitude(lacking[index(i)]));
      detail::subtract(normal_of(i), Scalar(-multipliers_[index(i)]), force);
    }
    if (!is_off(x_, operators_.used(), normal_of, multipliers_, force, lacking, beside, residual)) return false;

    const Six across = operators_.step_of(lacking);
    const Six pulled = inverse_.hessian_times(across);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) residual[j] += pulled[j];
    operators_.apply(residual);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += across[j] - operators_.image().step[j];
    move_multipliers(Scalar(-1));
    drop_negative();
    return true;
  }

  /// Makes row p satisfied with equality, dropping rows whose multiplier would turn negative.
  /// @param p  afterwards the next row to add, or −1
  Entry enter(const Problem& problem, int limit, Solution& solution, int& p) noexcept {
    const int row = p;
    const Six a = row_of(problem, row);
    const Scalar excused = detail::rounding_of_dot(a, x_);
    const auto lacking = [&] { return bounds_[row] - detail::dot(a, x_); };
    Scalar violation = lacking();
    p = -1;
    if (!(violation > accepted_ + excused)) return Entry::refused;  // a fresh look says that it is met
    Scalar whole = scan_.whole_weight(row);
    Scalar multiplier(0);
    while (++solution.iterations <= limit) {
      operators_.apply(a);
      Scalar slope = slope_along(a);
      if (!(slope >= Scalar(detail::least_share) * whole)) {
        whole = whole_weight(a);
        operators_.project_again();
        slope = slope_along(a);
      }
      const bool has_no_step = is_dependent(a, whole, violation, slope);

      const Scalar infinity = std::numeric_limits<Scalar>::infinity();
      Scalar dual_step = infinity;
      int leaving = -1;
      for (int i = 0; i < operators_.used(); ++i) {
        const Scalar& share = operators_.image().share[index(i)];
        if (share > Scalar(0) && multipliers_[index(i)] < dual_step * share) {
          dual_step = multipliers_[index(i)] / share;
          leaving = i;
        }
      }
      if (has_no_step && leaving < 0) return conclude_conflict(row, a, solution);

      const Scalar full_step = has_no_step ? infinity : Scalar(violation / slope);
      const bool is_full = full_step <= dual_step;
      const Scalar step = is_full ? full_step : dual_step;
      if (!has_no_step) move(step);
      multiplier += step;
      if (is_full) {
        clamp_multipliers();
        p = scan_.add(problem, operators_.image().step, step, slope, accepted_);
        scan_.set_active(row);
        if (p == row) p = scan_.select(problem, accepted_);  // rounding says that it is still violated
        activate(row, a, multiplier, slope);
        if (is_careful_) refine();
        return Entry::done;
      }
      if (has_no_step) move_multipliers(step);
      clamp_multipliers();
      const auto z = operators_.image().step;
      const Six dual = operators_.dual(leaving);
      const Scalar curvature = curve(dual);
      scan_.drop(problem, z, has_no_step ? Scalar(0) : step, dual, curvature);
      scan_.set_violation(slots_[index(leaving)], Scalar(0));
      release(leaving, dual, curvature);
      violation = lacking();
    }
    return Entry::in_doubt;
  }

  /// No step meets row p, as it is a sum of active ones with negative shares: then these rows contradict each
  /// other.
  Entry conclude_conflict(int p, const Six& a, Solution& solution) noexcept {
    Six shares{}, rest = a;
    bool is_sum = false;
    for (int round = 0; round < 2 && !is_sum; ++round) {  // what rounding left of it is in the span as well
      if (round > 0) operators_.apply(rest);
      rest = a;
      for (int i = 0; i < operators_.used(); ++i) {
        Scalar& share = shares[index(i)];
        share = std::min(Scalar(share + operators_.image().share[index(i)]), Scalar(0));
        detail::subtract(operators_.normal(i), share, rest);
      }
      is_sum = !(detail::size_of(rest) > allowed_rest(a));
    }
    const auto normal_of = [this](int i) -> const Six& { return operators_.normal(i); };
    return is_conflict(p, a, rest, is_sum, x_, slots_.begin(), operators_.used(), normal_of, shares, solution) ? Entry::infeasible : Entry::in_doubt;
  }

  /// What rounding leaves of a row that is a sum of others.
  static Scalar allowed_rest(const Six& a) noexcept {
    return std::max(Scalar(1e-12), Scalar(64 * std::numeric_limits<Scalar>::epsilon())) * detail::size_of(a);
  }

  /// Whether row p and active rows, whose sum it is but for a rest, contradict each other; then they are the conflict of the solution.
  ///
  /// They do not where a step could use the rest, or where all of them together agree within their tolerances.
  /// @param rows    active at x, `count` of them
  /// @param shares  of each in row p, none positive
  template <class Rows, class NormalOf>
  bool is_conflict(int p, const Six& a, const Six& rest, bool is_sum, const Six& x, Rows rows, int count, const NormalOf& normal_of, const Six& shares,
                   Solution& solution) const noexcept {
    const Scalar rounding = detail::rounding_at(x);
    const auto allowed = [&](const Six& row) {
      return is_careful_ ? Scalar(0) : Scalar(tolerance + detail::product(rounding, detail::size_of(row)));
    };
    Scalar slack = allowed(a), violation = bounds_[p] - detail::dot(a, x);
    for (int i = 0; i < count; ++i) {
      const Six normal = normal_of(i);
      slack -= detail::product(shares[index(i)], allowed(normal));
      const Scalar drift = bounds_[rows[i]] - detail::dot(normal, x);  // of x off this row
      violation -= detail::product(shares[index(i)], drift);
    }
    // A step some times as long as this one could use the rest; where that is more than rounding leaves, a far longer one.
    const Scalar reach = is_sum || is_careful_ ? Scalar(16 * detail::largest_of(x)) : far_away(a, x, violation);
    if (!(violation > slack + detail::size_of(rest) * reach)) return false;
    solution.conflict.push_back(p);
    for (int i = 0; i < count; ++i) {
      if (shares[index(i)] < -Scalar(1e-9)) solution.conflict.push_back(rows[i]);
    }
    return true;
  }

  /// A step along P·a, and what it does to the multipliers.
  void move(const Scalar& step) noexcept {
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += detail::product(step, operators_.image().step[j]);
    move_multipliers(step);
  }
  void move_multipliers(const Scalar& step) noexcept {
    using Group = detail::Lanes<Scalar, lanes>;
    const Group by = detail::spread<Group>(step);
    for (std::size_t g = 0; g < index(operators_.used()); g += std::size_t(lanes)) {
      const Group change = detail::product<Group>(by, detail::load<Group>(&operators_.image().share[g]));
      detail::store(&multipliers_[g], Group(detail::load<Group>(&multipliers_[g]) - change));
    }
  }
  void clamp_multipliers() noexcept {
    using Group = detail::Lanes<Scalar, lanes>;
    for (std::size_t g = 0; g < index(operators_.used()); g += std::size_t(lanes))
      detail::store(&multipliers_[g], detail::greater<Group>(detail::load<Group>(&multipliers_[g]), Group{}));
  }

  /// Applies the operators to H·dual and returns dual·H·dual.
  Scalar curve(const Six& dual) noexcept {
    const Six curved = inverse_.hessian_times(dual);
    operators_.apply(curved);
    return detail::dot(dual, curved);
  }

  void activate(int row, const Six& a, const Scalar& multiplier, const Scalar& slope) noexcept {
    const int slot = operators_.used();
    slots_[index(slot)] = row;
    multipliers_[index(slot)] = multiplier;
    operators_.add(a, slope);
    if (is_careful_) operators_.rebuild(inverse_);
  }

  void release(int slot, const Six& dual, const Scalar& curvature) noexcept {
    operators_.drop(slot, inverse_, dual, curvature);
    const std::size_t last = index(operators_.used());
    slots_[index(slot)] = slots_[last];
    multipliers_[index(slot)] = multipliers_[last];
    if (is_careful_) operators_.rebuild(inverse_);
  }

  detail::InverseHessian<Scalar> inverse_;
  detail::HeldMinimum<Scalar, table_lanes> guess_;
  FewRows few_;
  SomeRows some_;
  Operators operators_;
  detail::RowScan<Scalar, lanes> scan_;
  const Scalar* bounds_ = nullptr;     // of the rows, and the violation of them that is accepted
  Scalar accepted_ = Scalar(0);
  alignas(64) std::array<Scalar, std::size_t(Problem::row_capacity)> relaxed_bounds_{};
  Six gradient_{};
  Six x_{};
  typename Operators::Column multipliers_{};  // a number a slot in use
  std::array<int, 6> slots_{};
  Scalar dependent_angle_ = Scalar(0);  // of a row with the span of others, in the metric of H⁻¹ [rad]
  bool is_careful_ = false;
};

static_assert(QpSolver<DualActiveSet<double>>);

}  // namespace feeler
