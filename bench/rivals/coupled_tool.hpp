// What Feeler and its rivals have in common: the device's pose in, the tool's pose and a wrench out, once a
// tick.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/wrench.hpp"

/// Engines that people would take instead, coupled to the device as they advise, on the scenes of
/// bench/scenes.
namespace feeler::rivals {

/// What a tick leaves behind; world axes, wrenches on the hand at the origin of the tool frame of the
/// device's pose.
struct CoupledTick {
  Pose<double> graphic_pose;  ///< where the tool is shown
  Wrench<double> wrench;      ///< of the spring, K (q_g − q_h) as Feeler's
  Wrench<double> damping;     ///< of the damper beside the spring; add it for the whole reaction of the
                              ///< coupling; Feeler has none

  /// Poses on the way from the last graphic pose to this one, in order; valid until the next call. An
  /// engine's are those after its steps.
  std::span<const Pose<double>> path;
};

/// A tool that a device drags through an object.
///
/// One `update` is one tick of the device, of the length that it was made for. Two runs of the same poses
/// after a `reset` give the same result to the last bit. Not noexcept: rivals allocate.
class CoupledTool {
 public:
  CoupledTool() = default;
  CoupledTool(const CoupledTool&) = delete;
  CoupledTool& operator=(const CoupledTool&) = delete;
  virtual ~CoupledTool() = default;

  /// For tables: the engine and its substeps.
  virtual const std::string& name() const = 0;

  /// Puts tool and device at a pose, at rest, with everything that was learnt in earlier ticks forgotten.
  virtual void reset(const Pose<double>& pose) = 0;

  /// One tick.
  /// @param haptic_pose  that the device has at the end of the tick; unit quaternion
  virtual CoupledTick update(const Pose<double>& haptic_pose) = 0;
};

}  // namespace feeler::rivals
