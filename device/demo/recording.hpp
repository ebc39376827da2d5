// Everything that happened in a run, tick by tick.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "feeler/device/servo_report.hpp"
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
  double microseconds = 0.0;  ///< of the renderer's `update` alone
};

/// A run: its ticks, and what the servo loop says about itself.
struct Recording {
  std::vector<TickRecord> ticks;
  ServoReport servo;
  double wall_seconds = 0.0;  ///< from the first tick to the last

  double achieved_rate() const { return wall_seconds > 0.0 ? double(ticks.size() - 1) / wall_seconds : 0.0; }
};

}  // namespace feeler::demo
