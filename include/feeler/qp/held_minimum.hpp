// The minimum of a quadratic where known rows hold with equality.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "feeler/core/lanes.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/inverse_hessian.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/qp/six.hpp"
#include "feeler/qp/warm_start.hpp"

namespace feeler::detail {

/// min ½ xᵀHx + gᵀx subject to aᵢ·x = bᵢ for up to six rows, with their multipliers.
///
/// With H = LDLᵀ and yᵢ = L⁻¹aᵢ the multipliers solve YᵀD⁻¹Y·λ = b + YᵀD⁻¹L⁻¹g: H needs no inverse, and the rows no operators. Where the terms
/// of x all but cancel, as those of a tool that is pinned, it lies beside its rows by more than ten digits of itself, and one step of iterative
/// refinement follows.
/// Source: J. Nocedal, S. J. Wright, "Numerical Optimization" (2006), section 16.2, the Schur-complement method.
template <RealScalar Scalar>
class HeldMinimum {
 public:
  /// False, and nothing else is valid, where a row does not exist, where one all but depends on those before it, or where a multiplier is
  /// negative.
  /// @param bounds   of the rows of the problem [m]
  /// @param hessian  factored, not inverted
  bool find(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& start, const InverseHessian<Scalar>& hessian,
            const Six<Scalar>& gradient) noexcept {
    const Six<Scalar>& d_inverse = hessian.inverse_pivots();
    const Six<Scalar> home = hessian.solve_lower(gradient);
    SixBySix<Scalar> y, scaled;  // L⁻¹a and D⁻¹L⁻¹a of each row
    SixBySix<Scalar> l;          // of the Schur complement, rows before the diagonal
    Six<Scalar> pivot_inverse;
    std::size_t count = 0;
    for (const int row : start.rows) {
      if (row < 0 || row >= problem.row_count) return false;
      const Six<Scalar> a = take_normal(problem, row, count);
      y[count] = hessian.solve_lower(a);
      scaled[count] = multiply(d_inverse, y[count]);
      const Scalar whole = dot(scaled[count], y[count]);
      Scalar pivot = whole;
      Six<Scalar> ld;
      for (std::size_t j = 0; j < count; ++j) {
        ld[j] = dot(scaled[count], y[j]);
        for (std::size_t k = 0; k < j; ++k) ld[j] -= product(ld[k], l[j][k]);
        l[count][j] = ld[j] * pivot_inverse[j];
        pivot -= product(ld[j], l[count][j]);
      }
      if (!(pivot > Scalar(independent) * whole)) return false;
      pivot_inverse[count] = Scalar(1) / pivot;
      multipliers_[count] = bounds[row] + dot(scaled[count], home);
      ++count;
    }
    solve(l, pivot_inverse, count, multipliers_);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(multipliers_[i] >= Scalar(0))) return false;
    }
    // Forces that cancel do so before they are scaled.
    Six<Scalar> force = home;
    for (std::size_t i = 0; i < count; ++i) subtract(y[i], multipliers_[i], force);
    follow(force, hessian);
    if (look(bounds, start) > rough() * largest_of(x_)) {
      meet(hessian, scaled, l, pivot_inverse, count);
      look(bounds, start);
    }
    return true;
  }

  /// The same where the multipliers are known; returns by how much x lies beside a row at most [m].
  /// @param rows  of the problem, that exist
  Scalar place(const QpProblem<Scalar>& problem, const Scalar* bounds, const WarmStart& rows, const Six<Scalar>& multipliers,
               const InverseHessian<Scalar>& hessian, const Six<Scalar>& gradient) noexcept {
    Six<Scalar> force = hessian.solve_lower(gradient);
    for (int k = 0; k < rows.rows.size(); ++k) {
      const auto i = std::size_t(k);
      multipliers_[i] = multipliers[i];
      subtract(hessian.solve_lower(take_normal(problem, rows.rows[k], i)), multipliers[i], force);
    }
    follow(force, hessian);
    return look(bounds, rows);
  }

  /// Moves x by a change of the multipliers; returns the same.
  Scalar shift(const Scalar* bounds, const WarmStart& rows, const Six<Scalar>& change, const InverseHessian<Scalar>& hessian) noexcept {
    SixBySix<Scalar> scaled;
    const auto count = std::size_t(rows.rows.size());
    for (std::size_t i = 0; i < count; ++i) {
      multipliers_[i] = std::max(Scalar(0), multipliers_[i] + change[i]);
      scaled[i] = multiply(hessian.inverse_pivots(), hessian.solve_lower(normals_[i]));
    }
    shift(change, scaled, count, hessian);
    return look(bounds, rows);
  }

  const Six<Scalar>& x() const noexcept { return x_; }
  /// Of the rows, in the order of the start.
  const Six<Scalar>& multipliers() const noexcept { return multipliers_; }
  const Six<Scalar>& normal(int i) const noexcept { return normals_[std::size_t(i)]; }
  /// By how much x falls short of each of them [m].
  const Six<Scalar>& lacking() const noexcept { return lacking_; }

 private:
  Six<Scalar> take_normal(const QpProblem<Scalar>& problem, int row, std::size_t i) noexcept {
    Six<Scalar> a;
#pragma GCC unroll 6
    for (int j = 0; j < 6; ++j) a[std::size_t(j)] = problem.rows.column(j)[row];
    normals_[i] = a;
    return a;
  }

  /// x is where a force L⁻¹(g − Aᵀλ) leads.
  void follow(Six<Scalar> force, const InverseHessian<Scalar>& hessian) noexcept {
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) force[j] *= -hessian.inverse_pivots()[j];
    x_ = hessian.solve_upper(force);
  }

  /// By how much x falls short of each row; returns the largest distance.
  Scalar look(const Scalar* bounds, const WarmStart& start) noexcept {
    Scalar most(0);
    for (int k = 0; k < start.rows.size(); ++k) {
      const auto i = std::size_t(k);
      lacking_[i] = bounds[start.rows[k]] - dot(normals_[i], x_);
      most = std::max(most, magnitude(lacking_[i]));
    }
    return most;
  }

  /// Takes back by how much rounding left x beside the rows.
  void meet(const InverseHessian<Scalar>& hessian, const SixBySix<Scalar>& scaled, const SixBySix<Scalar>& l, const Six<Scalar>& pivot_inverse,
            std::size_t count) noexcept {
    Six<Scalar> along = lacking_;
    solve(l, pivot_inverse, count, along);
    shift(along, scaled, count, hessian);
  }
  /// Moves x by a change of the multipliers.
  /// @param scaled  D⁻¹L⁻¹a of each row
  void shift(const Six<Scalar>& change, const SixBySix<Scalar>& scaled, std::size_t count, const InverseHessian<Scalar>& hessian) noexcept {
    Six<Scalar> push{};
    for (std::size_t i = count; i-- > 0;) {
#pragma GCC unroll 6
      for (std::size_t j = 0; j < 6; ++j) push[j] += product(change[i], scaled[i][j]);
    }
    push = hessian.solve_upper(push);
#pragma GCC unroll 6
    for (std::size_t j = 0; j < 6; ++j) x_[j] += push[j];
  }

  /// S⁻¹·v of the first `count` numbers, S = LDLᵀ the Schur complement.
  static void solve(const SixBySix<Scalar>& l, const Six<Scalar>& pivot_inverse, std::size_t count, Six<Scalar>& v) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j) v[i] -= product(l[i][j], v[j]);
    }
    for (std::size_t i = count; i-- > 0;) {
      v[i] *= pivot_inverse[i];
      for (std::size_t k = i + 1; k < count; ++k) v[i] -= product(l[k][i], v[k]);
    }
  }

  /// Of x, by which it may lie beside a row.
  static Scalar rough() noexcept { return std::min(Scalar(0x1p17) * std::numeric_limits<Scalar>::epsilon(), Scalar(0x1p-35)); }

  /// Share of a row that has to be its own.
  static constexpr double independent = 1e-3;

  Six<Scalar> x_{};
  Six<Scalar> multipliers_{};
  Six<Scalar> lacking_{};
  SixBySix<Scalar> normals_{};
};

}  // namespace feeler::detail
