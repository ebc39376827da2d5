// Scenes by name, by file, and the real mesh that is shown when none is given.
#include "scene_choice.hpp"

#include <cmath>
#include <utility>

#include "bad_input.hpp"
#include "build_information.hpp"
#include "mesh_file.hpp"
#include "scenes/cavity.hpp"
#include "scenes/mesh_scene.hpp"
#include "scenes/plate.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/teeth.hpp"
#include "scenes/terrain.hpp"

namespace feeler::demo {
namespace {

constexpr const char* formula = "formula";

scenes::Tool load_tool(const Options& options) {
  if (!options.tool) return scenes::slender_probe();
  const Mesh mesh = load_mesh(*options.tool, options.scale);
  try {
    return ConvexPolytope<double>::hull_of(mesh.vertices);
  } catch (const std::invalid_argument& refusal) {
    throw BadInput("The tool " + options.tool->string() + " cannot be used: " + refusal.what());
  }
}

/// A scanned jaw, an animal, or the terrain: the first that this machine has.
ChosenScene best_real_mesh(const Options& options) {
  if (std::filesystem::exists(teeth_mesh_file)) {
    Mesh mesh = load_mesh(teeth_mesh_file, 1.0);
    return {scenes::lower_teeth(scenes::teeth_vertices(mesh.vertices), std::move(mesh.triangles)), teeth_mesh_file, formula};
  }
  if (std::filesystem::exists(animal_mesh_file)) {
    Mesh mesh = load_mesh(animal_mesh_file, 1.0);
    const double size = scenes::bounds(mesh.vertices, mesh.triangles).sizes().maxCoeff();
    mesh.vertices *= 0.1 / size;
    return {scenes::mesh_scene("mesh", std::move(mesh.vertices), std::move(mesh.triangles), scenes::slender_probe()), animal_mesh_file, formula};
  }
  return {scenes::terrain(71, options.seed), formula, formula};
}

ChosenScene scene_of_files(const Options& options) {
  if (!options.object && !options.tool) return best_real_mesh(options);
  if (!options.object) throw BadInput("--tool needs an object: give its mesh file with --object.");
  Mesh mesh = load_mesh(*options.object, options.scale);
  scenes::Scene scene = scenes::mesh_scene("file", std::move(mesh.vertices), std::move(mesh.triangles), load_tool(options));
  if (options.start) {
    scene.start.translation = *options.start;
    scene.motion = scenes::started_from(scene.start, std::move(scene.motion));
  }
  return {std::move(scene), options.object->string(), options.tool ? options.tool->string() : formula};
}

ChosenScene scene_named(const std::string& name, const Options& options) {
  if (name == "cavity") return {scenes::cavity(options.clearance), formula, formula};
  if (name == "steps") return {scenes::steps(), formula, formula};
  if (name == "plate") return {scenes::plate(), formula, formula};
  if (name == "sulcus") return {scenes::sulcus(), formula, formula};
  if (name == "terrain") {
    const int cells = std::max(1, int(std::lround(std::sqrt(double(options.triangles) / 2.0))));
    return {scenes::terrain(cells, options.seed), formula, formula};
  }
  return scene_of_files(options);
}

}  // namespace

std::vector<ChosenScene> choose_scenes(const Options& options) {
  std::vector<std::string> names{"cavity", "steps", "file"};
  if (options.scene) names = {*options.scene};
  std::vector<ChosenScene> chosen;
  for (const std::string& name : names) chosen.push_back(scene_named(name, options));
  return chosen;
}

}  // namespace feeler::demo
