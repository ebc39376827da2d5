// Random numbers, directions and rotations that are the same with every standard library: raw bits of a
// mt19937.
#pragma once

#include <cmath>
#include <random>

#include <Eigen/Geometry>

namespace feeler_test {

/// Uniform in [-1, 1).
inline double unit(std::mt19937& bits) { return double(bits()) / 2147483648.0 - 1.0; }
/// Uniform in [0, 1).
inline double fraction(std::mt19937& bits) { return double(bits()) / 4294967296.0; }
inline int below(std::mt19937& bits, int count) { return int(bits() % unsigned(count)); }
/// From 10^low to 10^high, uniform in the exponent.
inline double magnitude(std::mt19937& bits, double low, double high) { return std::pow(10.0, low + (high - low) * fraction(bits)); }
inline Eigen::Vector3d random_vector(std::mt19937& bits) {
  const double x = unit(bits), y = unit(bits), z = unit(bits);
  return {x, y, z};
}
inline Eigen::Matrix<double, 6, 1> random_six(std::mt19937& bits) {
  Eigen::Matrix<double, 6, 1> v;
  for (int i = 0; i < 6; ++i) v[i] = unit(bits);
  return v;
}
inline Eigen::Vector3d random_direction(std::mt19937& bits) {
  for (;;) {
    const Eigen::Vector3d v = random_vector(bits);
    if (v.norm() <= 1 && v.norm() > 0.1) return v.normalized();
  }
}
inline Eigen::Quaterniond random_rotation(std::mt19937& bits) {
  const Eigen::Vector3d axis = random_direction(bits);
  return Eigen::Quaterniond(Eigen::AngleAxisd(3.14159 * unit(bits), axis));
}

}  // namespace feeler_test
