// Feeler and its rivals on the same holds and slides.
#include <algorithm>

#include "stability/limit.hpp"
#include "stability/study_text.hpp"
#include "text_file.hpp"

namespace feeler::stability {

void study_rivals(const StudyOptions& options) {
  const std::vector<Meeting> meetings = meetings_of(options, holds());
  demo::TextFile csv(options.folder / "rivals.csv");
  csv.print(
      "device,engine,grip,scene,situation,unit,limit,preset,stable_at_preset,swing_um,turn_mrad,buzz_N,"
      "torque_buzz_Nm\n");
  demo::TextFile table(options.folder / "rivals.md");
  table.print(
      "| engine | grip | stable at the preset | largest stable K, least and most of the holds [N/m] | K_r "
      "[N·m/rad] | largest limit cycle at the preset [µm] | buzz there, largest RMS [mN] |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const NamedDevice& named : devices_of(options, {"premium-3.0"})) {
    for (const Engine engine : all_engines) {
      if (!is_built(engine)) {
        say("rivals", std::string(name_of(engine)) + " is not installed, left out");
        continue;
      }
      for (const NamedGrip& grip : grips_of(options)) {
        Range forces, torques;
        int loops = 0, stable = 0;
        double swing = 0, buzz = 0;
        for (const Meeting& meeting : meetings) {
          const Situation& hold = meeting.situation;
          if (!concerns(named.device, hold)) continue;
          LoopSetup setup = preset_loop(options, named.device, grip.grip, 1000);
          setup.engine = engine;
          const LoopResult at_preset = run_loop(hold, meeting.contact, setup);
          const double limit = limit_of(meeting, setup);
          (hold.turns() ? torques : forces).add(limit);
          ++loops;
          stable += at_preset.is_stable;
          swing = std::max(swing, at_preset.swing_end);
          buzz = std::max(buzz, at_preset.buzz);
          csv.print("%s,%s,%s,%s,%s,%s,%.4g,%g,%d,%.4g,%.4g,%.4g,%.4g\n", named.name.c_str(), name_of(engine), grip.name, hold.scene.c_str(),
                    hold.name.c_str(), unit_of(hold), limit, hold.turns() ? setup.rotational_stiffness : setup.stiffness, int(at_preset.is_stable),
                    1e6 * at_preset.swing_end, 1e3 * at_preset.turn_end, at_preset.buzz, at_preset.torque_buzz);
        }
        table.print("| %s | %s | %d of %d | %.0f to %.0f | %.2g to %.2g | %.3g | %.3g |\n", name_of(engine), grip.name, stable, loops, forces.low,
                    forces.high, torques.low, torques.high, shown(1e6 * swing), 1e3 * buzz);
      }
      say("rivals", named.name + ", " + name_of(engine));
    }
  }
  csv.close();
  table.close();
}

void study_slides(const StudyOptions& options) {
  demo::TextFile csv(options.folder / "slides.csv");
  csv.print("device,engine,rate,grip,scene,situation,buzz_N,torque_buzz_Nm,greatest_force_step_N\n");
  demo::TextFile table(options.folder / "slides.md");
  table.print(
      "| slide | engine | rate [kHz] | buzz, RMS above 50 Hz [mN]: soft | relaxed | firm | largest step of "
      "the force in a tick [mN]: soft | relaxed | firm |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  const std::vector<Meeting> meetings = meetings_of(options, slides());
  for (const NamedDevice& named : devices_of(options, {"premium-3.0"})) {
    for (const Meeting& meeting : meetings) {
      const Situation& slide = meeting.situation;
      for (const Engine engine : all_engines) {
        if (!is_built(engine)) continue;
        for (const double rate : {1000.0, 4000.0}) {
          std::string buzzes, steps;
          for (const NamedGrip& grip : grips) {
            if (grip.name == std::string("barely")) continue;  // it cannot lead the tool along
            LoopSetup setup = preset_loop(options, named.device, grip.grip, rate);
            setup.engine = engine;
            const LoopResult result = run_loop(slide, meeting.contact, setup);
            csv.print("%s,%s,%g,%s,%s,%s,%.4g,%.4g,%.4g\n", named.name.c_str(), name_of(engine), rate, grip.name, slide.scene.c_str(),
                      slide.name.c_str(), result.buzz, result.torque_buzz, result.greatest_force_step);
            buzzes += rounded_cell(1e3 * result.buzz);
            steps += rounded_cell(1e3 * result.greatest_force_step);
          }
          table.print("| %s, %s | %s | %g |%s%s\n", slide.scene.c_str(), slide.name.c_str(), name_of(engine), rate / 1000, buzzes.c_str(),
                      steps.c_str());
        }
      }
      say("slides", slide.scene + ", " + slide.name);
    }
  }
  csv.close();
  table.close();
}

}  // namespace feeler::stability
