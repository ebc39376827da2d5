// Every preset on every hold in every grip.
#include <algorithm>
#include <set>

#include "stability/limit.hpp"
#include "stability/study_text.hpp"
#include "text_file.hpp"

namespace feeler::stability {
namespace {

constexpr double papers_rotational_stiffness = 0.03;  // for its Premium 3.0 [N·m/rad]

/// A row of the table: one device at one rate and one rotational stiffness.
class PresetRow {
 public:
  PresetRow(const StudyOptions& options, const NamedDevice& named, double rate, double rotational_stiffness)
      : options_(options), named_(named), rate_(rate), rotational_stiffness_(rotational_stiffness) {}

  /// @return loops that were not stable
  int run(const std::vector<Meeting>& meetings, demo::TextFile& csv, demo::TextFile& table) {
    const DeviceSpecification& device = named_.device;
    table.print("| %s | %g | %g | %g%s |", device.name.c_str(), rate_ / 1000, device.stiffness, rotational_stiffness_,
                device.pushes_torque() ? "" : " (shown)");
    int unstable = 0;
    for (const NamedGrip& grip : grips) {
      int loops = 0, stable = 0;
      for (const Meeting& meeting : meetings) {
        if (!is_wanted(options_, grip) || !concerns(device, meeting.situation)) continue;
        ++loops;
        stable += run_one(grip, meeting, csv);
      }
      unstable += loops - stable;
      table.print(" %d of %d |", stable, loops);
    }
    table.print(" %.2g | %.2g | %.2g | %.2g |\n", shown(1e6 * swing_), shown(1e3 * turn_), shown(1e3 * buzz_), shown(1e3 * torque_buzz_));
    say("presets", at_rate(named_.name, rate_));
    return unstable;
  }

 private:
  bool run_one(const NamedGrip& grip, const Meeting& meeting, demo::TextFile& csv) {
    LoopSetup setup = preset_loop(options_, named_.device, grip.grip, rate_);
    setup.rotational_stiffness = rotational_stiffness_;
    const LoopResult result = run_loop(meeting.situation, meeting.contact, setup);
    const char* const scene = meeting.situation.scene.c_str();
    const char* const hold = meeting.situation.name.c_str();
    if (!result.is_stable) {
      std::printf("not stable: %s at %g Hz, %g N/m, %g N·m/rad, %s, %s, %s: %.3g µm, %.3g mrad\n", named_.name.c_str(), rate_, setup.stiffness,
                  rotational_stiffness_, grip.name, scene, hold, 1e6 * result.swing_end, 1e3 * result.turn_end);
    }
    csv.print("%s,%g,%g,%g,%s,%s,%s,%d,%.4g,%.4g,%.4g,%.4g\n", named_.name.c_str(), rate_, setup.stiffness, rotational_stiffness_, grip.name, scene,
              hold, int(result.is_stable), 1e6 * result.swing_end, 1e3 * result.turn_end, result.buzz, result.torque_buzz);
    if (grip.name == std::string("barely")) return result.is_stable;  // it swings by itself for seconds
    swing_ = std::max(swing_, result.swing_end);
    buzz_ = std::max(buzz_, result.buzz);
    if (named_.device.pushes_torque()) turn_ = std::max(turn_, result.turn_end), torque_buzz_ = std::max(torque_buzz_, result.torque_buzz);
    return result.is_stable;
  }

  const StudyOptions& options_;
  const NamedDevice& named_;
  double rate_, rotational_stiffness_;
  double swing_ = 0, turn_ = 0, buzz_ = 0, torque_buzz_ = 0;
};

}  // namespace

int study_presets(const StudyOptions& options) {
  const std::vector<Meeting> meetings = meetings_of(options, holds());
  demo::TextFile csv(options.folder / "presets.csv");
  csv.print(
      "device,rate,stiffness,rotational_stiffness,grip,scene,situation,stable,swing_um,turn_mrad,buzz_N,"
      "torque_buzz_Nm\n");
  demo::TextFile table(options.folder / "presets.md");
  table.print(
      "| device | rate [kHz] | K [N/m] | K_r [N·m/rad] | stable holds: barely | soft | relaxed | firm | "
      "largest swing that stays, soft to firm [µm] | [mrad] "
      "| buzz, largest RMS, soft to firm [mN] | [mN·m] "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  int unstable = 0;
  for (const NamedDevice& named : devices_of(options)) {
    std::vector<double> rotational = {preset_loop(options, named.device, {}, 1000).rotational_stiffness};
    if (named.name == "premium-3.0") rotational.push_back(papers_rotational_stiffness);
    for (const double rate : std::set<double>{named.device.nominal_rate, named.device.maximum_rate}) {
      for (const double stiffness : rotational) unstable += PresetRow(options, named, rate, stiffness).run(meetings, csv, table);
    }
  }
  csv.close();
  table.close();
  return unstable;
}

}  // namespace feeler::stability
