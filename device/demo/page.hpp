// The one page that shows a run.
#pragma once

#include <filesystem>
#include <vector>

#include "plots.hpp"
#include "scenes/scene.hpp"
#include "summary.hpp"

namespace feeler::demo {

/// Writes a page that needs no other file: the figures and scene.json of the folder are copied into it.
void write_page(const std::filesystem::path& file, const std::filesystem::path& folder,
                const scenes::Scene& scene, const Summary& summary, const std::vector<Figure>& figures);

}  // namespace feeler::demo
