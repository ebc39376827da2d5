// Where the simulated hand of a live scene wants to be: at rest, along the scene's motion, or where somebody
// at a page drags it.
#pragma once

#include <algorithm>
#include <cmath>

#include "feeler/device/conversion.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/viewer/live_feed.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// A pose that goes, tick by tick, where it is asked to, never faster than a hand. No function allocates.
class HandGuide {
 public:
  static constexpr double fastest = 0.3;       ///< [m/s]
  static constexpr double fastest_turn = 4.0;  ///< [rad/s]
  static constexpr double smoothing = 0.02;                                ///< time constant with which the steps of a mouse are rounded [s]
  static constexpr double blending = 1.0;  ///< from where the hand is into the scene's motion [s]

  /// @param reach   how far from the start the hand may be asked to go [m]
  /// @param period  of a tick [s]
  HandGuide(const Pose<double>& start, scenes::Motion motion, double reach, double period)
      : start_(start), motion_(std::move(motion)), reach_(reach), period_(period), before_(start), pose_(start), wanted_(start) {}

  void ask(const viewer::HandRequest& request) noexcept {
    if (request.mode == viewer::HandMode::motion && mode_ != request.mode) {
      began_ = pose_;
      motion_time_ = 0;
    }
    mode_ = request.mode;
    wanted_ = mode_ == viewer::HandMode::person ? within_reach(from_device<Pose<double>>(request.pose)) : pose_;
  }

  /// One tick on.
  void advance() noexcept {
    before_ = pose_;
    ++ticks_;
    if (mode_ == viewer::HandMode::motion) wanted_ = blended();
    pose_ = mode_ == viewer::HandMode::motion ? wanted_ : limited(motion_between(pose_, wanted_));
  }

  /// For a simulated hand that integrates within a tick: straight from the pose of the last one to this
  /// one's.
  DevicePose at(double time) const noexcept {
    const double share = std::clamp(time / period_ - double(ticks_ - 1), 0.0, 1.0);
    return to_device_pose(moved(before_, motion_between(before_, pose_) * share));
  }

  viewer::HandMode mode() const noexcept { return mode_; }
  const Pose<double>& pose() const noexcept { return pose_; }

 private:
  Pose<double> within_reach(Pose<double> pose) const noexcept {
    const Vector3<double> way = pose.translation - start_.translation;
    const double distance = way.norm();
    if (distance > reach_) pose.translation = start_.translation + way * (reach_ / distance);
    return pose;
  }

  Pose<double> blended() noexcept {
    motion_time_ += period_;
    const double s = std::min(motion_time_ / blending, 1.0);
    const double share = s * s * (3.0 - 2.0 * s);
    const Pose<double> there = motion_(motion_time_);
    return {began_.translation + share * (there.translation - began_.translation), began_.rotation.slerp(share, there.rotation)};
  }

  Pose<double> limited(const Twist<double>& way) const noexcept {
    const double share = period_ / smoothing;
    const auto factor = [&](double length, double speed) { return length > 0 ? std::min(share, speed * period_ / length) : 0.0; };
    return moved(pose_, {way.linear * factor(way.linear.norm(), fastest), way.angular * factor(way.angular.norm(), fastest_turn)});
  }

  Pose<double> start_;
  scenes::Motion motion_;
  double reach_, period_;
  viewer::HandMode mode_ = viewer::HandMode::still;
  Pose<double> before_, pose_, wanted_, began_;
  double motion_time_ = 0;
  std::int64_t ticks_ = 0;
};

}  // namespace feeler::demo
