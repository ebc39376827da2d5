#include "fuzz/laws/laws.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <string>

#include "fuzz/laws/budget.hpp"
#include "fuzz/laws/convex_room.hpp"
#include "fuzz/laws/convex_rooms.hpp"
#include "fuzz/laws/flat_plates.hpp"
#include "fuzz/laws/forces.hpp"
#include "fuzz/laws/free_axes.hpp"
#include "fuzz/laws/held_hand.hpp"
#include "fuzz/laws/no_history.hpp"
#include "fuzz/laws/prismatic_fits.hpp"
#include "fuzz/laws/profiles.hpp"
#include "fuzz/laws/status_truth.hpp"

namespace feeler::laws {

namespace {

/// What the runs of one law found together.
struct Tally {
  int runs = 0, refused = 0, broken = 0;
  long ticks = 0;
  double worst = 0;
  std::map<std::string, int> kinds;  ///< broken runs by family and kind
};

/// A law, checked in one scene.
template <class Law, class Tool>
void try_scene(const Law& law, const char* name, unsigned seed, std::mt19937& bits, const LawScene<Tool>& scene, Tally& tally) {
  const LawFinding finding = law(bits, scene);
  ++tally.runs;
  tally.refused += finding.is_refused;
  tally.ticks += finding.ticks;
  tally.worst = std::max(tally.worst, finding.worst);
  if (finding.kind.empty()) return;
  ++tally.broken;
  ++tally.kinds[scene.family + " " + finding.kind];
  std::printf("%s, %s (play %.2g m, margin %.2g m): %s, %s\n  again: feeler-fuzz --law %s --seed %u --trials 1\n", name, scene.family.c_str(),
              scene.play, scene.settings.margin, finding.kind.c_str(), finding.problem.c_str(), name, seed);
}

/// Round fits are apart: what touches all around in one is at rest, but not to the last bit, which some laws ask for. So are profiles, which have
/// folds, and tapers, of which no axis is free.
enum Families : unsigned { fits = 1, plates = 2, flat_plates = 4, rooms = 8, round_fits = 16, profiles = 32, tapers = 64 };

/// @param families  of which scenes are made, pegs twice as often
template <class Law>
int run_law(const std::string& wanted, const char* name, const char* figure, unsigned families, unsigned first, int trials, const Law& law) {
  if (wanted != "all" && wanted != name) return 0;
  Tally tally;
  for (int i = 0; i < trials; ++i) {
    const unsigned seed = first + unsigned(i);
    std::mt19937 bits(seed);
    const auto in = [&](const auto& scene) { try_scene(law, name, seed, bits, scene, tally); };
    for (bool is_made = false; !is_made;) {
      is_made = true;
      const int family = below(bits, 11);
      if (family < 2 && (families & fits) != 0) in(peg_in_hole(bits, "peg", random_section(bits)));
      else if (family == 2 && (families & fits) != 0) in(angle_in_hole(bits));
      else if (family == 3 && (families & fits) != 0) in(boxes_in_slot(bits));
      else if (family == 4 && (families & (plates | flat_plates)) != 0) in(box_on_plate(bits, (families & plates) == 0));
      else if (family == 5 && (families & rooms) != 0) in(ball_in_trough(bits));
      else if (family == 6 && (families & rooms) != 0) in(ball_in_bowl(bits));
      else if (family == 7 && (families & rooms) != 0) in(box_in_box(bits));
      else if (family == 8 && (families & round_fits) != 0) {
        const Section section = round_section(bits);
        if (below(bits, 3) > 0) in(peg_in_hole(bits, "round peg", section));
        else in(taper_in_hole(bits, "round taper", section));
      } else if (family == 9 && (families & profiles) != 0) in(lump_on_profile(bits));
      else if (family == 10 && (families & tapers) != 0) in(taper_in_hole(bits, "taper", random_section(bits)));
      else is_made = false;
    }
  }
  std::printf("%-12s %6d runs %9ld ticks   refused %d   broken %d   worst %.2e %s", name, tally.runs, tally.ticks, tally.refused, tally.broken,
              tally.worst, figure);
  for (const auto& [kind, count] : tally.kinds) std::printf("%s%s %d", kind == tally.kinds.begin()->first ? "   (" : ", ", kind.c_str(), count);
  std::printf("%s\n", tally.kinds.empty() ? "" : ")");
  std::fflush(stdout);
  return tally.broken;
}

}  // namespace

int run_laws(const std::string& law, unsigned first, int trials) {
  int broken = 0;
  const auto run = [&](const char* name, const char* figure, unsigned families, const auto& check) {
    broken += run_law(law, name, figure, families, first, trials, check);
  };
  constexpr unsigned all = fits | round_fits | plates | rooms | profiles | tapers;
  run("free-axes", "m along a free axis", fits | round_fits | plates | profiles,
      [](std::mt19937& bits, const auto& scene) { return check_free_axes(bits, scene); });
  run("held-hand", "times the worth of the margin", all & ~round_fits,
      [](std::mt19937& bits, const auto& scene) { return check_held_hand(bits, scene); });
  run("convex-room", "m off the projection", flat_plates | rooms,
      [](std::mt19937& bits, const auto& scene) { return check_convex_room(bits, scene); });
  run("no-history", "m apart", fits | plates | rooms | tapers, [](std::mt19937& bits, const auto& scene) { return check_no_history(bits, scene); });
  run("forces", "of the force amiss", all, [](std::mt19937& bits, const auto& scene) { return check_forces(bits, scene); });
  run("budget", "times the budget", all, [](std::mt19937& bits, const auto& scene) { return check_budget(bits, scene); });
  run("status", "m off the nearest", all, [](std::mt19937& bits, const auto& scene) { return check_status(bits, scene); });
  return broken;
}

}  // namespace feeler::laws
