// The dual active-set method of Goldfarb and Idnani, in operator form.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/best_row.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/kkt_check.hpp"
#include "feeler/qp/dual/problem_rows.hpp"
#include "feeler/qp/dual/row_scan.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/dual/solution_pair.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/solution.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// Starts at the unconstrained minimum, or where known rows hold, and adds the row that maximises violation²/(aᵀPa) until none is violated.
///
/// Source: D. Goldfarb, A. Idnani, "A numerically stable dual method for solving strictly convex quadratic programs", Mathematical Programming 27
/// (1983), in the operators of its section 3, `ActiveOperators`, kept by rank-one updates; a row that is nearly dependent on the active ones is
/// projected twice. An answer is optimal once `KktCheck` agrees, and infeasible once rows in conflict cancel; where
/// rounding prevents both, everything is done again with operators from an orthogonal factor.
template <RealScalar Scalar, int lanes>
class OperatorMethod {
 public:
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// @param known      rows to start from, which may not exist
  /// @param inverse    of the Hessian, inverted
  /// @param tolerance  violation of a row that is accepted [m]
  /// @param solution   with no rows, and a step of zero
  QpStatus solve(const Problem& problem, const WarmStart& known, const InverseHessian<Scalar>& inverse, const Six<Scalar>& gradient,
                 const Scalar& tolerance, Solution& solution) noexcept {
    inverse_ = &inverse;
    gradient_ = &gradient;
    tolerance_ = accepted_ = tolerance;
    bounds_ = problem.bounds.data();
    is_careful_ = false;
    dependent_angle_ = dependent_angle<Scalar>();
    QpStatus status = run(problem, known, solution);
    if (status == in_doubt) status = run_with_care(problem, solution);
    if (!pair_.is_finite()) {  // nor was the input: no step is the only one that is sure to be finite
      solution.conflict.clear();
      return in_doubt;
    }
    copy_six(pair_.x().data(), solution.step.data());
    for (int i = 0; i < pair_.rows().size(); ++i) solution.active.push_back({pair_.rows()[i], pair_.multipliers()[as_index(i)]});
    return status;
  }

 private:
  using Six = detail::Six<Scalar>;

  static constexpr QpStatus in_doubt = QpStatus::iteration_limit;  // of a run
  enum class Addition { done, refused, infeasible, in_doubt };

  /// What the choice of the next row knows.
  struct Pricing {
    bool is_weighed;  // the weights are those of the active rows
    bool is_measured = true;  // the violations were found from x just now
    bool is_strict = false;  // one that was found so was rounding alone
  };

  /// Of a row's weight with nothing active: where active rows leave less, rounding shows in it.
  static constexpr double clear_share = 1e-3;

  /// Starts again, with operators from an orthogonal factor and with bounds relaxed by most of the tolerance: rows that meet in one point only to
  /// within that then leave some room.
  QpStatus run_with_care(const Problem& problem, Solution& solution) noexcept {
    is_careful_ = true;
    const Scalar smallest_angle = 128 * std::numeric_limits<Scalar>::epsilon();
    Scalar rounding = (std::min)(rounding_at(pair_.x()), rounding_at(inverse_->inverse_times(*gradient_)));
    for (const double coarseness : {1.0, 1.0, 30.0, 1e6}) {
      relax_bounds(problem, rounding);
      dependent_angle_ = Scalar(coarseness) * smallest_angle;
      const QpStatus status = run(problem, WarmStart{}, solution);
      rounding = rounding_at(pair_.x());
      if (status == QpStatus::infeasible) return status;
      if (status == QpStatus::optimal && !scan_.is_violated(problem, problem.bounds.data(), pair_.x(), tolerance_, 2 * rounding)) return status;
    }
    return in_doubt;
  }

  void relax_bounds(const Problem& problem, Scalar rounding) noexcept {
    constexpr double share = 0.875;
    for (int k = 0; k < problem.row_count; ++k) {
      const Scalar allowed = tolerance_ + product(rounding, norm1(row_of(problem, k)));
      relaxed_bounds_[as_index(k)] = problem.bounds[as_index(k)] - product(Scalar(share), allowed);
    }
    bounds_ = relaxed_bounds_.data();
    accepted_ = Scalar(1 - share) * tolerance_;
  }

  /// The method itself.
  /// @param start  rows to make active first
  QpStatus run(const Problem& problem, const WarmStart& start, Solution& solution) noexcept {
    start_pair(problem, start);
    Pricing pricing{.is_weighed = pair_.rows().size() == 0};
    int entering = -1;
    if (pricing.is_weighed) {
      entering = scan_.start(problem, bounds_, *inverse_, pair_.x(), accepted_);
      if (entering < 0 && !scan_.is_violated(problem, bounds_, pair_.x(), accepted_)) return QpStatus::optimal;
    }
    const int limit = (is_careful_ ? 16 : 8) * (problem.row_count + 8);
    while (solution.iterations <= limit) {
      const Addition added = add_all(problem, limit, solution, entering, pricing);
      if (added != Addition::done) return added == Addition::infeasible ? QpStatus::infeasible : in_doubt;
      ++solution.iterations;
      const Scalar rounding = pricing.is_strict ? rounding_at(pair_.x()) : Scalar(0);
      const bool is_violated = is_any_violated(problem, rounding, pricing);
      entering = is_violated ? choose_entering(problem, rounding, pricing) : -1;
      if (entering < 0 && (pair_.rows().size() == 0 || !refine(problem))) return conclude_optimum(problem, is_violated);
    }
    return in_doubt;
  }

  /// The unconstrained minimum, or that on known rows, as long as they hold.
  [[gnu::always_inline]] inline void start_pair(const Problem& problem, const WarmStart& start) noexcept {
    pair_.reset(*inverse_, *gradient_, is_careful_);
    for (const int row : start.rows) assume(problem, row);
    pair_.drop_negative();
  }

  /// Whether a row is violated at x, by the problem itself.
  /// @param rounding  of x, where that is excused [m]
  [[gnu::always_inline]] inline bool is_any_violated(const Problem& problem, const Scalar& rounding, const Pricing& pricing) const noexcept {
    return pricing.is_strict ? scan_.is_violated(problem, bounds_, pair_.x(), accepted_, rounding)
                             : scan_.is_violated(problem, bounds_, pair_.x(), accepted_);
  }

  /// Nothing is left to enter or to refine: an optimum, unless rows have no value at x.
  [[gnu::always_inline]] inline QpStatus conclude_optimum(const Problem& problem, bool is_violated) const noexcept {
    const bool are_numbers = !is_violated || !scan_.is_violated(problem, bounds_, pair_.x(), std::numeric_limits<Scalar>::infinity());
    return are_numbers ? QpStatus::optimal : in_doubt;
  }

  /// Makes a row active, and those that the scan names after it; `done` where there is none any more.
  Addition add_all(const Problem& problem, int limit, Solution& solution, int entering, Pricing& pricing) noexcept {
    while (entering >= 0) {
      const Addition added = add(problem, limit, solution, entering);
      if (added == Addition::infeasible || added == Addition::in_doubt) return added;
      pricing.is_strict = pricing.is_strict || (pricing.is_measured && added == Addition::refused);
      pricing.is_measured = false;
    }
    return Addition::done;
  }

  /// The row to enter next, where one is violated; −1 if all those are active.
  int choose_entering(const Problem& problem, Scalar rounding, Pricing& pricing) noexcept {
    scan_.measure(problem, bounds_, pair_.x(), rounding);
    for (const int row : pair_.rows()) scan_.set_active(row);
    if (!pricing.is_weighed) scan_.weigh(problem, *inverse_, pair_.operators().projector());
    pricing.is_weighed = pricing.is_measured = true;
    const int entering = scan_.select(problem, accepted_);
    return entering < 0 ? most_violated(problem, rounding) : entering;
  }

  /// Of the rows that are not active; −1 if none is violated.
  ///
  /// Chosen by more digits than the scan has, as is needed where lengths or the Hessian are out of all proportion.
  int most_violated(const Problem& problem, Scalar rounding) const noexcept {
    int row = -1;
    Scalar most = accepted_;
    for (int k = 0; k < problem.row_count; ++k) {
      const Six a = row_of(problem, k);
      const Scalar violation = bounds_[k] - dot(a, pair_.x()) - product(rounding, norm1(a));
      if (violation > most && !pair_.has(k)) row = k, most = violation;
    }
    return row;
  }

  /// Whether no step along P·a meets the row that lacks `violation`: where its angle with the span of the
  /// active rows is too small or, with care, where the step leads far off.
  /// @param unconstrained  a·H⁻¹·a, about
  bool is_dependent(const Six& a, const Scalar& unconstrained, const Scalar& violation, const Scalar& slope) const noexcept {
    if (pair_.rows().full()) return true;
    if (!(slope > dependent_angle_ * dependent_angle_ * unconstrained)) return true;
    const Scalar clear = Scalar(1e-12);
    if (!is_careful_ || slope > clear * unconstrained) return false;
    return violation / slope * norm_inf(pair_.operators().image().step) > far_away(a, pair_.x(), violation);
  }

  /// a·H⁻¹·a, to all digits.
  Scalar exact_unconstrained_weight(const Six& a) const noexcept { return dot(a, inverse_->inverse_times(a)); }

  /// Makes a row active with equality, whatever the sign of its multiplier; leaves out rows that depend on
  /// others.
  void assume(const Problem& problem, int row) noexcept {
    if (row < 0 || row >= problem.row_count || pair_.rows().full() || pair_.has(row)) return;
    const Six a = row_of(problem, row);
    const Scalar unconstrained = exact_unconstrained_weight(a);
    pair_.operators().apply(a);
    const Scalar slope = pair_.slope_along(a);
    if (!(slope > Scalar(clear_share) * unconstrained)) return;
    const Scalar step = (bounds_[row] - dot(a, pair_.x())) / slope;
    pair_.move(step);
    pair_.add(row, a, step, slope);
  }

  /// Where the active rows or the gradient are off, takes one step of Newton's method and returns true.
  bool refine(const Problem& problem) noexcept {
    Six residual, lacking{}, force{};
    Scalar beside(0);
    for (int i = 0; i < pair_.rows().size(); ++i) {
      lacking[as_index(i)] = bounds_[pair_.rows()[i]] - dot(pair_.operators().normal(i), pair_.x());
      beside = (std::max)(beside, magnitude(lacking[as_index(i)]));
      subtract(pair_.operators().normal(i), Scalar(-pair_.multipliers()[as_index(i)]), force);
    }
    if (!kkt_check(problem).fails(*inverse_, *gradient_, pair_.x(), pair_.rows(), pair_.multipliers(), force, lacking, beside, residual))
      return false;

    pair_.correct(lacking, residual);
    return true;
  }

  /// Makes row p satisfied with equality, dropping rows whose multiplier would turn negative.
  /// @param p  afterwards the next row to add, or −1
  [[gnu::always_inline]] inline Addition add(const Problem& problem, int limit, Solution& solution, int& p) noexcept {
    const int row = p;
    const Six a = row_of(problem, row);
    const Scalar excused = rounding_of_dot(a, pair_.x());
    const auto lacking = [&] { return bounds_[row] - dot(a, pair_.x()); };
    Scalar violation = lacking();
    p = -1;
    if (!(violation > accepted_ + excused)) return Addition::refused;  // by the problem itself it is met
    Scalar unconstrained = scan_.rough_unconstrained_weight(row);
    Scalar multiplier(0);
    while (++solution.iterations <= limit) {
      pair_.operators().apply(a);
      Scalar slope = pair_.slope_along(a);
      if (!(slope >= Scalar(clear_share) * unconstrained)) {
        unconstrained = exact_unconstrained_weight(a);
        pair_.operators().project_again();
        slope = pair_.slope_along(a);
      }
      const bool has_no_step = is_dependent(a, unconstrained, violation, slope);

      Scalar step = has_no_step ? std::numeric_limits<Scalar>::infinity() : Scalar(violation / slope);
      const int leaving = pair_.first_to_leave(step);
      const bool is_full = leaving < 0;
      if (has_no_step && is_full) return conclude_conflict(problem, row, a, solution);
      if (!has_no_step) pair_.move(step);
      multiplier += step;
      if (is_full) {
        pair_.clamp_multipliers();
        p = scan_.add(problem, pair_.operators().image().step, step, slope, accepted_);
        scan_.set_active(row);
        if (p == row) p = -1;  // all others are violated by less than rounding leaves of this one, if at all
        pair_.add(row, a, multiplier, slope);
        if (is_careful_) refine(problem);
        return Addition::done;
      }
      if (has_no_step) pair_.move_multipliers(step);
      pair_.clamp_multipliers();
      const auto z = pair_.operators().image().step;
      const Six dual = pair_.operators().dual(leaving);
      const Scalar curvature = pair_.curve(dual);
      scan_.drop(problem, z, has_no_step ? Scalar(0) : step, dual, curvature);
      scan_.set_violation(pair_.rows()[leaving], Scalar(0));
      pair_.drop(leaving, dual, curvature);
      violation = lacking();
    }
    return Addition::in_doubt;
  }

  /// No step meets row p, as it is a sum of active ones with negative shares: then these rows contradict each
  /// other.
  [[gnu::noinline]]
  Addition conclude_conflict(const Problem& problem, int p, const Six& a, Solution& solution) noexcept {
    Six shares{}, rest;
    const bool is_sum = pair_.expand(a, shares, rest);
    const Scalar allowed = is_careful_ ? Scalar(-1) : tolerance_;  // with care the bounds are relaxed
    return kkt_check(problem).is_contradiction(p, a, rest, is_sum, pair_.x(), pair_.rows(), shares, allowed, solution) ? Addition::infeasible
                                                                                                                       : Addition::in_doubt;
  }

  KktCheck<Scalar> kkt_check(const Problem& problem) const noexcept { return KktCheck<Scalar>(problem, bounds_, accepted_); }

  const InverseHessian<Scalar>* inverse_ = nullptr;
  const Six* gradient_ = nullptr;
  SolutionPair<Scalar, lanes> pair_;
  RowScan<Scalar, lanes> scan_;
  const Scalar* bounds_ = nullptr;  // of the rows, and the violation of them that is accepted
  Scalar accepted_ = Scalar(0), tolerance_ = Scalar(0);
  alignas(64) std::array<Scalar, std::size_t(Problem::row_capacity)> relaxed_bounds_{};
  Scalar dependent_angle_ = Scalar(0);  // of a row with the span of others, in the metric of H⁻¹ [rad]
  bool is_careful_ = false;
};

}  // namespace feeler::detail
