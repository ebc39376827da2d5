// Recordings on the page of the viewer, served without a servo loop.
#pragma once

#include <filesystem>
#include <string>

#include "options.hpp"

namespace feeler::demo {

/// Serves one or two recordings until the program is interrupted.
/// @throws BadInput where a file is no recording, or the port cannot be had
void run_replay_view(const Options& options);

/// The text of a recording: of a file, of the replay.json of a report, or of the report that a session lies
/// in.
/// @throws BadInput where there is none
std::string load_player_recording(const std::filesystem::path& file);

}  // namespace feeler::demo
