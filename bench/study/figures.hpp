// The study's figures, drawn by gnuplot from its two files.
#pragma once

#include <filesystem>

namespace feeler::study {

/// Draws what the rows of a folder suffice for, as SVG and PNG beside them: errors against what is chosen, the fronts of error and time, and where each scalar ends.
/// @return false where gnuplot is missing or fails
bool draw_figures(const std::filesystem::path& folder);

}  // namespace feeler::study
