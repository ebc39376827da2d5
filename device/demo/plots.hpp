// The figures of a run, drawn by gnuplot from the files of its folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/scene.hpp"
#include "summary.hpp"

namespace feeler::demo {

/// A figure: `name`.gp draws it, as `name`.svg and `name`.png.
struct Figure {
  std::string name;
  std::string caption;
};

/// Writes the scripts and what they need beside ticks.csv, and runs them.
/// @return the figures drawn; empty where gnuplot is missing or fails, and then nothing of a figure remains
std::vector<Figure> draw_figures(const std::filesystem::path& folder, const scenes::Scene& scene, const std::vector<TickRecord>& ticks,
                                 const Summary& summary);

}  // namespace feeler::demo
