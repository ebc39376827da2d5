// The paper's three metrics, from the records of a run.
#include "experiments/measures.hpp"

#include <algorithm>
#include <cmath>

#include "times.hpp"

namespace feeler::experiments {

using bench::quantile;

const char* name_of(State state) {
  switch (state) {
    case State::none: return "no contact";
    case State::clockwise: return "rotate clockwise";
    case State::anticlockwise: return "rotate anti-clockwise";
    case State::translate: return "translate";
    case State::vertex_face: return "V-F";
    case State::edge_edge: return "E-E";
    case State::two_regions: return "V-F in two regions";
    case State::other: break;
  }
  return "other";
}

State cavity_state(const Record& record) {
  constexpr double least_torque = 1e-4;  // [N m]
  if (record.contacts == 0) return State::none;
  if (record.wrench.torque.z() > least_torque) return State::clockwise;
  if (record.wrench.torque.z() < -least_torque) return State::anticlockwise;
  return record.wrench.force.norm() > 0.05 ? State::translate : State::other;
}

State steps_state(const Record& record) {
  if (record.contacts == 0) return State::none;
  if (record.contacts == 1 && record.vertex_face == 1) return State::vertex_face;
  if (record.contacts == 1 && record.edge_edge == 1) return State::edge_edge;
  if (record.contacts == 2 && record.vertex_face == 2 && record.regions == 2) return State::two_regions;
  return State::other;
}

bool occur_in_order(const std::vector<Record>& ticks, State (*state_of)(const Record&), const std::vector<State>& states) {
  std::size_t next = 0;
  for (const Record& record : ticks) {
    if (next < states.size() && state_of(record) == states[next]) ++next;
  }
  return next == states.size();
}

Measures measure(const std::vector<Record>& ticks, double stiffness) {
  constexpr double least_force = 0.01;  // [N]
  const auto metric = Metric<double>::with_length(0.01);
  const auto length = [&](const Pose<double>& from, const Pose<double>& to) { return std::sqrt(2.0 * metric.energy(motion_between(from, to))); };
  Measures result;
  std::vector<double> total, optimisation;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const Record& now = ticks[i];
    result.deepest = std::max(result.deepest, now.depth);
    result.switches += now.is_switch ? 1 : 0;
    if (now.contacts == 0 && now.depth <= 1e-11 && now.wrench.force.norm() > least_force) ++result.force_without_contact;
    if (now.contacts > 0 || now.wrench.force.norm() > least_force) {
      total.push_back(now.microseconds);
      optimisation.push_back(now.optimisation_microseconds);
    }
    if (i == 0) continue;
    const Record& last = ticks[i - 1];
    const double device = length(last.haptic, now.haptic);
    result.pose_step = std::max(result.pose_step, length(last.graphic, now.graphic) - device);
    result.wrench_step = std::max(result.wrench_step, (now.wrench.force - last.wrench.force).norm() - stiffness * device);
  }
  result.p50 = quantile(total, 0.5);
  result.p99 = quantile(total, 0.99);
  result.optimisation_p50 = quantile(optimisation, 0.5);
  const auto late = std::count_if(total.begin(), total.end(), [](double us) { return us > 1000.0; });
  result.late_share = double(late) / double(std::max<std::size_t>(total.size(), 1));
  return result;
}

Measures worst_of(const Measures& a, const Measures& b) {
  return {std::max(a.deepest, b.deepest),
          a.force_without_contact + b.force_without_contact,
          std::max(a.pose_step, b.pose_step),
          std::max(a.wrench_step, b.wrench_step),
          std::max(a.p50, b.p50),
          std::max(a.p99, b.p99),
          std::max(a.late_share, b.late_share),
          std::max(a.optimisation_p50, b.optimisation_p50),
          a.switches + b.switches};
}

}  // namespace feeler::experiments
