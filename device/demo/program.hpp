// Another program, run to its end or left to itself.
#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace feeler::demo {

/// Runs a program of the search path in a folder, with its output thrown away.
/// @return its exit code, or 127 where it cannot be run
int run_program(const std::filesystem::path& folder, const std::vector<std::string>& command);

/// Starts a program of the search path and does not wait for it; nothing happens where it cannot be run.
void start_program(const std::vector<std::string>& command);

/// Runs a program with bytes as its input, and returns its output; nothing where it fails, or is stopped. The rest of this program runs on
/// undisturbed.
std::optional<std::string> filter(const std::vector<std::string>& command, const std::string& input, const std::stop_token& stop);

}  // namespace feeler::demo
