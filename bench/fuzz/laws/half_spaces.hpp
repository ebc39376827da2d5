// Rooms whose walls are planes, and the nearest point of an intersection of half spaces, in long double.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

namespace feeler::laws {

using Wide = long double;
using WideVector = Eigen::Matrix<Wide, 3, 1>;

/// The points with normal · x ≥ offset [m].
struct HalfSpace {
  WideVector normal;
  Wide offset = 0;

  /// Through three points of a wall, with a point inside.
  static HalfSpace through(const WideVector& a, const WideVector& b, const WideVector& c, const WideVector& inside) {
    WideVector normal = (b - a).cross(c - a).normalized();
    if (normal.dot(inside - a) < 0) normal = -normal;
    return {normal, normal.dot(a)};
  }
  Wide height(const WideVector& point) const { return normal.dot(point) - offset; }
};

/// The point of an intersection of half spaces that is nearest to a point, to about 1e-15 m.
///
/// At most three planes decide it. From those found so far and the plane most violated there, the best three or fewer of the four are
/// taken by trying all subsets; the distance grows each time, so it ends.
/// @throws std::logic_error  where there is none
class Projection {
 public:
  Projection(const std::vector<HalfSpace>& spaces, const WideVector& from) : spaces_(spaces), from_(from), point_(from) {
    for (int round = 0; round < 1000; ++round) {
      std::size_t worst = 0;
      Wide lowest = 0;
      for (std::size_t i = 0; i < spaces.size(); ++i)
        if (const Wide height = spaces[i].height(point_); height < lowest) lowest = height, worst = i;
      if (lowest >= -tolerance) return;
      add(worst);
    }
    throw std::logic_error("Projection: does not end; the half spaces may have no point in common");
  }
  const WideVector& point() const { return point_; }

 private:
  static constexpr Wide tolerance = 1e-15L;

  void add(std::size_t plane) {
    std::vector<std::size_t> among = basis_;
    among.push_back(plane);
    Wide nearest = std::numeric_limits<Wide>::infinity();
    WideVector best = point_;
    std::vector<std::size_t> best_basis;
    for (unsigned subset = 1; subset < (1U << among.size()); ++subset) {
      std::vector<std::size_t> chosen;
      for (std::size_t k = 0; k < among.size(); ++k)
        if ((subset >> k & 1U) != 0) chosen.push_back(among[k]);
      if (chosen.size() > 3) continue;
      const WideVector point = on_planes(chosen);
      const bool is_inside = std::all_of(among.begin(), among.end(), [&](std::size_t i) { return spaces_[i].height(point) >= -tolerance / 8; });
      if (const Wide distance = (point - from_).norm(); is_inside && distance < nearest) nearest = distance, best = point, best_basis = chosen;
    }
    if (best_basis.empty()) throw std::logic_error("Projection: four half spaces have no point in common");
    basis_ = best_basis;
    point_ = best;
  }

  /// The nearest point that lies on all of these planes; far away where they are parallel.
  WideVector on_planes(const std::vector<std::size_t>& planes) const {
    Eigen::Matrix<Wide, Eigen::Dynamic, 3, 0, 3, 3> normals(Eigen::Index(planes.size()), 3);
    Eigen::Matrix<Wide, Eigen::Dynamic, 1, 0, 3, 1> missing(Eigen::Index(planes.size()));
    for (Eigen::Index k = 0; k < normals.rows(); ++k) {
      const HalfSpace& space = spaces_[planes[std::size_t(k)]];
      normals.row(k) = space.normal.transpose();
      missing[k] = -space.height(from_);
    }
    const Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<Wide, Eigen::Dynamic, 3, 0, 3, 3>> solver(normals);
    const WideVector step = solver.solve(missing);
    return step.allFinite() ? WideVector(from_ + step) : WideVector(WideVector::Constant(std::numeric_limits<Wide>::infinity()));
  }

  const std::vector<HalfSpace>& spaces_;
  WideVector from_, point_;
  std::vector<std::size_t> basis_;
};

}  // namespace feeler::laws
