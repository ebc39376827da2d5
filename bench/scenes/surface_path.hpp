// The height of an object under a moving ray, smoothed in time: how a hand follows a surface that it sees.
#pragma once

#include <limits>
#include <numbers>
#include <utility>

#include "scenes/motions.hpp"

namespace feeler::scenes {

/// A ray: a point and a unit direction that looks away from the object.
struct Ray {
  Vector origin;
  Vector outward;
};

/// Distance from the ray's origin to its outermost crossing with the object [m]; −infinity where there is
/// none.
/// @cost every triangle
inline double outermost_crossing(const Points<double>& vertices, const Triangles& triangles, const Ray& ray) {
  double outermost = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    const Vector a = vertices.row(triangles(i, 0)).transpose();
    const Vector ab = vertices.row(triangles(i, 1)).transpose() - a;
    const Vector ac = vertices.row(triangles(i, 2)).transpose() - a;
    const Vector across = ray.outward.cross(ac);
    const double determinant = ab.dot(across);
    if (determinant == 0.0) continue;
    const Vector from_a = ray.origin - a;
    const double u = from_a.dot(across) / determinant;
    if (!(u >= 0.0 && u <= 1.0)) continue;
    const Vector normal = from_a.cross(ab);
    const double v = ray.outward.dot(normal) / determinant;
    if (!(v >= 0.0 && u + v <= 1.0)) continue;
    outermost = std::max(outermost, ac.dot(normal) / determinant);
  }
  return outermost;
}

/// Heights of a surface along a moving ray: cast once at regular times, averaged, then joined by cubic
/// curves.
///
/// A hand has mass, so it smooths what it follows; and a motion must be cheap when the servo loop asks for
/// it.
class SurfacePath {
 public:
  /// @param ray_at    the ray at a time [s]
  /// @param fallback  height where a ray misses the object before it ever hit it [m]
  /// @param duration  after it the path runs backwards [s]
  template <class RayAt>
  SurfacePath(const Points<double>& vertices, const Triangles& triangles, const RayAt& ray_at, double fallback, double duration)
      : duration_(duration) {
    const int knots = int(std::ceil(duration / spacing)) + 1;
    std::vector<double> cast(std::size_t(knots), fallback);
    for (int i = 0; i < knots; ++i) {
      const double height = outermost_crossing(vertices, triangles, ray_at(double(i) * spacing));
      const double before = i > 0 ? cast[std::size_t(i - 1)] : fallback;
      cast[std::size_t(i)] = std::isfinite(height) ? height : before;
    }
    heights_ = smoothed(smoothed(cast));
  }

  /// Folds time into the path, forth and back for ever; the hand rests where it turns.
  double folded(double t) const { return duration_ / 2.0 * (1.0 - std::cos(std::numbers::pi * t / duration_)); }

  /// Height at a folded time [m].
  double operator()(double t) const {
    const double position = std::clamp(t, 0.0, duration_) / spacing;
    const int last = int(heights_.size()) - 1;
    const int i = std::min(int(position), last);
    const double s = position - double(i);
    const auto knot = [&](int k) { return heights_[std::size_t(std::clamp(k, 0, last))]; };
    const double before = knot(i - 1), from = knot(i), to = knot(i + 1), after = knot(i + 2);
    return from + 0.5 * s * (to - before + s * (2.0 * before - 5.0 * from + 4.0 * to - after + s * (3.0 * (from - to) + after - before)));
  }

 private:
  static constexpr double spacing = 0.01;  // [s]

  static std::vector<double> smoothed(const std::vector<double>& values) {
    const int last = int(values.size()) - 1;
    std::vector<double> result(values.size());
    for (int i = 0; i <= last; ++i) {
      double sum = 0.0;
      for (int k = -2; k <= 2; ++k) sum += values[std::size_t(std::clamp(i + k, 0, last))];
      result[std::size_t(i)] = sum / 5.0;
    }
    return result;
  }

  double duration_;
  std::vector<double> heights_;
};

}  // namespace feeler::scenes
