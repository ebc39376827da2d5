// The figures of a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "feeler/device/force_safety.hpp"
#include "recording.hpp"
#include "scenes/scene.hpp"
#include "verification.hpp"

namespace feeler::demo {

/// Median and tail of a quantity.
struct Distribution {
  double median = 0.0, p99 = 0.0, p999 = 0.0, maximum = 0.0;
};

/// The smallest value that a share of the values does not exceed, at the median, the tails and the end.
Distribution distribution_of(std::vector<double> values);

/// Statistics of a run. Contact ticks are those whose energy ½ eᵀ M e exceeds 1e-14 m².
struct Summary {
  std::size_t ticks = 0;
  std::size_t contact_ticks = 0;
  double wanted_rate = 0.0;    ///< [Hz]
  double achieved_rate = 0.0;  ///< [Hz]
  std::int64_t missed_deadlines = 0;
  Distribution tick_time;            ///< of contact ticks [µs]
  Distribution rows, iterations;     ///< of contact ticks
  double converged_share = 1.0;      ///< of contact ticks
  double largest_translation = 0.0;  ///< of the graphic tool in one tick [m]
  double largest_rotation = 0.0;     ///< of the graphic tool in one tick [rad]
  double largest_force_step = 0.0;   ///< [N]
  double largest_torque_step = 0.0;  ///< [N·m]
  double peak_force = 0.0;           ///< norm [N]
  double peak_torque = 0.0;          ///< norm [N·m]
  ForceReport force;                 ///< what the safety did between renderer and motors
  Verification verification;
};

bool is_contact(const TickRecord& tick, double metric_length);

Summary summarise(const scenes::Scene& scene, const Recording& recording, const Verification& verification, double wanted_rate);

/// The summary as pairs of a name and a value with its unit, for the terminal and the page alike.
std::vector<std::pair<std::string, std::string>> table_of(const Summary& summary);

}  // namespace feeler::demo
