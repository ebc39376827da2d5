// Pairs of features of a tool and a triangle mesh that are closest to each other, and their gaps in 50 digits.
#pragma once

#include <array>
#include <compare>
#include <limits>
#include <vector>

#include "study/player.hpp"
#include "support/multiprecision.hpp"
#include "support/wide_distance.hpp"

namespace feeler::study {

using Real = feeler_test::Float50;

Vector3<Wide> wide(const Vector3<Real>& v);
Pose<Wide> wide(const Pose<Real>& pose);

/// A vertex, an edge or a face of a piece of the tool and one of a triangle: the two are closest inside both. Corners by their numbers; −1 where there is none.
struct FeaturePair {
  int piece = 0;
  std::array<int, 3> tool{-1, -1, -1}, object{-1, -1, -1};
  auto operator<=>(const FeaturePair&) const = default;
};

/// Distance of a pair of features at a pose, and how it changes with a step.
struct Gap {
  Real value;  ///< [m]
  Vector6<Real> gradient;  ///< by a step: the origin goes by the first three coordinates [m], the axes turn by the others [rad]
};

/// The gaps between the convex pieces of a tool and the triangles of a scene, by brute force over their features.
class FeatureGaps {
 public:
  explicit FeatureGaps(const StudyScene& scene);

  struct Near {
    FeaturePair pair;
    Wide distance;  ///< [m]
  };
  /// All pairs that are closest inside both of their features, and not farther than a reach [m]. Where a triangle cuts into a piece the closest pairs say nothing
  /// of it; see `cuts`.
  std::vector<Near> pairs_near(const Pose<Real>& pose, double reach) const;
  Gap gap(const FeaturePair& pair, const Pose<Real>& pose) const;
  /// Distance of the tool from the nearest triangle [m]; infinite beyond `reach`.
  Wide distance(const Pose<Real>& pose, double reach) const;
  /// Whether a triangle and a piece have a point in common.
  bool cuts(const Pose<Real>& pose) const;

  /// Largest distance of a point of the tool from the origin of its frame [m].
  double radius() const { return radius_; }
  /// Of the vertices as given: so flat is a face that is cut into triangles [m].
  double rounding() const { return rounding_; }

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

  template <class Visit>
  void visit_near(const Pose<Wide>& pose, double reach, const Visit& visit) const;
  template <class Add>
  static void add_pairs(const Piece& piece, const WidePoints& vertices, const std::array<int, 3>& ids, const test::WideTriangle& corners,
                        const Bounds& box, const Add& add);

  std::vector<Piece> pieces_;
  Points<double> vertices_;
  Triangles triangles_;
  double radius_ = 0, rounding_ = 0;
};

}  // namespace feeler::study
