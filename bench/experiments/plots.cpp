// Scripts for gnuplot, in the style of the demo's figures.
#include "experiments/plots.hpp"

#include <fstream>
#include <sstream>
#include <utility>

#include "program.hpp"
#include "text_file.hpp"

namespace feeler::experiments {
namespace {

constexpr const char* style =
    "red = '#c8322b'; green = '#2e8b57'; blue = '#2f6db5'; ink = '#222222'; amber = '#e08e0b'\n"
    "set datafile separator ','\n"
    "set border 3 lc rgb '#666666'\n"
    "set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
    "set grid lc rgb '#e6e9ec' lt 1 lw 1\n"
    "set key top right horizontal Left reverse samplen 1.6 textcolor rgb '#333333'\n";

/// Three lines of one quantity.
std::string three(const std::string& csv, const std::string& symbol, int first_column, const std::string& scale) {
  const char* const axes[] = {"x", "y", "z"};
  const char* const colours[] = {"red", "green", "blue"};
  std::string text = "plot ";
  for (int k = 0; k < 3; ++k) {
    text += std::string(k > 0 ? ", " : "") + "'" + csv + "' using 1:(" + scale + "*$" + std::to_string(first_column + k) +
            ") with lines lw 1.5 lc rgb " + colours[k] + " title '" + symbol + "_" + axes[k] + "'";
  }
  return text + "\n";
}

/// What is drawn has this at the end of its name until it is whole.
constexpr const char* fresh = ".new";

/// Empty lines aside; gnuplot ends with 0 on a full disk too.
bool ends_in(const std::filesystem::path& file, const std::string& end) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  return all.substr(0, all.find_last_not_of('\n') + 1).ends_with(end);
}

}  // namespace

bool draw(const std::filesystem::path& folder, const std::string& name, int width, int height, const std::string& body) {
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  const std::string script_name = name + ".gp" + fresh;
  demo::TextFile script(folder / script_name);
  script.write("# gnuplot " + name + ".gp draws this figure again from the files of this folder.\nif (!exists('fresh')) fresh = ''\n");
  script.write("set terminal svg size " + size + " enhanced font 'sans-serif,13' background rgb 'white'\nset output '" + name + ".svg'.fresh\n" +
               style + body + "unset output\nreset\n");
  script.write("set terminal pngcairo size " + size + " enhanced font 'DejaVu Sans,11'\nset output '" + name + ".png'.fresh\n" + style + body +
               "unset output\n");
  script.close();
  if (demo::run_program(folder, {"gnuplot", "-e", std::string("fresh = '") + fresh + "'", script_name}) != 0) return false;
  for (const auto& [ending, end_of_file] : {std::pair(".svg", "</svg>"), std::pair(".png", "IEND\xae\x42\x60\x82")})
    if (!ends_in(folder / (name + ending + fresh), end_of_file)) return false;
  for (const char* ending : {".gp", ".svg", ".png"}) {
    std::error_code problem;
    std::filesystem::rename(folder / (name + ending + fresh), folder / (name + ending), problem);
    if (problem) return false;
  }
  return true;
}

std::string wrench_body(const std::string& csv, const std::string& state_tics) {
  return "set multiplot layout 3,1 margins 0.2,0.975,0.09,0.97 spacing 0.035\n"
         "set format x ''; set offsets 0, 0, graph 0.2, graph 0.05\n"
         "set ylabel 'force  [N]' offset 1,0\n" +
         three(csv, "F", 16, "1") + "set ylabel 'torque  [mN·m]' offset 1,0\n" + three(csv, "T", 19, "1000") +
         "unset ylabel; set xlabel 'time  [s]'; set format x '%g'; set offsets; unset key\nset yrange [-0.5:7.5]; set ytics (" + state_tics +
         ")\nplot '" + csv + "' using 1:28 with points pt 7 ps 0.35 lc rgb blue\nunset multiplot\n";
}

std::string time_body(const std::string& standard_csv, const std::string& paper_csv) {
  std::string text =
      "set multiplot layout 2,1 margins 0.1,0.975,0.1,0.93 spacing 0.11\nset logscale y; set yrange [0.1:10000]\n"
      "set ylabel 'time per tick  [µs]'; set key at graph 1, graph 1.13\n";
  for (const auto& [csv, title] : {std::pair(standard_csv, "default"), std::pair(paper_csv, "paper as written")}) {
    text += std::string("set label 1 '") + title + "' at graph 0.0, graph 1.06\n" + (csv == paper_csv ? "set xlabel 'time  [s]'\n" : "") + "plot '" +
            csv +
            "' using 1:22 with points pt 7 ps 0.3 lc rgb blue title 'total', '' using 1:($23>0?$23:NaN) with points pt 7 ps 0.3 lc rgb "
            "amber title 'optimisation', 1000 with lines dt 2 lc rgb red title '1 ms'\n";
  }
  return text + "unset multiplot\n";
}

}  // namespace feeler::experiments
