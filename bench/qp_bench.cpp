// Times every QP solver on every family: cold, warm on consecutive ticks, and with its caches evicted; as a
// table and a plot.
//
// Usage: feeler-qp-bench --out folder. Writes qp.csv, and speed_and_accuracy.svg by gnuplot.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "qp/judge.hpp"
#include "qp/problem_families.hpp"
#include "qp/solvers.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using feeler::qp_families::Judge;
using feeler::qp_families::Verdict;

double nanoseconds_between(Clock::time_point start, Clock::time_point end) {
  return double(std::chrono::duration_cast<std::chrono::nanoseconds>(end - start).count());
}

/// What asking for the time takes by itself [ns].
double clock_overhead() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) {
    const auto start = Clock::now();
    least = std::min(least, nanoseconds_between(start, Clock::now()));
  }
  return least;
}

/// Reads and writes more memory than the caches hold.
class Eviction {
 public:
  void operator()() {
    for (std::size_t i = 0; i < memory_.size(); i += 64) ++memory_[i];
  }

 private:
  std::vector<unsigned char> memory_ = std::vector<unsigned char>(std::size_t(48) << 20);
};

enum class Start { cold, warm, evicted };
constexpr std::array<Start, 3> all_starts{Start::cold, Start::warm, Start::evicted};
constexpr std::array<const char*, 3> start_names{"cold", "warm", "evicted"};

/// Times of the problems of a family, each the median of some rounds over all of them.
template <class Solver>
std::vector<double> microseconds(Solver& solver, const std::vector<feeler::qp_families::Problem>& problems, Start start, int rounds) {
  static const double overhead = clock_overhead();
  static Eviction evict;
  feeler::QpSolution<double> solution;
  std::vector<std::vector<double>> times(problems.size());
  for (int round = 0; round < rounds; ++round) {
    feeler::qp_families::make_cold(solver);
    solution.active.clear();
    for (std::size_t i = 0; i < problems.size(); ++i) {
      if (start != Start::warm) feeler::qp_families::make_cold(solver);
      if (start == Start::evicted) evict();
      const auto begin = Clock::now();
      if constexpr (feeler::qp_families::takes_warm_start<Solver>) {
        solver.solve(problems[i], start == Start::warm ? feeler::WarmStart(solution) : feeler::WarmStart(), solution);
      } else {
        solver.solve(problems[i], solution);
      }
      times[i].push_back(std::max(0.0, nanoseconds_between(begin, Clock::now()) - overhead) / 1000.0);
    }
  }
  std::vector<double> medians;
  for (auto& of_problem : times) {
    std::sort(of_problem.begin(), of_problem.end());
    medians.push_back(of_problem[of_problem.size() / 2]);
  }
  std::sort(medians.begin(), medians.end());
  return medians;
}

double quantile(const std::vector<double>& sorted, double q) {
  return sorted.empty() ? std::numeric_limits<double>::quiet_NaN() : sorted[std::size_t(q * double(sorted.size() - 1) + 0.5)];
}

constexpr const char* script_text =
    "# gnuplot speed_and_accuracy.gp draws this figure again from the files of this folder.\n"
    "set terminal svg size 900,620 enhanced font 'sans-serif,13' background rgb 'white'\n"
    "set output 'speed_and_accuracy.svg'\n"
    "set border 3 lc rgb '#666666'; set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
    "set grid lc rgb '#e6e9ec' lt 1 lw 1; set logscale xy; unset key; set rmargin 4\n"
    "set format x '10^{%L}'; set format y '10^{%L}'; set yrange [1e-18:1e3]; set xrange [0.3:*]\n"
    "set xlabel 'time of a problem, median to 99th percentile  [µs]'\n"
    "set ylabel 'distance from the exact optimum, 90th percentile  [m]'\n"
    "plot 'speed_and_accuracy.dat' using 2:4:2:3 with xerrorbars pt 0 lw 1.4 lc rgb '#9fb8d6', \\\n"
    "  '' using 2:4 with points pt 7 ps 0.9 lc rgb '#2f6db5', \\\n"
    "  '' using 2:4:(sprintf('%s, %.1f %% right', strcol(1), $5)) with labels left rotate by 35 "
    "font ',11' offset 0.4,0.5 tc rgb '#222222'\n";

/// One point of the plot: a solver over all families.
struct Summary {
  std::vector<double> microseconds, distances;
  int problems = 0, right = 0;
};

struct Options {
  int problems = 40, rounds = 9;
  unsigned seed = 1;
  std::string family;
  std::filesystem::path out = "qp-bench";
};

class Bench {
 public:
  explicit Bench(const Options& options) : options_(options), csv_(options.out / "qp.csv") {
    csv_ << "solver,family,start,problems,median_us,p99_us,max_us,undecided,wrong,false_infeasible,median_"
            "distance_m,max_distance_m\n";
  }

  void run(const feeler::qp_families::Family& family, unsigned seed) {
    std::mt19937 bits(seed);
    std::vector<feeler::qp_families::Problem> problems;
    while (int(problems.size()) < options_.problems) family.append(bits, problems);
    std::vector<Judge> judges;
    for (const auto& problem : problems) judges.emplace_back(problem, family.metres_per_unit);
    const auto visit = [&](const auto& named) { time(named, family, problems, judges); };
    feeler::qp_families::for_every_solver(visit);
    feeler::qp_families::for_every_variant(visit);
  }

  /// The middle of each solver over all problems: speed against accuracy.
  bool draw() {
    csv_.close();
    std::ofstream points(options_.out / "speed_and_accuracy.dat");
    for (auto& [solver, summary] : summaries_) {
      std::sort(summary.microseconds.begin(), summary.microseconds.end());
      std::sort(summary.distances.begin(), summary.distances.end());
      points << '"' << solver << "\" " << quantile(summary.microseconds, 0.5) << ' ' << quantile(summary.microseconds, 0.99) << ' '
             << std::max(quantile(summary.distances, 0.9), 1e-17) << ' ' << 100.0 * summary.right / summary.problems << '\n';
    }
    points.close();
    std::ofstream script(options_.out / "speed_and_accuracy.gp");
    script << script_text;
    script.close();
    const std::string command = "cd '" + options_.out.string() + "' && gnuplot speed_and_accuracy.gp";
    return bool(script) && std::system(command.c_str()) == 0;
  }

 private:
  template <class Solver>
  void time(const feeler::qp_families::NamedSolver<Solver>& named, const feeler::qp_families::Family& family,
            const std::vector<feeler::qp_families::Problem>& problems, std::vector<Judge>& judges) {
    const auto solver = named.make(family.metres_per_unit);
    feeler::QpSolution<double> solution;
    std::array<int, 4> verdicts{};
    std::vector<double> distances;
    for (std::size_t i = 0; i < problems.size(); ++i) {
      feeler::qp_families::make_cold(*solver);
      const feeler::QpStatus status = solver->solve(problems[i], solution);
      const Verdict verdict = judges[i].judge(status, solution, named.tolerance());
      ++verdicts[std::size_t(verdict)];
      if (!std::isnan(judges[i].distance())) distances.push_back(judges[i].distance());
    }
    std::sort(distances.begin(), distances.end());
    Summary& summary = summaries_[named.name];
    for (std::size_t start = 0; start < all_starts.size(); ++start) {
      const bool is_warm = all_starts[start] == Start::warm;
      if (is_warm && !(family.is_sequence && feeler::qp_families::has_warm_start<Solver>)) continue;
      const auto times = microseconds(*solver, problems, all_starts[start], options_.rounds);
      if (all_starts[start] == Start::cold) summary.microseconds.insert(summary.microseconds.end(), times.begin(), times.end());
      char line[400];
      std::snprintf(line, sizeof line, "%s,%s,%s,%zu,%.3f,%.3f,%.3f,%d,%d,%d,%.2g,%.2g", named.name.c_str(), family.name.c_str(), start_names[start],
                    problems.size(), quantile(times, 0.5), quantile(times, 0.99), quantile(times, 1.0), verdicts[1], verdicts[2], verdicts[3],
                    quantile(distances, 0.5), quantile(distances, 1.0));
      csv_ << line << '\n';
      std::printf("%s\n", line);
    }
    summary.distances.insert(summary.distances.end(), distances.begin(), distances.end());
    summary.problems += int(problems.size());
    summary.right += verdicts[0];
  }

  Options options_;
  std::ofstream csv_;
  std::map<std::string, Summary> summaries_;
};

int run(const Options& options) {
  const auto& families = feeler::qp_families::all_families();
  if (!options.family.empty() && std::none_of(families.begin(), families.end(), [&](const auto& family) { return family.name == options.family; }))
    throw std::invalid_argument("there is no family " + options.family);
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error || !std::ofstream(options.out / "qp.csv")) throw std::runtime_error("cannot write to " + options.out.string());

  Bench bench(options);
  for (std::size_t i = 0; i < families.size(); ++i) {
    if (options.family.empty() || families[i].name == options.family) bench.run(families[i], options.seed + unsigned(i));
  }
  if (!bench.draw()) std::fprintf(stderr, "feeler-qp-bench: gnuplot did not draw; the figures are in qp.csv\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Times QP solvers on contact problems, and measures how far their answers lie from the exact ones.", "feeler-qp-bench");
  app.add_option("--problems", options.problems, "of each family, at least")->check(feeler::bench::within(1, 100000));
  app.add_option("--rounds", options.rounds, "over the problems of a family; the median counts")->check(feeler::bench::within(1, 1000));
  app.add_option("--seed", options.seed, "of the problems");
  app.add_option("--family", options.family, "only this one");
  app.add_option("--out", options.out, "folder for qp.csv and the plot");
  return feeler::bench::run_with_options(app, argc, argv, [&] { return run(options); });
}
