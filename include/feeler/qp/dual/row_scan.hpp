// What an active-set method knows of every row: by how much it is violated, and how much of it is free to
// move.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "feeler/core/index.hpp"
#include "feeler/core/lane_reductions.hpp"
#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/unfused_product.hpp"
#include "feeler/qp/dual/best_row.hpp"
#include "feeler/qp/dual/inverse_hessian.hpp"
#include "feeler/qp/dual/problem_rows.hpp"
#include "feeler/qp/dual/six.hpp"
#include "feeler/qp/problem.hpp"

namespace feeler::detail {

/// Violations and weights of the rows of a problem, and the row to add by dual steepest edge: the largest
/// violation²/weight.
///
/// A row's violation is bₖ − aₖ·x and its weight aₖᵀPaₖ, with P the inverse Hessian projected off the active
/// rows. Both follow x and P by one product with each row: a step along z changes aₖ·x by a multiple of aₖ·z,
/// and adding or dropping a row changes P by a multiple of zzᵀ. A row that hardly moves is weighed as a
/// two hundredth of what it was with nothing active (`least_share`). Source: J. J. Forrest, D. Goldfarb,
/// "Steepest-edge simplex algorithms for linear programming", Mathematical Programming 57 (1992), the dual
/// algorithms of section 3, for their counterpart in linear programs. A row is computed in one lane by the same operations in the same
/// order, however many lanes there are.
///
/// All this only says which row to look at next, and for that few digits do: the rows of a problem in `double`
/// are followed in `float`, of which a processor takes twice as many at a time. Whether a row is violated, and
/// by how much, is to be computed from the problem itself.
template <RealScalar Scalar, int lanes>
class RowScan {
 public:
  using Problem = QpProblem<Scalar>;

  /// Computes violations and weights where nothing is active, and selects as `select` does.
  /// @param bounds  of the rows, here and below
  int start(const Problem& problem, const Scalar* bounds, const InverseHessian<Scalar>& inverse, const Six<Scalar>& x, Scalar tolerance) noexcept {
    return inverse.is_diagonal() ? start(problem, bounds, DiagonalForm(inverse.inverse_pivots()), x, tolerance)
                                 : start(problem, bounds, FullForm(inverse.matrix()), x, tolerance);
  }
  /// Computes weights where some rows are active.
  void weigh(const Problem& problem, const InverseHessian<Scalar>& inverse, const SixBySix<Scalar>& projector) noexcept {
    if (inverse.is_diagonal()) {
      weigh(problem, DiagonalForm(inverse.inverse_pivots()), FullForm(projector));
    } else {
      weigh(problem, FullForm(inverse.matrix()), FullForm(projector));
    }
  }

  /// Whether a row is violated at x by more than `tolerance`, or by NaN; nothing of it is kept.
  static bool is_violated(const Problem& problem, const Scalar* bounds, const Six<Scalar>& x, Scalar tolerance) noexcept {
    return is_above(problem, tolerance, Violation(bounds, x));
  }
  /// The same less what rounding makes of it.
  /// @param rounding  of a row's value at x, for a row of size one, here and below
  [[gnu::noinline]]
  static bool is_violated(const Problem& problem, const Scalar* bounds, const Six<Scalar>& x, Scalar tolerance, Scalar rounding) noexcept {
    return is_above(problem, tolerance, Excess(bounds, x, rounding));
  }
  /// Computes violations at x afresh, less what rounding makes of them.
  void measure(const Problem& problem, const Scalar* bounds, const Six<Scalar>& x, Scalar rounding) noexcept {
    const Excess excess(bounds, x, rounding);
    for (int k = 0; k < problem.row_count; k += coarse_lanes) store(&violation_[as_index(k)], coarse_violation(problem, k, excess));
  }

  /// An active row is not violated, whatever rounding says.
  void set_active(int k) noexcept { violation_[as_index(k)] = -std::numeric_limits<Coarse>::infinity(); }
  void set_violation(int k, Scalar violation) noexcept { violation_[as_index(k)] = Coarse(violation); }

  /// About aₖᵀH⁻¹aₖ; too much, or NaN, where single precision does not hold it.
  Scalar rough_unconstrained_weight(int k) const noexcept { return Scalar(least_weight_[as_index(k)]) * Scalar(1 / least_share); }

  /// The row to add; −1 if none is violated by more than `tolerance`, and also where no score is a number.
  int select(const Problem& problem, Scalar tolerance) const noexcept {
    const CoarseGroup threshold = spread<CoarseGroup>(Coarse(tolerance));
    Best best;
    for (int k = 0; k < problem.row_count; k += coarse_lanes) best.meet(load<CoarseGroup>(&violation_[as_index(k)]), weight_at(k), threshold);
    return best.row();
  }

  /// Follows a step of `length` along z and the change of P by −z·zᵀ/slope, then selects as above.
  template <class Step>
  int add(const Problem& problem, const Step& z, Scalar length, Scalar slope, Scalar tolerance) noexcept {
    const SixCoarse direction = spread_all<CoarseGroup>(z);
    const CoarseGroup step = spread<CoarseGroup>(Coarse(length));
    const CoarseGroup factor = spread<CoarseGroup>(Coarse(Scalar(1) / slope));
    const CoarseGroup threshold = spread<CoarseGroup>(Coarse(tolerance));
    Best best;
    const int count = problem.row_count;
    for (int k = 0; k < count; k += coarse_lanes) {
      const CoarseGroup along = dot_of_six<CoarseGroup>(coarse_rows(problem, k), direction);
      const CoarseGroup violation = load<CoarseGroup>(&violation_[as_index(k)]) - product(step, along);
      store(&violation_[as_index(k)], violation);
      store(&weight_[as_index(k)], CoarseGroup(load<CoarseGroup>(&weight_[as_index(k)]) - product(product(factor, along), along)));
      best.meet(violation, weight_at(k), threshold);
    }
    return best.row();
  }

  /// Follows a step of `length` along z and the change of P by +u·uᵀ/curvature.
  template <class Step>
  void drop(const Problem& problem, const Step& z, Scalar length, const Six<Scalar>& u, Scalar curvature) noexcept {
    const SixCoarse direction = spread_all<CoarseGroup>(z), freed = spread_all<CoarseGroup>(u);
    const CoarseGroup step = spread<CoarseGroup>(Coarse(length));
    const CoarseGroup factor = spread<CoarseGroup>(Coarse(Scalar(1) / curvature));
    const int count = problem.row_count;
    for (int k = 0; k < count; k += coarse_lanes) {
      const SixCoarse a = coarse_rows(problem, k);
      const CoarseGroup along = dot_of_six<CoarseGroup>(a, direction), gained = dot_of_six<CoarseGroup>(a, freed);
      store(&violation_[as_index(k)], CoarseGroup(load<CoarseGroup>(&violation_[as_index(k)]) - product(step, along)));
      store(&weight_[as_index(k)], CoarseGroup(load<CoarseGroup>(&weight_[as_index(k)]) + product(product(factor, gained), gained)));
    }
  }

 private:
  using Coarse = std::conditional_t<std::is_same_v<Scalar, double>, float, Scalar>;
  static constexpr bool is_rounded = !std::is_same_v<Coarse, Scalar>;
  static constexpr int coarse_lanes = is_rounded && lanes > 1 ? 2 * lanes : lanes;
  using Group = Lanes<Scalar, lanes>;
  using SixGroups = std::array<Group, 6>;
  using CoarseGroup = Lanes<Coarse, coarse_lanes>;
  using SixCoarse = std::array<CoarseGroup, 6>;
  using Best = BestRow<Coarse, coarse_lanes>;
  // A little longer than a power of two, as the columns of a `RowList`.
  using Values = std::array<Coarse, std::size_t(Problem::row_capacity + 16)>;
  struct Nothing {};

  /// aᵀQa with Q diagonal.
  class DiagonalForm {
   public:
    explicit DiagonalForm(const Six<Scalar>& q) noexcept : entries_(spread_all<CoarseGroup>(q)) {}
    [[gnu::always_inline]] CoarseGroup operator()(const SixCoarse& a) const noexcept {
      SixCoarse image;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) image[j] = product(entries_[j], a[j]);
      return dot_of_six<CoarseGroup>(a, image);
    }

   private:
    SixCoarse entries_;
  };
  /// aᵀQa with Q symmetric, by the entries on and below the diagonal.
  class FullForm {
   public:
    explicit FullForm(const SixBySix<Scalar>& q) noexcept {
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) {
#pragma GCC unroll 6
        for (std::size_t i = j; i < 6; ++i) entries_[j][i] = spread<CoarseGroup>(Coarse(i == j ? q[j][i] : q[j][i] + q[j][i]));
      }
    }
    [[gnu::always_inline]] CoarseGroup operator()(const SixCoarse& a) const noexcept {
      SixCoarse image;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) {
        image[j] = product(entries_[j][j], a[j]);
#pragma GCC unroll 6
        for (std::size_t i = j + 1; i < 6; ++i) image[j] += product(entries_[j][i], a[i]);
      }
      return dot_of_six<CoarseGroup>(a, image);
    }

   private:
    std::array<SixCoarse, 6> entries_;
  };

  /// bₖ − aₖ·x
  class Violation {
   public:
    Violation(const Scalar* bounds, const Six<Scalar>& x) noexcept : bounds_(bounds), at_(spread_all<Group>(x)) {}
    [[gnu::always_inline]] Group operator()(const SixGroups& a, int k) const noexcept { return load<Group>(bounds_ + k) - dot_of_six<Group>(a, at_); }

   private:
    const Scalar* bounds_;
    SixGroups at_;
  };
  /// The same less what rounding makes of it.
  class Excess {
   public:
    Excess(const Scalar* bounds, const Six<Scalar>& x, Scalar rounding) noexcept : violation_(bounds, x), unit_(spread<Group>(rounding)) {}
    [[gnu::always_inline]] Group operator()(const SixGroups& a, int k) const noexcept {
      SixGroups size;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) size[j] = greater(a[j], Group(-a[j]));
      const Group sum = ((size[0] + size[1]) + (size[2] + size[3])) + (size[4] + size[5]);
      return violation_(a, k) - product(unit_, sum);
    }

   private:
    Violation violation_;
    Group unit_;
  };

  template <class Spread, class V>
  static std::array<Spread, 6> spread_all(const V& v) noexcept {
    using Number = std::conditional_t<std::is_same_v<Spread, Group>, Scalar, Coarse>;
    std::array<Spread, 6> groups;
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) groups[j] = spread<Spread>(Number(v[j]));
    return groups;
  }
  [[gnu::always_inline]] SixCoarse coarse_rows(const Problem& problem, int k) const noexcept {
    if constexpr (is_rounded) {
      SixCoarse a;
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) a[j] = load<CoarseGroup>(&rows_[j][as_index(k)]);
      return a;
    } else {
      return rows_of<Group>(problem, k);
    }
  }
  [[gnu::always_inline]] CoarseGroup weight_at(int k) const noexcept {
    return greater(load<CoarseGroup>(&weight_[as_index(k)]), load<CoarseGroup>(&least_weight_[as_index(k)]));
  }

  /// Computes the groups of `Scalar` from row k on that make one group, and rounds them.
  template <class Compute>
  [[gnu::always_inline]] static CoarseGroup coarse_group(int k, const Compute& compute) noexcept {
    if constexpr (coarse_lanes > lanes) {
      return rounded<CoarseGroup>(compute(k), compute(k + lanes));
    } else {
      return rounded<CoarseGroup>(compute(k));
    }
  }
  [[gnu::always_inline]] SixCoarse round_rows(const Problem& problem, int k) noexcept {
    SixCoarse a;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) {
      const CoarseGroup entries = coarse_group(k, [&](int at) { return load<Group>(problem.rows.column(j) + at); });
      if constexpr (is_rounded) store(&rows_[as_index(j)][as_index(k)], entries);
      a[as_index(j)] = entries;
    }
    return a;
  }
  template <class Value>
  [[gnu::always_inline]] static CoarseGroup coarse_violation(const Problem& problem, int k, const Value& value_of) noexcept {
    const CoarseGroup violation = coarse_group(k, [&](int at) { return value_of(rows_of<Group>(problem, at), at); });
    return only_rows<Coarse, coarse_lanes>(violation, problem.row_count - k);
  }

  template <class Form>
  int start(const Problem& problem, const Scalar* bounds, const Form& form, const Six<Scalar>& x, Scalar tolerance) noexcept {
    const Violation violation_of(bounds, x);
    const CoarseGroup share = spread<CoarseGroup>(Coarse(least_share)), least = spread<CoarseGroup>(smallest_weight<Coarse>());
    const CoarseGroup threshold = spread<CoarseGroup>(Coarse(tolerance));
    Best best;
    for (int k = 0; k < problem.row_count; k += coarse_lanes) {
      const CoarseGroup violation = coarse_violation(problem, k, violation_of);
      const CoarseGroup weight = form(round_rows(problem, k)) + least;
      store(&violation_[as_index(k)], violation);
      store(&weight_[as_index(k)], weight);
      store(&least_weight_[as_index(k)], CoarseGroup(product(share, weight) + least));
      best.meet(violation, weight, threshold);
    }
    return best.row();
  }

  template <class Form>
  void weigh(const Problem& problem, const Form& unconstrained, const FullForm& free) noexcept {
    const CoarseGroup share = spread<CoarseGroup>(Coarse(least_share)), least = spread<CoarseGroup>(smallest_weight<Coarse>());
    for (int k = 0; k < problem.row_count; k += coarse_lanes) {
      const SixCoarse a = round_rows(problem, k);
      store(&weight_[as_index(k)], free(a));
      store(&least_weight_[as_index(k)], CoarseGroup(product(share, unconstrained(a)) + least));
    }
  }

  template <class Value>
  static bool is_above(const Problem& problem, Scalar tolerance, const Value& value_of) noexcept {
    const Group threshold = spread<Group>(tolerance);
    auto is_met = Group{} <= Group{};
    for (int k = 0; k < problem.row_count; k += lanes)
      is_met &= only_rows<Scalar, lanes>(value_of(rows_of<Group>(problem, k), k), problem.row_count - k) <= threshold;
    return !in_all_lanes<Scalar, lanes>(is_met);
  }
  // Columns of the problem's rows, where they are rounded.
  alignas(64) [[no_unique_address]] std::conditional_t<is_rounded, std::array<Values, 6>, Nothing> rows_;
  alignas(64) Values violation_;     // bₖ − aₖ·x; −∞ for active rows
  alignas(64) Values weight_;        // aₖᵀPaₖ
  alignas(64) Values least_weight_;  // a share of aₖᵀH⁻¹aₖ
};

}  // namespace feeler::detail
