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
#include "golden/arithmetic.hpp"
#include "golden/comparison.hpp"
#include "golden/record.hpp"
#include "golden/trajectory.hpp"
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
  int repeats = 1;            // identical runs; of each tick the least time counts
  bool prints_table = false;  // the table of docs/performance.md
  bool counts_work = false;   // report the work of a tick in place of its time
  bool hashes = false;        // print one number a trajectory in place of figures
  std::string golden_file;    // compare them with those of this file; empty: print them
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

  const auto motion = options.hostile_seed != 0 ? feeler::scenes::hostile(scene.motion, options.hostile_seed, options.rate) : scene.motion;
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
          const auto found =
              feeler::test::deepest_penetration_on_path(checked_object, piece, feeler::test::checked_pose(from), feeler::test::checked_pose(to), 8);
          figures.deepest = std::max(figures.deepest, double(found.depth));
        }
        from = to;
      }
    }
    last = tick.graphic_pose;
  }
  return figures;
}

/// The same, with the least time of each tick in some identical runs: what else runs on the machine disturbs none of them all the time.
template <class Tool>
Figures replay_repeatedly(const feeler::scenes::Setting& scene, const Tool& tool, const Options& options) {
  Figures figures = replay(scene, tool, options);
  Options time_alone = options;
  time_alone.check_every = time_alone.settle_every = 0;
  for (int i = 1; i < options.repeats; ++i) {
    const auto cost = replay(scene, tool, time_alone).cost;
    std::transform(cost.begin(), cost.end(), figures.cost.begin(), figures.cost.begin(), [](double a, double b) { return std::min(a, b); });
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

double converged_share(const Figures& figures) { return 100.0 * figures.converged / double(std::max<std::size_t>(figures.cost.size(), 1)); }

void print_header(const Options& options) {
  const char* cost = options.counts_work ? "p50" : "p50 µs";
  if (options.counts_work) std::printf("work of a contact tick: 1 is a distance query, an optimisation, 16 planes or 16 nodes of the hierarchy\n");
  std::printf("%-18s %13s %7s | %7s %7s %7s %7s %7s | %7s %7s | %9s %9s %9s | %9s\n", "scene", "contact/ticks", "conv %", "mean", cost, "p99",
              "p99.9", "max", "rows", "iter99", "≤0.1 µm %", "of conv %", "p98 µm", "deepest m");
}

void print(const std::string& name, const Figures& figures, const Options& options) {
  const auto& cost = figures.cost;
  std::printf("%-18s %6zu/%6d %7.2f | %7.1f %7.1f %7.1f %7.1f %7.1f | %7.0f %7.0f | ", name.c_str(), cost.size(), figures.ticks,
              converged_share(figures), mean(cost), quantile(cost, 0.5), quantile(cost, 0.99), quantile(cost, 0.999), quantile(cost, 1.0),
              quantile(figures.rows, 0.5), quantile(figures.iterations, 0.99));
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

/// Calls `use(scene, tool)` with the tool that the scene holds.
template <class Use>
void with_tool(const feeler::scenes::Scene& scene, const Use& use) {
  std::visit([&](const auto& tool) { use(scene, tool); }, scene.tool);
}
template <class Use>
void with_tool(const feeler::scenes::CompoundScene& scene, const Use& use) {
  use(scene, feeler::CompoundTool<feeler::ConvexPolytope<double>>::hulls_of(scene.pieces));
}

/// Calls `use(name, scene, tool)` for each scene that is asked for, and `skip(name, file)` for one whose file is not here.
template <class Use, class Skip>
void for_each_scene(const Options& options, const Use& use, const Skip& skip) {
  const auto wanted = [&](const std::string& name) { return options.scene == "all" || options.scene == name; };
  for (const auto& entry : feeler::scenes::catalogue()) {
    if (!wanted(entry.family)) continue;
    const auto use_named = [&](const auto& scene, const auto& tool) { use(entry.label, scene, tool); };
    std::visit([&](const auto& scene) { with_tool(scene, use_named); }, entry.make());
  }
  if (!wanted("teeth")) return;
  const std::filesystem::path file = "../shared/meshes/lower_teeth.stl";
  if (!std::filesystem::exists(file)) return skip("teeth", file);
  auto mesh = feeler::demo::load_mesh(file, 1.0);
  with_tool(feeler::scenes::lower_teeth(feeler::scenes::teeth_vertices(mesh.vertices), std::move(mesh.triangles)),
            [&](const auto& scene, const auto& tool) { use("teeth", scene, tool); });
}

void print_table(const Options& options) {
  const auto print_times = [](const Figures& figures) {
    const char* before = " | ";
    for (const double share : {0.5, 0.99, 0.999, 1.0}) {
      const double time = quantile(figures.cost, share);
      std::printf("%s%.*f", before, time < 9.95 ? 1 : 0, time);
      before = " / ";
    }
    std::printf(" | %.1f", converged_share(figures));
  };
  std::printf(
      "| scene | 1 kHz: p50 / p99 / p99.9 / worst µs | converged %% | within 0.1 µm %% | 10 kHz: p50 / p99 / p99.9 / worst µs | converged %% |\n"
      "|---|---|---|---|---|---|\n");
  for_each_scene(
      options,
      [&](const std::string& name, const auto& scene, const auto& tool) {
        Options slow = options, fast = options;
        slow.rate = 1e3;
        slow.seconds = 10;
        slow.settle_every = 40;
        fast.rate = 1e4;
        fast.seconds = 2;
        const Figures at_1_khz = replay_repeatedly(scene, tool, slow);
        std::printf("| %s", name.c_str());
        print_times(at_1_khz);
        std::printf(" | %.1f", near_share(at_1_khz.distance));
        print_times(replay_repeatedly(scene, tool, fast));
        std::printf(" |\n");
        std::fflush(stdout);
      },
      [](const char* name, const std::filesystem::path& file) { std::fprintf(stderr, "%s: left out, %s is not here\n", name, file.c_str()); });
}

int print_figures(const Options& options) {
  if (options.prints_table) return print_table(options), 0;
  print_header(options);
  for_each_scene(
      options, [&](const std::string& name, const auto& scene, const auto& tool) { print(name, replay_repeatedly(scene, tool, options), options); },
      [](const char* name, const std::filesystem::path& file) { std::printf("%s: skipped, %s is not here\n", name, file.c_str()); });
  return 0;
}

int print_hashes(const Options& options) {
  std::fputs(feeler::bench::golden_head(feeler::bench::arithmetic()).c_str(), stdout);
  for_each_scene(
      options,
      [](const std::string& name, const auto& scene, const auto& tool) {
        std::fputs(feeler::bench::golden_line(name, feeler::bench::golden_hashes(scene, tool)).c_str(), stdout);
        std::fflush(stdout);
      },
      [](const char* name, const std::filesystem::path& file) { std::fprintf(stderr, "%s: left out, %s is not here\n", name, file.c_str()); });
  return 0;
}

/// @return 0 if the trajectories are those of the file, 1 if one is not, 77 if the file is of another arithmetic
int compare_hashes(const Options& options) {
  constexpr int differs = 1, is_skipped = 77;
  feeler::bench::GoldenComparison comparison(options.golden_file);
  if (!comparison.is_possible()) return is_skipped;
  for_each_scene(
      options, [&](const std::string& name, const auto& scene, const auto& tool) { comparison.add(name, feeler::bench::golden_hashes(scene, tool)); },
      [&](const char* name, const std::filesystem::path& mesh) {
        std::printf("%s: skipped, %s is not here\n", name, mesh.c_str());
        comparison.skip(name);
      });
  if (options.scene == "all") comparison.conclude_all();
  if (comparison.others() == 0) return 0;
  std::printf("scenes that differ: %d. A change that was to change no behaviour has changed it; if that was meant: feeler-replay --hash > %s\n",
              comparison.others(), options.golden_file.c_str());
  return differs;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("feeler-replay: how long a tick takes, how exact it is, and what penetrates", "feeler-replay");
  app.add_option("--scene", options.scene, "cavity, steps, spline, sulcus, teeth, terrain or all")
      ->check(CLI::IsMember({"all", "cavity", "steps", "spline", "sulcus", "teeth", "terrain"}));
  app.add_option("--rate", options.rate, "ticks a second")->check(feeler::bench::within(100.0, 1e5));
  app.add_option("--seconds", options.seconds, "length of the motion")->check(feeler::bench::within(0.01, 1e4));
  app.add_option("--hostile", options.hostile_seed, "seed of teleports and spins; 0 for none");
  app.add_option("--check", options.check_every, "check every Nth tick for penetration; 0 for none")->check(feeler::bench::within(0, 1000000000));
  app.add_option("--settle", options.settle_every, "hold the device at every Nth contact tick and see where the tool settles; 0 for none")
      ->check(feeler::bench::within(0, 1000000000));
  app.add_option("--budget", options.work_budget, "Settings::work_budget; 0 for the default")->check(feeler::bench::within(0, 1000000000));
  app.add_option("--margin", options.margin, "Settings::margin in metres; 0 for the default");
  app.add_option("--repeats", options.repeats, "identical runs: the least time of each tick counts")->check(feeler::bench::within(1, 1000));
  app.add_flag("--table", options.prints_table,
               "print the table of docs/performance.md, in Markdown; of the other options --scene, --repeats, --budget and --margin count");
  app.add_flag("--work", options.counts_work, "report the work of a tick, which does not depend on the machine, in place of its time");
  app.add_flag(
      "--hash", options.hashes,
      "print one number for the bits of each scene's trajectory at 1 kHz, at 10 kHz and with a hostile hand; of the other options --scene alone counts");
  app.add_option("--against", options.golden_file,
                 "with --hash: compare with this file; 1 if a scene differs, 77 if the file is of another arithmetic")
      ->needs("--hash");
  return feeler::bench::run_with_options(app, argc, argv, [&] {
    if (!options.hashes) return print_figures(options);
    return options.golden_file.empty() ? print_hashes(options) : compare_hashes(options);
  });
}
