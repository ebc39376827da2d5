// A servo loop at 4 kHz over a renderer at 1 kHz, with and without the derivative of the wrench.
#include <algorithm>

#include "stability/limit.hpp"
#include "stability/study_text.hpp"
#include "text_file.hpp"

namespace feeler::stability {
namespace {

struct Host {
  const char* name;
  double rate;
  Handover handover;
  int divider, latency;
};
constexpr Host hosts[] = {{"1 kHz", 1000, Handover::direct, 1, 0},
                          {"4 kHz, renderer at 1 kHz, held, 1 tick late", 4000, Handover::held, 4, 1},
                          {"4 kHz, renderer at 1 kHz, held, 4 ticks late", 4000, Handover::held, 4, 4},
                          {"4 kHz, renderer at 1 kHz, extrapolated, 1 tick late", 4000, Handover::extrapolated, 4, 1},
                          {"4 kHz, renderer at 1 kHz, extrapolated, 4 ticks late", 4000, Handover::extrapolated, 4, 4},
                          {"4 kHz", 4000, Handover::direct, 1, 0}};

}  // namespace

void study_extrapolation(const StudyOptions& options) {
  const std::vector<Meeting> meetings = meetings_of(options, holds());
  demo::TextFile csv(options.folder / "extrapolation.csv");
  csv.print("device,host,grip,scene,situation,unit,limit\n");
  demo::TextFile table(options.folder / "extrapolation.md");
  table.print(
      "| device | host | K, least of the holds [N/m]: barely | soft | relaxed | firm | K, median of the "
      "holds: barely | soft | relaxed | firm |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : devices_of(options, {"premium-3.0", "sigma.7"})) {
    for (const Host& host : hosts) {
      table.print("| %s | %s |", named.device.name.c_str(), host.name);
      std::string medians;
      for (const NamedGrip& grip : grips) {
        std::vector<double> limits;
        for (const Meeting& meeting : meetings) {
          const Situation& hold = meeting.situation;
          if (!is_wanted(options, grip) || !concerns(named.device, hold)) continue;
          LoopSetup setup = preset_loop(options, named.device, grip.grip, host.rate);
          setup.handover = host.handover;
          setup.divider = host.divider;
          setup.latency = host.latency;
          const double limit = limit_of(meeting, setup);
          if (!hold.turns()) limits.push_back(limit);
          csv.print("%s,\"%s\",%s,%s,%s,%s,%.4g\n", named.name.c_str(), host.name, grip.name, hold.scene.c_str(), hold.name.c_str(), unit_of(hold),
                    limit);
        }
        std::sort(limits.begin(), limits.end());
        table.print(" %.0f |", limits.empty() ? 0.0 : limits.front());
        medians += rounded_cell(limits.empty() ? 0.0 : limits[limits.size() / 2]);
      }
      table.print("%s\n", medians.c_str());
      say("extrapolation", named.name + ", " + host.name);
    }
  }
  csv.close();
  table.close();
}

}  // namespace feeler::stability
