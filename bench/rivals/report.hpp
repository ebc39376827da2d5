// Scores as CSV files, Markdown tables and figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rivals/contest.hpp"
#include "rivals/scaling.hpp"
#include "rivals/thin_plates.hpp"

namespace feeler::rivals {

/// All contenders in one scene.
struct SceneScores {
  std::string scene;
  std::vector<Score> scores;  ///< Feeler first
};

/// Tables to paste into docs/rivals.md: times, behaviour, crossings of plates, and where Feeler is
/// slower than ODE with 4 substeps.
std::string scenes_in_markdown(const std::vector<SceneScores>& all);
std::string plates_in_markdown(const std::vector<PlateScore>& all);
std::string scaling_in_markdown(const std::string& size, const std::vector<ScalingPoint>& curve);

/// scenes.csv, plates.csv and `name`.csv in the folder.
void write_scenes(const std::filesystem::path& folder, const std::vector<SceneScores>& all);
void write_plates(const std::filesystem::path& folder, const std::vector<PlateScore>& all);
void write_scaling(const std::filesystem::path& folder, const std::string& name, const std::vector<ScalingPoint>& curve);

/// Draw rivals_time and rivals_penetration from scenes.csv, and `name` from `name`.csv.
/// @return false where gnuplot is missing or fails
bool draw_scenes(const std::filesystem::path& folder, const std::vector<SceneScores>& all);
bool draw_scaling(const std::filesystem::path& folder, const std::string& name, const std::string& size, const std::vector<ScalingPoint>& curve);

}  // namespace feeler::rivals
