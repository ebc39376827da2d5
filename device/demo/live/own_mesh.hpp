// A mesh that somebody opened on the page, as a scene of the gallery.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "feeler/object/mesh_report.hpp"
#include "live/gallery.hpp"
#include "live/wishes.hpp"

namespace feeler::demo {

/// A mesh to feel, with a probe of a size that suits it. Its variants are the units that its numbers may be in; the first is the one that somebody
/// has said, or that is guessed.
///
/// @param number  tells it from others of the gallery
/// @param stop    ends the reading
/// @throws BadInput with a sentence where the file cannot be used
GalleryEntry own_mesh_entry(const SentFile& file, int number, const std::stop_token& stop);

/// What somebody should know of a mesh that was opened.
std::string sentence_of(const SentFile& file, const GalleryEntry& entry, const MeshReport& report);

/// Puts an entry first; another one of the same file leaves, and the oldest where there are too many.
void put_own_mesh_first(std::vector<GalleryEntry>& gallery, GalleryEntry entry);

}  // namespace feeler::demo
