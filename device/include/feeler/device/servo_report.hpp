// What a servo loop did: what the system granted it, how many ticks it ran and missed, and how long they took.
#pragma once

#include <cstdint>
#include <string>

#include "feeler/device/force_safety.hpp"
#include "feeler/device/histogram.hpp"
#include "feeler/device/passivity_control.hpp"
#include "feeler/device/real_time.hpp"

namespace feeler {

/// Report of a `ServoLoop` that has ended.
struct ServoReport {
  RealTimeSetup setup;
  std::int64_t period = 0;      ///< [ns]; 0 when it did not wait
  std::int64_t ticks = 0;       ///< callbacks run
  std::int64_t missed = 0;      ///< deadlines that passed while a tick was late or still computing; skipped, never caught up
  Histogram wake_up_latency;    ///< from the deadline to the start of the callback [ns]; empty when it did not wait
  Histogram compute_time;       ///< of the callback [ns]
  ForceReport force;            ///< what the safety did; of a loop with a device
  std::int64_t let_go = 0;      ///< how often the watchdog took the force away, because no wrench came
  PassivityReport passivity;    ///< of a loop that was asked to keep the hand passive
  std::string problem;          ///< why it ended before it was told to, as one sentence; empty if it did not
};

/// The report as lines of text, for a log; with the tails of both histograms and every refusal.
std::string to_string(const ServoReport& report);

/// The setup as lines of text: kernel, scheduler, memory, processors, and every refusal.
std::string to_string(const RealTimeSetup& setup);

}  // namespace feeler
