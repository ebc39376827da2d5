// Other tools than a scene's own, as large as suits it.
#pragma once

#include <array>
#include <string>

#include "live/live_scene.hpp"

namespace feeler::demo {

/// A tool that a page may choose.
struct ToolKind {
  const char *id, *label;
};
constexpr std::array<ToolKind, 4> tool_kinds = {{{"own", "the scene's own"}, {"cube", "a cube"}, {"pebble", "a pebble"}, {"needle", "a needle"}}};

/// Puts another tool in the place of a scene's own: about its middle, and of half its size, so that it fits where that does.
/// @param kind  an id of `tool_kinds`; empty for the scene's own
/// @throws std::invalid_argument with a sentence for another one
void choose_tool(LiveScene& scene, const std::string& kind);

}  // namespace feeler::demo
