// The Hessian of the Lagrangian of a step, made positive definite where it matters least.
#pragma once

#include <array>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/render/sqp/definiteness.hpp"
#include "feeler/spatial/turned_metric.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

namespace detail {

/// Sets the lower triangle of a matrix to `entry(i, j)`, i ≥ j, number by number.
template <class Scalar, class Entry>
void set_lower(Matrix6<Scalar>& m, const Entry& entry) noexcept {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
#pragma GCC unroll 6
    for (int i = j; i < 6; ++i) m(i, j) = entry(i, j);
  }
}
/// Sets a symmetric matrix to `entry(i, j)`, i ≥ j.
template <class Scalar, class Entry>
void set_symmetric(Matrix6<Scalar>& m, const Entry& entry) noexcept {
  set_lower(m, [&](int i, int j) { return m(j, i) = entry(i, j); });
}
/// Entries of a diagonal matrix.
template <class Scalar>
auto diagonal_of(const Vector6<Scalar>& diagonal) noexcept {
  return [diagonal](int i, int j) { return i == j ? diagonal[i] : Scalar(0); };
}

/// Stiffness across the active rows, and share of the Lagrangian in what is left to the metric; the first that will do is taken, where the
/// Lagrangian alone does not.
struct Regularisation {
  double weight, share;  // a scalar may not be constexpr
};
inline constexpr std::array<Regularisation, 7> regularisations{
    {{8, 1}, {64, 1}, {1024, 1}, {64, 15.0 / 16}, {64, 3.0 / 4}, {64, 1.0 / 2}, {64, 1.0 / 4}}};

/// `set_lagrangian` in the metric M.
/// @param base         entries of M, (i, j) for i ≥ j; `has(i, j)` where there may be one
/// @param is_definite  whether the Hessian of the problem is positive definite, by enough
template <class Scalar, class AnyMetric, class Base, class Has, class IsDefinite, class Rows, class Active>
bool set_lagrangian_in(QpProblem<Scalar>& problem, const AnyMetric& metric, const Base& base, const Has& has, const IsDefinite& is_definite,
                       const Twist<Scalar>& e, const Rows& rows, const Active& active) noexcept {
  problem.gradient = metric.gradient(e);
  // Summed before it is subtracted: of contacts between faces much cancels, and does so to the last bit.
  Matrix6<Scalar> curvature;
  set_lower(curvature, [](int, int) { return Scalar(0); });
  for (const auto& held : active) rows[held.row].add_curvature(held.multiplier, curvature);
  const Matrix3<Scalar> turns = metric.hessian_of_turns(e);
  const auto lagrangian = [&](int i, int j) {
    const Scalar hessian = j >= 3 ? turns(i - 3, j - 3) : has(i, j) ? base(i, j) : Scalar(0);
    return hessian - curvature(i, j);
  };
  set_symmetric(problem.hessian, lagrangian);
  if (is_definite()) return true;

  Matrix6<Scalar> across;
  set_lower(across, [](int, int) { return Scalar(0); });
  Vector6<Scalar> pull = Vector6<Scalar>::Zero();
  for (const auto& held : active) {
    const Vector6<Scalar>& row = problem.rows[std::size_t(held.row)];
    set_lower(across, [&](int i, int j) { return across(i, j) + row[i] * row[j]; });
    pull += problem.bounds[std::size_t(held.row)] * row;
  }
  for (const Regularisation& regular : regularisations) {
    const Scalar weight = Scalar(regular.weight), share = Scalar(regular.share);
    const auto entry = [&](int i, int j) {
      const Scalar sum = share * lagrangian(i, j) + weight * across(i, j);
      return has(i, j) ? sum + (Scalar(1) - share) * base(i, j) : sum;
    };
    set_symmetric(problem.hessian, entry);
    if (!is_definite()) continue;
    problem.gradient -= weight * pull;
    return share == Scalar(1);
  }
  set_symmetric(problem.hessian, base);
  return false;
}

/// A Hessian much flatter than the metric makes steps that no linearisation can carry: so much of the metric it has to keep.
inline constexpr int flattest = 80;

template <class Scalar, class Rows, class Active>
FEELER_FLATTEN bool set_lagrangian_along(QpProblem<Scalar>& problem, const Metric<Scalar>& metric, const Twist<Scalar>& e, const Rows& rows,
                                         const Active& active) noexcept {
  const Vector6<Scalar> base = metric.diagonal(), floor = base * (Scalar(1) / flattest);
  return set_lagrangian_in(
      problem, metric, diagonal_of(base), [](int i, int j) { return i == j; }, [&] { return is_positive_definite(problem.hessian, floor); }, e, rows,
      active);
}
/// The same along axes that are not those of the poses.
template <class Scalar, class Rows, class Active>
[[gnu::noinline]] bool set_turned_lagrangian(QpProblem<Scalar>& problem, const TurnedMetric<Scalar>& metric, const Twist<Scalar>& e, const Rows& rows,
                                             const Active& active) noexcept {
  const Matrix6<Scalar> base = metric.matrix(), floor = base * (Scalar(1) / flattest);
  const auto is_definite = [&] { return is_positive_definite<Scalar>(problem.hessian - floor, Vector6<Scalar>::Zero()); };
  return set_lagrangian_in(problem, metric, base, [](int i, int j) { return (i < 3) == (j < 3); }, is_definite, e, rows, active);
}

}  // namespace detail

/// Sets Hessian and gradient of a problem to H = ∇²f − Σ λₖ ∇²sₖ and ∇f; false where that had to be changed along the rows, or given up.
///
/// Across the active rows the step is fixed, so ½ρ(Jₖd − bₖ)² added for each changes nothing along them (augmented Lagrangian). Where H
/// has negative curvature along the rows too, the tool is about to slip off: there part of the metric takes its place.
/// @param problem  with its rows
/// @param e        the graphic pose, from the haptic one
/// @param rows     `ContactRow`s, those of the problem
/// @param active   of a solution: rows with their multipliers λ
template <class Scalar, class Rows, class Active>
bool set_lagrangian(QpProblem<Scalar>& problem, const TurnedMetric<Scalar>& metric, const Twist<Scalar>& e, const Rows& rows,
                    const Active& active) noexcept {
  return metric.is_turned() ? detail::set_turned_lagrangian(problem, metric, e, rows, active)
                            : detail::set_lagrangian_along(problem, metric.along(), e, rows, active);
}

}  // namespace feeler
