// Which arithmetic a program computes in: two that differ in a last bit render different trajectories.
#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "golden/bits.hpp"
#include "scenes/motions.hpp"

namespace feeler::bench {

/// A hash over results that the C++ and IEEE 754 standards leave open: the last bits of sin, cos, tan, atan2
/// and exp, which differ between mathematics libraries, and within one between processors for which it has
/// variants; and whether a product and a sum are rounded once or twice, by the compiler's choice and by
/// Eigen's.
inline std::uint64_t arithmetic() {
  BitHash hash;
  scenes::RandomBits random(1);
  const auto within = [&](double largest) { return largest * (2.0 * random.unit() - 1.0); };
  for (int i = 0; i < 20000; ++i) {
    const double x = within(4.0), y = within(4.0), z = within(4.0);
    for (const double value : {std::sin(x), std::cos(x), std::tan(x), std::atan2(x, y), std::exp(x), x * y + z}) hash.add(value);
    const Eigen::Matrix4d square = Eigen::Matrix4d::Identity() * x + Eigen::Matrix4d::Constant(z);
    hash.add(Eigen::Vector4d(square * Eigen::Vector4d(x, y, z, x - y)));
  }
  return hash.value();
}

}  // namespace feeler::bench
