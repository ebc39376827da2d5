// Exact answers to "which side of this plane?" for points on an integer lattice.
#pragma once

#include <cmath>
#include <cstdint>

namespace feeler::detail {

__extension__ typedef __int128 WideInteger;

/// Bits of a lattice coordinate: the side of the bounding box is 2^60 units, so a unit is far below the
/// rounding of a double.
inline constexpr int lattice_bits = 60;

/// A point with coordinates in [0, 2^60].
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
};

/// The oriented plane through three lattice points, with its exact normal (b − a) × (c − a).
///
/// A component of the normal has 122 bits; it is kept as high · 2^60 + low, 0 ≤ low < 2^60, so that its
/// product with a coordinate fits 128 bits. No rounding happens anywhere, hence no tolerance, no assumption
/// on the floating-point environment, and topology built on it is consistent.
class LatticePlane {
 public:
  LatticePlane() noexcept = default;
  LatticePlane(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) noexcept : origin_(a) {
    const WideInteger ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const WideInteger vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const WideInteger normal[3] = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    for (int k = 0; k < 3; ++k) {
      high_[k] = std::int64_t(normal[k] >> lattice_bits);
      low_[k] = std::int64_t(normal[k] & mask);
      normal_[k] = static_cast<long double>(normal[k]);
    }
    length_ = std::sqrt(normal_[0] * normal_[0] + normal_[1] * normal_[1] + normal_[2] * normal_[2]);
  }

  /// Exactly normal · (p − a) > 0.
  bool is_below(const LatticePoint& p) const noexcept {
    const Volume v = volume(p);
    return v.high > 0 || (v.high == 0 && v.low > 0);
  }
  /// Height of a point above the plane in lattice units, to relative rounding.
  long double height(const LatticePoint& p) const noexcept {
    const Volume v = volume(p);
    return (std::ldexp(static_cast<long double>(v.high), lattice_bits) + static_cast<long double>(v.low)) / length_;
  }
  /// The normal, to relative rounding of each component; its length is twice the area of the triangle.
  const long double* normal() const noexcept { return normal_; }
  long double length() const noexcept { return length_; }

 private:
  static constexpr WideInteger mask = (WideInteger(1) << lattice_bits) - 1;
  /// high · 2^60 + low, 0 ≤ low < 2^60.
  struct Volume {
    WideInteger high;
    WideInteger low;
  };

  Volume volume(const LatticePoint& p) const noexcept {
    const WideInteger dx = p.x - origin_.x, dy = p.y - origin_.y, dz = p.z - origin_.z;
    const WideInteger high = high_[0] * dx + high_[1] * dy + high_[2] * dz;
    const WideInteger low = low_[0] * dx + low_[1] * dy + low_[2] * dz;
    return {high + (low >> lattice_bits), low & mask};
  }

  LatticePoint origin_;
  std::int64_t high_[3] = {0, 0, 0};
  std::int64_t low_[3] = {0, 0, 0};
  long double normal_[3] = {0, 0, 0};
  long double length_ = 0;
};

}  // namespace feeler::detail
