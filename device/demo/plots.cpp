// Scripts for gnuplot: force and torque as the paper's Fig. 11 and 13, time per tick as its Fig. 14, and the
// run in space.
#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "program.hpp"
#include "run_figure_data.hpp"
#include "text_file.hpp"

namespace feeler::demo {
namespace {

constexpr const char* colours =
    "red = '#c8322b'; green = '#2e8b57'; blue = '#2f6db5'; ink = '#222222'; soft = '#b9c2cc'; amber = "
    "'#e08e0b'\n";

constexpr const char* style =
    "set datafile separator ','\n"
    "set border 3 lc rgb '#666666'\n"
    "set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
    "set grid lc rgb '#e6e9ec' lt 1 lw 1\n"
    "set key top right horizontal Left reverse samplen 1.6 spacing 1.1 width 1 textcolor rgb '#333333'\n";

/// The force, the torque and the number of contacts over time, one below the other.
constexpr const char* wrench_body =
    "set multiplot layout 3,1 margins 0.085,0.975,0.085,0.97 spacing 0.035\n"
    "set xrange [0:duration]; set format x ''; set offsets 0, 0, graph 0.2, graph 0.03\n"
    "set ylabel 'force  [N]' offset 1,0\n"
    "plot 'ticks.csv' every every_tick using 1:(sqrt($16**2+$17**2+$18**2)) with filledcurves y1=0 fs solid "
    "0.12 noborder lc rgb ink notitle, \\\n"
    "  '' every every_tick using 1:16 with lines lw 1.4 lc rgb red title 'F_x', \\\n"
    "  '' every every_tick using 1:17 with lines lw 1.4 lc rgb green title 'F_y', \\\n"
    "  '' every every_tick using 1:18 with lines lw 1.4 lc rgb blue title 'F_z', \\\n"
    "  '' every every_tick using 1:(sqrt($16**2+$17**2+$18**2)) with lines lw 1.6 lc rgb ink title '|F|'\n"
    "set ylabel 'torque  [mN·m]' offset 1,0\n"
    "plot 'ticks.csv' every every_tick using 1:(1e3*sqrt($19**2+$20**2+$21**2)) with filledcurves y1=0 fs "
    "solid 0.12 noborder lc rgb ink notitle, \\\n"
    "  '' every every_tick using 1:(1e3*$19) with lines lw 1.4 lc rgb red title 'T_x', \\\n"
    "  '' every every_tick using 1:(1e3*$20) with lines lw 1.4 lc rgb green title 'T_y', \\\n"
    "  '' every every_tick using 1:(1e3*$21) with lines lw 1.4 lc rgb blue title 'T_z', \\\n"
    "  '' every every_tick using 1:(1e3*sqrt($19**2+$20**2+$21**2)) with lines lw 1.6 lc rgb ink title "
    "'|T|'\n"
    "set ylabel 'contacts' offset 1,0; set xlabel 'time  [s]'; set format x '%g'; set offsets; set yrange "
    "[0:most_contacts+1]; set ytics contact_tics\n"
    "plot 'ticks.csv' every every_tick using 1:22 with fillsteps fs solid 0.35 noborder lc rgb blue notitle, "
    "\\\n"
    "  '' every every_tick using 1:22 with steps lw 1.2 lc rgb blue notitle\n"
    "unset multiplot\n";

/// A dot a tick on a logarithmic axis, with the median and the tail of the contact ticks.
constexpr const char* time_body =
    "set lmargin at screen 0.085; set rmargin at screen 0.88; set tmargin at screen 0.95; set bmargin at "
    "screen 0.18\n"
    "set logscale y; set yrange [lowest:highest]; set xrange [0:duration]\n"
    "set xlabel 'time  [s]'; set ylabel 'time per tick  [µs]' offset 1,0\n"
    "set grid mytics lc rgb '#e6e9ec' lt 1 lw 1, lc rgb '#f1f3f5' lt 1 lw 0.6\n"
    "set label 1 sprintf('p50  %.1f', p50) at screen 0.89, first p50 tc rgb ink\n"
    "set label 2 sprintf('p99  %.1f', p99) at screen 0.89, first p99 tc rgb amber\n"
    "set label 3 sprintf('period  %.0f', period) at screen 0.89, first period tc rgb red\n"
    "plot 'ticks.csv' every every_tick using 1:($22==0?$26:NaN) with points pt 7 ps 0.22 lc rgb soft "
    "notitle, \\\n"
    "  '' every every_tick using 1:($22>0?$26:NaN) with points pt 7 ps 0.22 lc rgb blue notitle, \\\n"
    "  NaN with points pt 7 ps 0.7 lc rgb soft title 'free', NaN with points pt 7 ps 0.7 lc rgb blue title "
    "'in contact', \\\n"
    "  p50 with lines lw 1.6 lc rgb ink notitle, p99 with lines lw 1.6 lc rgb amber notitle, \\\n"
    "  period with lines lw 1.2 dt 2 lc rgb red notitle\n";

/// The object with the way of the tool's tip and both tools at the peak force, the hand in red and the tool
/// in grey as in the paper's video; the same from near; and the force, with the time of the peak.
///
/// The close-up is drawn first and what spills out of its frame is painted over. A plot of its own draws the
/// lines over the object, so that the way of the hand can be seen inside it.
constexpr const char* run_body =
    "unset border; unset tics; unset grid; unset colorbox; unset key\n"
    "set multiplot\n"
    "set view equal xyz; set xyplane relative 0; set cbrange [0:1]\n"
    "set pm3d depthorder\n"
    "set style fill transparent solid opacity noborder\n"
    "do for [part = (split < 1 ? 1 : 2):2] {\n"
    "  if (part == 1) {\n"
    "    set origin split, base; set size 1 - split, 1 - base; set view tilt, turn, near_zoom\n"
    "    set xrange [near_x0:near_x1] noextend; set yrange [near_y0:near_y1] noextend; set zrange "
    "[near_z0:near_z1] noextend\n"
    "  } else {\n"
    "    paint = 'behind fc rgb \"white\" fs solid noborder'\n"
    "    eval 'set object 1 rectangle from screen -0.01, -0.01 to screen split, 1.01 ' . paint\n"
    "    eval 'set object 2 rectangle from screen -0.01, -0.01 to screen 1.01, base ' . paint\n"
    "    eval 'set object 3 rectangle from screen 0.995, -0.01 to screen 1.01, 1.01 ' . paint\n"
    "    eval 'set object 4 rectangle from screen -0.01, 0.993 to screen 1.01, 1.01 ' . paint\n"
    "    if (split < 1) { set object 5 rectangle from screen split, base to screen 0.995, 0.993 behind fs "
    "empty border lc rgb '#d5dade' }\n"
    "    set origin 0, base; set size split, 1 - base; set view tilt, turn, far_zoom\n"
    "    set xrange [far_x0:far_x1] noextend; set yrange [far_y0:far_y1] noextend; set zrange "
    "[far_z0:far_z1] noextend\n"
    "  }\n"
    "  set palette defined (0 '#7d7364', 1 '#f6f0e4'); eval 'set pm3d border ' . object_border\n"
    "  splot 'run_object.dat' using 1:2:3:4 with pm3d notitle\n"
    "  unset object\n"
    "  set palette defined (0 '#1b242c', 1 '#93a5b4'); set pm3d border retrace\n"
    "  splot 'run_tool.dat' using 1:2:3:4 with pm3d notitle\n"
    "  splot 'run.dat' index 0 using 1:2:3 with lines lw 0.8 lc rgb red notitle, \\\n"
    "    '' index 0 using 4:5:6 with lines lw 1.2 lc rgb '#26323c' notitle, \\\n"
    "    '' index 1 using 1:2:3:4:5:6 with vectors nohead lw tool_width lc rgb red notitle, \\\n"
    "    '' index 2 using 1:2:3:4:5:6 with vectors nohead lw tool_width lc rgb '#26323c' notitle\n"
    "}\n"
    "reset\n";

/// Below the pictures: a legend for them, and the force with the time of the peak.
constexpr const char* run_strip =
    "set origin 0, 0; set size 1, 1\n"
    "set lmargin at screen 0.075; set rmargin at screen 0.985; set bmargin at screen 0.095; set tmargin at "
    "screen strip\n"
    "set xrange [0:duration]; set yrange [0:force_top]; set ytics 0, force_tics\n"
    "set xlabel 'time  [s]' offset 0,0.4; set ylabel 'force  [N]' offset 1,0\n"
    "set arrow 1 from peak_time, graph 0 to peak_time, graph 1 nohead lw 1.2 dt 2 lc rgb red front\n"
    "set label 1 'both tools above' at peak_time, graph 1 offset peak_side, -0.7 @peak_align tc rgb red "
    "front\n"
    "set label 2 '●  haptic tool: where the hand is' at screen 0.075, base - 0.025 tc rgb red\n"
    "set label 3 '●  graphic tool: where it may be' at screen 0.42, base - 0.025 tc rgb '#26323c'\n"
    "plot 'ticks.csv' every every_tick using 1:(sqrt($16**2+$17**2+$18**2)) with filledcurves y1=0 fs solid "
    "0.12 noborder lc rgb ink notitle, \\\n"
    "  '' every every_tick using 1:(sqrt($16**2+$17**2+$18**2)) with lines lw 1.4 lc rgb ink notitle\n"
    "unset multiplot\n";

/// A figure as a script: its size on the screen in pixels, what its body needs, and whether there is a
/// drawing besides the picture.
struct Script {
  std::string name;
  int width, height;
  std::string settings;
  std::string body;
  bool has_drawing = true;
};

/// Draws the body for the screen, and at twice the size for print.
void write_script(const std::filesystem::path& folder, const Script& script) {
  const char* name = script.name.c_str();
  TextFile text(folder / (script.name + ".gp"));
  text.print("# gnuplot %s.gp draws this figure again from the files of this folder.\n", name);
  text.write(colours);
  text.write(script.settings);
  if (script.has_drawing) {
    text.print("set terminal svg size %d,%d enhanced font 'sans-serif,13' name '%s' background rgb 'white'\n", script.width, script.height, name);
    text.print("set output '%s.svg'\n", name);
    text.write(style);
    text.write(script.body);
    text.print("unset output\nreset\n");
  }
  text.print(
      "set terminal pngcairo size %d,%d enhanced font 'DejaVu Sans,13' fontscale 2 linewidth 2 pointscale "
      "2\n",
      2 * script.width, 2 * script.height);
  text.print("set output '%s.png'\n", name);
  text.write(style);
  text.write(script.body);
  text.print("unset output\n");
  text.close();
}

std::string assignment(const char* name, double value) {
  char text[80];
  std::snprintf(text, sizeof text, "%s = %.9g\n", name, value);
  return text;
}

std::string wrench_settings(const std::vector<TickRecord>& ticks) {
  int most_contacts = 0;
  for (const TickRecord& tick : ticks) most_contacts = std::max(most_contacts, tick.contacts);
  return assignment("most_contacts", most_contacts) + assignment("contact_tics", most_contacts / 5 + 1);
}

std::string time_settings(const std::vector<TickRecord>& ticks, const Summary& summary) {
  double lowest = 1e9, highest = 1e6 / summary.wanted_rate;
  for (const TickRecord& tick : ticks) {
    lowest = std::min(lowest, tick.microseconds);
    highest = std::max(highest, tick.microseconds);
  }
  lowest = std::max(lowest, 1e-2);
  const double p50 = std::max(summary.tick_time.median, lowest);
  return assignment("lowest", lowest / 1.5) + assignment("highest", highest * 2.0) + assignment("p50", p50) +
         assignment("p99", std::max(summary.tick_time.p99, p50 * 1.0001)) + assignment("period", 1e6 / summary.wanted_rate);
}

constexpr int run_width = 1000, run_height = 760;
// Of the figure: right end of the overview, lower end of both pictures, upper end of the force.
constexpr double panels_split = 0.6, panels_base = 0.285, strip_top = 0.225;

/// Ranges and zoom that show a view in a panel of the picture.
///
/// The ranges are a cube that holds all that is drawn, because gnuplot drops what is outside of them; it
/// draws the side of the cube 4/7 of the panel long, less its own margins, times the zoom.
std::string view_settings(const std::string& name, const View& view, const Eigen::AlignedBox3d& box, double panel_width, double panel_height) {
  const double side = 2.0 * std::max((box.max() - view.centre).cwiseAbs().maxCoeff(), (view.centre - box.min()).cwiseAbs().maxCoeff());
  const double inner = std::min(panel_width - 52.0, panel_height - 72.0);
  const double pixels_a_millimetre = 0.94 * std::min(panel_width / std::max(view.width, 1e-9), panel_height / std::max(view.height, 1e-9));
  std::string settings;
  for (int k = 0; k < 3; ++k) {
    const std::string range = name + "_" + char('x' + k);
    settings += assignment((range + "0").c_str(), view.centre[k] - side / 2.0) + assignment((range + "1").c_str(), view.centre[k] + side / 2.0);
  }
  return settings + assignment((name + "_zoom").c_str(), pixels_a_millimetre * side / (4.0 / 7.0 * inner));
}

/// 1, 2 or 5 times a power of ten, about half of a value.
double tic_step(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value / 2.0)));
  const double digit = value / 2.0 / power;
  return power * (digit < 2.0 ? 1.0 : digit < 5.0 ? 2.0 : 5.0);
}

std::string run_settings(const RunFigureData& data, double duration) {
  const std::optional<View> close_up = data.close_up();
  const double split = close_up ? panels_split : 1.0;
  const double height = run_height * (1.0 - panels_base);
  const bool is_simple = data.drawn_triangles() < 1000;
  const bool is_late = data.peak().time > duration / 2.0;
  const double peak_force = std::max(data.peak().wrench.force.norm(), 1e-3);
  std::string settings = view_settings("far", data.overview(), data.box(), run_width * split, height);
  if (close_up) settings += view_settings("near", *close_up, data.box(), run_width * (1.0 - split), height);
  return settings + assignment("split", split) + assignment("base", panels_base) + assignment("strip", strip_top) +
         assignment("tilt", RunFigureData::tilt) + assignment("turn", RunFigureData::turn) + assignment("opacity", is_simple ? 0.45 : 1.0) +
         assignment("tool_width", is_simple ? 2.0 : 1.0) + assignment("force_top", 1.25 * peak_force) +
         assignment("force_tics", tic_step(1.25 * peak_force)) + assignment("peak_time", data.peak().time) +
         assignment("peak_side", is_late ? -0.5 : 0.5) + "peak_align = '" + (is_late ? "right" : "left") + "'\nobject_border = \"" +
         (is_simple ? "lc rgb '#8d877c' lw 0.7" : "retrace") + "\"\n";
}

}  // namespace

std::vector<Figure> draw_figures(const std::filesystem::path& folder, const scenes::Scene& scene, const std::vector<TickRecord>& ticks,
                                 const Summary& summary) {
  const double duration = double(ticks.size()) / summary.wanted_rate;
  // More points than pixels make files large and nothing clearer.
  const std::string common = assignment("duration", duration) + assignment("every_tick", double(ticks.size() / 4000 + 1));
  const RunFigureData data(folder, scene, ticks);

  write_script(folder, {"wrench", 1000, 760, common + wrench_settings(ticks), wrench_body});
  write_script(folder, {"tick_time", 1000, 420, common + time_settings(ticks, summary), time_body});
  // As a picture only: gnuplot's drawings garble what lies outside of them and forget the second palette.
  write_script(folder, {"run", run_width, run_height, common + run_settings(data, duration), std::string(run_body) + style + run_strip, false});

  std::vector<Figure> figures{{"run",
                               "The way of the tool's tip, and both tools at the peak force: where the hand is in red, where the "
                               "tool "
                               "may be in grey. Below, the norm of the force."},
                              {"wrench", "Force and torque on the hand, and the number of contacts that hold the tool."},
                              {"tick_time", "Time of each tick of the renderer, with median and 99th percentile of the ticks in contact."}};
  const bool drawn =
      std::all_of(figures.begin(), figures.end(), [&](const Figure& figure) { return run_program(folder, {"gnuplot", figure.name + ".gp"}) == 0; });
  if (drawn) return figures;
  for (const Figure& figure : figures) {
    for (const char* extension : {".svg", ".png"}) std::filesystem::remove(folder / (figure.name + extension));
  }
  return {};
}

}  // namespace feeler::demo
