// Statistics over contact ticks, and their table.
#include "summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "feeler/spatial/metric.hpp"

namespace feeler::demo {
namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[200];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(text, sizeof text, pattern, values...);
#pragma GCC diagnostic pop
  return text;
}

std::string depth_text(double depth, std::size_t tick) {
  if (!(depth > 0.0)) return "none";
  if (depth > Verification::tolerance) return format("%.3g mm at tick %zu", 1e3 * depth, tick);
  return format("none but rounding: %.1g m at tick %zu, of %.0e m allowed", depth, tick, Verification::tolerance);
}

void add_steps(const std::vector<TickRecord>& ticks, Summary& summary) {
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const TickRecord &before = ticks[i - 1], &here = ticks[i];
    const Twist<double> step = motion_between(before.graphic, here.graphic);
    summary.largest_translation = std::max(summary.largest_translation, step.linear.norm());
    summary.largest_rotation = std::max(summary.largest_rotation, step.angular.norm());
    summary.largest_force_step = std::max(summary.largest_force_step, (here.wrench.force - before.wrench.force).norm());
    summary.largest_torque_step = std::max(summary.largest_torque_step, (here.wrench.torque - before.wrench.torque).norm());
  }
}

}  // namespace

Distribution distribution_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto rank = std::size_t(std::ceil(share * double(values.size())));
    return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
  };
  return {at(0.5), at(0.99), at(0.999), values.back()};
}

bool is_contact(const TickRecord& tick, double metric_length) {
  const auto metric = Metric<double>::with_length(metric_length);
  return metric.energy(motion_between(tick.haptic, tick.graphic)) > 1e-14;
}

Summary summarise(const scenes::Scene& scene, const Recording& recording, const Verification& verification, double wanted_rate) {
  Summary summary;
  summary.ticks = recording.ticks.size();
  summary.wanted_rate = wanted_rate;
  summary.achieved_rate = recording.achieved_rate();
  summary.missed_deadlines = recording.servo.missed;
  summary.force = recording.servo.force;
  summary.verification = verification;

  std::vector<double> times, rows, iterations;
  std::size_t converged = 0;
  for (const TickRecord& tick : recording.ticks) {
    summary.peak_force = std::max(summary.peak_force, tick.wrench.force.norm());
    summary.peak_torque = std::max(summary.peak_torque, tick.wrench.torque.norm());
    if (!is_contact(tick, scene.length)) continue;
    times.push_back(tick.microseconds);
    rows.push_back(tick.rows);
    iterations.push_back(tick.iterations);
    if (tick.converged) ++converged;
  }
  summary.contact_ticks = times.size();
  if (!times.empty()) summary.converged_share = double(converged) / double(times.size());
  summary.tick_time = distribution_of(std::move(times));
  summary.rows = distribution_of(std::move(rows));
  summary.iterations = distribution_of(std::move(iterations));
  add_steps(recording.ticks, summary);
  return summary;
}

/// What it shortened, slowed and dropped, and the first fault.
std::string safety_text(const ForceReport& force) {
  const auto count = [](std::int64_t ticks) { return static_cast<long long>(ticks); };
  std::string text = format("%lld ticks shortened, %lld slowed", count(force.ticks_shortened), count(force.ticks_slowed));
  if (force.ticks_without_torque > 0) {
    text += format("; torque dropped in %lld, up to %.1f mN·m: the device has no motors for it", count(force.ticks_without_torque),
                   1e3 * force.peak_lost_torque);
  }
  if (force.first_fault == ForceFault::none) return text + "; no fault";
  return text + format("; first fault at %.3f s: ", force.first_fault_time) + to_string(force.first_fault);
}

std::vector<std::pair<std::string, std::string>> table_of(const Summary& s) {
  const Distribution& t = s.tick_time;
  const Verification& v = s.verification;
  const auto contact = [&](std::string text) { return s.contact_ticks > 0 ? text : "no contact"; };
  const std::string which = v.stride == 1 ? format("all %zu ticks", v.checked_ticks) : format("%zu ticks, one in %zu", v.checked_ticks, v.stride);
  const std::string checked = which + format(", at %zu places on the way of the tool", v.checked_places);
  return {
      {"ticks", format("%zu, of them %zu in contact", s.ticks, s.contact_ticks)},
      {"rate", format("%.1f Hz, of %.0f Hz asked for", s.achieved_rate, s.wanted_rate)},
      {"missed deadlines", format("%lld", static_cast<long long>(s.missed_deadlines))},
      {"tick time in contact", contact(format("median %.1f, p99 %.1f, p99.9 %.1f, max %.1f µs", t.median, t.p99, t.p999, t.maximum))},
      {"constraint rows in contact", contact(format("median %.0f, p99 %.0f, max %.0f", s.rows.median, s.rows.p99, s.rows.maximum))},
      {"iterations in contact", contact(format("median %.0f, p99 %.0f, max %.0f", s.iterations.median, s.iterations.p99, s.iterations.maximum))},
      {"converged in contact", contact(format("%.2f %%", 100.0 * s.converged_share))},
      {"deepest penetration at poses", depth_text(v.pose_depth, v.pose_tick)},
      {"deepest penetration between", depth_text(v.way_depth, v.way_tick)},
      {"checked", checked},
      {"largest pose step", format("%.3f mm, %.3f°", 1e3 * s.largest_translation, s.largest_rotation * 57.29577951308232)},
      {"largest wrench step", format("%.3f N, %.2f mN·m", s.largest_force_step, 1e3 * s.largest_torque_step)},
      {"peak force and torque wanted", format("%.2f N, %.1f mN·m", s.peak_force, 1e3 * s.peak_torque)},
      {"peak force and torque pushed", format("%.2f N, %.1f mN·m", s.force.peak_force, 1e3 * s.force.peak_torque)},
      {"force safety", safety_text(s.force)},
  };
}

}  // namespace feeler::demo
