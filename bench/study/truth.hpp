// The nearest free pose in 50 digits, by a method that shares nothing with the renderer but the solver of its first guesses.
#pragma once

#include <optional>
#include <vector>

#include "study/feature_gaps.hpp"

namespace feeler::study {

/// A local minimum of the distance to the hand: the pose that Newton's method gives, and what proves it.
struct NearestPose {
  Pose<Real> pose;
  Vector3<Real> force, torque;  ///< on the hand [N], [N·m]
  std::vector<FeaturePair> active;  ///< the pairs that hold it
  std::vector<Real> multipliers;  ///< of those; none is negative
  Real last_step = 0;  ///< of Newton's method, by which a point of the tool moved at most [m]
  double curvature = 0;  ///< least eigenvalue of the Lagrangian's Hessian on what the pairs leave free; positive
};

/// min ½ eᵀ M e over the poses at which no triangle is nearer to the tool than a distance.
///
/// From a free pose near the minimum, sequential quadratic programming over all pairs of features that are near finds which of them hold the tool; then
/// Newton's method on their Karush-Kuhn-Tucker conditions, its derivatives by differences in 50 digits, for smaller and smaller distances: what is left is
/// the rigid problem. The answer is checked against every triangle, none of which may cut into the tool, the signs of the multipliers and the
/// second-order condition (Nocedal and Wright, "Numerical Optimization", theorems 12.1 and 12.6); else there is none.
class Truth {
 public:
  explicit Truth(const StudyScene& scene);

  /// @param near   a free pose about the minimum
  /// @param first, last  distances that are kept to begin with and in the end [m]
  std::optional<NearestPose> nearest(const Pose<double>& hand, const Pose<double>& near, double first = 1e-6, double last = 1e-12) const;

  /// Further steps of Newton's method, each of which squares the error.
  NearestPose tightened(const Pose<double>& hand, NearestPose answer, double distance, int steps) const;

  /// ½ eᵀ M e of a pose [m²].
  Real energy(const Pose<double>& hand, const Pose<Real>& pose) const;
  /// The pose after a step: the origin goes by the first three coordinates [m], the axes turn by the others [rad].
  static Pose<Real> moved(const Pose<Real>& pose, const Vector6<Real>& step);
  const FeatureGaps& gaps() const { return gaps_; }

 private:
  Vector6<Real> energy_gradient(const Pose<double>& hand, const Pose<Real>& pose) const;
  Vector6<Real> lagrangian_gradient(const Pose<double>& hand, const NearestPose& answer, const Pose<Real>& pose) const;
  Matrix6<Real> lagrangian_hessian(const Pose<double>& hand, const NearestPose& answer) const;
  bool find_active(const Pose<double>& hand, NearestPose& answer, double distance) const;
  bool newton(const Pose<double>& hand, NearestPose& answer, double distance, int steps) const;
  bool refine(const Pose<double>& hand, NearestPose& answer, double distance) const;
  Eigen::MatrixXd held_rows(const NearestPose& answer) const;
  bool is_independent(const FeaturePair& pair, NearestPose answer) const;
  bool is_stationary(const NearestPose& answer, double distance) const;
  bool is_curved(const Pose<double>& hand, NearestPose& answer) const;

  FeatureGaps gaps_;
  Vector3<Real> stiffness_, rotational_stiffness_;
};

}  // namespace feeler::study
