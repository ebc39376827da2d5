// The same holds with and without passivity control.
#include <algorithm>

#include "stability/limit.hpp"
#include "stability/study_text.hpp"
#include "text_file.hpp"

namespace feeler::stability {

void study_passivity(const StudyOptions& options) {
  const std::vector<Meeting> meetings = meetings_of(options, holds());
  demo::TextFile table(options.folder / "passivity.md");
  table.print(
      "| device | grip | largest stable K without, least of the holds [N/m] | with passivity control | limit "
      "cycle at twice the least, largest [µm]: without | with |\n|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : devices_of(options, {"premium-3.0"})) {
    for (const NamedGrip& grip : grips_of(options)) {
      double least[2] = {1e9, 1e9}, swing[2] = {0, 0};
      for (const bool is_passive : {false, true}) {
        LoopSetup setup = preset_loop(options, named.device, grip.grip, 1000);
        setup.is_passive = is_passive;
        for (const Meeting& meeting : meetings) {
          if (!meeting.situation.turns()) least[is_passive] = std::min(least[is_passive], limit_of(meeting, setup));
        }
        setup.stiffness = 2 * least[0];
        for (const Meeting& meeting : meetings) {
          if (!meeting.situation.turns())
            swing[is_passive] = std::max(swing[is_passive], run_loop(meeting.situation, meeting.contact, setup).swing_end);
        }
      }
      table.print("| %s | %s | %.0f | %.0f | %.0f | %.0f |\n", named.device.name.c_str(), grip.name, least[0], least[1], 1e6 * swing[0],
                  1e6 * swing[1]);
      say("passivity", named.name + ", " + grip.name);
    }
  }
  table.close();
}

}  // namespace feeler::stability
