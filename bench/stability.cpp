// How stiff may it be: closes a simulated hand and device over the renderer, and over its rivals, and
// searches for the limit.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line.hpp"
#include "experiments/plots.hpp"
#include "stability/grips.hpp"
#include "stability/studies.hpp"

namespace {

using namespace feeler::stability;

bool draw_figures(const std::filesystem::path& folder, const std::string& study) {
  using feeler::experiments::draw;
  bool is_drawn = true;
  const auto wanted = [&](const char* name) { return study == "all" || study == "figures" || study == name; };
  if (wanted("limits")) {
    std::string body =
        "set logscale xy; set xlabel 'rate of the loop  [Hz]'; set ylabel 'largest stable stiffness  [N/m]'; "
        "set key outside top horizontal Left reverse samplen 1.6\n"
        "set xrange [900:11000]; set multiplot layout 1,2\n";
    for (const char* device : {"premium-3.0", "sigma.7"}) {
      const std::string of = std::string("'< grep ^") + device + ", limits_by_rate.csv' using 2:";
      body += std::string("set label 1 '") + device + "' at graph 0.05, graph 0.95\nplot " + of +
              "3 with linespoints pt 7 lc rgb red title 'barely', " + of + "4 with linespoints pt 7 lc rgb amber title 'soft', " + of +
              "5 with linespoints pt 7 lc rgb green title 'relaxed', " + of + "6 with linespoints pt 7 lc rgb blue title 'firm', " + of +
              "7 with lines dt 2 lc rgb ink title '2b/T'\n";
    }
    is_drawn = draw(folder, "stability_limits", 900, 420, body + "unset multiplot; unset label\n") && is_drawn;
  }
  if (wanted("traces")) {
    std::string body =
        "set multiplot layout 2,1 margins 0.1,0.975,0.13,0.95 spacing 0.1\nset ylabel 'handle  [mm]'; set "
        "xrange [0.4:1.2]\n";
    body +=
        "set label 1 '0.9 of the limit' at graph 0.02, graph 0.92\nplot 'trace_below.csv' using 1:2 with "
        "lines lw 1.5 lc rgb green notitle\n";
    body +=
        "set label 1 '1.1 of the limit'; set xlabel 'time  [s]'\nplot 'trace_above.csv' using 1:2 with lines "
        "lw 1.5 lc rgb red notitle\nunset multiplot; unset label\n";
    is_drawn = draw(folder, "stability_traces", 800, 460, body) && is_drawn;
  }
  return is_drawn;
}

}  // namespace

int main(int argc, char** argv) {
  StudyOptions options;
  std::string study = "all", folder = "out/stability";
  bool has_no_figures = false, has_no_friction = false;
  std::vector<std::string> names, grip_names{""};
  for (const auto& device : all_devices()) names.emplace_back(device.name);
  for (const auto& grip : grips) grip_names.emplace_back(grip.name);
  options.rates = {1000, 2000, 4000, 10000};

  CLI::App app("The largest stable stiffness of a device in a hand, and how much it buzzes.", "feeler-stability");
  app.add_option("--study", study,
                 "all, presets, limits, rivals, slides, extrapolation, passivity, theory, traces, or figures "
                 "of what is in the folder")
      ->check(CLI::IsMember({"all", "presets", "limits", "rivals", "slides", "extrapolation", "passivity", "theory", "traces", "figures"}));
  app.add_option("--device", options.devices, "presets by their short names; all where none is given")->check(CLI::IsMember(names))->delimiter(',');
  app.add_option("--rate", options.rates, "of the loop in the study of limits [Hz]")->check(feeler::bench::within(200.0, 1e5))->delimiter(',');
  app.add_option("--scene", options.scene, "cavity, steps, plate or terrain; all where none is given")
      ->check(CLI::IsMember({"cavity", "steps", "plate", "terrain"}));
  app.add_option("--grip", options.grip, "barely, soft, relaxed or firm; all where none is given")->check(CLI::IsMember(grip_names));
  app.add_flag("--no-friction", has_no_friction, "without the Coulomb friction of the device");
  app.add_flag("--no-figures", has_no_figures, "write CSV files and tables only");
  app.add_option("--out", folder, "folder of the CSV files, tables and figures");
  return feeler::bench::run_with_options(app, argc, argv, [&] {
    options.folder = folder;
    options.has_friction = !has_no_friction;
    std::filesystem::create_directories(options.folder);
    const auto wanted = [&](const char* name) { return study == "all" || study == name; };
    int unstable = 0, disagreements = 0;
    if (wanted("presets")) unstable = study_presets(options);
    if (wanted("theory")) disagreements = study_theory(options);
    if (wanted("traces")) study_traces(options);
    if (wanted("slides")) study_slides(options);
    if (wanted("passivity")) study_passivity(options);
    if (wanted("rivals")) study_rivals(options);
    if (wanted("extrapolation")) study_extrapolation(options);
    if (wanted("limits")) study_limits(options);
    if (!has_no_figures && !draw_figures(options.folder, study)) {
      std::fprintf(stderr,
                   "feeler-stability: the CSV files are written, but gnuplot could not draw them: install "
                   "gnuplot-nox.\n");
      return 3;
    }
    if (disagreements > 0) {
      std::fprintf(stderr, "feeler-stability: %d limits differ from linear theory by more than 7 %%.\n", disagreements);
      return 1;
    }
    if (unstable > 0) {
      std::fprintf(stderr, "feeler-stability: %d loops are not stable at the stiffness of their preset; see above.\n", unstable);
      return 1;
    }
    return 0;
  });
}
