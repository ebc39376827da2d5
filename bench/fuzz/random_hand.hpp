// Hands that do not care for the object: slow, fast, leaping, spinning, trembling, and devices that fail.
#pragma once

#include <limits>
#include <numbers>
#include <random>

#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/rotation.hpp"
#include "fuzz/random_object.hpp"

namespace feeler::fuzz {

/// Haptic poses about an object placed somewhere.
class RandomHand {
 public:
  /// @param object  as it was placed: its rotation and translation are those of `placed`
  RandomHand(std::mt19937& bits, const RandomObject& object, const Pose<double>& placed, const Pose<double>& start)
      : bits_(bits), placed_(placed), reach_(object.reach), kind_(Kind(below(bits, 6))), pose_(start) {}

  /// The pose of the next tick; now and then one that is not finite, or whose quaternion is not unit.
  Pose<double> next() {
    move();
    Pose<double> pose = pose_;
    if (tick_ % 61 == 60) spoil(pose, tick_ / 61 % 5);
    ++tick_;
    return pose;
  }

 private:
  enum class Kind { slow, fast, leaping, resting, flung, pressing };

  void move() {
    switch (kind_) {
      case Kind::slow: return drift(1e-4);
      case Kind::fast: return drift(1e-3);
      case Kind::leaping:
        leap(1);
        pose_.rotation = random_rotation(bits_);
        return;
      case Kind::resting:
        if (tick_ % 40 == 0) leap(1);
        if (tick_ % 80 == 0) pose_.rotation = random_rotation(bits_);
        pose_.translation += 1e-5 * random_direction(bits_);
        return;
      case Kind::flung:
        if (tick_ % 10 == 0) {
          pose_.translation = placed_.translation + magnitude(bits_, -3, 4) * random_direction(bits_);
          pose_.rotation = random_rotation(bits_);
        }
        if (tick_ % 10 == 5) leap(1);
        turn({0, 0, std::numbers::pi});
        return;
      case Kind::pressing:
        if (tick_ % 100 == 0) {
          leap(0.3);
          pose_.rotation = random_rotation(bits_);
        }
        pose_.translation += magnitude(bits_, -12, -5) * random_direction(bits_);
        turn(magnitude(bits_, -12, -4) * random_direction(bits_));
        return;
    }
  }

  /// Towards the object and about it, no faster than a distance a tick [m].
  void drift(double longest) {
    velocity_ = 0.98 * velocity_ + 0.2 * longest * random_direction(bits_) - 2e-3 * (pose_.translation - placed_.translation);
    if (velocity_.norm() > longest) velocity_ *= longest / velocity_.norm();
    spin_ = 0.98 * spin_ + 0.002 * random_direction(bits_);
    if (spin_.norm() > 0.02) spin_ *= 0.02 / spin_.norm();
    pose_.translation += velocity_;
    turn(spin_);
  }
  void leap(double share_of_height) {
    const Vector to = reach_ * random_vector(bits_);
    pose_.translation = placed_ * Vector(to.x(), to.y(), share_of_height * to.z());
  }
  void turn(const Vector& by) { pose_.rotation = (exp_rotation<double>(by) * pose_.rotation).normalized(); }

  static void spoil(Pose<double>& pose, int how) {
    if (how == 0) pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
    if (how == 1) pose.rotation.coeffs().setZero();
    if (how == 2) pose.translation.y() = std::numeric_limits<double>::infinity();
    if (how == 3) pose.rotation.coeffs() *= 37;
    if (how == 4) pose.rotation.coeffs() *= -1;
  }

  std::mt19937& bits_;
  Pose<double> placed_;
  double reach_;
  Kind kind_;
  Pose<double> pose_;
  Vector velocity_ = Vector::Zero(), spin_ = Vector::Zero();
  int tick_ = 0;
};

}  // namespace feeler::fuzz
