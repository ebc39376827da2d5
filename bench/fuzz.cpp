// Renders random objects with random tools, settings and hands, and looks for penetration, crossings and false outputs with a checker
// that shares no code with the library. With --law, scenes of which the nearest pose is known, and the laws that it obeys.
//
// Usage: feeler-fuzz --trials 100, feeler-fuzz --law all --trials 100. Exits with 1 where something was found, after the command that repeats it.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <type_traits>
#include <utility>

#include "command_line.hpp"
#include "fuzz/laws/laws.hpp"
#include "fuzz/random_tool.hpp"
#include "fuzz/trial.hpp"

namespace {

using namespace feeler;

class Fuzzer {
 public:
  Fuzzer(unsigned first, int trials, int ticks, std::string wanted) : first_(first), trials_(trials), ticks_(ticks), wanted_(std::move(wanted)) {}

  /// @param make  a tool from random bits
  template <class Make>
  void run(const char* name, const Make& make) {
    if (wanted_ != "all" && wanted_ != name) return;
    long ticks = 0;
    double deepest = 0;
    int found = 0;
    for (int i = 0; i < trials_; ++i) {
      const unsigned seed = first_ + unsigned(i);
      std::mt19937 bits(seed);
      const auto tool = make(bits);
      const fuzz::Finding finding = fuzz::Trial<std::remove_const_t<decltype(tool)>>(bits, tool).run(ticks_);
      ticks += finding.ticks;
      deepest = std::max(deepest, finding.deepest);
      if (finding.problem.empty()) continue;
      ++found;
      std::printf("%s: %s\n  again: feeler-fuzz --tool %s --seed %u --trials 1 --ticks %d\n", name, finding.problem.c_str(), name, seed, ticks_);
    }
    std::printf("%-13s %6d trials %9ld ticks   deepest %.1e m   found %d\n", name, trials_, ticks, deepest, found);
    std::fflush(stdout);
    found_ += found;
  }
  int found() const { return found_; }

 private:
  unsigned first_;
  int trials_, ticks_;
  std::string wanted_;
  int found_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  unsigned seed = 0;
  int trials = 20, ticks = 300;
  std::string tool = "all", law;
  CLI::App app("feeler-fuzz: random objects, tools, settings and hands, watched by the checker", "feeler-fuzz");
  const auto* const seed_option = app.add_option("--seed", seed, "of the first trial, the next ones count on; new each run unless given");
  app.add_option("--trials", trials, "for each kind of tool, or for each law")->check(feeler::bench::within(1, 1'000'000));
  app.add_option("--ticks", ticks, "a trial")->check(feeler::bench::within(1, 1'000'000));
  app.add_option("--tool", tool, "all, or one kind")
      ->check(CLI::IsMember({"all", "point", "segment", "box", "polytope", "sphere", "capsule", "rounded-box", "rounded-hull", "compound"}));
  app.add_option("--law", law, "of the nearest pose: all, or one; in place of tools")
      ->check(CLI::IsMember({"all", "free-axes", "held-hand", "convex-room", "no-history", "forces", "status", "budget"}));
  return bench::run_with_options(app, argc, argv, [&] {
    if (seed_option->empty()) seed = std::random_device{}();
    std::printf("first seed %u\n", seed);
    if (!law.empty()) return laws::run_laws(law, seed, trials) > 0 ? 1 : 0;
    Fuzzer fuzzer(seed, trials, ticks, tool);
    fuzzer.run("point", [](std::mt19937&) { return Point<double>(); });
    fuzzer.run("segment", fuzz::random_segment);
    fuzzer.run("box", fuzz::random_box);
    fuzzer.run("polytope", [](std::mt19937& bits) { return fuzz::random_polytope(bits); });
    fuzzer.run("sphere", [](std::mt19937& bits) { return fuzz::random_swept(bits, Point<double>()); });
    fuzzer.run("capsule", [](std::mt19937& bits) { return fuzz::random_swept(bits, fuzz::random_segment(bits)); });
    fuzzer.run("rounded-box", [](std::mt19937& bits) { return fuzz::random_swept(bits, fuzz::random_box(bits)); });
    fuzzer.run("rounded-hull", [](std::mt19937& bits) { return fuzz::random_swept(bits, fuzz::random_polytope(bits)); });
    fuzzer.run("compound", fuzz::random_compound);
    return fuzzer.found() > 0 ? 1 : 0;
  });
}
