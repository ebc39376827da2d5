// The height of an object under a moving ray, smoothed in time: how a hand follows a surface that it sees.
#pragma once

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "scenes/motions.hpp"

namespace feeler::scenes {

/// A ray: a point and a unit direction that looks away from the object.
struct Ray {
  Vector origin;
  Vector outward;
};

/// Distance from the ray's origin to its outermost crossing with the triangles from one to another [m]; −infinity where there is none.
inline double outermost_crossing(const Points<double>& vertices, const Triangles& triangles, const Ray& ray, Eigen::Index first, Eigen::Index last) {
  double outermost = -std::numeric_limits<double>::infinity();
  for (Eigen::Index i = first; i < last; ++i) {
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

/// The triangles in bundles, each in a ball, so that a ray leaves out those that it passes by: neighbours in a list are neighbours in space mostly.
class TriangleBundles {
 public:
  TriangleBundles(const Points<double>& vertices, const Triangles& triangles) : vertices_(vertices), triangles_(triangles) {
    for (Eigen::Index first = 0; first < triangles.rows(); first += size) {
      Eigen::AlignedBox3d box;
      for (Eigen::Index i = first; i < last_of(first); ++i)
        for (int k = 0; k < 3; ++k) box.extend(Vector(vertices.row(triangles(i, k)).transpose()));
      balls_.push_back({box.center(), 0.501 * box.diagonal().norm()});
    }
  }

  /// Of all triangles.
  double outermost_crossing(const Ray& ray) const {
    double outermost = -std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < balls_.size(); ++b) {
      const Vector way = balls_[b].centre - ray.origin;
      if ((way - ray.outward.dot(way) * ray.outward).norm() > balls_[b].radius) continue;
      const Eigen::Index first = Eigen::Index(b) * size;
      outermost = std::max(outermost, scenes::outermost_crossing(vertices_, triangles_, ray, first, last_of(first)));
    }
    return outermost;
  }

 private:
  static constexpr Eigen::Index size = 64;
  struct Ball {
    Vector centre;
    double radius;
  };

  Eigen::Index last_of(Eigen::Index first) const { return std::min(first + size, triangles_.rows()); }

  const Points<double>& vertices_;
  const Triangles& triangles_;
  std::vector<Ball> balls_;
};

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
    const TriangleBundles bundles(vertices, triangles);
    for (int i = 0; i < knots; ++i) {
      const double height = bundles.outermost_crossing(ray_at(double(i) * spacing));
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
