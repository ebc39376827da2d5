// Scripts for gnuplot: force and torque as the paper's Fig. 11 and 13, time per tick as its Fig. 14, and the
// run in space.
#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

/// The object and the way of the tool's tip: the hand in red, the tool in grey, as in the paper's video; both
/// tools at the peak force.
constexpr const char* run_body =
    "unset border; unset tics; unset grid; unset colorbox\n"
    "set multiplot\n"
    "set lmargin at screen 0.0; set rmargin at screen 1.0; set tmargin at screen 1.0; set bmargin at screen "
    "0.0\n"
    "set view equal xyz; set view tilt, turn, zoom; set xyplane relative 0\n"
    "set xrange [x0:x1] noextend; set yrange [y0:y1] noextend; set zrange [z0:z1] noextend\n"
    "set palette defined (0 '#7d7364', 1 '#f6f0e4'); set cbrange [0:1]\n"
    "set pm3d depthorder border lc rgb edge_colour lw edge_width\n"
    "set style fill transparent solid opacity noborder\n"
    "splot 'run_object.dat' using 1:2:3:4 with pm3d notitle\n"
    // Over the object, so that the way of the hand can be seen inside it.
    "set key at screen 0.97, 0.95 vertical Left reverse samplen 2\n"
    "splot 'run.dat' index 0 using 1:2:3 with lines lw 0.9 lc rgb red title 'haptic tool: where the hand "
    "is', \\\n"
    "  '' index 0 using 4:5:6 with lines lw 1.5 lc rgb '#26323c' title 'graphic tool: where it may be', \\\n"
    "  '' index 1 using 1:2:3:4:5:6 with vectors nohead lw 1.2 lc rgb red notitle, \\\n"
    "  '' index 2 using 1:2:3:4:5:6 with vectors nohead lw 1.2 lc rgb '#26323c' notitle\n"
    "unset multiplot\n";

/// A figure as a script: its size on the screen in pixels, what its body needs, and whether it is light
/// enough for a drawing.
struct Script {
  std::string name;
  int width, height;
  std::string settings;
  const char* body;
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
    text.print("set terminal svg size %d,%d enhanced font 'sans-serif,13' name '%s' background rgb 'white'\n",
               script.width, script.height, name);
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
         assignment("p99", std::max(summary.tick_time.p99, p50 * 1.0001)) +
         assignment("period", 1e6 / summary.wanted_rate);
}

std::string run_settings(const RunFigureData& data) {
  // A cube about all that is drawn: from any side it then fills the picture alike.
  const Vector3<double> centre = data.box().center();
  const double half = data.box().sizes().norm() / 2.0;
  std::string settings;
  for (int k = 0; k < 3; ++k) {
    const std::string axis(1, char('x' + k));
    settings += assignment((axis + "0").c_str(), centre[k] - half) +
                assignment((axis + "1").c_str(), centre[k] + half);
  }
  const bool is_simple = data.drawn_triangles() < 1000;
  return settings + assignment("tilt", RunFigureData::tilt) + assignment("turn", RunFigureData::turn) +
         assignment("zoom", 2.0) + assignment("opacity", is_simple ? 0.45 : 1.0) +
         assignment("edge_width", is_simple ? 0.7 : 0.05) + "edge_colour = '" +
         (is_simple ? "#8d877c" : "#b9ae9b") + "'\n";
}

}  // namespace

std::vector<Figure> draw_figures(const std::filesystem::path& folder, const scenes::Scene& scene,
                                 const std::vector<TickRecord>& ticks, const Summary& summary) {
  const double duration = ticks.empty() ? 1.0 : std::max(ticks.back().time, 1e-3);
  // More points than pixels make files large and nothing clearer.
  const std::string common =
      assignment("duration", duration) + assignment("every_tick", double(ticks.size() / 4000 + 1));
  const RunFigureData data(folder, scene, ticks);

  constexpr std::size_t most_drawn_triangles = 6000;  // more make a drawing that browsers choke on
  write_script(folder, {"wrench", 1000, 760, common + wrench_settings(ticks), wrench_body});
  write_script(folder, {"tick_time", 1000, 420, common + time_settings(ticks, summary), time_body});
  write_script(folder, {"run", 1000, 700, run_settings(data), run_body,
                        data.drawn_triangles() <= most_drawn_triangles});

  std::vector<Figure> figures{
      {"run",
       "Way of the tool's tip [mm]: where the hand is in red, where the tool may be in grey; both tools at "
       "the peak force."},
      {"wrench", "Force and torque on the hand, and the number of contacts that hold the tool."},
      {"tick_time",
       "Time of each tick of the renderer, with median and 99th percentile of the ticks in contact."}};
  const bool drawn = std::all_of(figures.begin(), figures.end(), [&](const Figure& figure) {
    return run_program(folder, {"gnuplot", figure.name + ".gp"}) == 0;
  });
  if (drawn) return figures;
  for (const Figure& figure : figures) {
    for (const char* extension : {".svg", ".png"})
      std::filesystem::remove(folder / (figure.name + extension));
  }
  return {};
}

}  // namespace feeler::demo
