// Guesses the unit of a mesh, and sizes its probe.
#include "live/own_mesh.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <utility>

#include "mesh_reader.hpp"
#include "scenes/mesh_scene.hpp"
#include "scenes/sulcus.hpp"

namespace feeler::demo {
namespace {

constexpr const char* own_mesh_id = "own-";
constexpr std::ptrdiff_t most_own_meshes = 6;
constexpr std::size_t longest_title = 60;

struct Unit {
  const char *id, *label;
  double metres;
};
constexpr Unit units[] = {{"m", "in metres", 1.0}, {"cm", "in centimetres", 0.01}, {"mm", "in millimetres", 0.001}, {"in", "in inches", 0.0254}};

/// Files of parts are in millimetres mostly, and scenes in metres are smaller than one.
const char* guessed_unit(double width) { return width < 1 ? "m" : "mm"; }

/// Among the units; that of millimetres where there is no such.
std::ptrdiff_t place_of(const std::string& id) {
  const auto* const found = std::find_if(std::begin(units), std::end(units), [&](const Unit& unit) { return unit.id == id; });
  return found == std::end(units) ? 2 : found - std::begin(units);
}

bool is_own(const GalleryEntry& entry) { return entry.id.rfind(own_mesh_id, 0) == 0; }

double width_of(const Mesh& mesh) { return scenes::bounds(mesh.vertices, mesh.triangles).sizes().maxCoeff(); }

/// 0.024 as "24 mm".
std::string length_text(double metres) {
  constexpr std::pair<double, const char*> steps[] = {{1.0, "m"}, {1e-3, "mm"}, {1e-6, "µm"}};
  const auto* step = std::begin(steps);
  while (metres < 0.9995 * step->first && step + 1 != std::end(steps)) ++step;
  char text[40];
  std::snprintf(text, sizeof text, "%.*g %s", metres < 999.5 * step->first ? 3 : 6, metres / step->first, step->second);
  return text;
}

/// The slender probe of 40 mm suits what is as large as a hand. Around larger things an arm is no longer, so there it grows less.
ConvexPolytope<double> probe_for(double width) {
  constexpr double hand = 0.1, most = 5.0, least = 1e-3;
  const ConvexPolytope<double> probe = scenes::slender_probe();
  Points<double> points(probe.vertex_count(), 3);
  for (int i = 0; i < probe.vertex_count(); ++i) points.row(i) = Vector3<double>(probe.vertex(i)).transpose();
  return ConvexPolytope<double>::hull_of(points * std::clamp(width / hand, least, most));
}

LiveScene scene_of(const Mesh& mesh, double metres) {
  Points<double> vertices = metres * mesh.vertices;
  ConvexPolytope<double> probe = probe_for(metres * width_of(mesh));
  return live(scenes::mesh_scene("file", std::move(vertices), mesh.triangles, std::move(probe)));
}

}  // namespace

GalleryEntry own_mesh_entry(const SentFile& file, int number, const std::stop_token& stop) {
  const auto mesh = std::make_shared<const Mesh>(read_mesh_apart(file.bytes, file.name, stop));
  GalleryEntry entry{
      own_mesh_id + std::to_string(number), file.name.substr(0, longest_title), "Your own mesh: drag the probe onto it and slide around.", {}, {}};
  for (const Unit& unit : units) entry.variants.push_back({unit.label, [mesh, metres = unit.metres] { return scene_of(*mesh, metres); }});
  const auto place = entry.variants.begin() + place_of(file.unit.empty() ? guessed_unit(width_of(*mesh)) : file.unit);
  std::rotate(entry.variants.begin(), place, place + 1);
  return entry;
}

std::string sentence_of(const SentFile& file, const GalleryEntry& entry, const MeshReport& report) {
  std::string text = to_string(report);
  text.erase(text.rfind(" It is "));  // its size in metres, and a guess: both are said better here
  const auto side = [&](std::size_t k) { return length_text(report.upper[k] - report.lower[k]); };
  text = entry.title + ": " + text + " Taken as " + side(0) + " × " + side(1) + " × " + side(2) + ", its numbers " + entry.variants.front().label;
  return text + (file.unit.empty() ? ", which is a guess: another unit can be chosen under Which." : ".");
}

void put_own_mesh_first(std::vector<GalleryEntry>& gallery, GalleryEntry entry) {
  std::erase_if(gallery, [&](const GalleryEntry& other) { return is_own(other) && other.title == entry.title; });
  if (std::count_if(gallery.begin(), gallery.end(), is_own) >= most_own_meshes)
    gallery.erase(std::next(std::find_if(gallery.rbegin(), gallery.rend(), is_own)).base());
  gallery.insert(gallery.begin(), std::move(entry));
}

}  // namespace feeler::demo
