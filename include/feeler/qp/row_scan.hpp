// What an active-set method knows of every row: by how much it is violated, and how much of it is free to
// move.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/best_row.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/six.hpp"

namespace feeler::detail {

/// Violations and weights of the rows of a problem, and the row to add by dual steepest edge: the largest
/// violation²/weight.
///
/// A row's violation is bₖ − aₖ·x and its weight aₖᵀPaₖ, with P the inverse Hessian projected off the active
/// rows. Both follow x and P by one product with each row: a step along z changes aₖ·x by a multiple of aₖ·z,
/// and adding or dropping a row changes P by a multiple of zzᵀ. A row that hardly moves is weighed as a
/// thousandth of what it was with nothing active. Source: J. J. Forrest, D. Goldfarb, "Steepest-edge simplex
/// algorithms for linear programming", Mathematical Programming 57 (1992), the dual algorithms of section 3,
/// for their counterpart in linear programs. A row is computed in one lane by the same operations in the same
/// order, however many lanes there are.
template <RealScalar Scalar, int lanes>
class RowScan {
 public:
  using Problem = QpProblem<Scalar>;

  /// Computes violations and weights where nothing is active, and selects.
  /// @param bounds  of the rows, here and below
  int start(const Problem& problem, const Scalar* bounds, const InverseHessian<Scalar>& inverse,
            const Six<Scalar>& x, Scalar tolerance) noexcept {
    return inverse.is_diagonal() ? start(problem, bounds, DiagonalForm(inverse.diagonal()), x, tolerance)
                                 : start(problem, bounds, FullForm(inverse.matrix()), x, tolerance);
  }
  /// Computes weights where some rows are active.
  void weigh(const Problem& problem, const InverseHessian<Scalar>& inverse,
             const SixBySix<Scalar>& projector) noexcept {
    if (inverse.is_diagonal()) {
      weigh(problem, DiagonalForm(inverse.diagonal()), FullForm(projector));
    } else {
      weigh(problem, FullForm(inverse.matrix()), FullForm(projector));
    }
  }

  /// Computes violations at x afresh, and says whether one is above `tolerance`.
  bool measure(const Problem& problem, const Scalar* bounds, const Six<Scalar>& x,
               Scalar tolerance) noexcept {
    const SixGroups at = spread_all(x);
    return measure(problem, bounds, tolerance, [&at](const SixGroups& a, const Group& bound) {
      return bound - dot_of_six<Group>(a, at);
    });
  }
  /// The same less what rounding makes of them.
  /// @param rounding  of a row's value at x, for a row of size one
  bool measure_excess(const Problem& problem, const Scalar* bounds, const Six<Scalar>& x, Scalar tolerance,
                      Scalar rounding) noexcept {
    const SixGroups at = spread_all(x);
    const Group unit = spread<Group>(rounding);
    return measure(problem, bounds, tolerance, [&at, &unit](const SixGroups& a, const Group& bound) {
      SixGroups size;
      for (std::size_t j = 0; j < 6; ++j) size[j] = greater(a[j], Group(-a[j]));
      const Group sum = ((size[0] + size[1]) + (size[2] + size[3])) + (size[4] + size[5]);
      return (bound - dot_of_six<Group>(a, at)) - product(unit, sum);
    });
  }

  /// An active row is not violated, whatever rounding says.
  void set_active(int k) noexcept { violation_[index(k)] = -std::numeric_limits<Scalar>::infinity(); }
  void set_violation(int k, Scalar violation) noexcept { violation_[index(k)] = violation; }

  /// aₖᵀH⁻¹aₖ
  Scalar whole_weight(int k) const noexcept { return least_weight_[index(k)] * Scalar(1 / least_share); }

  /// The row to add, or −1 if none is violated by more than `tolerance`.
  int select(const Problem& problem, Scalar tolerance) const noexcept {
    const Group threshold = spread<Group>(tolerance);
    Best best;
    for (int k = 0; k < problem.row_count; k += lanes)
      best.meet(load<Group>(&violation_[index(k)]), weight_at(k), threshold);
    const int row = best.row();
    return row < 0 ? first_violated(problem, tolerance) : row;
  }

  /// Follows a step of `length` along z and the change of P by −z·zᵀ/slope, then selects as above; −1 also where no score is a number.
  template <class Step>
  int add(const Problem& problem, const Step& z, Scalar length, Scalar slope, Scalar tolerance) noexcept {
    const SixGroups direction = spread_all(z);
    const Group step = spread<Group>(length), factor = spread<Group>(Scalar(1) / slope);
    const Group threshold = spread<Group>(tolerance);
    Best best;
    const int count = problem.row_count;
    for (int k = 0; k < count; k += lanes) {
      const Group along = dot_of_six<Group>(load_rows(problem, k), direction);
      const Group violation = load<Group>(&violation_[index(k)]) - product(step, along);
      store(&violation_[index(k)], violation);
      store(&weight_[index(k)],
            Group(load<Group>(&weight_[index(k)]) - product(product(factor, along), along)));
      best.meet(violation, weight_at(k), threshold);
    }
    return best.row();
  }

  /// Follows a step of `length` along z and the change of P by +u·uᵀ/curvature.
  template <class Step>
  void drop(const Problem& problem, const Step& z, Scalar length, const Six<Scalar>& u,
            Scalar curvature) noexcept {
    const SixGroups direction = spread_all(z), freed = spread_all(u);
    const Group step = spread<Group>(length), factor = spread<Group>(Scalar(1) / curvature);
    const int count = problem.row_count;
    for (int k = 0; k < count; k += lanes) {
      const SixGroups a = load_rows(problem, k);
      const Group along = dot_of_six<Group>(a, direction), gained = dot_of_six<Group>(a, freed);
      store(&violation_[index(k)], Group(load<Group>(&violation_[index(k)]) - product(step, along)));
      store(&weight_[index(k)],
            Group(load<Group>(&weight_[index(k)]) + product(product(factor, gained), gained)));
    }
  }

 private:
  using Group = Lanes<Scalar, lanes>;
  using SixGroups = std::array<Group, 6>;
  using Best = BestRow<Scalar, lanes>;
  using Values = std::array<Scalar, std::size_t(Problem::row_capacity)>;
  static constexpr double least_share = 1e-3;

  /// aᵀQa with Q diagonal.
  class DiagonalForm {
   public:
    explicit DiagonalForm(const Six<Scalar>& q) noexcept : entries_(spread_all(q)) {}
    Group operator()(const SixGroups& a) const noexcept {
      SixGroups image;
      for (std::size_t j = 0; j < 6; ++j) image[j] = product(entries_[j], a[j]);
      return dot_of_six<Group>(a, image);
    }

   private:
    SixGroups entries_;
  };
  /// aᵀQa with Q symmetric, by the entries on and below the diagonal.
  class FullForm {
   public:
    explicit FullForm(const SixBySix<Scalar>& q) noexcept {
      for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t i = j; i < 6; ++i)
          entries_[j][i] = spread<Group>(i == j ? q[j][i] : q[j][i] + q[j][i]);
      }
    }
    Group operator()(const SixGroups& a) const noexcept {
      SixGroups image;
      for (std::size_t j = 0; j < 6; ++j) {
        image[j] = product(entries_[j][j], a[j]);
        for (std::size_t i = j + 1; i < 6; ++i) image[j] += product(entries_[j][i], a[i]);
      }
      return dot_of_six<Group>(a, image);
    }

   private:
    std::array<SixGroups, 6> entries_;
  };

  static std::size_t index(int i) noexcept { return std::size_t(i); }
  /// Keeps the score of a row of zeros finite.
  static Scalar smallest() noexcept {
    return std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon();
  }

  template <class V>
  static SixGroups spread_all(const V& v) noexcept {
    SixGroups groups;
    for (std::size_t j = 0; j < 6; ++j) groups[j] = spread<Group>(v[j]);
    return groups;
  }
  static SixGroups load_rows(const Problem& problem, int k) noexcept {
    SixGroups a;
    for (int j = 0; j < 6; ++j) a[index(j)] = load<Group>(problem.rows.column(j) + k);
    return a;
  }
  Group weight_at(int k) const noexcept {
    return greater(load<Group>(&weight_[index(k)]), load<Group>(&least_weight_[index(k)]));
  }

  template <class Form>
  int start(const Problem& problem, const Scalar* bounds, const Form& form, const Six<Scalar>& x,
            Scalar tolerance) noexcept {
    const SixGroups at = spread_all(x);
    const Group share = spread<Group>(Scalar(least_share)), least = spread<Group>(smallest());
    Best best;
    auto is_above = Group{} > Group{};
    for_each_group(problem, tolerance, [&](int k, const Group& threshold) {
      const SixGroups a = load_rows(problem, k);
      const Group violation = load<Group>(bounds + k) - dot_of_six<Group>(a, at);
      const Group weight = form(a) + least;
      store(&violation_[index(k)], violation);
      store(&weight_[index(k)], weight);
      store(&least_weight_[index(k)], Group(product(share, weight) + least));
      is_above |= best.meet(violation, weight, threshold);
    });
    clear_rest(problem);
    const int row = best.row();
    return row < 0 && any(is_above) ? first_violated(problem, tolerance) : row;
  }

  template <class Form>
  void weigh(const Problem& problem, const Form& whole, const FullForm& free) noexcept {
    const Group share = spread<Group>(Scalar(least_share)), least = spread<Group>(smallest());
    for (int k = 0; k < problem.row_count; k += lanes) {
      const SixGroups a = load_rows(problem, k);
      store(&weight_[index(k)], free(a));
      store(&least_weight_[index(k)], Group(product(share, whole(a)) + least));
    }
  }

  template <class Violation>
  bool measure(const Problem& problem, const Scalar* bounds, Scalar tolerance,
               const Violation& violation_of) noexcept {
    auto is_above = Group{} > Group{};
    for_each_group(problem, tolerance, [&](int k, const Group& threshold) {
      const Group violation = violation_of(load_rows(problem, k), load<Group>(bounds + k));
      store(&violation_[index(k)], violation);
      is_above |= violation > threshold;
    });
    clear_rest(problem);
    return any(is_above);
  }

  template <class Comparison>
  static bool any(const Comparison& comparison) noexcept {
    if constexpr (lanes == 1) {
      return comparison;
    } else {
      LaneBits<Scalar> any = 0;
      for (const LaneBits<Scalar> bits : in_lanes<LaneBits<Scalar>>(comparison)) any |= bits;
      return any != 0;
    }
  }

  /// What a last group holds behind the last row is not violated, however it is followed.
  void clear_rest(const Problem& problem) noexcept {
    for (int k = problem.row_count; k % lanes != 0; ++k) set_active(k);
  }

  /// Calls `visit` with every group of rows and with a threshold that no number behind the last row exceeds.
  template <class Visit>
  static void for_each_group(const Problem& problem, Scalar tolerance, const Visit& visit) noexcept {
    Group threshold = spread<Group>(tolerance);
    for (int k = 0; k < problem.row_count; k += lanes) {
      if constexpr (lanes > 1) {
        for (int i = lanes; k + i > problem.row_count; --i)
          threshold[i - 1] = std::numeric_limits<Scalar>::infinity();
      }
      visit(k, threshold);
    }
  }

  /// Where violations are so large that scores are no numbers, any row will do.
  int first_violated(const Problem& problem, Scalar tolerance) const noexcept {
    for (int k = 0; k < problem.row_count; ++k) {
      if (violation_[index(k)] > tolerance) return k;
    }
    return -1;
  }

  alignas(64) Values violation_;     // bₖ − aₖ·x; −∞ for active rows
  alignas(64) Values weight_;        // aₖᵀPaₖ
  alignas(64) Values least_weight_;  // a share of aₖᵀH⁻¹aₖ
};

}  // namespace feeler::detail
