// A loop that is linear, against theory; and a loop to look at.
#include <cmath>

#include "stability/limit.hpp"
#include "stability/linear_theory.hpp"
#include "stability/study_text.hpp"
#include "text_file.hpp"

namespace feeler::stability {
namespace {

/// A cube on a wall.
Meeting face_on_wall() {
  const Situation hold = holds().front();
  return {hold, contact_of(hold, scene_named(hold.scene))};
}

}  // namespace

int study_theory(const StudyOptions& options) {
  constexpr double tolerance = 0.07;  // 2 % of the bisection, and the first order of the integration
  demo::TextFile table(options.folder / "theory.md");
  table.print(
      "| grip | rate [kHz] | linear theory [N/m] | simulated [N/m] | difference [%%] "
      "|\n|---|---|---|---|---|\n");
  const Meeting meeting = face_on_wall();
  int disagreements = 0;
  for (const NamedGrip& grip : grips_of(options)) {
    for (const double rate : options.rates) {
      LoopSetup setup = preset_loop(options, phantom_premium_3_0_6dof(), grip.grip, rate);
      setup.has_friction = false;
      setup.device.position_resolution = setup.device.rotation_resolution = 0;
      setup.device.maximum_force = 1e6;  // nothing may bend the loop,
      setup.kick = 0.02;                 // and the tool not leave the wall
      const double theory = linear_limit(handle_of(setup.device), grip.grip, 1 / rate, std::pow(decay_of_a_stable_loop, 1 / window));
      setup.stiffness = theory;
      setup.rotational_stiffness = 1e-4 * theory;
      const double simulated = limit_of(meeting, setup);
      const double difference = simulated / theory - 1;
      if (!(std::abs(difference) <= tolerance)) ++disagreements;
      table.print("| %s | %g | %.0f | %.0f | %.1f |\n", grip.name, rate / 1000, theory, simulated, 100 * difference);
      say("theory", at_rate(grip.name, rate) + ": " + std::to_string(100 * difference) + " %");
    }
  }
  table.close();
  return disagreements;
}

void study_traces(const StudyOptions& options) {
  const Meeting meeting = face_on_wall();
  for (const double share : {0.9, 1.1}) {
    LoopSetup setup = preset_loop(options, phantom_premium_3_0_6dof(), grips[1].grip, 1000);
    setup.stiffness = share * limit_of(meeting, setup);
    demo::TextFile csv(options.folder / (share < 1 ? "trace_below.csv" : "trace_above.csv"));
    csv.print("t,position_mm,force_N,stiffness\n");
    for (const TracePoint& p : run_loop(meeting.situation, meeting.contact, setup, true).trace)
      csv.print("%.6g,%.6g,%.6g,%.4g\n", p.time, 1e3 * p.position, p.force, setup.stiffness);
    csv.close();
  }
}

}  // namespace feeler::stability
