// Runs section V of the paper again: writes CSV files and figures, and prints what was found.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line.hpp"
#include "experiments/measures.hpp"
#include "experiments/motions.hpp"
#include "experiments/plots.hpp"
#include "experiments/run.hpp"
#include "experiments/table.hpp"
#include "scenes/spline.hpp"
#include "scenes/sulcus.hpp"
#include "text_file.hpp"

namespace {

using namespace feeler::experiments;
namespace fs = std::filesystem;

/// What the program found wrong: figures that could not be drawn, states out of order, penetration of the default method.
struct Findings {
  bool has_all_figures = true;
  bool is_as_expected = true;
};

class Experiments {
 public:
  Experiments(fs::path folder, bool draws) : folder_(std::move(folder)), draws_(draws) {}
  const Findings& findings() const { return findings_; }

  /// Fig. 11, and the truncation error.
  void cavity() {
    std::printf("\nA  Cube in a cavity (Fig. 10, 11), K = 1 N/mm and 30 mN m/rad\n");
    for (const auto& [clearance, name] : {std::pair(1e-3, "1mm"), std::pair(1e-5, "10um"), std::pair(0.0, "0")}) {
      const auto scene = cavity_states(clearance);
      for (const Method method : {Method::standard, Method::paper}) {
        const std::string file = std::string("cavity_") + name + (method == Method::paper ? "_paper" : "");
        const auto ticks = simulate(scene, paper_settings(method), method, file, cavity_state);
        // Without clearance the cube touches all the time.
        if (clearance == 1e-3) {
          expect_order(ticks, cavity_state, {State::none, State::clockwise, State::anticlockwise, State::translate, State::none}, method);
        }
        figure(file, 900, 620, wrench_body(file + ".csv", "'no contact' 0, 'clockwise' 1, 'anti-clockwise' 2, 'translate' 3, 'other' 7"));
      }
    }
    feeler::demo::TextFile csv(folder_ / "truncation.csv");
    csv.print("turn_rad_per_s,truncation_um,bound_um\n");
    std::printf("   truncation error of one linear step, sliding and turning with a clearance of 1 mm:\n");
    for (const double speed : {0.5, 1.0, 2.0, 4.0, 8.0}) {
      auto scene = feeler::scenes::cavity(1e-3);  // turns while it slides
      scene.motion = [motion = scene.motion, speed](double t) { return motion(t * speed); };
      scene.duration = 4.0 / speed;
      double turn = 0.0, error = 0.0, bound = 0.0;
      auto last = scene.start;
      for (const Record& record : run(scene, paper_settings(Method::standard), Method::standard, scene.duration, false).ticks) {
        turn = std::max(turn, 1e3 * motion_between(last, record.haptic).angular.norm());
        error = std::max(error, record.truncation);
        bound = std::max(bound, record.truncation_bound);
        last = record.haptic;
      }
      csv.print("%.6g,%.6g,%.6g\n", turn, 1e6 * error, 1e6 * bound);
      std::printf("   hand turns at up to %5.2f rad/s: %9.3g um, bound r phi^2/2 %9.3g um%s\n", turn, 1e6 * error, 1e6 * bound,
                  error < 1e-6 ? "  (the paper is right: below 1 um)" : "  (more than the paper's 1 um)");
    }
    csv.close();
  }

  /// Fig. 13 and 14.
  void steps(double seconds) {
    std::printf("\nB  Line over convex and concave edges (Fig. 12 to 14), K = 1 N/mm and 0.3 N m/rad\n");
    for (const Method method : {Method::standard, Method::paper}) {
      const std::string file = method == Method::paper ? "steps_paper" : "steps";
      auto scene = steps_states();
      if (seconds > 0.0) {  // the same way, faster
        const double speed = scene.duration / seconds;
        scene.motion = [motion = scene.motion, speed](double t) { return motion(t * speed); };
        scene.duration = seconds;
      }
      const auto ticks = simulate(scene, stiff_settings(method), method, file, steps_state);
      expect_order(ticks, steps_state, {State::none, State::vertex_face, State::edge_edge, State::vertex_face, State::two_regions, State::none},
                   method);
      figure(file, 900, 620, wrench_body(file + ".csv", "'no contact' 0, 'V-F' 4, 'E-E' 5, 'V-F in two regions' 6, 'other' 7"));
    }
    figure("steps_time", 900, 560, time_body("steps.csv", "steps_paper.csv"));
  }

  /// Fig. 5.
  void local() {
    std::printf("\nFig. 5  Local and global solution\n");
    auto settings = stiff_settings(Method::standard);
    settings.stiffness.rotational.setConstant(1000.0);  // the closed forms know translations only
    for (const bool is_wedge : {false, true}) {
      const auto scene = is_wedge ? push_through_wedge() : push_through_plate();
      const char* name = is_wedge ? "local_wedge" : "local_plate";
      const int axis = is_wedge ? 0 : 2;
      feeler::demo::TextFile csv(folder_ / (std::string(name) + ".csv"));
      csv.print("t,haptic_mm,local_mm,global_mm,paper_mm\n");
      const auto ticks = run(scene, settings, Method::standard, scene.duration, true).ticks;
      const auto paper = run(scene, settings, Method::paper, scene.duration, true).ticks;
      double jump = 0.0, local_jump = 0.0, last = scene.start.translation[axis], last_local = last;
      for (std::size_t i = 0; i < ticks.size(); ++i) {
        const Vector& hand = ticks[i].haptic.translation;
        const double global = is_wedge ? global_beside_wedge(hand) : global_over_plate(hand.z());
        const double local = ticks[i].graphic.translation[axis];
        csv.print("%.17g,%.17g,%.17g,%.17g,%.17g\n", ticks[i].t, 1e3 * hand[axis], 1e3 * local, 1e3 * global,
                  1e3 * paper[i].graphic.translation[axis]);
        jump = std::max(jump, std::abs(global - last));
        local_jump = std::max(local_jump, std::abs(local - last_local));
        last = global;
        last_local = local;
      }
      csv.close();
      const auto measures = measure(ticks, 1000.0), of_paper = measure(paper, 1000.0);
      std::printf("   %s: global solution jumps %.2f mm, ours %.3f mm; deepest %.2g um, paper's method %.3g um\n", is_wedge ? "wedge" : "plate",
                  1e3 * jump, 1e3 * local_jump, 1e6 * measures.deepest, 1e6 * of_paper.deepest);
      if (measures.deepest > 1e-11) findings_.is_as_expected = false;
      const std::string file = std::string("'") + name + ".csv'";
      figure(name, 800, 380,
             std::string("set xlabel 'time  [s]'; set ylabel '") + (is_wedge ? "place across the wedge  [mm]" : "height  [mm]") +
                 "'; set key outside top horizontal Left reverse samplen 1.6; set xrange [0:1]\nplot " + file +
                 " using 1:2 with lines lw 1.5 lc rgb red title 'haptic tool', " + file +
                 " using 1:4 with lines lw 2 dt 2 lc rgb amber title 'global solution', " + file +
                 " using 1:5 with lines lw 3.5 lc rgb green title 'paper as written', " + file +
                 " using 1:3 with lines lw 1.5 lc rgb ink title 'default'\n");
    }
  }

  /// Fig. 1.
  void fine() {
    std::printf("\nFig. 1  Probe in the sulcus, splined shaft in its hole\n");
    auto probe = feeler::scenes::sulcus();
    probe.duration = 4.0;
    for (const Method method : {Method::standard, Method::paper}) {
      simulate(probe, paper_settings(method), method, method == Method::paper ? "sulcus_paper" : "sulcus", any_state);
    }
    figure("sulcus", 900, 620, wrench_body("sulcus.csv", "'no contact' 0, 'contact' 7"));
    for (const auto& [clearance, name] : {std::pair(2e-4, "spline_200um"), std::pair(2e-5, "spline_20um")}) {
      const auto shaft = insertion(clearance);
      note(run(shaft, stiff_settings(Method::standard), shaft.duration, true), Method::standard, name, any_state);
    }
    figure("spline_20um", 900, 620, wrench_body("spline_20um.csv", "'no contact' 0, 'contact' 7"));
  }

  void table() {
    std::printf("\nTable: each correction alone\n");
    make_table(folder_);
  }

 private:
  static State any_state(const Record& record) { return record.contacts == 0 ? State::none : State::other; }

  static double global_over_plate(double z) {
    constexpr double half = 0.001;
    return std::abs(z) >= half ? z : std::copysign(half, z);
  }
  /// The nearer of the two sides of the wedge grown by the cube; the hand is below its ridge.
  static double global_beside_wedge(const Vector& hand) {
    constexpr double half = 0.001;
    const Vector normal(std::cos(wedge_half_angle), 0.0, std::sin(wedge_half_angle));
    const double side = std::copysign(1.0, hand.x());
    const double depth = half * (normal.x() + normal.z()) - (normal.x() * std::abs(hand.x()) + normal.z() * hand.z());
    return hand.x() + side * std::max(depth, 0.0) * normal.x();
  }

  std::vector<Record> simulate(const feeler::scenes::Scene& scene, const feeler::Settings<double>& settings, Method method, const std::string& file,
                               State (*state_of)(const Record&)) {
    return note(run(scene, settings, method, scene.duration, true), method, file, state_of);
  }

  /// Writes a run down and says what it measured.
  std::vector<Record> note(const Run& result, Method method, const std::string& file, State (*state_of)(const Record&)) {
    constexpr double stiffness = 1000.0;  // of all experiments [N/m]
    if (result.start != feeler::Status::converged) {
      std::printf("   %-18s cannot start: %s\n", file.c_str(), to_string(result.start));
      findings_.is_as_expected = findings_.is_as_expected && method != Method::standard;
      return {};
    }
    write(file, result.ticks, state_of);
    const Measures m = measure(result.ticks, stiffness);
    std::printf(
        "   %-18s deepest %9.3g um | force without contact %4d ticks | steps beyond the hand %6.3f mm, %6.2f N | p50 %6.1f (QP %.1f) "
        "p99 %7.1f us, %.2f %% above 1 ms | %d switches\n",
        file.c_str(), 1e6 * m.deepest, m.force_without_contact, 1e3 * m.pose_step, m.wrench_step, m.p50, m.optimisation_p50, m.p99,
        100.0 * m.late_share, m.switches);
    std::fflush(stdout);
    if (method == Method::standard && m.deepest > 1e-11) findings_.is_as_expected = false;
    return result.ticks;
  }

  void expect_order(const std::vector<Record>& ticks, State (*state_of)(const Record&), const std::vector<State>& states, Method method) {
    const bool is_ordered = occur_in_order(ticks, state_of, states);
    std::printf("   %-18s the five states come in order: %s\n", name_of(method), is_ordered ? "yes" : "no");
    if (!is_ordered && method == Method::standard) findings_.is_as_expected = false;
  }

  void write(const std::string& name, const std::vector<Record>& ticks, State (*state_of)(const Record&)) const {
    feeler::demo::TextFile csv(folder_ / (name + ".csv"));
    csv.print(
        "t,haptic_px,haptic_py,haptic_pz,haptic_qw,haptic_qx,haptic_qy,haptic_qz,graphic_px,graphic_py,graphic_pz,graphic_qw,"
        "graphic_qx,graphic_qy,graphic_qz,fx,fy,fz,tx,ty,tz,tick_us,optimisation_us,depth,truncation,contacts,regions,state,state_name\n");
    for (const Record& r : ticks) {
      csv.print("%.17g", r.t);
      for (const auto& pose : {r.haptic, r.graphic}) {
        for (int k = 0; k < 3; ++k) csv.print(",%.17g", pose.translation[k]);
        csv.print(",%.17g,%.17g,%.17g,%.17g", pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z());
      }
      for (int k = 0; k < 3; ++k) csv.print(",%.17g", r.wrench.force[k]);
      for (int k = 0; k < 3; ++k) csv.print(",%.17g", r.wrench.torque[k]);
      const State state = state_of(r);
      csv.print(",%.4g,%.4g,%.6g,%.6g,%d,%d,%d,%s\n", r.microseconds, r.optimisation_microseconds, r.depth, r.truncation, r.contacts, r.regions,
                int(state), name_of(state));
    }
    csv.close();
  }

  void figure(const std::string& name, int width, int height, const std::string& body) {
    if (draws_ && !draw(folder_, name, width, height, body)) findings_.has_all_figures = false;
  }

  fs::path folder_;
  bool draws_;
  Findings findings_;
};

}  // namespace

int main(int argc, char** argv) {
  std::string folder = "out/experiments", experiment = "all";
  double seconds = 0.0;
  bool has_no_figures = false;
  CLI::App app("feeler-experiments: section V of the paper, measured again", "feeler-experiments");
  app.add_option("--out", folder, "folder of the CSV files and figures");
  app.add_option("--experiment", experiment, "all, cavity, steps, local, fine or table")
      ->check(CLI::IsMember({"all", "cavity", "steps", "local", "fine", "table"}));
  app.add_option("--seconds", seconds, "length of the motion over the steps; 0 for its own")->check(feeler::bench::within(0.0, 1000.0));
  app.add_flag("--no-figures", has_no_figures, "write CSV files only");
  return feeler::bench::run_with_options(app, argc, argv, [&] {
    fs::create_directories(folder);
    Experiments experiments(folder, !has_no_figures);
    const auto wanted = [&](const char* name) { return experiment == "all" || experiment == name; };
    if (wanted("cavity")) experiments.cavity();
    if (wanted("steps")) experiments.steps(seconds);
    if (wanted("local")) experiments.local();
    if (wanted("fine")) experiments.fine();
    if (wanted("table")) experiments.table();
    if (!experiments.findings().is_as_expected) {
      std::fprintf(stderr, "feeler-experiments: the default method penetrated, or its states are not in the order of the paper; see above.\n");
      return 1;
    }
    if (!experiments.findings().has_all_figures) {
      std::fprintf(stderr, "feeler-experiments: the CSV files are written, but gnuplot could not draw them: install gnuplot-nox.\n");
      return 3;
    }
    return 0;
  });
}
