// The Hessian of the Lagrangian of a step, made positive definite where it matters least.
#pragma once

#include <array>

#include "feeler/core/flatten.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/qp/problem.hpp"
#include "feeler/render/sqp/definiteness.hpp"
#include "feeler/spatial/metric.hpp"
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
FEELER_FLATTEN bool set_lagrangian(QpProblem<Scalar>& problem, const Metric<Scalar>& metric, const Twist<Scalar>& e, const Rows& rows,
                                   const Active& active) noexcept {
  const Vector6<Scalar> base = metric.diagonal();
  problem.gradient = metric.gradient(e);
  // Summed before it is subtracted: of contacts between faces much cancels, and does so to the last bit.
  Matrix6<Scalar> curvature;
  detail::set_lower(curvature, [](int, int) { return Scalar(0); });
  for (const auto& held : active) rows[held.row].add_curvature(held.multiplier, curvature);
  const Matrix3<Scalar> turns = metric.hessian_of_turns(e);
  const auto lagrangian = [&](int i, int j) {
    const Scalar hessian = j >= 3 ? turns(i - 3, j - 3) : i == j ? base[i] : Scalar(0);
    return hessian - curvature(i, j);
  };
  // Not much flatter than the metric: a flatter one makes steps that no linearisation can carry.
  const Vector6<Scalar> floor = base * (Scalar(1) / 80);
  detail::set_symmetric(problem.hessian, lagrangian);
  if (is_positive_definite(problem.hessian, floor)) return true;

  Matrix6<Scalar> across;
  detail::set_lower(across, [](int, int) { return Scalar(0); });
  Vector6<Scalar> pull = Vector6<Scalar>::Zero();
  for (const auto& held : active) {
    const Vector6<Scalar>& row = problem.rows[std::size_t(held.row)];
    detail::set_lower(across, [&](int i, int j) { return across(i, j) + row[i] * row[j]; });
    pull += problem.bounds[std::size_t(held.row)] * row;
  }
  for (const detail::Regularisation& regular : detail::regularisations) {
    const Scalar weight = Scalar(regular.weight), share = Scalar(regular.share);
    const auto entry = [&](int i, int j) {
      const Scalar sum = share * lagrangian(i, j) + weight * across(i, j);
      return i == j ? sum + (Scalar(1) - share) * base[i] : sum;
    };
    detail::set_symmetric(problem.hessian, entry);
    if (!is_positive_definite(problem.hessian, floor)) continue;
    problem.gradient -= weight * pull;
    return share == Scalar(1);
  }
  detail::set_symmetric(problem.hessian, detail::diagonal_of(base));
  return false;
}

}  // namespace feeler
