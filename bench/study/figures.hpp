// The study's figures, drawn by gnuplot from its two files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace feeler::study {

/// Draws what the rows of a folder suffice for, as SVG and PNG beside them: errors against what is chosen, the fronts of error and time, and where each scalar ends.
/// @return their names
/// @throws std::runtime_error  where one cannot be drawn: what was there before is there still
std::vector<std::string> draw_figures(const std::filesystem::path& folder);

}  // namespace feeler::study
