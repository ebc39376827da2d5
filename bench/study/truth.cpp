#include "study/truth.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Dense>

#include "feeler/qp/dual_active_set.hpp"

namespace feeler::study {
namespace {

using RealVector = Vector3<Real>;

RealVector real(const Vector3<double>& v) { return v.cast<Real>(); }

/// Rotation vector of a unit quaternion.
RealVector log_of(const Quaternion<Real>& q) {
  const Real sine = q.vec().norm();
  if (!(sine > 0)) return RealVector::Zero();
  const Real sign = q.w() < 0 ? -1 : 1;
  return (sign * 2 * atan2(sine, Real(sign * q.w())) / sine) * q.vec();
}

}  // namespace

Truth::Truth(const StudyScene& scene)
    : gaps_(scene), stiffness_(real(scene.stiffness().translational)), rotational_stiffness_(real(scene.stiffness().rotational)) {}

Pose<Real> Truth::moved(const Pose<Real>& pose, const Vector6<Real>& step) {
  const RealVector turn = step.tail<3>();
  const Real angle = turn.norm();
  Quaternion<Real> rotation = pose.rotation;
  if (angle > 0) {
    const RealVector axis = (sin(Real(angle / 2)) / angle) * turn;
    rotation = (Quaternion<Real>(cos(Real(angle / 2)), axis.x(), axis.y(), axis.z()) * rotation).normalized();
  }
  return {pose.translation + step.head<3>(), rotation};
}

Vector6<Real> Truth::energy_gradient(const Pose<double>& hand, const Pose<Real>& pose) const {
  // With equal weights about all axes the inverse Jacobian of the logarithm maps its argument to itself.
  Vector6<Real> gradient;
  gradient << stiffness_.cwiseProduct(pose.translation - real(hand.translation)),
      rotational_stiffness_.cwiseProduct(log_of((pose.rotation * hand.rotation.cast<Real>().normalized().conjugate()).normalized()));
  return gradient / stiffness_.maxCoeff();
}

Real Truth::energy(const Pose<double>& hand, const Pose<Real>& pose) const {
  const RealVector way = pose.translation - real(hand.translation),
                   turn = log_of((pose.rotation * hand.rotation.cast<Real>().normalized().conjugate()).normalized());
  return (way.dot(stiffness_.cwiseProduct(way)) + turn.dot(rotational_stiffness_.cwiseProduct(turn))) / (2 * stiffness_.maxCoeff());
}

Vector6<Real> Truth::lagrangian_gradient(const Pose<double>& hand, const NearestPose& answer, const Pose<Real>& pose) const {
  Vector6<Real> gradient = energy_gradient(hand, pose);
  for (std::size_t i = 0; i < answer.active.size(); ++i) gradient -= answer.multipliers[i] * gaps_.gap(answer.active[i], pose).gradient;
  return gradient;
}

Matrix6<Real> Truth::lagrangian_hessian(const Pose<double>& hand, const NearestPose& answer) const {
  const Real width = 1e-18;
  Matrix6<Real> hessian;
  for (int k = 0; k < 6; ++k) {
    const Vector6<Real> step = width * Vector6<Real>::Unit(k);
    hessian.col(k) =
        (lagrangian_gradient(hand, answer, moved(answer.pose, step)) - lagrangian_gradient(hand, answer, moved(answer.pose, -step))) / (2 * width);
  }
  return hessian;
}

bool Truth::find_active(const Pose<double>& hand, NearestPose& answer, double distance) const {
  // Rows of features that are parallel hold near by only.
  const double band = distance / 2, longest = distance / 5;
  DualActiveSet<double> solver;
  QpSolution<double> solution;
  for (int iteration = 0; iteration < 150; ++iteration) {
    const auto near = gaps_.pairs_near(answer.pose, distance + band);
    QpProblem<double> problem;
    // The curvature of the pairs that held it last, where the whole is convex with it.
    const Matrix6<double> curved = lagrangian_hessian(hand, answer).unaryExpr([](const Real& x) { return static_cast<double>(x); });
    const Matrix6<double> symmetric = (curved + curved.transpose()) / 2;
    const double least_weight = std::min(1.0, static_cast<double>(Real(rotational_stiffness_.minCoeff() / stiffness_.maxCoeff())));
    const bool is_convex = Eigen::SelfAdjointEigenSolver<Matrix6<double>>(symmetric).eigenvalues().minCoeff() > 0.1 * least_weight;
    problem.hessian = symmetric;
    if (!is_convex) {
      problem.hessian.setZero();
      problem.hessian.diagonal() << Vector3<double>::Ones(),
          Vector3<double>::Constant(static_cast<double>(Real(rotational_stiffness_.x() / stiffness_.x())));
    }
    problem.gradient = energy_gradient(hand, answer.pose).unaryExpr([](const Real& x) { return static_cast<double>(x); });
    std::vector<std::size_t> of_row;
    for (std::size_t i = 0; i < near.size() && problem.row_count < QpProblem<double>::row_capacity; ++i) {
      const Gap at = gaps_.gap(near[i].pair, answer.pose);
      problem.add_row(at.gradient.unaryExpr([](const Real& x) { return static_cast<double>(x); }), static_cast<double>(Real(distance - at.value)));
      of_row.push_back(i);
    }
    if (solver.solve(problem, solution) != QpStatus::optimal) return false;
    answer.active.clear();
    answer.multipliers.clear();
    for (const auto& active : solution.active) {
      answer.active.push_back(near[of_row[std::size_t(active.row)]].pair);
      answer.multipliers.emplace_back(active.multiplier);
    }
    const double length = solution.step.head<3>().norm() + gaps_.radius() * solution.step.tail<3>().norm();
    Vector6<double> step = solution.step;
    if (length > longest) step *= longest / length;
    answer.pose = moved(answer.pose, step.cast<Real>());
    if (length < 1e-3 * distance) return true;
  }
  return false;
}

bool Truth::newton(const Pose<double>& hand, NearestPose& answer, double distance, int steps) const {
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  const auto held = Eigen::Index(answer.active.size());
  for (int step = 0; step < steps; ++step) {
    Matrix matrix = Matrix::Zero(6 + held, 6 + held);
    Vector rest(6 + held);
    matrix.topLeftCorner(6, 6) = lagrangian_hessian(hand, answer);
    rest.head(6) = lagrangian_gradient(hand, answer, answer.pose);
    for (Eigen::Index i = 0; i < held; ++i) {
      const Gap at = gaps_.gap(answer.active[std::size_t(i)], answer.pose);
      matrix.block(0, 6 + i, 6, 1) = -at.gradient;
      matrix.block(6 + i, 0, 1, 6) = at.gradient.transpose();
      rest[6 + i] = at.value - distance;
    }
    const Vector change = matrix.fullPivLu().solve(-rest);
    answer.pose = moved(answer.pose, change.head<6>());
    for (Eigen::Index i = 0; i < held; ++i) answer.multipliers[std::size_t(i)] += change[6 + i];
    answer.last_step = change.head<3>().norm() + gaps_.radius() * change.segment<3>(3).norm();
    if (!(answer.last_step < 1e-4)) return false;
    if (answer.last_step < Real("1e-36")) return true;
  }
  return answer.last_step < Real("1e-28");
}

/// Newton's method on the pairs at hand, and then with those too that are as near but for rounding, as where faces lie flush, as far as they push and do not pull.
bool Truth::refine(const Pose<double>& hand, NearestPose& answer, double distance) const {
  if (!newton(hand, answer, distance, 12) || !is_stationary(answer, distance)) return false;
  while (answer.active.size() < 6) {
    std::vector<std::pair<Real, FeaturePair>> tight;
    for (const FeatureGaps::Near& near : gaps_.pairs_near(answer.pose, distance + 1e-13)) {
      const Real room = gaps_.gap(near.pair, answer.pose).value - distance;
      if (room < gaps_.rounding() && std::find(answer.active.begin(), answer.active.end(), near.pair) == answer.active.end())
        tight.emplace_back(room, near.pair);
    }
    std::sort(tight.begin(), tight.end());
    if ((tight.empty() || tight.front().first > -Real("1e-28")) && is_curved(hand, answer)) return true;
    const auto can_be_held = [&](const auto& pair) {
      if (!is_independent(pair.second, answer)) return false;
      NearestPose trial = answer;
      trial.active.push_back(pair.second);
      trial.multipliers.emplace_back(0);
      if (!newton(hand, trial, distance, 12) || !is_stationary(trial, distance)) return false;
      answer = trial;
      return true;
    };
    if (std::none_of(tight.begin(), tight.end(), can_be_held)) break;
  }
  return is_curved(hand, answer);
}

/// Gradients of what is held, a row each, with turns as lengths.
Eigen::MatrixXd Truth::held_rows(const NearestPose& answer) const {
  Eigen::MatrixXd rows(Eigen::Index(answer.active.size()), 6);
  for (std::size_t i = 0; i < answer.active.size(); ++i) {
    const Vector6<Real> gradient = gaps_.gap(answer.active[i], answer.pose).gradient;
    for (int k = 0; k < 6; ++k) rows(Eigen::Index(i), k) = static_cast<double>(gradient[k]) / (k < 3 ? 1 : gaps_.radius());
  }
  return rows;
}

/// Whether a pair holds in a direction of its own. Triangles of one face, not quite in a plane by rounding, do not.
bool Truth::is_independent(const FeaturePair& pair, NearestPose answer) const {
  answer.active.push_back(pair);
  return Eigen::JacobiSVD<Eigen::MatrixXd>(held_rows(answer)).singularValues().minCoeff() > 1e-6;
}

/// Whether the pairs that are held push, are closest inside both of their features or the same as a pair that is, and no other is nearer.
bool Truth::is_stationary(const NearestPose& answer, double distance) const {
  const auto near = gaps_.pairs_near(answer.pose, distance + 1e-13 + gaps_.rounding());
  const auto is_met = [&](const FeaturePair& held) {
    const Gap at = gaps_.gap(held, answer.pose);
    return std::any_of(near.begin(), near.end(), [&](const FeatureGaps::Near& one) {
      if (one.pair == held) return true;
      const Gap other = gaps_.gap(one.pair, answer.pose);
      return other.value <= distance + gaps_.rounding() && (other.gradient - at.gradient).norm() < 1e-7;
    });
  };
  return std::all_of(answer.active.begin(), answer.active.end(), is_met) &&
         std::all_of(answer.multipliers.begin(), answer.multipliers.end(), [](const Real& multiplier) { return multiplier >= -Real("1e-24"); }) &&
         std::all_of(near.begin(), near.end(),
                     [&](const FeatureGaps::Near& one) { return gaps_.gap(one.pair, answer.pose).value >= distance - gaps_.rounding(); });
}

/// The second-order condition, on the null space of the gradients of what is held.
bool Truth::is_curved(const Pose<double>& hand, NearestPose& answer) const {
  if (answer.active.size() >= 6) return answer.curvature = std::numeric_limits<double>::infinity(), true;
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Identity(6, 6);
  if (!answer.active.empty()) kernel = Eigen::FullPivLU<Eigen::MatrixXd>(held_rows(answer)).kernel();
  Matrix6<double> hessian = lagrangian_hessian(hand, answer).unaryExpr([](const Real& x) { return static_cast<double>(x); });
  for (int k = 3; k < 6; ++k) hessian.row(k) /= gaps_.radius(), hessian.col(k) /= gaps_.radius();
  const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(kernel).householderQ() * Eigen::MatrixXd::Identity(6, kernel.cols());
  const Eigen::MatrixXd reduced = basis.transpose() * ((hessian + hessian.transpose()) / 2) * basis;
  answer.curvature = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(reduced).eigenvalues().minCoeff();
  return answer.curvature > 0;
}

NearestPose Truth::tightened(const Pose<double>& hand, NearestPose answer, double distance, int steps) const {
  newton(hand, answer, distance, steps);
  return answer;
}

std::optional<NearestPose> Truth::nearest(const Pose<double>& hand, const Pose<double>& near, double first, double last) const {
  NearestPose answer;
  answer.pose = {real(near.translation), near.rotation.cast<Real>().normalized()};
  if (!find_active(hand, answer, first)) return {};
  for (double distance = first;; distance = std::max(last, distance / 4)) {
    NearestPose trial = answer;
    const auto is_found = [&] { return refine(hand, trial, distance) && !gaps_.cuts(trial.pose); };
    if (!is_found()) {
      trial = answer;
      if (!find_active(hand, trial, distance) || !is_found()) return {};
    }
    answer = trial;
    if (distance <= last) break;
  }
  const Real unit = stiffness_.maxCoeff();
  const Vector6<Real> gradient = unit * energy_gradient(hand, answer.pose);
  answer.force = gradient.head<3>();
  answer.torque = gradient.tail<3>();
  return answer;
}

}  // namespace feeler::study
