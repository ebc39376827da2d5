// The largest stable stiffness of each device, and how far it is from its free motion.
#include <array>
#include <cmath>
#include <numbers>

#include "feeler/device/stiffness_limits.hpp"
#include "stability/limit.hpp"
#include "stability/linear_theory.hpp"
#include "stability/study_text.hpp"
#include "text_file.hpp"

namespace feeler::stability {
namespace {

/// The least of the holds in each grip; 0 where there are none.
struct LeastLimits {
  std::array<double, grips.size()> translational = {}, rotational = {};
};

LeastLimits least_limits(const StudyOptions& options, const NamedDevice& named, double rate, const StiffnessLimits& bounds,
                         const std::vector<Meeting>& meetings, demo::TextFile& csv) {
  const DeviceSpecification& device = named.device;
  LeastLimits least;
  for (std::size_t g = 0; g < grips.size(); ++g) {
    if (!is_wanted(options, grips[g])) continue;
    Range forces, torques;
    for (const Meeting& meeting : meetings) {
      const Situation& hold = meeting.situation;
      if (!concerns(device, hold)) continue;
      const double limit = limit_of(meeting, preset_loop(options, device, grips[g].grip, rate));
      (hold.turns() ? torques : forces).add(limit);
      const double theory = hold.turns() ? 0 : linear_limit(handle_of(device), grips[g].grip, 1 / rate);
      csv.print("%s,%g,%s,%s,%s,%s,%.4g,%g,%.4g,%.4g,%.4g\n", named.name.c_str(), rate, grips[g].name, hold.scene.c_str(), hold.name.c_str(),
                unit_of(hold), limit, hold.turns() ? device.rotational_stiffness : device.stiffness,
                hold.turns() ? bounds.rotational_passive : bounds.passive, hold.turns() ? 0.0 : bounds.quantised, theory);
    }
    least.translational[g] = std::isfinite(forces.low) ? forces.low : 0;
    least.rotational[g] = std::isfinite(torques.low) ? torques.low : 0;
  }
  return least;
}

/// From free space to the stiffest wall for a relaxed hand, at 5 Hz, moved by 10 mm each way; friction as the
/// damper that takes as much energy.
void print_width(const DeviceSpecification& device, double rate, double stiffest, demo::TextFile& width) {
  constexpr double pace = 2 * std::numbers::pi * 5, amplitude = 0.010;
  const double damper = device.damping + 4 * device.friction / (std::numbers::pi * amplitude * pace);
  const double lowest = std::hypot(damper, pace * device.apparent_mass);
  const double highest = std::hypot(damper, pace * device.apparent_mass - stiffest / pace);
  width.print("| %s | %g | %.2f | %.0f | %.0f |\n", device.name.c_str(), rate / 1000, lowest, highest, 20 * std::log10(highest / lowest));
}

}  // namespace

void study_limits(const StudyOptions& options) {
  const std::vector<Meeting> meetings = meetings_of(options, holds());
  demo::TextFile csv(options.folder / "limits.csv");
  csv.print("device,rate,grip,scene,situation,unit,limit,preset,passive_2b_T,quantised_2f_D,linear_theory\n");
  demo::TextFile table(options.folder / "limits.md");
  table.print(
      "| device | rate [kHz] | preset | 2b/T | 2f_c/Δ | barely | soft | relaxed | firm | rotations: preset | "
      "barely | soft | relaxed | firm |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  demo::TextFile width(options.folder / "zwidth.md");
  width.print("| device | rate [kHz] | lowest [N·s/m] | highest [N·s/m] | Z-width [dB] |\n|---|---|---|---|---|\n");
  demo::TextFile plot(options.folder / "limits_by_rate.csv");
  plot.print("device,rate,barely,soft,relaxed,firm,passive\n");
  for (const NamedDevice& named : devices_of(options)) {
    const DeviceSpecification& device = named.device;
    for (const double rate : options.rates) {
      const StiffnessLimits bounds = stiffness_limits_of(device, 1 / rate);
      const LeastLimits least = least_limits(options, named, rate, bounds, meetings, csv);
      table.print("| %s | %g | %g | %.0f | %.0f |", device.name.c_str(), rate / 1000, device.stiffness, bounds.passive, bounds.quantised);
      for (const double limit : least.translational) table.print(" %.0f |", limit);
      if (device.pushes_torque()) {
        table.print(" %g |", device.rotational_stiffness);
        for (const double limit : least.rotational) table.print(" %.2g |", limit);
      } else {
        table.print(" – | – | – | – | – |");
      }
      table.print("\n");
      plot.print("%s,%g", named.name.c_str(), rate);
      for (const double limit : least.translational) plot.print(",%.4g", limit);
      plot.print(",%.4g\n", bounds.passive);
      print_width(device, rate, least.translational[2], width);
      say("limits", at_rate(named.name, rate));
    }
  }
  for (demo::TextFile* file : {&csv, &table, &width, &plot}) file->close();
}

}  // namespace feeler::stability
