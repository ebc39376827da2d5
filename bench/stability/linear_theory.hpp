// The limit of stiffness that linear theory gives for a hand on a wall: what the simulation must agree with
// where it is linear.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "feeler/device/simulated_hand.hpp"

namespace feeler::stability {

/// Largest modulus of an eigenvalue, by Gelfand's formula: the root of degree n of |Aⁿ|, with n = 2⁵⁰ by squaring.
inline double spectral_radius(Eigen::Matrix3d a) {
  double logarithm = 0;
  double share = 1;
  for (int squaring = 0; squaring <= 50; ++squaring) {
    const double size = a.norm();
    logarithm += share * std::log(size);
    a /= size;
    a *= a;
    share /= 2;
  }
  return std::exp(logarithm);
}

/// Largest eigenvalue of one tick of a handle on a grip and a bilateral wall that is felt one tick late:
/// above 1 it grows.
///
/// m x'' = −k x − c x' − b x' + F is sampled exactly; the push of a tick is −K x of the tick before. No
/// friction, no encoder.
/// @param stiffness  K of the wall [N/m]
inline double growth_of_a_tick(const Handle& handle, const Grip& grip, double period, double stiffness) {
  const double damping = handle.damping + 2 * grip.damping_ratio * std::sqrt(grip.stiffness * handle.mass);
  // exp([A B; 0 0] T) by squaring: x, v and the constant push.
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
  rate(0, 1) = 1;
  rate(1, 0) = -grip.stiffness / handle.mass;
  rate(1, 1) = -damping / handle.mass;
  rate(1, 2) = 1 / handle.mass;
  constexpr int doublings = 20;
  const Eigen::Matrix3d small = rate * (period / double(1 << doublings));
  Eigen::Matrix3d tick = small + small * small / 2;  // exp − 1, to keep its digits
  for (int i = 0; i < doublings; ++i) tick = Eigen::Matrix3d(2 * tick + tick * tick);
  tick += Eigen::Matrix3d::Identity();
  tick.row(2) << -stiffness, 0, 0;  // pushed from the next tick on
  return spectral_radius(tick);
}

/// The largest K that grows by no more than this in a second [N/m], by bisection; below 1 it must decay.
inline double linear_limit(const Handle& handle, const Grip& grip, double period, double growth = 1) {
  const double growth_of_period = std::pow(growth, period);
  double good = 1, bad = 1e8;
  while (bad / good > 1.001) {
    const double middle = std::sqrt(good * bad);
    (growth_of_a_tick(handle, grip, period, middle) <= growth_of_period ? good : bad) = middle;
  }
  return good;
}

}  // namespace feeler::stability
