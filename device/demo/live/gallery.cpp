// The gallery: families of the catalogue, and scenes of the demo alone.
#include "live/gallery.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bad_input.hpp"
#include "build_information.hpp"
#include "mesh_file.hpp"
#include "scene_choice.hpp"
#include "scenes/catalogue.hpp"
#include "scenes/peg.hpp"
#include "scenes/plate.hpp"
#include "scenes/shaft.hpp"

namespace feeler::demo {
namespace {

/// Title and hint of a family of the catalogue.
struct Words {
  const char *family, *title, *hint;
};
constexpr Words words[] = {
    {"cavity", "Cube in a cavity", "Push the cube against a wall and slide along it, then turn it until two opposite edges jam."},
    {"steps", "Line on steps", "Lower the tool onto a step, then drag it over the edge and watch how the contact changes its type."},
    {"spline", "Spline shaft", "Turn the shaft until its teeth meet the grooves, then push it down the hole."},
    {"sulcus", "Gum and tooth", "Follow the groove between tooth and gum with the tip of the probe."},
    {"terrain", "Pebble on bumps",
     "Press the pebble down and roll it over the bumps; the count of triangles hardly changes the time of a "
     "tick."},
};

LiveScene made(const scenes::CatalogueEntry& entry) {
  return std::visit([](auto scene) { return live(std::move(scene)); }, entry.make());
}

void add_catalogue(std::vector<GalleryEntry>& list) {
  for (const scenes::CatalogueEntry& entry : scenes::catalogue()) {
    auto place = std::find_if(list.begin(), list.end(), [&](const GalleryEntry& e) { return e.id == entry.family; });
    if (place == list.end()) {
      const auto* found = std::find_if(std::begin(words), std::end(words), [&](const Words& w) { return entry.family == w.family; });
      const bool is_known = found != std::end(words);
      list.push_back({entry.family, is_known ? found->title : entry.family, is_known ? found->hint : "Press the tool on the object.", {}, {}});
      place = std::prev(list.end());
    }
    place->variants.push_back({entry.label, [entry] { return made(entry); }});
    if (entry.family == "cavity") place->with_clearance = [](double c) { return live(scenes::cavity(c)); };
    if (entry.family == "spline") place->with_clearance = [](double c) { return live(scenes::spline(c)); };
  }
}

/// The terrain of the user's own count of triangles, before those of the catalogue.
void put_own_terrain_first(std::vector<GalleryEntry>& list, const Options& options) {
  Options of_terrain = options;
  of_terrain.scene = "terrain";
  for (GalleryEntry& entry : list) {
    if (entry.id != "terrain") continue;
    const auto make = [of_terrain] { return live(std::move(choose_scenes(of_terrain).front().scene)); };
    entry.variants.insert(entry.variants.begin(), {"about " + std::to_string(options.triangles) + " triangles", make});
  }
}

void add_shafts(std::vector<GalleryEntry>& list) {
  GalleryEntry entry{
      "shaft", "Shaft in its bore", "Push the shaft aside until it touches, then turn it about its axis: all its walls are near at once.", {}, {}};
  for (const int facets : {24, 5, 120}) {
    for (const auto& [play, label] : {std::pair(2e-5, "20 µm"), std::pair(2e-4, "200 µm")})
      entry.variants.push_back({std::to_string(facets) + " facets, " + label, [facets, play = play] { return live(scenes::shaft(facets, play)); }});
  }
  entry.with_clearance = [](double play) { return live(scenes::shaft(24, play)); };
  list.push_back(std::move(entry));
}

void add_plates(std::vector<GalleryEntry>& list) {
  list.push_back({"plate",
                  "Plate of no thickness",
                  "Try to push the box through the plate, as fast as you like.",
                  {{"plate", [] { return live(scenes::plate()); }}},
                  {}});
  GalleryEntry tunnel{"tunnel", "Tunnel of thin walls", "Try to break out of the tunnel, in any direction.", {}, {}};
  for (const int walls : {4, 3, 2})
    tunnel.variants.push_back({std::to_string(walls) + " walls, 1 mm", [walls] { return live(scenes::tunnel(walls)); }});
  list.push_back(std::move(tunnel));
}

void add_pegs(std::vector<GalleryEntry>& list) {
  const std::filesystem::path folder = factory_mesh_folder;
  const std::filesystem::path hole = folder / "rectangular_hole_8mm.obj";
  GalleryEntry entry{"peg", "Peg in its hole", "Tilt the peg, find the hole with its chamfers, and push it in.", {}, {}};
  for (const char* fit : {"tight", "loose"}) {
    const std::filesystem::path peg = folder / (std::string("rectangular_peg_8mm_") + fit + ".obj");
    if (!std::filesystem::exists(peg) || !std::filesystem::exists(hole)) continue;
    entry.variants.push_back({std::string("8 mm, ") + fit, [peg, hole] {
                                Mesh object = load_mesh(hole, 1.0);
                                return live(scenes::peg(std::move(object.vertices), std::move(object.triangles), load_mesh(peg, 1.0).vertices));
                              }});
  }
  if (!entry.variants.empty()) list.push_back(std::move(entry));
}

GalleryEntry file_entry(const Options& options) {
  Options of_file = options;
  of_file.scene = "file";
  const bool is_own = options.object.has_value();
  return {
      is_own ? "file" : "mesh",
      is_own ? options.object->filename().string() : "A real mesh",
      is_own ? "Feel your own mesh: drag the tool onto it and slide around." : "Feel the surface with the tip, into its grooves and over its edges.",
      {{is_own ? "file" : "mesh", [of_file] { return live(std::move(choose_scenes(of_file).front().scene)); }}},
      {}};
}

}  // namespace

std::vector<GalleryEntry> gallery(const Options& options) {
  std::vector<GalleryEntry> list;
  if (options.object) list.push_back(file_entry(options));
  add_catalogue(list);
  if (options.are_triangles_given) put_own_terrain_first(list, options);
  if (!options.object) list.push_back(file_entry(options));
  add_shafts(list);
  add_pegs(list);
  add_plates(list);
  return list;
}

const GalleryEntry* find_entry(const std::vector<GalleryEntry>& gallery, const std::string& id) {
  const auto found = std::find_if(gallery.begin(), gallery.end(), [&](const GalleryEntry& entry) { return entry.id == id; });
  return found == gallery.end() ? nullptr : &*found;
}

LiveScene make_scene(const GalleryEntry& entry, const std::string& variant, std::optional<double> clearance) {
  if (clearance) {
    if (!entry.with_clearance) throw BadInput("The scene " + entry.id + " has no clearance to choose.");
    return entry.with_clearance(*clearance);
  }
  if (variant.empty()) return entry.variants.front().make();
  for (const GalleryVariant& candidate : entry.variants)
    if (candidate.label == variant) return candidate.make();
  throw BadInput("The scene " + entry.id + " has no variant " + variant + ".");
}

}  // namespace feeler::demo
