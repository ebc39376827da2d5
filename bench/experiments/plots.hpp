// The experiments' figures, drawn by gnuplot from their CSV files.
#pragma once

#include <filesystem>
#include <string>

namespace feeler::experiments {

/// Writes `name`.gp and draws `name`.svg and `name`.png with it in the folder; the body may use what style.gp defines.
/// A figure that was there stays until the new one is whole.
/// @return false where gnuplot is missing or fails, or the figure does not reach the disk
/// @throws std::runtime_error  where the script does not
bool draw(const std::filesystem::path& folder, const std::string& name, int width, int height, const std::string& body);

/// Force, torque and state over time (Fig. 11 and 13) of `csv`.
std::string wrench_body(const std::string& csv, const std::string& state_tics);
/// Total time and that of the optimisation (Fig. 14) of two files.
std::string time_body(const std::string& standard_csv, const std::string& paper_csv);

}  // namespace feeler::experiments
