// The scenes that can be chosen on the page, each with a sentence of what to try.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "live/live_scene.hpp"
#include "options.hpp"

namespace feeler::demo {

/// One way a scene comes: with a clearance, a tool or a number of triangles.
struct GalleryVariant {
  std::string label;
  std::function<LiveScene()> make;  ///< throws BadInput or std::invalid_argument where it cannot be
};

/// A scene of the gallery.
struct GalleryEntry {
  std::string id;  ///< one word
  std::string title;
  std::string hint;                                                ///< what to try, a sentence
  std::vector<GalleryVariant> variants;                            ///< one at least
  std::function<LiveScene(double clearance)> with_clearance = {};  ///< where any clearance can be had [m]
};

/// All scenes of the catalogue, those of files that this machine has, and first the user's own file where one
/// is given. Nothing is made before it is asked for.
std::vector<GalleryEntry> gallery(const Options& options);

/// The entry of an id, or null.
const GalleryEntry* find_entry(const std::vector<GalleryEntry>& gallery, const std::string& id);

/// What is chosen: a variant by its label, the first for an empty one, or any clearance.
/// @throws BadInput where the entry has no such variant or no clearance
LiveScene make_scene(const GalleryEntry& entry, const std::string& variant, std::optional<double> clearance);

}  // namespace feeler::demo
