// Feeler side by side with what people would take instead: the same scenes and motions, in one process and
// one run.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "../device/demo/mesh_file.hpp"
#include "command_line.hpp"
#include "rivals/arena.hpp"
#include "rivals/report.hpp"
#include "scenes/catalogue.hpp"
#include "scenes/teeth.hpp"
#include "text_file.hpp"

namespace {

using namespace feeler::rivals;
namespace fs = std::filesystem;

struct Options {
  std::string scene = "all", folder = "out/rivals", teeth = "../shared/meshes/lower_teeth.stl";
  double seconds = 0.0;  // 0: as long as the scene is
  bool has_no_figures = false, is_scaling = false;
  ContestOptions contest;
};

template <class Tool>
std::vector<Score> compete(const feeler::scenes::Setting& scene, const Tool& tool, double clearance, const Options& options) {
  Arena arena(scene, tool, clearance, 1.0 / options.contest.rate);
  ContestOptions contest = options.contest;
  contest.seconds = options.seconds > 0.0 ? options.seconds : scene.duration;
  return hold(arena.contest(), contest);
}

std::vector<Score> compete(const feeler::scenes::Scene& scene, double clearance, const Options& options) {
  return std::visit([&](const auto& tool) { return compete(scene, tool, clearance, options); }, scene.tool);
}

std::vector<Score> compete(const feeler::scenes::CompoundScene& scene, double clearance, const Options& options) {
  return compete(scene, feeler::CompoundTool<feeler::ConvexPolytope<double>>::hulls_of(scene.pieces), clearance, options);
}

/// The scenes wanted, with the teeth where their file is.
std::vector<feeler::scenes::CatalogueEntry> wanted_scenes(const Options& options) {
  auto list = feeler::scenes::catalogue();
  std::erase_if(list, [&](const auto& entry) { return options.scene != "all" && options.scene != entry.family; });
  if (options.scene != "all" && options.scene != "teeth") return list;
  if (!fs::exists(options.teeth)) {
    if (options.scene == "teeth") {
      throw std::runtime_error("The file " + options.teeth + " is not here: give the scan of the lower teeth with --teeth.");
    }
    std::fprintf(stderr, "teeth: left out, %s is not here\n", options.teeth.c_str());
    return list;
  }
  feeler::scenes::CatalogueEntry entry{.family = "teeth", .label = "lower teeth", .make = {}};
  entry.make = [file = options.teeth]() -> std::variant<feeler::scenes::Scene, feeler::scenes::CompoundScene> {
    auto mesh = feeler::demo::load_mesh(file, 1.0);
    return feeler::scenes::lower_teeth(feeler::scenes::teeth_vertices(mesh.vertices), std::move(mesh.triangles));
  };
  list.push_back(std::move(entry));
  return list;
}

/// What was found wrong.
struct Findings {
  bool has_all_figures = true;
  bool has_feeler_penetrated = false;
};

bool has_penetrated(const Score& score) {
  constexpr double allowance = 1e-11;  // for rounding, where nothing is left between tool and object [m]
  return score.deepest > allowance || score.crossed > 0;
}

Findings run(const Options& options) {
  const fs::path folder = options.folder;
  fs::create_directories(folder);
  std::string text;
  Findings findings;
  if (options.is_scaling) {
    ContestOptions contest = options.contest;
    contest.seconds = options.seconds > 0.0 ? options.seconds : 4.0;
    for (const auto& [name, size, grow] :
         {std::tuple("rivals_triangles", "triangles of the object", &grow_object), std::tuple("rivals_vertices", "vertices of the tool", &grow_tool),
          std::tuple("rivals_pieces", "pieces of the tool", &cut_tool)}) {
      const auto curve = grow(contest);
      write_scaling(folder, name, curve);
      text += (text.empty() ? "" : "\n") + scaling_in_markdown(size, curve);
      if (!options.has_no_figures) findings.has_all_figures &= draw_scaling(folder, name, size, curve);
    }
  } else {
    std::vector<SceneScores> all;
    for (const auto& entry : wanted_scenes(options)) {
      std::fprintf(stderr, "%s\n", entry.label.c_str());
      all.push_back({entry.label, std::visit([&](const auto& scene) { return compete(scene, entry.clearance, options); }, entry.make())});
    }
    for (const auto& scene : all) findings.has_feeler_penetrated |= has_penetrated(scene.scores.front());
    if (!all.empty()) {
      write_scenes(folder, all);
      text += scenes_in_markdown(all);
      if (!options.has_no_figures) findings.has_all_figures = draw_scenes(folder, all);
    }
    if (options.scene == "all" || options.scene == "plates") {
      std::fprintf(stderr, "plates\n");
      const auto plates = push_through_plates(options.contest.rate);
      findings.has_feeler_penetrated |= plates.front().crossed > 0;
      write_plates(folder, plates);
      text += (text.empty() ? "" : "\n") + plates_in_markdown(plates);
    }
  }
  feeler::demo::TextFile markdown(folder / (options.is_scaling ? "scaling.md" : "tables.md"));
  markdown.write(text);
  markdown.close();
  std::fputs(text.c_str(), stdout);
  return findings;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "feeler-rivals: Feeler and the engines that people would take instead, on the same scenes; Markdown to "
      "the standard output",
      "feeler-rivals");
  app.add_option("--scene", options.scene, "cavity, steps, spline, sulcus, terrain, teeth, plates or all")
      ->check(CLI::IsMember({"all", "cavity", "steps", "spline", "sulcus", "terrain", "teeth", "plates"}));
  app.add_option("--rate", options.contest.rate, "ticks a second")->check(feeler::bench::within(100.0, 1e5));
  app.add_option("--seconds", options.seconds, "length of the motion; 0 for the scene's own")->check(feeler::bench::within(0.0, 1e4));
  app.add_option("--repeats", options.contest.repeats, "identical runs; a tick's time is the least of them")->check(feeler::bench::within(1, 1000));
  app.add_option("--check", options.contest.check_every, "check every Nth tick for penetration")->check(feeler::bench::within(1, 1000000));
  app.add_option("--patience", options.contest.patience, "processor seconds after which a contender drops out of a run")
      ->check(feeler::bench::within(1e-3, 1e6));
  app.add_option("--teeth", options.teeth, "mesh file of the lower teeth");
  app.add_option("--out", options.folder, "folder of the CSV files, tables and figures");
  app.add_flag("--scaling", options.is_scaling, "grow the object and the tool, and cut the tool, instead");
  app.add_flag("--no-figures", options.has_no_figures, "write CSV files and tables only");
  return feeler::bench::run_with_options(app, argc, argv, [&] {
    if (const auto packages = missing_packages(); !packages.empty()) {
      std::string list;
      for (const auto& package : packages) list += " " + package;
      std::fprintf(stderr,
                   "feeler-rivals: built without some rivals; install%s, and configure and build again to "
                   "measure them too.\n",
                   list.c_str());
    }
    const Findings findings = run(options);
    if (findings.has_feeler_penetrated) {
      std::fprintf(stderr, "feeler-rivals: Feeler's own tool penetrated or crossed; see the tables.\n");
      return 1;
    }
    if (!findings.has_all_figures) {
      std::fprintf(stderr,
                   "feeler-rivals: the CSV files are written, but gnuplot could not draw them: install "
                   "gnuplot-nox.\n");
      return 3;
    }
    return 0;
  });
}
