// Guesses the unit of a mesh, and sizes its probe.
#include "live/own_mesh.hpp"

#include <algorithm>
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
  const char* label;
  double metres;
};
constexpr Unit units[] = {{"in metres", 1.0}, {"in centimetres", 0.01}, {"in millimetres", 0.001}, {"in inches", 0.0254}};

bool is_own(const GalleryEntry& entry) { return entry.id.rfind(own_mesh_id, 0) == 0; }

MeshReport box_of(const Mesh& mesh) {
  const Eigen::AlignedBox3d box = scenes::bounds(mesh.vertices, mesh.triangles);
  MeshReport report;
  for (std::size_t k = 0; k < 3; ++k) report.lower[k] = (box.min)()[Eigen::Index(k)], report.upper[k] = (box.max)()[Eigen::Index(k)];
  return report;
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
  ConvexPolytope<double> probe = probe_for(metres * box_of(mesh).width());
  return live(scenes::mesh_scene("file", std::move(vertices), mesh.triangles, std::move(probe)));
}

}  // namespace

GalleryEntry own_mesh_entry(const SentFile& file, int number) {
  const auto mesh = std::make_shared<const Mesh>(read_mesh_apart(file.bytes, file.name));
  GalleryEntry entry{
      own_mesh_id + std::to_string(number), file.name.substr(0, longest_title), "Your own mesh: drag the probe onto it and slide around.", {}, {}};
  for (const Unit& unit : units) entry.variants.push_back({unit.label, [mesh, metres = unit.metres] { return scene_of(*mesh, metres); }});
  if (box_of(*mesh).looks_like_millimetres()) std::rotate(entry.variants.begin(), entry.variants.begin() + 2, entry.variants.begin() + 3);
  return entry;
}

std::string sentence_of(const GalleryEntry& entry, const MeshReport& report) {
  const std::string& unit = entry.variants.front().label;
  const char* const why = unit == units[0].label ? "" : ", because it would be wider than 10 m otherwise";
  return entry.title + ": " + to_string(report) + " Its numbers were taken " + unit + why + "; choose another unit under Which.";
}

void put_own_mesh_first(std::vector<GalleryEntry>& gallery, GalleryEntry entry) {
  std::erase_if(gallery, [&](const GalleryEntry& other) { return is_own(other) && other.title == entry.title; });
  if (std::count_if(gallery.begin(), gallery.end(), is_own) >= most_own_meshes)
    gallery.erase(std::next(std::find_if(gallery.rbegin(), gallery.rend(), is_own)).base());
  gallery.insert(gallery.begin(), std::move(entry));
}

}  // namespace feeler::demo
