// How the wrench answers to a small motion of the hand: computed where it is asked for, from the contacts of
// the last tick.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/render/haptic_renderer.hpp"
#include "feeler/spatial/rotation.hpp"

namespace feeler {

/// ∂(force, torque)/∂(haptic pose) and whether it describes what the next ticks will do.
template <RealScalar ScalarType>
struct WrenchDerivative {
  using Scalar = ScalarType;

  /// Change of force [N] and torque [N·m] at the reference point by a step (dp, w) of the haptic pose [m,
  /// rad], all in world axes: the reference point moves by dp, the axes by Exp(w). In N/m, N/rad, N·m/m and
  /// N·m/rad.
  Matrix6<Scalar> matrix = Matrix6<Scalar>::Zero();
  /// False where the tick did not converge, where a contact touches without pushing, so that it holds on one
  /// side only, and where the contacts are about to let go of the tool: then it is that of planes in their
  /// place.
  bool is_smooth = false;
};

/// A contact method whose last optimisation can be looked at.
template <class Follower>
concept HasStepProblem = requires(const Follower& follower) {
  follower.target().translation;
  follower.problem().solution().active;
  follower.problem().is_solved();
  curvature_of(follower.problem().row(0));
};

namespace detail {

/// (1 − (θ/2) cot(θ/2))/θ² of θ² = u, and its derivative by u: the coefficient of [φ]×² in the inverse
/// Jacobian of SO(3).
template <class Scalar>
struct JacobianCoefficient {
  Scalar value, derivative;

  explicit JacobianCoefficient(Scalar u) noexcept {
    using std::sin;
    using std::sqrt;
    using std::tan;
    if (u < Scalar(1) / 4) {
      value = Scalar(1) / 12 + u * (Scalar(1) / 720 + u * (Scalar(1) / 30240 + u * (Scalar(1) / 1209600 + u / 47900160)));
      derivative = Scalar(1) / 720 + u * (Scalar(1) / 15120 + u * (Scalar(1) / 403200 + u / 11975040));
    } else {
      const Scalar half = sqrt(u) / 2;
      const Scalar cotangent = Scalar(1) / tan(half);
      value = (Scalar(1) - half * cotangent) / u;
      derivative = -((cotangent - half / (sin(half) * sin(half))) / (8 * half) + value) / u;
    }
  }
};

/// Derivative by φ of J⁻ᵀ(φ) W φ, the gradient of ½ φᵀ W φ, with the left Jacobian (side = 1) or the right
/// one (side = −1): Wφ + side/2 φ × Wφ + c φ × (φ × Wφ).
template <class Scalar>
Matrix3<Scalar> derivative_of_pull(const Vector3<Scalar>& weights, const Vector3<Scalar>& phi, int side) noexcept {
  const Matrix3<Scalar> weight = weights.asDiagonal();
  const Vector3<Scalar> pull = weights.cwiseProduct(phi);
  const Matrix3<Scalar> cross = cross_matrix(phi);
  const Vector3<Scalar> once = phi.cross(pull);
  const Vector3<Scalar> twice = phi.cross(once);
  const JacobianCoefficient<Scalar> c(phi.squaredNorm());
  return weight + Scalar(side) / 2 * (cross * weight - cross_matrix(pull)) +
         c.value * (cross * (cross * weight - cross_matrix(pull)) - cross_matrix(once)) + 2 * c.derivative * twice * phi.transpose();
}

/// The contacts that push, and how they share the force: what the optimisation needs of them is unique, its
/// choice of six is not.
///
/// A box flat on a table needs two corners to carry it, and yet all four keep it from rocking. So of all rows
/// that touch, the shares of least squares are taken, without those that would pull.
template <class Scalar>
class PushingRows {
 public:
  static constexpr int capacity = 32;

  struct Share {
    int row = -1;
    Vector6<Scalar> gradient;  // in units of the metric
    Scalar force = Scalar(0);  // multiplier
  };

  /// @param axes   of those coordinates
  /// @param unit   of the coordinates in which the metric is the identity
  /// @param touch  room below which a row touches [m]
  template <class Problem>
  PushingRows(const Problem& problem, const TurnedMetric<Scalar>& axes, const Vector6<Scalar>& unit, Scalar touch) noexcept {
    Vector6<Scalar> pull = Vector6<Scalar>::Zero();
    Scalar most(0);
    for (const auto& active : problem.solution().active) {
      if (active.row >= problem.row_count()) continue;
      shares_.push_back({active.row, unit.cwiseProduct(axes.in_axes(problem.row(active.row).gradient())), active.multiplier});
      pull += active.multiplier * shares_.back().gradient;
      most = (std::max)(most, active.multiplier);
    }
    const auto of_solver = shares_;
    for (int k = 0; k < problem.row_count() && !shares_.empty() && !shares_.full(); ++k) {
      const auto is_k = [k](const Share& share) { return share.row == k; };
      if (problem.room_after(k) > touch || std::any_of(of_solver.begin(), of_solver.end(), is_k)) continue;
      shares_.push_back({k, unit.cwiseProduct(axes.in_axes(problem.row(k).gradient())), Scalar(0)});
    }
    touching_ = shares_.size();
    const Scalar least = most * Scalar(1e-6);
    if (!share_out(pull, least)) shares_ = of_solver;
    for (int i = shares_.size() - 1; i >= 0; --i) {
      if (!(shares_[i].force > least)) shares_.swap_remove(i);
    }
  }

  const FixedVector<Share, capacity>& shares() const noexcept { return shares_; }
  /// Whether some row touches without pushing.
  bool has_idle() const noexcept { return shares_.size() < touching_; }

 private:
  /// The least shares that add up to the pull, none negative; false where that was not found.
  bool share_out(const Vector6<Scalar>& pull, Scalar least) noexcept {
    while (!shares_.empty()) {
      Matrix6<Scalar> sum = Matrix6<Scalar>::Zero();
      for (const Share& share : shares_) sum += share.gradient * share.gradient.transpose();
      const Eigen::SelfAdjointEigenSolver<Matrix6<Scalar>> eigen(sum);
      Vector6<Scalar> inverse = eigen.eigenvalues();
      for (int i = 0; i < 6; ++i) inverse[i] = inverse[i] > inverse[5] * Scalar(1e-12) ? Scalar(1) / inverse[i] : Scalar(0);
      const Vector6<Scalar> weights = eigen.eigenvectors() * inverse.cwiseProduct(Vector6<Scalar>(eigen.eigenvectors().transpose() * pull));
      int worst = -1;
      Vector6<Scalar> rest = pull;
      for (int i = 0; i < shares_.size(); ++i) {
        Share& share = shares_[i];
        share.force = share.gradient.dot(weights);
        rest -= share.force * share.gradient;
        if (share.force < -least && (worst < 0 || share.force < shares_[worst].force)) worst = i;
      }
      if (rest.norm() > Scalar(1e-5) * pull.norm()) return false;
      if (worst < 0) return true;
      shares_.swap_remove(worst);
    }
    return true;
  }

  FixedVector<Share, capacity> shares_;
  int touching_ = 0;
};

}  // namespace detail

/// The derivative of the wrench by the haptic pose, at the last tick.
///
/// The graphic pose g solves min f(g, h) with sₖ(g) = margin for the contacts that push. Moving h by dh moves
/// g by the step x with
///
///     H x + F dh ∈ span Jₖ,  Jₖ x = 0,   H = ∂²f/∂g² − Σ λₖ ∂²sₖ/∂g²,   F = ∂²f/∂g∂h
///
/// (the KKT conditions of the active set, differentiated), and the wrench of the paper's eq. 4, K e(g, h), by ∂W/∂g x + ∂W/∂h dh: in flat space K (x
/// − dh). Axes that `update` was given for stiffness and metric stand. Nothing is added to a tick that does not ask.
/// @cost  noexcept, no allocation; a factorisation and some eigenvalues of 6×6 matrices: half of a tick in the cavity, a
///        fifth of one on terrain
template <RigidTool Tool, QpSolver Solver, class Method>
  requires HasStepProblem<typename HapticRenderer<Tool, Solver, Method>::Follower>
WrenchDerivative<typename HapticRenderer<Tool, Solver, Method>::Working> wrench_derivative(
    const HapticRenderer<Tool, Solver, Method>& renderer) noexcept {
  using std::sqrt;
  using Scalar = typename HapticRenderer<Tool, Solver, Method>::Working;
  WrenchDerivative<Scalar> result;
  const auto status = renderer.tick().status;
  if (status != TickStatus::converged && status != TickStatus::unconverged) return result;

  const auto& settings = renderer.settings();
  const TurnedMetric<Scalar>& axes = renderer.scene().metric();  // all that follows is along these
  const Metric<Scalar>& metric = axes.along();
  const Vector3<Scalar> stiffness = settings.stiffness.translational.template cast<Scalar>();
  const Vector3<Scalar> rotational_stiffness = settings.stiffness.rotational.template cast<Scalar>();
  const Vector3<Scalar> phi = axes.in_axes(motion_between(renderer.follower().target(), renderer.follower().pose())).angular;
  const Matrix3<Scalar> by_graphic = inverse_left_jacobian<Scalar>(phi);  // dφ by a turn of the graphic tool
  const Matrix3<Scalar> by_haptic = -inverse_left_jacobian<Scalar>(Vector3<Scalar>(-phi));  // and of the haptic tool

  // The energy: second derivatives by the steps of both tools.
  const Matrix3<Scalar> bend = detail::derivative_of_pull<Scalar>(metric.rotational, phi, 1);
  const Matrix3<Scalar> turn = bend * by_graphic;
  Matrix6<Scalar> hessian = Matrix6<Scalar>::Zero();
  hessian.template topLeftCorner<3, 3>() = metric.translational.asDiagonal();
  hessian.template bottomRightCorner<3, 3>() = (turn + turn.transpose()) / 2;
  Matrix6<Scalar> mixed = Matrix6<Scalar>::Zero();
  mixed.template topLeftCorner<3, 3>() = -Matrix3<Scalar>(metric.translational.asDiagonal());
  mixed.template bottomRightCorner<3, 3>() = bend * by_haptic;

  // In coordinates in which the metric is the identity, `along` is the projection on the directions that the
  // contacts leave free.
  Vector6<Scalar> unit;
  for (int i = 0; i < 3; ++i) {
    unit[i] = Scalar(1) / sqrt(metric.translational[i]);
    unit[i + 3] = Scalar(1) / sqrt(metric.rotational[i]);
  }
  const auto& problem = renderer.follower().problem();
  const detail::PushingRows<Scalar> pushing(problem, axes, unit, Scalar(settings.margin) / 100);
  Matrix6<Scalar> across = Matrix6<Scalar>::Zero();
  Matrix6<Scalar> curvature = Matrix6<Scalar>::Zero();
  for (const auto& share : pushing.shares()) {
    curvature += share.force * axes.in_axes(curvature_of(problem.row(share.row)));
    Vector6<Scalar> rest = share.gradient - across * share.gradient;
    rest -= across * rest;  // once more, against rounding
    const Scalar dependent = Scalar(1e-6);
    if (rest.norm() > dependent * share.gradient.norm()) across += rest.normalized() * rest.normalized().transpose();
  }
  if (!problem.is_solved()) across.setIdentity();  // the work ran out before the next step was known: the tool stays
  const Matrix6<Scalar> along = Matrix6<Scalar>::Identity() - across;
  const auto scaled = [&](const Matrix6<Scalar>& m) { return Matrix6<Scalar>(unit.asDiagonal() * m * unit.asDiagonal()); };
  Eigen::LLT<Matrix6<Scalar>> factor(along * scaled(hessian - curvature) * along + across);
  constexpr Eigen::ComputationInfo success{};  // the enumerator's name is a macro of X11
  result.is_smooth = factor.info() == success && status == TickStatus::converged && !pushing.has_idle();
  if (factor.info() != success) factor.compute(along * scaled(hessian) * along + across);
  if (factor.info() != success) factor.compute(Matrix6<Scalar>::Identity());  // turned by π: as if in flat space
  const Matrix6<Scalar> answer = unit.asDiagonal() * Matrix6<Scalar>(along * factor.solve(along * scaled(mixed))) * unit.cwiseInverse().asDiagonal();

  const Matrix3<Scalar> twist = detail::derivative_of_pull<Scalar>(rotational_stiffness, phi, -1);
  Matrix6<Scalar> graphic = Matrix6<Scalar>::Zero();
  graphic.template topLeftCorner<3, 3>() = stiffness.asDiagonal();
  graphic.template bottomRightCorner<3, 3>() = twist * by_graphic;
  Matrix6<Scalar> haptic = Matrix6<Scalar>::Zero();
  haptic.template topLeftCorner<3, 3>() = -Matrix3<Scalar>(stiffness.asDiagonal());
  haptic.template bottomRightCorner<3, 3>() = twist * by_haptic;
  result.matrix = axes.in_world(Matrix6<Scalar>(haptic - graphic * answer));
  return result;
}

}  // namespace feeler
