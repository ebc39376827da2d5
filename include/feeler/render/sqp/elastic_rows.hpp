// Rows that may all be relaxed by the same amount, at a price: the elastic mode of the textbooks, solved with any QP solver.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "feeler/core/index.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/gram_schmidt.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler {

/// Solves  min ½ dᵀ H d + gᵀ d + c ξ  subject to  aₖᵀ d ≥ max(hardₖ, softₖ − ξ),  ξ ≥ 0.
///
/// The penalty of the largest violation with price c (J. Nocedal, S. Wright, "Numerical Optimization", 2nd ed., section 17.2): exact as long as the
/// multipliers of soft rows add up to no more than c. As it counts the largest violation, rows that repeat others change nothing.
///
/// The relaxation ξ grows from 0 to the least that will do. A QP without a solution names rows that contradict each other, Σ yₖ aₖ = 0 with y ≥ 0.
/// So Σ yₖ boundₖ ≤ 0 must hold, which tells how much ξ must be. Where the multipliers of soft rows add up to more than c, they fall by
/// 1ᵀ(A H⁻¹ Aᵀ)⁻¹ 1 for each unit of ξ, until other rows are active, and by its whole multiplier where a row reaches its hard bound: ξ is where their
/// sum is c, or falls past it.
template <RealScalar ScalarType, int row_capacity>
class ElasticRows {
 public:
  using Scalar = ScalarType;
  static constexpr int most_solves = 24;

  void clear() noexcept { size_ = 0; }
  /// Appends the bounds of the next row of a problem.
  void add(Scalar soft, Scalar hard) noexcept { rows_[as_index(size_++)] = {soft, (std::min)(hard, soft)}; }

  /// @param unit  the new unit of length, in the old one
  void change_unit(Scalar unit) noexcept {
    for (int k = 0; k < size_; ++k) {
      rows_[as_index(k)].soft /= unit;
      rows_[as_index(k)].hard /= unit;
    }
    relaxation_ /= unit;
    tolerance_ /= unit;
  }

  /// ξ of the last solution [m].
  Scalar relaxation() const noexcept { return relaxation_; }
  /// Whether the QPs allowed, fewer than `most_solves`, did not suffice: less relaxation may do.
  bool is_cut_short() const noexcept { return is_cut_short_; }
  /// Whether a row has its hard bound: more relaxation would not lower it.
  bool is_hard(int k) const noexcept { return !is_soft(k); }
  /// The relaxation that a step of zero needs [m].
  Scalar relaxation_at_rest() const noexcept {
    Scalar most(0);
    for (int k = 0; k < size_; ++k) most = (std::max)(most, rows_[as_index(k)].soft);
    return most;
  }

  /// @param problem  its Hessian, gradient and rows are given; its bounds become those that hold
  /// @param price    c
  /// @param least    smallest change of ξ worth a QP: some tolerances of the solver [m]
  /// @param allowed  QPs, `most_solves` at most; with the last one rows are relaxed by what is surely enough
  /// @param start    rows that are likely to be active
  /// @return  QPs solved, or 0 where not even the hard bounds have a solution, to the solver's tolerance
  /// @cost    noexcept, no allocation; one QP where nothing is to be relaxed
  template <QpSolver Solver>
  int solve(Solver& solver, QpProblem<Scalar>& problem, Scalar price, Scalar least, int allowed, const WarmStart& start,
            QpSolution<Scalar>& solution) noexcept {
    const int last = (std::min)(allowed, most_solves);
    const Scalar most = most_relaxation();
    Search search{.price = price, .least = least, .most = most, .high = most};
    tolerance_ = least;
    relaxation_ = Scalar(0);
    is_cut_short_ = false;
    for (int solves = 1; solves <= last; ++solves) {
      const bool is_last = solves == last;
      if (is_last) {
        const Scalar surely_enough = (std::min)(relaxation_at_rest(), search.high);
        relaxation_ = search.low < surely_enough ? surely_enough : search.high;
        is_cut_short_ = allowed < most_solves;
      }
      load(problem);
      const QpStatus status = solves == 1 ? solve_from(solver, problem, start, solution) : solver.solve(problem, solution);
      if (status == QpStatus::optimal) {
        if (is_last || !follow_multipliers(problem, solution, search)) return solves;
      } else {
        if (is_last || status != QpStatus::infeasible || !resolve_conflict(problem, solution, search)) return 0;
      }
    }
    return 0;
  }

 private:
  struct Row {
    Scalar soft, hard;
  };

  /// The search for the least relaxation that will do.
  struct Search {
    Scalar price, least;  // as `solve` has them
    Scalar most;  // with more no row is relaxed further [m]
    Scalar low = Scalar(0), high;  // the relaxation lies between [m]
    bool is_least = true;  // with less than the one at hand there is no solution
    bool is_high_enough = false;  // the multipliers there said so: else it has not been tried
  };

  /// Rows that do not depend on each other, but for rounding.
  struct Independent {
    static constexpr int most = GramSchmidt<Scalar>::capacity;
    GramSchmidt<Scalar> basis;
    std::array<int, std::size_t(most)> rows;

    /// @param image  of the row: itself, or H⁻¹ times it
    void add(int row, const Vector6<Scalar>& vector, const Vector6<Scalar>& image) noexcept {
      const auto expansion = basis.expand(vector, image);
      const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
      if (basis.size() == most || !(expansion.free_squared > rounding * rounding * expansion.squared)) return;
      rows[as_index(basis.size())] = row;
      basis.add(expansion);
    }
  };

  /// A solver that knows no warm start does without.
  template <QpSolver Solver>
  static QpStatus solve_from(Solver& solver, const QpProblem<Scalar>& problem, const WarmStart& start, QpSolution<Scalar>& solution) noexcept {
    if constexpr (requires { solver.solve(problem, start, solution); }) {
      return solver.solve(problem, start, solution);
    } else {
      return solver.solve(problem, solution);
    }
  }

  Scalar bound(int k) const noexcept {
    const Row& row = rows_[as_index(k)];
    return (std::max)(row.hard, row.soft - relaxation_);
  }
  /// Whether more relaxation would lower the bound of a row.
  bool is_soft(int k) const noexcept { return kink(k) > relaxation_ + tolerance_; }
  /// The relaxation with which a row comes to its hard bound.
  Scalar kink(int k) const noexcept { return rows_[as_index(k)].soft - rows_[as_index(k)].hard; }
  /// With more no row is relaxed further [m].
  Scalar most_relaxation() const noexcept {
    Scalar most(0);
    for (int k = 0; k < size_; ++k) most = (std::max)(most, kink(k));
    return most;
  }
  void load(QpProblem<Scalar>& problem) const noexcept {
    for (int k = 0; k < size_; ++k) problem.bounds[as_index(k)] = bound(k);
  }
  /// Where rows contradict each other, relaxes them by more; false where that does not help.
  bool resolve_conflict(const QpProblem<Scalar>& problem, const QpSolution<Scalar>& solution, Search& search) noexcept {
    if (!(relaxation_ < search.high)) return false;
    search.low = relaxation_;
    relaxation_ = (std::min)(search.low + (std::max)(lack(problem, solution), search.least), search.high);
    search.is_least = true;
    return true;
  }

  /// Where the multipliers of an optimum tell that less will do, or that more is cheaper, chooses what to solve with next; false where neither is so.
  /// As long as the same rows are active and none comes to its hard bound, or leaves it, their sum is linear in ξ: a secant finds where it is the price.
  bool follow_multipliers(const QpProblem<Scalar>& problem, const QpSolution<Scalar>& solution, Search& search) noexcept {
    Scalar above(0), below(0);  // the sums with a little more ξ, and with a little less
    Scalar next_kink = search.high, last_kink = search.low;
    for (const auto& active : solution.active) {
      const Scalar hard_from = kink(active.row);
      if (is_soft(active.row)) {
        above += active.multiplier;
        next_kink = (std::min)(next_kink, hard_from);
      }
      if (hard_from > relaxation_ - tolerance_) below += active.multiplier;
      else last_kink = (std::max)(last_kink, hard_from);
    }
    const Scalar resolution = (std::max)(search.least, search.most / 1000);
    Scalar next;
    if (above > search.price) {
      if (!(relaxation_ < search.high)) return false;
      search.low = relaxation_;
      next = (std::min)(relaxation_ + (std::max)((above - search.price) / fall_of_sum(problem, solution), search.least), next_kink);
    } else {
      if (search.is_least || below >= search.price - search.price / 1000 || relaxation_ - search.low <= resolution) return false;
      search.high = relaxation_;
      search.is_high_enough = true;
      next = (std::max)(relaxation_ - (search.price - below) / fall_of_sum(problem, solution), last_kink);
    }
    search.is_least = false;
    const bool is_between = search.low < next && (next < search.high || !search.is_high_enough);
    relaxation_ = is_between ? next : (search.low + search.high) / 2;
    return true;
  }
  /// By how much more rows that contradict each other must be relaxed.
  Scalar lack(const QpProblem<Scalar>& problem, const QpSolution<Scalar>& solution) const noexcept {
    const auto& rows = solution.conflict;
    const int last = rows.size() - 1;
    if (last < 1) return Scalar(0);
    Independent others;
    for (int i = 0; i < last; ++i) others.add(rows[i], problem.rows[as_index(rows[i])], problem.rows[as_index(rows[i])]);
    const Vector6<Scalar> row = problem.rows[as_index(rows[last])];
    const auto along_others = others.basis.expand(row, row).coefficients;
    Scalar lacking = bound(rows[last]), soft = is_soft(rows[last]) ? Scalar(1) : Scalar(0);
    for (int i = 0; i < others.basis.size(); ++i) {
      const Scalar weight = (std::max)(Scalar(-along_others[as_index(i)]), Scalar(0));
      const int k = others.rows[as_index(i)];
      lacking += weight * bound(k);
      if (is_soft(k)) soft += weight;
    }
    return soft > Scalar(0) ? lacking / soft : Scalar(0);
  }

  /// By how much the multipliers of soft rows fall for each unit of ξ, as long as the same rows are active; positive.
  Scalar fall_of_sum(const QpProblem<Scalar>& problem, const QpSolution<Scalar>& solution) const noexcept {
    const Scalar none = std::numeric_limits<Scalar>::epsilon();
    detail::InverseHessian<Scalar> hessian;
    if (!hessian.factor(problem.hessian)) return none;
    Independent actives;
    for (const auto& active : solution.active) {
      const Vector6<Scalar> row = problem.rows[as_index(active.row)];
      detail::Six<Scalar> image;
      for (int j = 0; j < 6; ++j) image[as_index(j)] = row[j];
      image = hessian.solve(image);
      actives.add(active.row, row, Eigen::Map<const Vector6<Scalar>>(image.data()));
    }
    std::array<Scalar, Independent::most> soft{};
    for (int i = 0; i < actives.basis.size(); ++i) soft[as_index(i)] = is_soft(actives.rows[as_index(i)]) ? Scalar(1) : Scalar(0);
    const auto change = actives.basis.solve(soft);
    Scalar fall(0);
    for (int i = 0; i < actives.basis.size(); ++i) fall += soft[as_index(i)] * change[as_index(i)];
    return (std::max)(fall, none);
  }

  int size_ = 0;
  Scalar relaxation_ = Scalar(0);
  Scalar tolerance_ = Scalar(0);  // of the kinks [m]
  bool is_cut_short_ = false;
  std::array<Row, std::size_t(row_capacity)> rows_;
};

}  // namespace feeler
