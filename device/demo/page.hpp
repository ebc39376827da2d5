// The one page that shows a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plots.hpp"
#include "scenes/scene.hpp"
#include "summary.hpp"

namespace feeler::demo {

/// Writes a page that needs no other file: the figures and scene.json of the folder are copied into it.
/// @param player  a page that plays the run, to be shown within this one; empty for none
void write_page(const std::filesystem::path& file, const std::filesystem::path& folder, const scenes::Scene& scene, const Summary& summary,
                const std::vector<Figure>& figures, const std::string& player);

}  // namespace feeler::demo
