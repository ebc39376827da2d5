// The nearest free pose in 50 digits, by a method that shares nothing with the renderer but the solver of its first guesses.
#pragma once

#include <array>
#include <compare>
#include <limits>
#include <optional>
#include <vector>

#include "study/player.hpp"
#include "support/multiprecision.hpp"
#include "support/wide_distance.hpp"

namespace feeler::study {

using Real = feeler_test::Float50;

/// A vertex, an edge or a face of a piece of the tool and one of a triangle: the two are closest inside both. Corners by their numbers; −1 where there is none.
struct FeaturePair {
  int piece = 0;
  std::array<int, 3> tool{-1, -1, -1}, object{-1, -1, -1};
  auto operator<=>(const FeaturePair&) const = default;
};

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
/// the rigid problem. The answer is checked against every triangle, the signs of the multipliers and the second-order condition (Nocedal and
/// Wright, "Numerical Optimization", theorems 12.1 and 12.6); else there is none.
class Truth {
 public:
  explicit Truth(const StudyScene& scene);

  /// @param near   a free pose about the minimum
  /// @param first, last  distances that are kept to begin with and in the end [m]
  std::optional<NearestPose> nearest(const Pose<double>& hand, const Pose<double>& near, double first = 1e-6, double last = 1e-12) const;

  /// Further steps of Newton's method, each of which squares the error.
  NearestPose tightened(const Pose<double>& hand, NearestPose answer, double distance, int steps) const;

  /// Distance of the tool from the nearest triangle [m]; infinite beyond `reach`.
  Wide distance(const Pose<Real>& pose, double reach) const;
  /// ½ eᵀ M e of a pose [m²].
  Real energy(const Pose<double>& hand, const Pose<Real>& pose) const;
  /// The pose after a step: the origin goes by the first three coordinates [m], the axes turn by the others [rad].
  static Pose<Real> moved(const Pose<Real>& pose, const Vector6<Real>& step);
  /// Largest distance of a point of the tool from the origin of its frame [m].
  double radius() const { return radius_; }

 private:
  using WidePoint = Vector3<Wide>;
  using WidePoints = std::vector<WidePoint>;

  /// A box in the tool frame.
  struct Bounds {
    WidePoint low = WidePoint::Constant(std::numeric_limits<Wide>::infinity()), high = -low;
    void add(const WidePoint& point) { low = low.cwiseMin(point), high = high.cwiseMax(point); }
    void grow(Wide by) { low.array() -= by, high.array() += by; }
    bool meets(const Bounds& other) const { return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all(); }
  };
  /// A convex piece of the tool, in the tool frame.
  struct Piece {
    test::WideTool shape;
    std::vector<Vector3<Real>> vertices = {};
    Bounds bounds = {};
    std::vector<Bounds> of_vertex = {}, of_edge = {}, of_face = {};
  };

  struct Gap {
    Real value;
    Vector6<Real> gradient;  // by a step
  };
  struct Near {
    FeaturePair pair;
    Wide distance;
  };

  std::vector<Near> pairs_near(const Pose<Real>& pose, double reach) const;
  template <class Add>
  static void add_pairs(const Piece& piece, const WidePoints& vertices, const std::array<int, 3>& ids, const std::array<WidePoint, 3>& corners,
                        const Bounds& box, const Add& add);
  Gap gap(const FeaturePair& pair, const Pose<Real>& pose) const;
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

  std::vector<Piece> pieces_;
  Points<double> vertices_;
  Triangles triangles_;
  Vector3<Real> stiffness_, rotational_stiffness_;
  double radius_ = 0;
  double rounding_ = 0;  // of the vertices as given: so flat is a face that is cut into triangles [m]
};

}  // namespace feeler::study
