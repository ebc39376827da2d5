// The page of the viewer, built into the program.
#pragma once

#include <string_view>

namespace feeler::viewer {

/// HTML that needs no other file and no network.
std::string_view page_html() noexcept;

}  // namespace feeler::viewer
