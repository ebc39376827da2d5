// From options to scenes.
#pragma once

#include <vector>

#include "options.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// A scene to run, with where its meshes came from.
struct ChosenScene {
  scenes::Scene scene;
  std::string object_source;  ///< a file, or "formula"
  std::string tool_source;    ///< a file, or "formula"
};

/// The scenes that the options name; the default is the cavity, the steps, and the best real mesh at hand.
/// @throws BadInput for a file that cannot be used
std::vector<ChosenScene> choose_scenes(const Options& options);

}  // namespace feeler::demo
