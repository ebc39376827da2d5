// The paper's three metrics as numbers, and the states that its figures name.
#pragma once

#include <string>
#include <vector>

#include "experiments/run.hpp"

namespace feeler::experiments {

/// The states of Fig. 11 and 13; `other` is a formation that the figure does not name.
enum class State { none, clockwise, anticlockwise, translate, vertex_face, edge_edge, two_regions, other };
const char* name_of(State state);

State cavity_state(const Record& record);
State steps_state(const Record& record);

/// Whether states occur one after the other, whatever lies between.
bool occur_in_order(const std::vector<Record>& ticks, State (*state_of)(const Record&), const std::vector<State>& states);

/// Responsiveness, stability and update rate (paper, section V).
struct Measures {
  double deepest = 0;               ///< [m]
  int force_without_contact = 0;    ///< ticks
  double pose_step = 0;             ///< largest step of the graphic tool beyond the device's own, in the metric of 10 mm [m]
  double wrench_step = 0;           ///< largest step of the force beyond stiffness × the device's own [N]
  double p50 = 0, p99 = 0;          ///< of ticks in contact [µs]
  double late_share = 0;            ///< of ticks in contact above 1 ms
  double optimisation_p50 = 0;      ///< [µs]
  int switches = 0;
};
Measures measure(const std::vector<Record>& ticks, double stiffness);
/// The worse of both; of times the larger.
Measures worst_of(const Measures& a, const Measures& b);

}  // namespace feeler::experiments
