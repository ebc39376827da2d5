// The default QP solver: the dual active-set method of Goldfarb and Idnani, in operator form.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "feeler/qp/problem.hpp"
#include "feeler/qp/qp_solver.hpp"
#include "feeler/qp/solution.hpp"

namespace feeler {

/// Dual active set: starts at the unconstrained minimum and adds the most violated row until none is left.
///
/// Source: D. Goldfarb, A. Idnani, "A numerically stable dual method for solving strictly convex quadratic programs", Mathematical
/// Programming 27 (1983), in the operators of its section 3: P = H⁻¹ − H⁻¹N(NᵀH⁻¹N)⁻¹NᵀH⁻¹ projects onto the null space of
/// the active rows N, and N* = (NᵀH⁻¹N)⁻¹NᵀH⁻¹ gives their multipliers. Both are kept by rank-one updates; a row that
/// is nearly dependent on the active ones is projected twice. The row to add maximises violation²/(aᵀPa) (dual steepest edge).
///
/// Rows are met to `tolerance` [m]. Rows that make an angle below about 1e-8 rad with the span of the active ones count as dependent.
/// Cost: 36 multiplications a row and iteration, about 0.2 to 1 µs in all; noexcept, no allocation.
template <RealScalar ScalarType>
class DualActiveSet {
 public:
  using Scalar = ScalarType;
  using Problem = QpProblem<Scalar>;
  using Solution = QpSolution<Scalar>;

  /// Violation of a row that is accepted [m].
  Scalar tolerance = Scalar(2e-13);

  QpStatus solve(const Problem& problem, Solution& solution) noexcept {
    solution.active.clear();
    solution.conflict.clear();
    solution.iterations = 0;
    solution.step.setZero();
    if (!invert(problem.hessian)) return QpStatus::not_positive_definite;
    projector_ = inverse_;
    count_ = 0;
    Vector6<Scalar> x = -(inverse_ * problem.gradient);

    const int limit = 8 * (problem.row_count + 8);
    QpStatus status = QpStatus::iteration_limit;
    while (solution.iterations < limit) {
      const int entering = most_violated(problem, x);
      if (entering < 0) {
        ++solution.iterations;
        if (correct_active_rows(problem, x)) continue;
        status = QpStatus::optimal;
        break;
      }
      status = enter(problem, entering, limit, x, solution);
      if (status != QpStatus::optimal) break;
      status = QpStatus::iteration_limit;
    }
    if (!is_finite(x)) {  // nor was the input: no step is the only one that is sure to be finite
      solution.conflict.clear();
      return QpStatus::iteration_limit;
    }
    solution.step = x;
    for (int i = 0; i < count_; ++i) solution.active.push_back({active_[index(i)], multiplier_[index(i)]});
    return status;
  }

 private:
  static std::size_t index(int i) noexcept { return std::size_t(i); }

  /// H⁻¹ = L⁻ᵀD⁻¹L⁻¹ by H = LDLᵀ, without square roots; false unless H is positive definite.
  bool invert(const Matrix6<Scalar>& h) noexcept {
    if (is_diagonal(h)) {
      for (int j = 0; j < 6; ++j) {
        if (!is_pivot(h(j, j))) return false;
      }
      inverse_ = h.diagonal().cwiseInverse().asDiagonal();
      return true;
    }
    Matrix6<Scalar> l, m;       // unit lower triangles of L and L⁻¹
    Vector6<Scalar> d_inverse;  // D⁻¹
    for (int j = 0; j < 6; ++j) {
      Vector6<Scalar> scaled;  // row j of LD
      Scalar pivot = h(j, j);
      for (int k = 0; k < j; ++k) {
        scaled[k] = l(j, k);
        l(j, k) *= d_inverse[k];
        pivot -= scaled[k] * l(j, k);
      }
      if (!is_pivot(pivot)) return false;
      d_inverse[j] = Scalar(1) / pivot;
      for (int i = j + 1; i < 6; ++i) {  // below the diagonal LD for now
        Scalar sum = h(i, j);
        for (int k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
        l(i, j) = sum;
      }
    }
    for (int j = 0; j < 6; ++j) {
      m(j, j) = Scalar(1);
      for (int i = j + 1; i < 6; ++i) {
        Scalar sum = -l(i, j);
        for (int k = j + 1; k < i; ++k) sum -= l(i, k) * m(k, j);
        m(i, j) = sum;
      }
    }
    for (int j = 0; j < 6; ++j) {
      for (int i = j; i < 6; ++i) {
        Scalar sum(0);
        for (int k = i; k < 6; ++k) sum += m(k, i) * d_inverse[k] * m(k, j);
        inverse_(i, j) = inverse_(j, i) = sum;
      }
    }
    return true;
  }

  static bool is_pivot(Scalar pivot) noexcept {
    return pivot > Scalar(0) && pivot < std::numeric_limits<Scalar>::max();
  }

  static bool is_diagonal(const Matrix6<Scalar>& h) noexcept {
    for (int j = 0; j < 6; ++j) {
      for (int i = j + 1; i < 6; ++i) {
        if (h(i, j) != Scalar(0)) return false;
      }
    }
    return true;
  }

  bool is_finite(const Vector6<Scalar>& x) const noexcept {
    using std::isfinite;
    Scalar sum = x.cwiseAbs().sum();
    for (int i = 0; i < count_; ++i) sum += multiplier_[index(i)];
    return isfinite(sum);
  }

  /// Rounding of a row's value at x, for a row of size one.
  static Scalar rounding_at(const Vector6<Scalar>& x) noexcept {
    return 8 * std::numeric_limits<Scalar>::epsilon() * x.template lpNorm<Eigen::Infinity>();
  }

  /// Undoes the drift of x off the active rows where it exceeds the tolerance, and says whether it did.
  bool correct_active_rows(const Problem& problem, Vector6<Scalar>& x) noexcept {
    using std::abs;
    const Scalar rounding = rounding_at(x);
    Vector6<Scalar> correction = Vector6<Scalar>::Zero();
    bool has_drifted = false;
    for (int i = 0; i < count_; ++i) {
      const auto row = index(active_[index(i)]);
      const Vector6<Scalar>& a = problem.rows[row];
      const Scalar lacking = problem.bounds[row] - a.dot(x);
      has_drifted = has_drifted || abs(lacking) > tolerance + rounding * a.template lpNorm<1>();
      correction += lacking * dual_[index(i)];
    }
    if (!has_drifted) return false;
    x += correction;
    const Vector6<Scalar> curved = problem.hessian * correction;
    for (int i = 0; i < count_; ++i) {
      const Scalar u = multiplier_[index(i)] + dual_[index(i)].dot(curved);
      multiplier_[index(i)] = u > Scalar(0) ? u : Scalar(0);
    }
    return true;
  }

  int most_violated(const Problem& problem, const Vector6<Scalar>& x) const noexcept {
    const Scalar rounding = rounding_at(x);
    Scalar best = Scalar(0);
    int entering = -1;
    for (int k = 0; k < problem.row_count; ++k) {
      const Vector6<Scalar>& a = problem.rows[index(k)];
      const Scalar violation = problem.bounds[index(k)] - a.dot(x);
      if (!(violation > tolerance) || !(violation > tolerance + rounding * a.template lpNorm<1>()) || is_active(k)) continue;
      const Scalar free_part = a.dot(projector_ * a);
      const Scalar whole = a.dot(inverse_ * a);
      const Scalar score = violation * violation / (free_part > Scalar(1e-3) * whole ? free_part : Scalar(1e-3) * whole);
      if (score > best) {
        best = score;
        entering = k;
      }
    }
    return entering;
  }

  bool is_active(int row) const noexcept {
    for (int i = 0; i < count_; ++i) {
      if (active_[index(i)] == row) return true;
    }
    return false;
  }

  /// Makes row p satisfied with equality, dropping rows whose multiplier would turn negative.
  QpStatus enter(const Problem& problem, int p, int limit, Vector6<Scalar>& x, Solution& solution) noexcept {
    const Vector6<Scalar>& a = problem.rows[index(p)];
    const Scalar whole = a.dot(inverse_ * a);
    // Squared sine under which a row is dependent: of 1e-8 rad, or of what rounding leaves of a row projected twice.
    const Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
    const Scalar dependence = std::max(Scalar(1e-16), Scalar(rounding * rounding));
    Scalar multiplier = Scalar(0);
    while (++solution.iterations <= limit) {
      Vector6<Scalar> z = projector_ * a;
      std::array<Scalar, 6> r;
      for (int i = 0; i < count_; ++i) r[index(i)] = dual_[index(i)].dot(a);
      if (a.dot(z) < Scalar(1e-3) * whole) project_again(problem, z);
      const Scalar slope = a.dot(z);
      const bool is_dependent = count_ == 6 || !(slope > dependence * whole);

      Scalar dual_step = std::numeric_limits<Scalar>::infinity();
      int leaving = -1;
      for (int i = 0; i < count_; ++i) {
        if (r[index(i)] > Scalar(0) && multiplier_[index(i)] < dual_step * r[index(i)]) {
          dual_step = multiplier_[index(i)] / r[index(i)];
          leaving = i;
        }
      }
      if (is_dependent && leaving < 0) {
        solution.conflict.push_back(p);
        for (int i = 0; i < count_; ++i) {
          if (r[index(i)] < -Scalar(1e-9)) solution.conflict.push_back(active_[index(i)]);
        }
        return QpStatus::infeasible;
      }
      const Scalar violation = problem.bounds[index(p)] - a.dot(x);
      const Scalar full_step = is_dependent ? std::numeric_limits<Scalar>::infinity() : violation / slope;
      const bool is_full = full_step <= dual_step;
      const Scalar t = is_full ? full_step : dual_step;
      if (!is_dependent) x += t * z;
      for (int i = 0; i < count_; ++i) {
        const Scalar u = multiplier_[index(i)] - t * r[index(i)];
        multiplier_[index(i)] = u > Scalar(0) ? u : Scalar(0);
      }
      multiplier += t;
      if (is_full) {
        add(p, multiplier, z, slope, r);
        return QpStatus::optimal;
      }
      drop(problem, leaving);
    }
    return QpStatus::iteration_limit;
  }

  /// Removes from z what rounding left of it along the active rows.
  void project_again(const Problem& problem, Vector6<Scalar>& z) const noexcept {
    std::array<Scalar, 6> residual;
    for (int i = 0; i < count_; ++i) residual[index(i)] = problem.rows[index(active_[index(i)])].dot(z);
    for (int i = 0; i < count_; ++i) z -= residual[index(i)] * dual_[index(i)];
  }

  void add(int row, Scalar multiplier, const Vector6<Scalar>& z, Scalar slope,
           const std::array<Scalar, 6>& r) noexcept {
    const Vector6<Scalar> direction = z / slope;
    for (int i = 0; i < count_; ++i) dual_[index(i)] -= r[index(i)] * direction;
    projector_ -= z * direction.transpose();
    active_[index(count_)] = row;
    multiplier_[index(count_)] = multiplier;
    dual_[index(count_)] = direction;
    ++count_;
  }

  void drop(const Problem& problem, int leaving) noexcept {
    const Vector6<Scalar> u = dual_[index(leaving)];
    const Vector6<Scalar> curved = problem.hessian * u;
    const Scalar length = u.dot(curved);
    --count_;
    for (int i = leaving; i < count_; ++i) {
      active_[index(i)] = active_[index(i + 1)];
      multiplier_[index(i)] = multiplier_[index(i + 1)];
      dual_[index(i)] = dual_[index(i + 1)];
    }
    for (int i = 0; i < count_; ++i) dual_[index(i)] -= (dual_[index(i)].dot(curved) / length) * u;
    projector_ += (u / length) * u.transpose();
    if (count_ == 0) projector_ = inverse_;
  }

  Matrix6<Scalar> inverse_;    // H⁻¹
  Matrix6<Scalar> projector_;  // P
  int count_ = 0;
  std::array<int, 6> active_;
  std::array<Scalar, 6> multiplier_;
  std::array<Vector6<Scalar>, 6> dual_;  // rows of N*
};

static_assert(QpSolver<DualActiveSet<double>>);

}  // namespace feeler
