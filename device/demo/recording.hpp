// Everything that happened in a run, tick by tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "feeler/device/servo_report.hpp"
#include "feeler/device/session_recorder.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/wrench.hpp"

namespace feeler::demo {

/// One tick as the servo loop saw it; world axes, SI units.
struct TickRecord {
  double time = 0.0;  ///< of the device, since the start [s]
  Pose<double> haptic;
  Pose<double> graphic;
  Wrench<double> wrench;
  int contacts = 0;
  int rows = 0;
  int iterations = 0;
  bool converged = false;
  double microseconds = 0.0;       ///< of the renderer's `update` alone
  double late_microseconds = 0.0;  ///< from the deadline to the start of the tick
  int missed = 0;                  ///< deadlines skipped just before it
  std::size_t way_end = 0;         ///< in `Recording::way`, one past the graphic pose of this tick
};

/// A run: its ticks, the way of the tool, and what the servo loop says about itself.
struct Recording {
  std::vector<TickRecord> ticks;
  /// The certified way of the graphic tool through the whole run: from the start pose through every pose of
  /// every tick, the last of a tick being its graphic pose. Between two poses the origin of the tool moves on
  /// a straight line and its axes turn at a constant rate.
  std::vector<Pose<double>> way;
  ServoReport servo;
  DeviceSpecification device;
  bool is_simulated = true;                 ///< the device
  double stiffness_share = 1.0;             ///< of the scene's stiffness, that the device can render
  std::optional<SessionRecording> session;  ///< where it was asked for
  double wall_seconds = 0.0;                ///< from the first tick to the last

  /// Where in `way` a tick begins: at the graphic pose of the tick before, or at the start pose.
  std::size_t way_begin(std::size_t tick) const { return tick == 0 ? 0 : ticks[tick - 1].way_end - 1; }

  double achieved_rate() const { return wall_seconds > 0.0 ? double(ticks.size() - 1) / wall_seconds : 0.0; }
};

}  // namespace feeler::demo
