// Replays the scenes against the renderer alone and says how long a tick took, how exact it was, and what penetrated.
//
// The device is a recorded hand: poses at a fixed rate, no servo loop and no feedback, so that runs can be compared.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "../device/demo/mesh_file.hpp"
#include "command_line.hpp"
#include "feeler/feeler.hpp"
#include "scenes/catalogue.hpp"
#include "scenes/motions.hpp"
#include "scenes/renderers.hpp"
#include "scenes/teeth.hpp"
#include "support/penetration_checker.hpp"
#include "times.hpp"

namespace {

using feeler::Pose;
using feeler::Twist;
using feeler::bench::quantile;
using feeler::bench::thread_time;

struct Options {
  std::string scene = "all";
  double rate = 1000.0;
  double seconds = 10.0;
  unsigned hostile_seed = 0;  // 0: the hand moves as the scene says
  int check_every = 0;        // ticks between checks of pose and way; 0: none
  int settle_every = 0;       // contact ticks between looks at where the tool would settle; 0: none
  int work_budget = 0;        // 0: the library's default
  double margin = 0.0;        // [m]; 0: the library's default
  bool counts_work = false;   // report the work of a tick in place of its time
};

/// What one replay found.
struct Figures {
  int ticks = 0;
  int checked = 0;
  int converged = 0;
  std::vector<double> cost;                                  // of contact ticks: time [µs] or work
  std::vector<double> iterations, rows;                      // of contact ticks
  std::vector<double> distance, distance_if_converged;       // to where the held device settles [m]
  double deepest = 0.0;
};

/// Distance in the metric of the scene from the graphic pose to where the renderer would settle with the device held [m].
template <class Renderer>
double distance_to_settled(Renderer renderer, const Pose<double>& haptic, const feeler::Metric<double>& metric) {
  constexpr int most_ticks = 200;
  const Pose<double> graphic = renderer.tick().graphic_pose;
  for (int i = 0; i < most_ticks; ++i) {
    if (renderer.update(haptic).converged() && renderer.tick().path.empty()) break;
  }
  return std::sqrt(2.0 * metric.energy(motion_between(graphic, renderer.tick().graphic_pose)));
}

template <class Tool>
Figures replay(const feeler::scenes::Setting& scene, const Tool& tool, const Options& options) {
  constexpr double contact_energy = 1e-14;  // [m²]
  const feeler::TriangleMesh<double> object(scene.vertices, scene.triangles);
  auto settings = scene.settings();
  if (options.work_budget > 0) settings.work_budget = options.work_budget;
  if (options.margin != 0.0) settings.margin = options.margin;
  feeler::HapticRenderer renderer(object, tool, settings);
  if (renderer.reset(scene.start) != feeler::Status::converged) throw std::runtime_error("the scene starts in penetration");

  const auto motion =
      options.hostile_seed != 0 ? feeler::scenes::hostile(scene.motion, options.hostile_seed, options.rate) : scene.motion;
  const auto metric = feeler::Metric<double>::proportional_to(settings.stiffness);
  const feeler::test::CheckedObject checked_object(scene.vertices, scene.triangles);
  const auto checked_pieces = feeler::test::checked_pieces(tool);
  Figures figures;
  figures.ticks = int(options.seconds * options.rate);
  Pose<double> last = scene.start;
  for (int k = 1; k <= figures.ticks; ++k) {
    const Pose<double> haptic = motion(double(k) / options.rate);
    const double begin = thread_time();
    const auto& tick = renderer.update(haptic);
    const double end = thread_time();
    if (metric.energy(motion_between(haptic, tick.graphic_pose)) > contact_energy) {
      figures.cost.push_back(options.counts_work ? tick.work : end - begin);
      figures.iterations.push_back(tick.iterations);
      figures.rows.push_back(tick.rows);
      figures.converged += tick.converged() ? 1 : 0;
      if (options.settle_every > 0 && int(figures.cost.size()) % options.settle_every == 0) {
        const double distance = distance_to_settled(renderer, haptic, metric);
        figures.distance.push_back(distance);
        if (tick.converged()) figures.distance_if_converged.push_back(distance);
      }
    }
    if (options.check_every > 0 && k % options.check_every == 0) {
      ++figures.checked;
      Pose<double> from = last;
      for (const auto& to : tick.path) {
        for (const auto& piece : checked_pieces) {
          const auto found = feeler::test::deepest_penetration_on_path(checked_object, piece, feeler::test::checked_pose(from),
                                                                       feeler::test::checked_pose(to), 8);
          figures.deepest = std::max(figures.deepest, double(found.depth));
        }
        from = to;
      }
    }
    last = tick.graphic_pose;
  }
  return figures;
}

/// Share of distances of at most 0.1 µm [%].
double near_share(const std::vector<double>& distance) {
  const auto near = std::count_if(distance.begin(), distance.end(), [](double d) { return d <= 1e-7; });
  return 100.0 * double(near) / double(std::max<std::size_t>(distance.size(), 1));
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(std::max<std::size_t>(values.size(), 1));
}

void print_header(const Options& options) {
  const char* cost = options.counts_work ? "p50" : "p50 µs";
  if (options.counts_work) std::printf("work of a contact tick: 1 is a distance query, an optimisation, 16 planes or 16 nodes of the hierarchy\n");
  std::printf("%-18s %13s %7s | %7s %7s %7s %7s %7s | %7s %7s | %9s %9s %9s | %9s\n", "scene", "contact/ticks", "conv %", "mean",
              cost, "p99", "p99.9", "max", "rows", "iter99", "≤0.1 µm %", "of conv %", "p98 µm", "deepest m");
}

void print(const std::string& name, const Figures& figures, const Options& options) {
  const auto& cost = figures.cost;
  const double contacts = double(std::max<std::size_t>(cost.size(), 1));
  std::printf("%-18s %6zu/%6d %7.2f | %7.1f %7.1f %7.1f %7.1f %7.1f | %7.0f %7.0f | ", name.c_str(), cost.size(), figures.ticks,
              100.0 * figures.converged / contacts, mean(cost), quantile(cost, 0.5), quantile(cost, 0.99), quantile(cost, 0.999),
              quantile(cost, 1.0), quantile(figures.rows, 0.5), quantile(figures.iterations, 0.99));
  if (figures.distance.empty()) {
    std::printf("%9s %9s %9s | ", "-", "-", "-");
  } else {
    std::printf("%9.2f %9.2f %9.3g | ", near_share(figures.distance), near_share(figures.distance_if_converged),
                1e6 * quantile(figures.distance, 0.98));
  }
  if (options.check_every > 0) {
    std::printf("%9.2g\n", figures.deepest);
  } else {
    std::printf("%9s\n", "-");
  }
  std::fflush(stdout);
}

void run(const std::string& name, const feeler::scenes::Scene& scene, const Options& options) {
  std::visit([&](const auto& tool) { print(name, replay(scene, tool, options), options); }, scene.tool);
}

void run(const std::string& name, const feeler::scenes::CompoundScene& scene, const Options& options) {
  using Tool = feeler::CompoundTool<feeler::ConvexPolytope<double>>;
  print(name, replay(scene, Tool::hulls_of(scene.pieces), options), options);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("feeler-replay: how long a tick takes, how exact it is, and what penetrates", "feeler-replay");
  app.add_option("--scene", options.scene, "cavity, steps, spline, sulcus, teeth, terrain or all")
      ->check(CLI::IsMember({"all", "cavity", "steps", "spline", "sulcus", "teeth", "terrain"}));
  app.add_option("--rate", options.rate, "ticks a second")->check(CLI::Range(100.0, 1e5));
  app.add_option("--seconds", options.seconds, "length of the motion")->check(CLI::Range(0.01, 1e4));
  app.add_option("--hostile", options.hostile_seed, "seed of teleports and spins; 0 for none");
  app.add_option("--check", options.check_every, "check every Nth tick for penetration; 0 for none")->check(CLI::NonNegativeNumber);
  app.add_option("--settle", options.settle_every, "hold the device at every Nth contact tick and see where the tool settles; 0 for none")->check(CLI::NonNegativeNumber);
  app.add_option("--budget", options.work_budget, "Settings::work_budget; 0 for the default")->check(CLI::NonNegativeNumber);
  app.add_option("--margin", options.margin, "Settings::margin in metres; 0 for the default");
  app.add_flag("--work", options.counts_work, "report the work of a tick, which does not depend on the machine, in place of its time");
  return feeler::bench::run_with_options(app, argc, argv, [&] {
    const auto wanted = [&](const std::string& name) { return options.scene == "all" || options.scene == name; };
    print_header(options);
    for (const auto& entry : feeler::scenes::catalogue()) {
      if (!wanted(entry.family)) continue;
      std::visit([&](const auto& scene) { run(entry.label, scene, options); }, entry.make());
    }
    if (wanted("teeth")) {
      const std::filesystem::path file = "../shared/meshes/lower_teeth.stl";
      if (std::filesystem::exists(file)) {
        auto mesh = feeler::demo::load_mesh(file, 1.0);
        run("teeth", feeler::scenes::lower_teeth(feeler::scenes::teeth_vertices(mesh.vertices), std::move(mesh.triangles)), options);
      } else {
        std::printf("teeth: skipped, %s is not here\n", file.c_str());
      }
    }
    return 0;
  });
}
