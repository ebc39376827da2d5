// Writes the report of a servo loop as text.
#include "feeler/device/servo_report.hpp"

#include <ostream>
#include <sstream>

namespace feeler {
namespace {

void write_tail(std::ostream& out, const char* name, const Histogram& histogram) {
  if (histogram.count() == 0) return;
  const auto microseconds = [](std::int64_t nanoseconds) { return double(nanoseconds) / 1000; };
  out << name << " [us]: median " << microseconds(histogram.percentile(50)) << ", p99 "
      << microseconds(histogram.percentile(99)) << ", p99.9 " << microseconds(histogram.percentile(99.9)) << ", max "
      << microseconds(histogram.maximum()) << "\n";
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
  if (!report.problem.empty()) out << report.problem << "\n";
  return out.str();
}

}  // namespace feeler
