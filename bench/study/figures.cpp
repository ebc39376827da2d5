#include "study/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "experiments/plots.hpp"
#include "study/rows.hpp"

namespace feeler::study {
namespace {

namespace fs = std::filesystem;

struct Figure {
  std::string name;
  int width = 0, height = 0;
  std::string body;  ///< empty where the rows do not suffice
};

/// At the head of a figure: of how many samples an error is, and how many cells are left out.
std::string note_of(const std::vector<Row>& rows) {
  double samples = 0;
  int refused = 0, without_truth = 0;
  for (const Row& row : rows) {
    samples = std::max(samples, number(row, "samples"));
    refused += is_refused(row);
    without_truth += !is_refused(row) && !is_measured(row);
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "set label 99 'errors of %.0f samples a cell at most; cells not drawn: refused %d, no truth %d' at screen 0.01, 0.98 font ',9'\n",
                samples, refused, without_truth);
  return text;
}

std::string scene_family(const std::string& scene) { return scene.substr(0, scene.find('_')); }
std::string legible(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// A block of data for gnuplot, as x and y in rows.
std::string block(const std::string& name, std::vector<std::pair<double, double>> points) {
  std::sort(points.begin(), points.end());
  std::string data = "$" + name + " << EOD\n";
  for (const auto& [x, y] : points) {
    char line[80];
    std::snprintf(line, sizeof line, "%.9g,%.9g\n", x, y);
    data += line;
  }
  return data + "EOD\n";
}

constexpr std::array<const char*, 8> colours{"#2f6db5", "#c8322b", "#2e8b57", "#e08e0b", "#7b4fa3", "#444444", "#0fa3a3", "#b0699a"};

/// Error against one choice, a line for each scene, coloured by its family.
std::string panel(const std::vector<Row>& rows, const Choice& choice, int panel_number) {
  std::vector<std::string> families;
  std::string data, plot;
  std::set<std::string> scenes;
  for (const Row& row : rows) scenes.insert(text(row, "scene"));
  int count = 0;
  std::set<std::string> named;
  for (const auto& scene : scenes) {
    std::vector<std::pair<double, double>> points;
    for (const Row& row : rows)
      if (is_measured(row) && text(row, "scene") == scene && text(row, "rendering") == "double" && is_standard_but_for(row, choice.column))
        points.emplace_back(number(row, choice.column), std::max(number(row, "error_p99_m"), 1e-9));
    if (points.size() < 2) continue;
    const std::string family = scene_family(scene), name = "p" + std::to_string(panel_number) + "_" + std::to_string(count++);
    auto at = std::find(families.begin(), families.end(), family);
    if (at == families.end()) families.push_back(family), at = families.end() - 1;
    const bool is_first = named.insert(family).second;
    data += block(name, points);
    plot += (plot.empty() ? "plot " : ", ") + ("$" + name) + " using 1:2 with linespoints pt 7 ps 0.4 lw 1.6 lc rgb '" +
            colours[std::size_t(at - families.begin()) % colours.size()] + "' " +
            (is_first && panel_number == 0 ? "title '" + family + "'" : "notitle");
  }
  if (plot.empty()) return "";
  char standard[120];
  std::snprintf(standard, sizeof standard, "set arrow 1 from %g, graph 0 to %g, graph 1 nohead dt 3 lc rgb '#888888'\n", choice.standard,
                choice.standard);
  return data + "set xlabel '" + choice.label + "'\n" + standard + plot + "\n";
}

Figure sweeps_of(const std::vector<Row>& rows) {
  std::string body =
      "set logscale xy; set yrange [1e-9:1e-2]; set format y '10^{%L}'; set ylabel 'error, p99  [m]'\nset multiplot layout 2,2 margins 0.09,0.97,0.09,0.88 spacing 0.1,0.13\n"
      "set key at screen 0.97, 0.99 horizontal maxrows 3\n";
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string one = panel(rows, choices[i], count);
    if (one.empty()) continue;
    body += std::string(std::string(choices[i].column) == "margin_m" ? "set format x '10^{%L}'\n" : "set format x '%g'\n") + one;
    ++count;
  }
  return {"study_choices", 1000, 720, count > 0 ? body : ""};
}

Figure fronts_of(const std::vector<Row>& rows, const std::vector<Row>& times) {
  std::map<std::string, std::vector<std::pair<double, double>>> by_scene, standard;
  for (const Row& row : rows) {
    if (!is_measured(row) || text(row, "rendering") != "double" || text(row, "motion") != Cell().motion || number(row, "scale") != 1 ||
        number(row, "offset_m") != 0 || number(row, "rate_hz") != Cell().rate)
      continue;
    const double time = number(times_of(row, times), "time_p99_us");
    if (std::isnan(time)) continue;  // no tick was in contact
    const std::pair point(std::max(time, 0.1), std::max(number(row, "error_p99_m"), 1e-9));
    by_scene[text(row, "scene")].push_back(point);
    if (is_standard_but_for(row, "")) standard[text(row, "scene")] = {point};
  }
  std::erase_if(by_scene, [](const auto& scene) { return scene.second.size() < 6; });
  if (by_scene.empty()) return {};
  const int columns = 4, lines = (int(by_scene.size()) + columns - 1) / columns, height = 200 * lines + 80;
  std::string body = "set logscale xy; set format y '10^{%L}'; set xrange [1:1000]; set yrange [1e-8:1e-2]; unset key\nset multiplot layout " +
                     std::to_string(lines) + "," + std::to_string(columns) + " margins 0.06,0.98," + std::to_string(60.0 / height) + "," +
                     std::to_string(1 - 45.0 / height) + " spacing 0.045,0.08\n";
  int count = 0;
  for (auto& [scene, points] : by_scene) {
    std::sort(points.begin(), points.end());
    std::vector<std::pair<double, double>> front;
    for (const auto& point : points)
      if (front.empty() || point.second < front.back().second) front.push_back(point);
    const std::string name = "f" + std::to_string(count);
    body += block(name, points) + block(name + "_front", front) + block(name + "_standard", standard[scene]) + "set title '" + legible(scene) +
            "' offset 0,-0.7\n" + (count % columns == 0 ? "set ylabel 'error, p99  [m]'\n" : "unset ylabel\n") +
            (count >= int(by_scene.size()) - columns ? "set xlabel 'time, p99  [µs]'\n" : "unset xlabel\n") + "plot $" + name +
            " using 1:2 with points pt 7 ps 0.35 lc rgb '#9db8d6', $" + name + "_front using 1:2 with steps lw 1.6 lc rgb blue, $" + name +
            "_standard using 1:2 with points pt 7 ps 0.9 lc rgb red\n";
    ++count;
  }
  return {"study_fronts", 1200, height, body};
}

Figure scalars_of(const std::vector<Row>& rows) {
  std::string body =
      "set logscale xy; set format '10^{%L}'; set yrange [1e-16:1e0]\nset multiplot layout 1,2 margins 0.09,0.97,0.15,0.84 spacing 0.1\nset key at screen 0.97, 0.99 horizontal maxrows 2\n";
  int count = 0;
  for (const std::size_t i : {std::size_t(5), std::size_t(4)}) {
    std::string data, plot;
    int lines = 0;
    for (const auto& [rendering, colour] :
         {std::pair("float", "#c8322b"), std::pair("double", "#2f6db5"), std::pair("long_double", "#2e8b57"), std::pair("quad", "#e08e0b")}) {
      std::map<double, double> worst;
      for (const Row& row : rows)
        if (is_measured(row) && text(row, "rendering") == rendering && is_standard_but_for(row, choices[i].column)) {
          if (!std::set<std::string>{"bore_24", "plate_2", "wedge_4"}.contains(text(row, "scene"))) continue;
          double& most =
              worst[std::string(choices[i].column) == "offset_m" ? std::max(number(row, choices[i].column), 0.1) : number(row, choices[i].column)];
          most = std::max({most, number(row, "solver_error_p99_m"), 1e-16});
        }
      if (worst.size() < 2) continue;
      const std::string name = "s" + std::to_string(i) + "_" + std::to_string(lines++);
      data += block(name, {worst.begin(), worst.end()});
      plot += (plot.empty() ? "plot $" : ", $") + name + " using 1:2 with linespoints pt 7 ps 0.6 lw 1.8 lc rgb '" + colour + "' " +
              (count == 0 ? "title '" + legible(rendering) + "'" : "notitle");
    }
    if (plot.empty()) continue;
    body += data + "set xlabel '" + choices[i].label + "'\nset ylabel '" + (count == 0 ? "off the minimum, p99, worst scene  [m]" : "") + "'\n" +
            plot + "\n";
    ++count;
  }
  return {"study_scalars", 1000, 420, count > 0 ? body : ""};
}

}  // namespace

std::vector<std::string> draw_figures(const fs::path& folder) {
  const auto [rows, times] = read_rows(folder);
  std::vector<std::string> drawn;
  for (const Figure& figure : {sweeps_of(rows), fronts_of(rows, times), scalars_of(rows)}) {
    if (figure.body.empty()) continue;
    std::string body = note_of(rows) + figure.body + "unset multiplot\n";
    body.insert(body.find('\n', body.find("plot $")) + 1, "unset label 99\n");  // with the first panel only
    if (!experiments::draw(folder, figure.name, figure.width, figure.height, body))
      throw std::runtime_error("The figure " + (folder / figure.name).string() +
                               " cannot be drawn; install gnuplot-nox, or make room, and draw it with --figures; --no-figures draws none.");
    drawn.push_back(figure.name);
  }
  return drawn;
}

}  // namespace feeler::study
