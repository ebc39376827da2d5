// The study's answers as Markdown, from its two files.
#pragma once

#include <filesystem>
#include <string>

namespace feeler::study {

/// One table for each choice: what becomes of errors and times over all scenes, with all else by default.
/// @throws std::runtime_error  where there is nothing to tell
std::string markdown_tables(const std::filesystem::path& folder);

}  // namespace feeler::study
