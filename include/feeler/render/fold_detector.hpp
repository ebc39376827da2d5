// Tells folds: the pose that held the tool ceased to be nearest, and the tool slid on to another one.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "feeler/core/requirement.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/core/status.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/render/tick.hpp"
#include "feeler/spatial/metric.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// A local solution that vanished, and the one that the tool slid to.
template <RealScalar ScalarType>
struct Fold {
  using Scalar = ScalarType;

  Pose<Scalar> from;        ///< the tool frame before
  Pose<Scalar> to;          ///< and where it came to rest
  Scalar jump = Scalar(0);  ///< how much farther the tool went from tick to tick than the device, in the metric of the settings [m]
  int ticks = 0;            ///< that it took
};

/// Watches a renderer for folds. It reads ticks and changes nothing.
///
/// Between folds the pose is a continuous function of the device, and the tool goes hardly farther than the device did. Where the local
/// minimum vanishes, as at the edge of a step, it goes on to the next one however slow the hand is. Ways are added up until a tick
/// has converged, so that one fold is told once, whatever the work budget spreads it over.
template <RealScalar ScalarType>
class FoldDetector {
 public:
  using Scalar = ScalarType;
  /// The tool may go so many times as far as the device without a fold: past a corner that it turns about it is faster than the hand.
  inline static const Scalar most_gain = Scalar(4);

  /// @param least_jump  shorter ones are not told [m]; refused where it is negative or not finite
  explicit FoldDetector(const Settings<Scalar>& settings, Scalar least_jump = Scalar(1e-4))
      : reference_(settings.reference_point), metric_(settings.metric_in_use()), least_jump_(least_jump) {
    refuse_for(reason_against(settings, least_jump));
  }
  /// The sentence with which the constructor refuses what it is given; empty where it does not.
  static std::string reason_against(const Settings<Scalar>&, Scalar least_jump = Scalar(1e-4)) {
    if (least_jump >= Scalar(0) && least_jump <= (std::numeric_limits<Scalar>::max)()) return {};
    return "FoldDetector: the least jump is not a length; give the shortest one that is to be told, 1e-4 if in doubt";
  }

  /// Starts anew, after `HapticRenderer::reset`.
  void reset(const Pose<Scalar>& haptic_pose, const Pose<Scalar>& graphic_pose) noexcept {
    haptic_ = haptic_pose;
    fold_.to = graphic_pose;
    begin();
  }

  /// To be called after each tick.
  /// @return  the fold that ended with this tick, or null; valid until the next call
  const Fold<Scalar>* observe(const Pose<Scalar>& haptic_pose, const Tick<Scalar>& tick) noexcept {
    if (tick.status != TickStatus::converged && tick.status != TickStatus::unconverged) return nullptr;
    if (has_ended_) begin();
    device_way_ += length(haptic_, haptic_pose);
    haptic_ = haptic_pose;
    tool_way_ += length(fold_.to, tick.graphic_pose);
    fold_.to = tick.graphic_pose;
    ++fold_.ticks;
    has_ended_ = tick.converged();
    fold_.jump = tool_way_ - device_way_;
    return has_ended_ && tool_way_ > most_gain * device_way_ + least_jump_ ? &fold_ : nullptr;
  }

 private:
  void begin() noexcept {
    fold_.from = fold_.to;
    fold_.ticks = 0;
    device_way_ = tool_way_ = Scalar(0);
    has_ended_ = false;
  }

  Scalar length(const Pose<Scalar>& a, const Pose<Scalar>& b) const noexcept {
    using std::sqrt;
    return sqrt(2 * metric_.energy(motion_between(Pose<Scalar>{a * reference_, a.rotation}, Pose<Scalar>{b * reference_, b.rotation})));
  }

  Vector3<Scalar> reference_;
  Metric<Scalar> metric_;
  Scalar least_jump_;
  Pose<Scalar> haptic_;
  Fold<Scalar> fold_;
  Scalar device_way_ = Scalar(0), tool_way_ = Scalar(0);  // since the last converged tick
  bool has_ended_ = false;
};

}  // namespace feeler
