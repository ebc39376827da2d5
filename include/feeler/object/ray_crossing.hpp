// Where a ray along x crosses a triangle, decided without rounding.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "feeler/core/exact_sum.hpp"
#include "feeler/core/scalar.hpp"

namespace feeler {

namespace detail {

constexpr int sign_of(double x) noexcept { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// On which side of the line from u to v a point p lies in the plane of y and z: 1 on the left. Where it is
/// on the line, that of a point that is off by less than any number in y, and by less than that in z; 0 only
/// where the line is a point there.
inline int side_of_line(const Vector3<double>& u, const Vector3<double>& v, const Vector3<double>& p) noexcept {
  const double left = (v.y() - u.y()) * (p.z() - u.z()), right = (v.z() - u.z()) * (p.y() - u.y());
  if (std::abs(left - right) > 4 * std::numeric_limits<double>::epsilon() * (std::abs(left) + std::abs(right))) return sign_of(left - right);
  const auto parts = [](double a, double b) {
    const TwoParts two = TwoParts::difference(a, b);
    return std::array{two.high, two.low};
  };
  ExactSum<17> sum;
  const auto add_product = [&sum](const std::array<double, 2>& a, const std::array<double, 2>& b, double sign) {
    for (const double x : a) {
      for (const double y : b) {
        const TwoParts product = TwoParts::product(sign * x, y);
        sum.add(product.low);
        sum.add(product.high);
      }
    }
  };
  add_product(parts(v.y(), u.y()), parts(p.z(), u.z()), 1);
  add_product(parts(v.z(), u.z()), parts(p.y(), u.y()), -1);
  if (sum.sign() != 0) return sum.sign();
  return v.z() != u.z() ? sign_of(u.z() - v.z()) : sign_of(v.y() - u.y());
}

/// On which side of a plane through three points a point lies: 1 where they are seen counter-clockwise, 0 on
/// the plane.
/// @param triangle  one corner in each column
inline int side_of_plane(const Matrix3<double>& triangle, const Vector3<double>& p) noexcept {
  const Matrix3<double> from = triangle.colwise() - p;
  double volume = 0, size = 0;
  const auto each_product = [](const auto& visit) {
    for (int k = 0; k < 3; ++k) {
      visit(k, (k + 1) % 3, (k + 2) % 3, -1.0);
      visit(k, (k + 2) % 3, (k + 1) % 3, 1.0);
    }
  };
  each_product([&](int x, int y, int z, double sign) {
    const double product = from(x, 0) * from(y, 1) * from(z, 2);
    volume += sign * product;
    size += std::abs(product);
  });
  if (std::abs(volume) > 16 * std::numeric_limits<double>::epsilon() * size) return sign_of(volume);
  ExactSum<193> sum;
  const auto parts = [&](int axis, int corner) {
    const TwoParts two = TwoParts::difference(triangle(axis, corner), p[axis]);
    return std::array{two.high, two.low};
  };
  each_product([&](int x, int y, int z, double sign) {
    for (const double a : parts(x, 0)) {
      for (const double b : parts(y, 1)) {
        const TwoParts product = TwoParts::product(a, b);
        for (const double c : parts(z, 2)) {
          for (const double ab : {product.low, product.high}) {
            const TwoParts all = TwoParts::product(ab, sign * c);
            sum.add(all.low);
            sum.add(all.high);
          }
        }
      }
    }
  });
  return sum.sign();
}

}  // namespace detail

/// How a ray from a point along x crosses a triangle: 1 in the direction of its normal, −1 against it, 0 not
/// at all.
///
/// Decided exactly, and of the triangles around an edge or a corner that the ray meets as if it passed beside
/// it: the crossings of a closed surface sum up to its winding number around the point. A point on the
/// triangle is in front of it.
/// @param triangle  one corner in each column [m]
inline int ray_crossing(const Vector3<double>& point, const Matrix3<double>& triangle) noexcept {
  if (triangle.row(0).maxCoeff() < point.x()) return 0;
  const int facing = detail::side_of_line(triangle.col(0), triangle.col(1), point);
  if (facing == 0 || detail::side_of_line(triangle.col(1), triangle.col(2), point) != facing ||
      detail::side_of_line(triangle.col(2), triangle.col(0), point) != facing)
    return 0;
  return detail::side_of_plane(triangle, point) == -facing ? facing : 0;
}

}  // namespace feeler
