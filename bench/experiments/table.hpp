// The table: what each choice of the paper costs, on the same motions.
#pragma once

#include <filesystem>

#include "experiments/run.hpp"

namespace feeler::experiments {

/// The paper's stiffness, 1 N/mm and 30 mN·m/rad, with M = K or with an M of its own (a length of 10 mm).
Settings<double> paper_settings(Method method);
/// The paper's translational stiffness with 0.3 N·m/rad, at which a line that touches far from the hand does not fold away.
Settings<double> stiff_settings(Method method);

/// Runs the probes and writes table.csv and table.md.
void make_table(const std::filesystem::path& folder);

}  // namespace feeler::experiments
