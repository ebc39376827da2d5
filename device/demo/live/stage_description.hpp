// What a page is told in words and small numbers: the gallery once, and each stage as it comes on show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "live/gallery.hpp"
#include "live/stage.hpp"

namespace feeler::demo {

/// What a stage is called, and where it came from.
struct StageOrigin {
  std::string scene;  ///< id of the gallery
  std::string title;
  std::string hint;                      ///< what to try
  std::string variant;                   ///< its label
  std::optional<double> clearance = {};  ///< chosen by hand [m]
  std::string tool = "own";              ///< an id of `tool_kinds`
};

/// How a stage is rendered, for those who read of it.
struct StageSettings {
  Settings<double> renderer;
  RenderChoice choice = {};
};

/// The first text of a page: version, gallery, and what can be chosen.
/// @param device  name of a real one that is the hand; empty where the page is
std::string hello_text(const std::vector<GalleryEntry>& gallery, double rate, const std::string& device);
/// The gallery alone, when it has changed.
std::string gallery_text(const std::vector<GalleryEntry>& gallery);
/// A stage: its scene, settings and tool.
std::string stage_text(int number, const LiveScene& scene, const StageSettings& settings, const StageOrigin& origin);
/// One sentence for the user; `type` is note or refusal.
std::string sentence_text(const char* type, const std::string& sentence);

}  // namespace feeler::demo
