// Building blocks of motions: poses from formulas, approach, random bits, sampling, and a hostile device.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "scenes/scene.hpp"

namespace feeler::scenes {

using Vector = Vector3<double>;

inline Pose<double> pose_of(const Vector& rotation_vector, const Vector& position) { return {position, exp_rotation(rotation_vector)}; }

/// The ramp a = min(1, 2t) with which a hand comes down in the first half second.
inline double approach(double t) { return std::min(1.0, 2.0 * t); }

/// Random numbers from raw mt19937 bits: the distributions of the standard library differ between its
/// vendors.
class RandomBits {
 public:
  explicit RandomBits(std::uint32_t seed) : bits_(seed) {}

  /// Uniform in [0, 1).
  double unit() { return double(bits_()) / 4294967296.0; }

  /// Uniform on the unit sphere, by rejection: no trigonometry, so the same on every platform.
  Vector direction() {
    for (;;) {
      const double x = 2.0 * unit() - 1.0;
      const double y = 2.0 * unit() - 1.0;
      const double z = 2.0 * unit() - 1.0;
      const Vector v(x, y, z);
      const double length = v.norm();
      if (length > 0.1 && length <= 1.0) return v / length;
    }
  }

 private:
  std::mt19937 bits_;
};

/// The poses at t = 0, 1/rate, 2/rate, …: a motion at 1 kHz and the same one at 10 kHz differ in `rate`
/// alone.
inline std::vector<Pose<double>> sampled(const Motion& motion, double rate, int ticks) {
  std::vector<Pose<double>> poses(std::size_t(std::max(ticks, 0)));
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = motion(double(i) / rate);
  return poses;
}

/// A device that fails: every seventh tick it jumps by up to 50 mm and 3 rad in random directions, one jump
/// in sixteen by 10 m.
///
/// Deterministic: the jump is a function of the seed and of the number of the tick at `rate` [Hz].
inline Motion hostile(Motion motion, std::uint32_t seed, double rate = 1000.0) {
  return [motion = std::move(motion), seed, rate](double t) {
    Pose<double> pose = motion(t);
    const long tick = std::lround(t * rate);
    if (tick % 7 != 6) return pose;
    RandomBits random(seed ^ (std::uint32_t(tick) * 2654435761u));
    const bool far = random.unit() < 1.0 / 16.0;
    const double distance = far ? 10.0 : 0.05 * random.unit();
    pose.translation += distance * random.direction();
    const Vector axis = random.direction();  // before the angle: within one expression compilers would differ
    const double angle = 3.0 * random.unit();
    pose.rotation = (exp_rotation(Vector(angle * axis)) * pose.rotation).normalized();
    return pose;
  };
}

/// A motion that begins elsewhere: from `start` it glides into `motion` within `seconds`, with no jump in
/// velocity.
inline Motion started_from(const Pose<double>& start, Motion motion, double seconds = 1.0) {
  return [start, motion = std::move(motion), seconds](double t) {
    const Pose<double> pose = motion(t);
    const double s = std::clamp(t / seconds, 0.0, 1.0);
    const double share = s * s * (3.0 - 2.0 * s);
    return Pose<double>{start.translation + share * (pose.translation - start.translation), start.rotation.slerp(share, pose.rotation)};
  };
}

}  // namespace feeler::scenes
