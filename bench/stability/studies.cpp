// Runs the loop many times, and writes down what it showed.
#include "stability/studies.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "feeler/device/stiffness_limits.hpp"
#include "stability/closed_loop.hpp"
#include "stability/grips.hpp"
#include "stability/linear_theory.hpp"
#include "stability/search.hpp"
#include "text_file.hpp"

namespace feeler::stability {
namespace {

using demo::TextFile;

/// Contacts are found once a situation.
class Contacts {
 public:
  const Pose<double>& of(const Situation& situation) {
    const std::string key = situation.scene + "/" + situation.name;
    const auto found = poses_.find(key);
    if (found != poses_.end()) return found->second;
    return poses_.emplace(key, contact_of(situation, scene_named(situation.scene))).first->second;
  }

 private:
  std::map<std::string, Pose<double>> poses_;
};

bool is_wanted(const StudyOptions& options, const NamedDevice& device) {
  return options.devices.empty() ||
         std::find(options.devices.begin(), options.devices.end(), device.name) != options.devices.end();
}
bool is_wanted(const StudyOptions& options, const Situation& situation) {
  return options.scene.empty() || options.scene == situation.scene;
}
bool is_wanted(const StudyOptions& options, const NamedGrip& grip) {
  return options.grip.empty() || options.grip == grip.name;
}

/// The stiffness of the preset; where no motor turns the handle, a turn is shown as one of 10 mm.
LoopSetup preset_loop(const DeviceSpecification& device, const Grip& grip, double rate) {
  constexpr double length = 0.010;
  LoopSetup setup;
  setup.device = device;
  setup.grip = grip;
  setup.rate = rate;
  setup.stiffness = device.stiffness;
  setup.rotational_stiffness =
      device.pushes_torque() ? device.rotational_stiffness : device.stiffness * length * length;
  return setup;
}

/// The largest stiffness of the loop's kind, translational or rotational, the other one left; 0 where none
/// is.
double limit_of(const Situation& situation, const Pose<double>& contact, LoopSetup setup) {
  const bool turns = situation.turns();
  double& stiffness = turns ? setup.rotational_stiffness : setup.stiffness;
  const double guess = stiffness;
  // The metric follows the stiffness: with the other one left, the tool would be held by a length that no
  // scene has.
  const double length_squared = setup.rotational_stiffness / setup.stiffness;
  return largest_where(
      [&](double value) {
        stiffness = value;
        if (!setup.device.pushes_torque()) setup.rotational_stiffness = length_squared * value;
        return run_loop(situation, contact, setup).is_stable;
      },
      guess, guess / 300, guess * 300);
}

bool concerns(const DeviceSpecification& device, const Situation& situation) {
  return device.pushes_torque() || !situation.turns();
}

const char* unit_of(const Situation& situation) {
  return situation.turns() ? "N·m/rad" : "N/m";
}

/// Least and largest of what was seen.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

/// For tables: what is nothing but rounding is nothing.
double shown(double value) {
  return std::abs(value) < 1e-3 ? 0.0 : value;
}

void say(const char* what, const std::string& of) {
  std::printf("%s: %s\n", what, of.c_str());
  std::fflush(stdout);
}

}  // namespace

std::vector<NamedDevice> all_devices() {
  return {{"premium-3.0", phantom_premium_3_0_6dof()},
          {"premium-1.5", phantom_premium_1_5_6dof()},
          {"premium-1.5-hf", phantom_premium_1_5_high_force_6dof()},
          {"touch", touch()},
          {"touch-x", touch_x()},
          {"omega.6", omega_6()},
          {"sigma.7", sigma_7()},
          {"lambda.7", lambda_7()},
          {"delta.3", delta_3()},
          {"falcon", falcon()},
          {"virtuose-6d", virtuose_6d()},
          {"virtuose-desktop", virtuose_6d_desktop()}};
}

int study_presets(const StudyOptions& options) {
  Contacts contacts;
  TextFile csv(options.folder / "presets.csv");
  csv.print(
      "device,rate,stiffness,rotational_stiffness,grip,scene,situation,stable,swing_um,turn_mrad,buzz_N,"
      "torque_buzz_Nm\n");
  TextFile table(options.folder / "presets.md");
  table.print(
      "| device | rate [kHz] | K [N/m] | K_r [N·m/rad] | stable holds: barely | soft | relaxed | firm | "
      "largest swing that stays, soft to firm [µm] | [mrad] "
      "| buzz, largest RMS, soft to firm [mN] | [mN·m] "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  int unstable = 0;
  for (const NamedDevice& named : all_devices()) {
    if (!is_wanted(options, named)) continue;
    const DeviceSpecification& device = named.device;
    std::vector<double> rotational = {preset_loop(device, {}, 1000).rotational_stiffness};
    if (named.name == std::string("premium-3.0")) rotational.push_back(0.03);  // the paper's
    for (const double rate : std::set<double>{device.nominal_rate, device.maximum_rate}) {
      for (const double k_r : rotational) {
        table.print("| %s | %g | %g | %g%s |", device.name.c_str(), rate / 1000, device.stiffness, k_r,
                    device.pushes_torque() ? "" : " (shown)");
        double swing = 0, turn = 0, buzz = 0, torque_buzz = 0;
        for (const NamedGrip& grip : grips) {
          int loops = 0, stable = 0;
          for (const Situation& hold : holds()) {
            if (!is_wanted(options, grip) || !is_wanted(options, hold) || !concerns(device, hold)) continue;
            LoopSetup setup = preset_loop(device, grip.grip, rate);
            setup.rotational_stiffness = k_r;
            setup.has_friction = options.has_friction;
            const LoopResult result = run_loop(hold, contacts.of(hold), setup);
            ++loops;
            stable += result.is_stable;
            if (!result.is_stable) {
              std::printf("not stable: %s at %g Hz, %g N/m, %g N·m/rad, %s, %s, %s: %.3g µm, %.3g mrad\n",
                          named.name, rate, setup.stiffness, k_r, grip.name, hold.scene.c_str(),
                          hold.name.c_str(), 1e6 * result.swing_end, 1e3 * result.turn_end);
            }
            csv.print("%s,%g,%g,%g,%s,%s,%s,%d,%.4g,%.4g,%.4g,%.4g\n", named.name, rate, setup.stiffness, k_r,
                      grip.name, hold.scene.c_str(), hold.name.c_str(), int(result.is_stable),
                      1e6 * result.swing_end, 1e3 * result.turn_end, result.buzz, result.torque_buzz);
            if (grip.name == std::string("barely")) continue;  // it swings by itself for seconds
            swing = std::max(swing, result.swing_end);
            buzz = std::max(buzz, result.buzz);
            if (device.pushes_torque())
              turn = std::max(turn, result.turn_end), torque_buzz = std::max(torque_buzz, result.torque_buzz);
          }
          unstable += loops - stable;
          table.print(" %d of %d |", stable, loops);
        }
        table.print(" %.2g | %.2g | %.2g | %.2g |\n", shown(1e6 * swing), shown(1e3 * turn),
                    shown(1e3 * buzz), shown(1e3 * torque_buzz));
        say("presets", std::string(named.name) + " at " + std::to_string(int(rate)) + " Hz");
      }
    }
  }
  csv.close();
  table.close();
  return unstable;
}

void study_limits(const StudyOptions& options) {
  Contacts contacts;
  TextFile csv(options.folder / "limits.csv");
  csv.print("device,rate,grip,scene,situation,unit,limit,preset,passive_2b_T,quantised_2f_D,linear_theory\n");
  TextFile table(options.folder / "limits.md");
  table.print(
      "| device | rate [kHz] | preset | 2b/T | 2f_c/Δ | barely | soft | relaxed | firm | rotations: preset | "
      "barely | soft | relaxed | firm |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  TextFile width(options.folder / "zwidth.md");
  width.print(
      "| device | rate [kHz] | lowest [N·s/m] | highest [N·s/m] | Z-width [dB] |\n|---|---|---|---|---|\n");
  TextFile plot(options.folder / "limits_by_rate.csv");
  plot.print("device,rate,barely,soft,relaxed,firm,passive\n");
  for (const NamedDevice& named : all_devices()) {
    if (!is_wanted(options, named)) continue;
    for (const double rate : options.rates) {
      const StiffnessLimits bounds = stiffness_limits_of(named.device, 1 / rate);
      double translational[grips.size()] = {}, rotational[grips.size()] = {};
      for (std::size_t g = 0; g < grips.size(); ++g) {
        if (!is_wanted(options, grips[g])) continue;
        Range forces, torques;
        for (const Situation& hold : holds()) {
          if (!is_wanted(options, hold) || !concerns(named.device, hold)) continue;
          LoopSetup setup = preset_loop(named.device, grips[g].grip, rate);
          setup.has_friction = options.has_friction;
          const double limit = limit_of(hold, contacts.of(hold), setup);
          (hold.turns() ? torques : forces).add(limit);
          const Handle handle = {named.device.apparent_mass, named.device.apparent_inertia,
                                 named.device.damping, named.device.rotational_damping};
          const double theory = hold.turns() ? 0 : linear_limit(handle, grips[g].grip, 1 / rate);
          csv.print("%s,%g,%s,%s,%s,%s,%.4g,%g,%.4g,%.4g,%.4g\n", named.name, rate, grips[g].name,
                    hold.scene.c_str(), hold.name.c_str(), unit_of(hold), limit,
                    hold.turns() ? named.device.rotational_stiffness : named.device.stiffness,
                    hold.turns() ? bounds.rotational_passive : bounds.passive,
                    hold.turns() ? 0.0 : bounds.quantised, theory);
        }
        translational[g] = std::isfinite(forces.low) ? forces.low : 0;
        rotational[g] = std::isfinite(torques.low) ? torques.low : 0;
      }
      table.print("| %s | %g | %g | %.0f | %.0f |", named.device.name.c_str(), rate / 1000,
                  named.device.stiffness, bounds.passive, bounds.quantised);
      for (const double limit : translational) table.print(" %.0f |", limit);
      if (named.device.pushes_torque()) {
        table.print(" %g |", named.device.rotational_stiffness);
        for (const double limit : rotational) table.print(" %.2g |", limit);
      } else {
        table.print(" – | – | – | – | – |");
      }
      table.print("\n");
      plot.print("%s,%g", named.name, rate);
      for (const double limit : translational) plot.print(",%.4g", limit);
      plot.print(",%.4g\n", bounds.passive);
      // At 5 Hz, moved by 10 mm each way; friction as the damper that takes as much energy.
      constexpr double pace = 2 * std::numbers::pi * 5, amplitude = 0.010;
      const double damper =
          named.device.damping + 4 * named.device.friction / (std::numbers::pi * amplitude * pace);
      const double lowest = std::hypot(damper, pace * named.device.apparent_mass);
      const double highest = std::hypot(damper, pace * named.device.apparent_mass - translational[2] / pace);
      width.print("| %s | %g | %.2f | %.0f | %.0f |\n", named.device.name.c_str(), rate / 1000, lowest,
                  highest, 20 * std::log10(highest / lowest));
      say("limits", std::string(named.name) + " at " + std::to_string(int(rate)) + " Hz");
    }
  }
  for (TextFile* file : {&csv, &table, &width, &plot}) file->close();
}

void study_rivals(const StudyOptions& options) {
  Contacts contacts;
  TextFile csv(options.folder / "rivals.csv");
  csv.print(
      "device,engine,grip,scene,situation,unit,limit,preset,stable_at_preset,swing_um,turn_mrad,buzz_N,"
      "torque_buzz_Nm\n");
  TextFile table(options.folder / "rivals.md");
  table.print(
      "| engine | grip | stable at the preset | largest stable K, least and most of the holds [N/m] | K_r "
      "[N·m/rad] | largest limit cycle at the preset [µm] | buzz there, largest RMS [mN] |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : all_devices()) {
    if (options.devices.empty() ? named.name != std::string("premium-3.0") : !is_wanted(options, named))
      continue;
    for (const Engine engine : all_engines) {
      if (!is_built(engine)) {
        say("rivals", std::string(name_of(engine)) + " is not installed, left out");
        continue;
      }
      for (const NamedGrip& grip : grips) {
        if (!is_wanted(options, grip)) continue;
        Range forces, torques;
        int loops = 0, stable = 0;
        double swing = 0, buzz = 0;
        for (const Situation& hold : holds()) {
          if (!is_wanted(options, hold) || !concerns(named.device, hold)) continue;
          LoopSetup setup = preset_loop(named.device, grip.grip, 1000);
          setup.engine = engine;
          setup.has_friction = options.has_friction;
          const LoopResult at_preset = run_loop(hold, contacts.of(hold), setup);
          const double limit = limit_of(hold, contacts.of(hold), setup);
          (hold.turns() ? torques : forces).add(limit);
          ++loops;
          stable += at_preset.is_stable;
          swing = std::max(swing, at_preset.swing_end);
          buzz = std::max(buzz, at_preset.buzz);
          csv.print("%s,%s,%s,%s,%s,%s,%.4g,%g,%d,%.4g,%.4g,%.4g,%.4g\n", named.name, name_of(engine),
                    grip.name, hold.scene.c_str(), hold.name.c_str(), unit_of(hold), limit,
                    hold.turns() ? setup.rotational_stiffness : setup.stiffness, int(at_preset.is_stable),
                    1e6 * at_preset.swing_end, 1e3 * at_preset.turn_end, at_preset.buzz,
                    at_preset.torque_buzz);
        }
        table.print("| %s | %s | %d of %d | %.0f to %.0f | %.2g to %.2g | %.3g | %.3g |\n", name_of(engine),
                    grip.name, stable, loops, forces.low, forces.high, torques.low, torques.high,
                    shown(1e6 * swing), 1e3 * buzz);
      }
      say("rivals", std::string(named.name) + ", " + name_of(engine));
    }
  }
  csv.close();
  table.close();
}

void study_slides(const StudyOptions& options) {
  Contacts contacts;
  TextFile csv(options.folder / "slides.csv");
  csv.print("device,engine,rate,grip,scene,situation,buzz_N,torque_buzz_Nm,greatest_force_step_N\n");
  TextFile table(options.folder / "slides.md");
  table.print(
      "| slide | engine | rate [kHz] | buzz, RMS above 50 Hz [mN]: soft | relaxed | firm | largest step of "
      "the force in a tick [mN]: soft | relaxed | firm |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : all_devices()) {
    if (options.devices.empty() ? named.name != std::string("premium-3.0") : !is_wanted(options, named))
      continue;
    for (const Situation& slide : slides()) {
      if (!is_wanted(options, slide)) continue;
      for (const Engine engine : all_engines) {
        if (!is_built(engine)) continue;
        for (const double rate : {1000.0, 4000.0}) {
          std::string buzzes, steps;
          for (const NamedGrip& grip : grips) {
            if (grip.name == std::string("barely")) continue;  // it cannot lead the tool along
            LoopSetup setup = preset_loop(named.device, grip.grip, rate);
            setup.engine = engine;
            setup.has_friction = options.has_friction;
            const LoopResult result = run_loop(slide, contacts.of(slide), setup);
            csv.print("%s,%s,%g,%s,%s,%s,%.4g,%.4g,%.4g\n", named.name, name_of(engine), rate, grip.name,
                      slide.scene.c_str(), slide.name.c_str(), result.buzz, result.torque_buzz,
                      result.greatest_force_step);
            char text[32];
            std::snprintf(text, sizeof text, " %.0f |", 1e3 * result.buzz);
            buzzes += text;
            std::snprintf(text, sizeof text, " %.0f |", 1e3 * result.greatest_force_step);
            steps += text;
          }
          table.print("| %s, %s | %s | %g |%s%s\n", slide.scene.c_str(), slide.name.c_str(), name_of(engine),
                      rate / 1000, buzzes.c_str(), steps.c_str());
        }
      }
      say("slides", slide.scene + ", " + slide.name);
    }
  }
  csv.close();
  table.close();
}

void study_extrapolation(const StudyOptions& options) {
  struct Host {
    const char* name;
    double rate;
    Handover handover;
    int divider, latency;
  };
  constexpr Host hosts[] = {
      {"1 kHz", 1000, Handover::direct, 1, 0},
      {"4 kHz, renderer at 1 kHz, held, 1 tick late", 4000, Handover::held, 4, 1},
      {"4 kHz, renderer at 1 kHz, held, 4 ticks late", 4000, Handover::held, 4, 4},
      {"4 kHz, renderer at 1 kHz, extrapolated, 1 tick late", 4000, Handover::extrapolated, 4, 1},
      {"4 kHz, renderer at 1 kHz, extrapolated, 4 ticks late", 4000, Handover::extrapolated, 4, 4},
      {"4 kHz", 4000, Handover::direct, 1, 0}};
  Contacts contacts;
  TextFile csv(options.folder / "extrapolation.csv");
  csv.print("device,host,grip,scene,situation,unit,limit\n");
  TextFile table(options.folder / "extrapolation.md");
  table.print(
      "| device | host | K, least of the holds [N/m]: barely | soft | relaxed | firm | K, median of the "
      "holds: barely | soft | relaxed | firm |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : all_devices()) {
    const bool is_default = named.name == std::string("premium-3.0") || named.name == std::string("sigma.7");
    if (options.devices.empty() ? !is_default : !is_wanted(options, named)) continue;
    for (const Host& host : hosts) {
      table.print("| %s | %s |", named.device.name.c_str(), host.name);
      std::string medians;
      for (const NamedGrip& grip : grips) {
        std::vector<double> limits;
        for (const Situation& hold : holds()) {
          if (!is_wanted(options, grip) || !is_wanted(options, hold) || !concerns(named.device, hold))
            continue;
          LoopSetup setup = preset_loop(named.device, grip.grip, host.rate);
          setup.handover = host.handover;
          setup.divider = host.divider;
          setup.latency = host.latency;
          setup.has_friction = options.has_friction;
          const double limit = limit_of(hold, contacts.of(hold), setup);
          if (!hold.turns()) limits.push_back(limit);
          csv.print("%s,\"%s\",%s,%s,%s,%s,%.4g\n", named.name, host.name, grip.name, hold.scene.c_str(),
                    hold.name.c_str(), unit_of(hold), limit);
        }
        std::sort(limits.begin(), limits.end());
        table.print(" %.0f |", limits.empty() ? 0.0 : limits.front());
        char text[32];
        std::snprintf(text, sizeof text, " %.0f |", limits.empty() ? 0.0 : limits[limits.size() / 2]);
        medians += text;
      }
      table.print("%s\n", medians.c_str());
      say("extrapolation", std::string(named.name) + ", " + host.name);
    }
  }
  csv.close();
  table.close();
}

void study_passivity(const StudyOptions& options) {
  Contacts contacts;
  TextFile table(options.folder / "passivity.md");
  table.print(
      "| device | grip | largest stable K without, least of the holds [N/m] | with passivity control | limit "
      "cycle at twice the least, largest [µm]: without | with |\n|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : all_devices()) {
    if (options.devices.empty() ? named.name != std::string("premium-3.0") : !is_wanted(options, named))
      continue;
    for (const NamedGrip& grip : grips) {
      if (!is_wanted(options, grip)) continue;
      double least[2] = {1e9, 1e9}, swing[2] = {0, 0};
      for (const bool is_passive : {false, true}) {
        for (const Situation& hold : holds()) {
          if (hold.turns() || !is_wanted(options, hold)) continue;
          LoopSetup setup = preset_loop(named.device, grip.grip, 1000);
          setup.has_friction = options.has_friction;
          setup.is_passive = is_passive;
          least[is_passive] = std::min(least[is_passive], limit_of(hold, contacts.of(hold), setup));
        }
        for (const Situation& hold : holds()) {
          if (hold.turns() || !is_wanted(options, hold)) continue;
          LoopSetup setup = preset_loop(named.device, grip.grip, 1000);
          setup.has_friction = options.has_friction;
          setup.is_passive = is_passive;
          setup.stiffness = 2 * least[0];
          swing[is_passive] = std::max(swing[is_passive], run_loop(hold, contacts.of(hold), setup).swing_end);
        }
      }
      table.print("| %s | %s | %.0f | %.0f | %.0f | %.0f |\n", named.device.name.c_str(), grip.name, least[0],
                  least[1], 1e6 * swing[0], 1e6 * swing[1]);
      say("passivity", std::string(named.name) + ", " + grip.name);
    }
  }
  table.close();
}

int study_theory(const StudyOptions& options) {
  constexpr double tolerance = 0.07;  // 2 % of the bisection, and the first order of the integration
  Contacts contacts;
  TextFile table(options.folder / "theory.md");
  table.print(
      "| grip | rate [kHz] | linear theory [N/m] | simulated [N/m] | difference [%%] "
      "|\n|---|---|---|---|---|\n");
  const Situation hold = holds().front();
  int disagreements = 0;
  for (const NamedGrip& grip : grips) {
    if (!is_wanted(options, grip)) continue;
    for (const double rate : options.rates) {
      LoopSetup setup = preset_loop(phantom_premium_3_0_6dof(), grip.grip, rate);
      setup.has_friction = false;
      setup.device.position_resolution = setup.device.rotation_resolution = 0;
      setup.device.maximum_force = 1e6;  // nothing may bend the loop,
      setup.kick = 0.02;                 // and the tool not leave the wall
      const DeviceSpecification& device = setup.device;
      const Handle handle = {device.apparent_mass, device.apparent_inertia, device.damping,
                             device.rotational_damping};
      const double theory =
          linear_limit(handle, grip.grip, 1 / rate, std::pow(decay_of_a_stable_loop, 1 / window));
      setup.stiffness = theory;
      setup.rotational_stiffness = 1e-4 * theory;
      const double simulated = limit_of(hold, contacts.of(hold), setup);
      const double difference = simulated / theory - 1;
      if (!(std::abs(difference) <= tolerance)) ++disagreements;
      table.print("| %s | %g | %.0f | %.0f | %.1f |\n", grip.name, rate / 1000, theory, simulated,
                  100 * difference);
      say("theory", std::string(grip.name) + " at " + std::to_string(int(rate)) +
                        " Hz: " + std::to_string(100 * difference) + " %");
    }
  }
  table.close();
  return disagreements;
}

void study_traces(const StudyOptions& options) {
  Contacts contacts;
  const Situation hold = holds().front();
  for (const double share : {0.9, 1.1}) {
    LoopSetup setup = preset_loop(phantom_premium_3_0_6dof(), grips[1].grip, 1000);
    setup.stiffness = share * limit_of(hold, contacts.of(hold), setup);
    TextFile csv(options.folder / (share < 1 ? "trace_below.csv" : "trace_above.csv"));
    csv.print("t,position_mm,force_N,stiffness\n");
    for (const TracePoint& p : run_loop(hold, contacts.of(hold), setup, true).trace)
      csv.print("%.6g,%.6g,%.6g,%.4g\n", p.time, 1e3 * p.position, p.force, setup.stiffness);
    csv.close();
  }
}

}  // namespace feeler::stability
