// Tables and figures of the comparison.
#include "rivals/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiments/plots.hpp"
#include "text_file.hpp"

namespace feeler::rivals {
namespace {

constexpr const char* reference_rival = "ODE ×4";

/// Two significant digits, without an exponent where it can be read without.
std::string rounded(double value) {
  if (std::isnan(value)) return "–";
  std::array<char, 32> text;
  const char* format = value >= 10.0 ? "%.0f" : value >= 0.1 ? "%.1f" : "%.1g";
  std::snprintf(text.data(), text.size(), value == 0.0 ? "%.0f" : format, value);
  return text.data();
}

std::string times(const Score& score) {
  if (score.ticks == 0) return "–";
  return rounded(score.p50) + " / " + rounded(score.p99) + " / " + rounded(score.p999);
}

std::string behaviour(const Score& score) {
  if (score.ticks == 0) return "–; –; –; " + rounded(1e6 * score.lag);  // dropped out before it touched anything
  return rounded(1e6 * score.deepest) + "; " + std::to_string(score.crossed) + "/" + std::to_string(score.samples) + "; " +
         rounded(1e6 * score.jitter) + "; " + rounded(1e6 * score.lag);
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const auto& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string header(const std::vector<std::string>& cells) {
  std::string text = row(cells) + "|";
  for (std::size_t i = 0; i < cells.size(); ++i) text += "---|";
  return text + "\n";
}

std::vector<std::string> names(const std::vector<Score>& scores) {
  std::vector<std::string> list;
  list.reserve(scores.size());
  for (const auto& score : scores) list.push_back(score.name);
  return list;
}

const Score* find(const std::vector<Score>& scores, const std::string& name) {
  const auto found = std::find_if(scores.begin(), scores.end(), [&](const Score& s) { return s.name == name; });
  return found == scores.end() ? nullptr : &*found;
}

/// Draws the rows of a contender in a colour of the plots' style.
struct Series {
  const char* name;
  const char* colour;
};
constexpr std::array shown{Series{"Feeler", "ink"},          Series{"ODE ×1", "'#9bd0ae'"},    Series{"ODE ×4", "green"},
                           Series{"ODE ×10", "'#14532d'"},   Series{"Bullet ×1", "'#f0c27a'"}, Series{"Bullet ×4", "amber"},
                           Series{"Bullet as CHAI3D", "red"}};

}  // namespace

std::string scenes_in_markdown(const std::vector<SceneScores>& all) {
  if (all.empty()) return {};
  std::vector<std::string> columns = names(all.front().scores);
  columns.insert(columns.begin(), {"scene", "ticks"});
  std::string text = "Time of a tick in contact, median / p99 / p99.9 [µs]:\n\n" + header(columns);
  for (const auto& scene : all) {
    std::vector<std::string> cells{scene.scene, std::to_string(scene.scores.front().ticks)};
    for (const auto& score : scene.scores) {
      const bool is_partial = score.ticks < scene.scores.front().ticks;
      cells.push_back(times(score) + (is_partial ? " (" + std::to_string(score.ticks) + ")" : ""));
    }
    text += row(cells);
  }

  columns.erase(columns.begin() + 1);
  std::erase(columns, "FCL distance");
  text +=
      "\nDeepest penetration [µm]; samples in which the tool has crossed; jitter with the device held [µm]; "
      "lag in free space [µm]:\n\n" +
      header(columns);
  for (const auto& scene : all) {
    std::vector<std::string> cells{scene.scene};
    for (const auto& score : scene.scores) {
      if (!score.is_query) cells.push_back(behaviour(score));
    }
    text += row(cells);
  }

  if (find(all.front().scores, reference_rival) != nullptr) {
    text += std::string("\nTime of Feeler as a multiple of ") + reference_rival + ":\n\n" + header({"scene", "median", "p99", "p99.9"});
    for (const auto& scene : all) {
      const Score& ours = scene.scores.front();
      const Score* theirs = find(scene.scores, reference_rival);
      if (theirs == nullptr || theirs->ticks == 0) continue;
      const auto ratio = [](double a, double b) {
        std::array<char, 32> cell;
        std::snprintf(cell.data(), cell.size(), "%.2f%s", a / b, a > b ? " (slower)" : "");
        return std::string(cell.data());
      };
      text += row({scene.scene, ratio(ours.p50, theirs->p50), ratio(ours.p99, theirs->p99), ratio(ours.p999, theirs->p999)});
    }
  }

  for (const auto& scene : all) {
    for (const auto& score : scene.scores) {
      if (!score.is_repeatable) text += "\n" + score.name + " did not repeat its poses in " + scene.scene + ".\n";
      if (score.touching > 0) {
        text += "\n" + score.name + " says that tool and object touch in " + std::to_string(score.touching) + " of " + std::to_string(score.ticks) +
                " contact ticks of Feeler in " + scene.scene + ".\n";
      }
    }
  }
  return text;
}

std::string plates_in_markdown(const std::vector<PlateScore>& all) {
  std::vector<std::string> columns{"thin plates"}, cells{"crossed"};
  for (const auto& score : all) {
    columns.push_back(score.name);
    cells.push_back(std::to_string(score.crossed) + "/" + std::to_string(score.trials));
  }
  return header(columns) + row(cells);
}

std::string scaling_in_markdown(const std::string& size, const std::vector<ScalingPoint>& curve) {
  if (curve.empty()) return {};
  std::vector<std::string> columns = names(curve.front().scores);
  columns.insert(columns.begin(), size);
  std::string text = "Time of a tick in contact, median / p99 / p99.9 [µs]:\n\n" + header(columns);
  for (const auto& point : curve) {
    std::vector<std::string> cells{std::to_string(point.size)};
    for (const auto& score : point.scores) cells.push_back(times(score));
    text += row(cells);
  }
  return text;
}

void write_scenes(const std::filesystem::path& folder, const std::vector<SceneScores>& all) {
  demo::TextFile csv(folder / "scenes.csv");
  csv.print(
      "index,scene,contender,contact_ticks,p50_us,p99_us,p999_us,samples,deepest_um,crossed,jitter_um,lag_um,"
      "repeatable,touching\n");
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Score& s : all[i].scores) {
      csv.print("%d,%s,%s,%d,%.6g,%.6g,%.6g,", int(i), all[i].scene.c_str(), s.name.c_str(), s.ticks, s.p50, s.p99, s.p999);
      if (s.is_query) {
        csv.print(",,,,,%d,%d\n", int(s.is_repeatable), s.touching);
      } else {
        csv.print("%d,%.6g,%d,%.6g,%.6g,%d,\n", s.samples, 1e6 * s.deepest, s.crossed, 1e6 * s.jitter, 1e6 * s.lag, int(s.is_repeatable));
      }
    }
  }
  csv.close();
}

void write_plates(const std::filesystem::path& folder, const std::vector<PlateScore>& all) {
  demo::TextFile csv(folder / "plates.csv");
  csv.print("contender,trials,crossed\n");
  for (const auto& s : all) csv.print("%s,%d,%d\n", s.name.c_str(), s.trials, s.crossed);
  csv.close();
}

void write_scaling(const std::filesystem::path& folder, const std::string& name, const std::vector<ScalingPoint>& curve) {
  demo::TextFile csv(folder / (name + ".csv"));
  csv.print("size,contender,contact_ticks,p50_us,p99_us,p999_us\n");
  for (const auto& point : curve) {
    for (const Score& s : point.scores) csv.print("%d,%s,%d,%.6g,%.6g,%.6g\n", point.size, s.name.c_str(), s.ticks, s.p50, s.p99, s.p999);
  }
  csv.close();
}

bool draw_scenes(const std::filesystem::path& folder, const std::vector<SceneScores>& all) {
  if (all.empty()) return true;
  std::vector<Series> series;
  for (const Series& s : shown) {
    if (find(all.front().scores, s.name) != nullptr) series.push_back(s);
  }
  const auto plot = [&](const std::string& columns, const std::string& with) {
    std::string text = "plot ";
    for (std::size_t k = 0; k < series.size(); ++k) {
      const double offset = 0.11 * (double(k) - double(series.size() - 1) / 2.0);
      const std::string x = "(strcol(3) eq '" + std::string(series[k].name) + "' ? $1+" + std::to_string(offset) + " : NaN)";
      text += std::string(k > 0 ? ", " : "") + "'scenes.csv' skip 1 using " + x + ":" + columns + " with " + with + " lc rgb " + series[k].colour +
              " title '" + series[k].name + "'";
    }
    return text + "\n";
  };
  const std::string axes =
      "set key outside top horizontal Left reverse samplen 1\nset logscale y; unset grid; set grid y lc rgb "
      "'#e6e9ec' lt 1 lw 1\nset xtics rotate by -35\nset xrange [-0.6:" +
      std::to_string(double(all.size()) - 0.4) + "]\n";
  std::string labels = "set xtics (";
  for (std::size_t i = 0; i < all.size(); ++i) {
    labels.append(i > 0 ? ", '" : "'").append(all[i].scene).append("' ").append(std::to_string(i));
  }
  labels += ")\n";
  const bool has_times =
      experiments::draw(folder, "rivals_time", 1100, 480,
                        axes + labels + "set ylabel 'time of a tick, median to p99  [µs]'\n" + plot("5:5:6", "yerrorbars pt 7 ps 0.55 lw 1.6"));
  const bool has_depths =
      experiments::draw(folder, "rivals_penetration", 1100, 480,
                        axes + labels + "set ylabel 'deepest penetration  [µm]'; set yrange [0.01:]; set ytics add ('≤ 0.01' 0.01)\n" +
                            plot("($9 > 0.01 ? $9 : 0.01)", "points pt 7 ps 0.8"));
  return has_times && has_depths;
}

bool draw_scaling(const std::filesystem::path& folder, const std::string& name, const std::string& size, const std::vector<ScalingPoint>& curve) {
  std::string text =
      "set key outside top horizontal Left reverse samplen 1.6\nset logscale xy; unset mxtics\n"
      "set autoscale xfix; set offsets graph 0.02, graph 0.02, 0, 0\nset xlabel '" +
      size + "'; set ylabel 'time of a tick  [µs]'\nplot ";
  bool is_first = true;
  for (const Series& s : shown) {
    if (curve.empty() || find(curve.front().scores, s.name) == nullptr) continue;
    for (const auto& [column, title, dash] : {std::tuple("4", "median", "1"), std::tuple("5", "p99", "2")}) {
      text += std::string(is_first ? "" : ", ") + "'< grep \"" + s.name + "\" " + name + ".csv' using 1:" + column +
              ":xtic(1) with linespoints pt 7 ps 0.6 lw 1.8 dt " + dash + " lc rgb " + s.colour + " title '" + s.name + ", " + title + "'";
      is_first = false;
    }
  }
  return experiments::draw(folder, name, 760, 440, text + "\n");
}

}  // namespace feeler::rivals
