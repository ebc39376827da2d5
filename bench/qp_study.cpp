// Counts the wrong and the undecided answers of every QP solver on fresh problems of every family, by an
// exact solver.
//
// Usage: feeler-qp-study --problems 100000 --seed 7. Exits with 1 where the default solver is not right.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "qp/judge.hpp"
#include "qp/problem_families.hpp"
#include "qp/solvers.hpp"

namespace {

using feeler::qp_families::Judge;
using feeler::qp_families::Verdict;

/// How often each verdict was given, and how far right answers lie from the exact optimum.
struct Tally {
  std::array<int, 4> verdicts{};
  double farthest = 0;

  void count(Verdict verdict, double distance) {
    ++verdicts[std::size_t(verdict)];
    if (verdict == Verdict::right && distance > farthest) farthest = distance;
  }
  int times(Verdict verdict) const { return verdicts[std::size_t(verdict)]; }
};

class Study {
 public:
  void run(const feeler::qp_families::Family& family, int count, unsigned seed) {
    std::mt19937 bits(seed);
    std::vector<feeler::qp_families::Problem> problems;
    for (int done = 0; done < count;) {
      problems.clear();
      family.append(bits, problems);
      for (const auto& problem : problems) {
        if (done++ == count) break;
        Judge judge(problem, family.metres_per_unit);
        feeler::qp_families::for_every_solver([&](const auto& named) {
          const auto solver = named.make(family.metres_per_unit);
          feeler::QpSolution<double> solution;
          const feeler::QpStatus status = solver->solve(problem, solution);
          const Verdict verdict = judge.judge(status, solution, named.tolerance());
          tallies_[named.name][family.name].count(verdict, judge.distance());
        });
      }
    }
  }

  /// A line a solver, and below it a line for each family where it is not always right.
  void print() const {
    std::printf("%-24s %9s %9s %9s %9s   %s\n", "", "right", "undecided", "wrong", "false inf", "farthest right answer [m]");
    feeler::qp_families::for_every_solver([&](const auto& named) {
      Tally all;
      for (const auto& [family, tally] : tallies_.at(named.name)) {
        for (std::size_t i = 0; i < 4; ++i) all.verdicts[i] += tally.verdicts[i];
        all.farthest = std::max(all.farthest, tally.farthest);
      }
      print_line(named.name, all);
      for (const auto& [family, tally] : tallies_.at(named.name)) {
        if (tally.times(Verdict::right) < tally.verdicts[0] + tally.verdicts[1] + tally.verdicts[2] + tally.verdicts[3])
          print_line("  " + family, tally);
      }
    });
  }

  bool is_right(const std::string& solver) const {
    const auto& families = tallies_.at(solver);
    return std::all_of(families.begin(), families.end(),
                       [](const auto& entry) { return entry.second.verdicts[1] + entry.second.verdicts[2] + entry.second.verdicts[3] == 0; });
  }

 private:
  static void print_line(const std::string& name, const Tally& tally) {
    std::printf("%-24s %9d %9d %9d %9d   %.2g\n", name.c_str(), tally.times(Verdict::right), tally.times(Verdict::undecided),
                tally.times(Verdict::wrong), tally.times(Verdict::falsely_infeasible), tally.farthest);
  }

  std::map<std::string, std::map<std::string, Tally>> tallies_;
};

}  // namespace

int main(int argc, char** argv) {
  int problems = 1000;
  unsigned seed = std::random_device()();
  CLI::App app("Counts wrong answers of QP solvers on fresh contact problems, judged in exact arithmetic.", "feeler-qp-study");
  app.add_option("--problems", problems, "how many, over all families")->check(feeler::bench::within(1, 100000000));
  app.add_option("--seed", seed, "of the problems; a new one each run unless given");

  return feeler::bench::run_with_options(app, argc, argv, [&] {
    const auto& families = feeler::qp_families::all_families();
    const int each = (problems + int(families.size()) - 1) / int(families.size());
    std::printf("%d problems of each of %zu families, seed %u, judged by %s\n", each, families.size(), seed,
                feeler::qp_families::exact_solver_name());
    Study study;
    for (std::size_t i = 0; i < families.size(); ++i) study.run(families[i], each, seed + unsigned(i));
    study.print();
    return study.is_right("DualActiveSet") ? 0 : 1;
  });
}
