// A run as a recording that the page of the viewer plays, without a server.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "recording.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// The run as JSON, as page/recording.js reads it: at most 2000 pictures, and a sample of every tick. Nothing
/// where the program was built without its viewer.
std::optional<std::string> player_recording(const scenes::Scene& scene, const Recording& recording);

/// The page with recordings inside, one or two.
std::string player_page(const std::vector<std::string>& recordings);

}  // namespace feeler::demo
