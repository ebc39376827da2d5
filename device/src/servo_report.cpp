// Writes the report of a servo loop as text.
#include "feeler/device/servo_report.hpp"

#include <ostream>
#include <sstream>

namespace feeler {
namespace {

void write_tail(std::ostream& out, const char* name, const Histogram& histogram) {
  if (histogram.count() == 0) return;
  const auto microseconds = [](std::int64_t nanoseconds) { return double(nanoseconds) / 1000; };
  out << name << " [us]: median " << microseconds(histogram.percentile(50)) << ", p99 " << microseconds(histogram.percentile(99)) << ", p99.9 "
      << microseconds(histogram.percentile(99.9)) << ", max " << microseconds(histogram.maximum()) << "\n";
}

void write_force(std::ostream& out, const ForceReport& force) {
  for (int fault = 1; fault < force_faults; ++fault) {
    const std::int64_t ticks = force.ticks_with[std::size_t(fault)];
    if (ticks > 0) out << "force: " << to_string(ForceFault(fault)) << " (" << ticks << " ticks)\n";
  }
  if (force.ticks_shortened > 0) out << "force: shortened to what the device can push in " << force.ticks_shortened << " ticks\n";
  if (force.ticks_slowed > 0) out << "force: growth slowed in " << force.ticks_slowed << " ticks\n";
  if (force.ticks_without_torque > 0) {
    out << "torque: the device has no motors for it; dropped in " << force.ticks_without_torque << " ticks, at most " << force.peak_lost_torque
        << " N m\n";
  }
}

}  // namespace

std::string to_string(const RealTimeSetup& setup) {
  std::ostringstream out;
  out << "kernel: " << setup.kernel << (setup.is_preempt_rt ? " with" : " without") << " PREEMPT_RT\n";
  out << "scheduler: " << setup.policy << ", priority " << setup.priority << "\n";
  out << "memory: " << (setup.is_memory_locked ? "locked" : "not locked") << "\n";
  out << "processors:";
  for (int processor : setup.processors) out << " " << processor;
  out << "\n";
  for (const std::string& sentence : setup.refused) out << sentence << "\n";
  return out.str();
}

std::string to_string(const ServoReport& report) {
  std::ostringstream out;
  out << to_string(report.setup);
  out << "ticks: " << report.ticks << ", missed deadlines: " << report.missed << "\n";
  write_tail(out, "wake-up latency", report.wake_up_latency);
  write_tail(out, "compute time", report.compute_time);
  if (report.let_go > 0) {
    out << "watchdog: the renderer or the system held the loop up, so the force was taken away " << report.let_go << " times\n";
  }
  write_force(out, report.force);
  if (report.passivity.ticks_damped > 0) {
    out << "passivity: the renderer gave the hand up to " << -report.passivity.lowest_energy << " J; damped in " << report.passivity.ticks_damped
        << " ticks\n";
  }
  if (!report.problem.empty()) out << report.problem << "\n";
  return out.str();
}

}  // namespace feeler
