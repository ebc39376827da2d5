// The battery of extremes as a table, and a soak: what holds at the ends of what a renderer may be given.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include <CLI/CLI.hpp>

#include "command_line.hpp"
#include "extremes/trial.hpp"
#include "study/figures_of_cell.hpp"
#include "support/penetration_checker.hpp"
#include "times.hpp"

namespace {

using namespace feeler;
using namespace feeler::extremes;

struct Options {
  std::vector<std::string> groups;
  std::vector<std::string> renderings;
  long soak = 0;
  bool is_markdown = false;
};

std::string length(double metres) {
  char text[40];
  if (metres < 0) return "–";
  if (metres == 0) return "0";
  std::snprintf(text, sizeof text, "%.0e", metres);
  return text;
}

std::string outcome_of(const Case& one, const Finding& finding) {
  if (!finding.fault.empty()) return "FAILS: " + finding.fault;
  if (!finding.refusal.empty()) {
    const auto start = finding.refusal.find(": ") == std::string::npos ? 0 : finding.refusal.find(": ") + 2;
    return "refused: " + finding.refusal.substr(start, finding.refusal.find(';', start) - start);  // the reason; then comes advice
  }
  return finding.is_at_rest ? "at rest" : "free" + (one.remark.empty() ? "" : ": " + one.remark);
}

void print(const Case& one, const std::string& scalar, const Finding& finding) {
  const bool is_rendered = finding.refusal.empty();
  std::printf("%-20s %-40s %-12s %9s %9s %5.0f %8.1f  %s\n", one.group.c_str(), one.name.c_str(), scalar.c_str(),
              is_rendered ? length(finding.deepest).c_str() : "–", is_rendered ? length(finding.distance).c_str() : "–", 100 * finding.converged,
              finding.microseconds, outcome_of(one, finding).c_str());
  std::fflush(stdout);
}

void print_markdown_head(const std::vector<std::string>& renderings) {
  std::string head = "| what | case | deepest [m] |", rule = "|---|---|---|";
  for (const auto& rendering : renderings) head += " off, `" + study::rendering(rendering).scalar + "` [m] |", rule += "---|";
  std::printf("%s converged %% | median µs | in the end |\n%s---|---|---|\n", head.c_str(), rule.c_str());
}

/// One line a case: the deepest of all scalars; share and time of the first that renders it; outcomes, where they differ by scalar.
void print_markdown(const Case& one, const std::vector<std::string>& renderings, const std::vector<Finding>& findings) {
  const auto first = std::find_if(findings.begin(), findings.end(), [](const Finding& finding) { return finding.refusal.empty(); });
  std::string line = "| " + one.group + " | " + one.name + " | ", outcomes = outcome_of(one, findings.front());
  double deepest = 0;
  bool is_same = true;
  for (const Finding& finding : findings) {
    deepest = std::max(deepest, finding.deepest);
    is_same = is_same && outcome_of(one, finding) == outcomes;
  }
  line += (first == findings.end() ? "–" : length(deepest)) + " |";
  for (const Finding& finding : findings) line += " " + (finding.refusal.empty() ? length(finding.distance) : "–") + " |";
  if (!is_same) {
    outcomes.clear();
    for (std::size_t i = 0; i < findings.size(); ++i)
      outcomes += (i > 0 ? "; `" : "`") + study::rendering(renderings[i]).scalar + "` " + outcome_of(one, findings[i]);
  }
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, first == findings.end() ? " – | – |" : " %.0f | %.0f |",
                first == findings.end() ? 0 : 100 * first->converged, first == findings.end() ? 0 : first->microseconds);
  std::printf("%s%s %s |\n", line.c_str(), numbers, outcomes.c_str());
  std::fflush(stdout);
}

/// @return 1 where a case is not as expected
int run_battery(const Options& options) {
  const auto is_among = [](const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
  };
  std::vector<std::string> groups;
  for (const Case& one : cases())
    if (groups.empty() || groups.back() != one.group) groups.push_back(one.group);
  for (const auto& group : options.groups) {
    if (std::find(groups.begin(), groups.end(), group) != groups.end()) continue;
    std::string text = "There is no group " + group + "; there are:";
    for (const auto& known : groups) text += " '" + known + "'";
    throw std::invalid_argument(text);
  }
  std::vector<std::string> chosen = options.renderings;
  if (chosen.empty())
    for (const auto& rendering : study::renderings())
      if (rendering.name == "double" || rendering.name == "float" || rendering.name == "long_double") chosen.push_back(rendering.name);
  for (const auto& name : chosen) study::rendering(name);
  if (options.is_markdown) {
    print_markdown_head(chosen);
  } else {
    std::printf("%-20s %-40s %-12s %9s %9s %5s %8s  %s\n", "what", "case", "scalar", "deepest", "off", "conv%", "µs", "outcome");
  }
  int failed = 0, count = 0;
  for (const Case& one : cases()) {
    if (!is_among(options.groups, one.group)) continue;
    std::vector<Finding> findings;
    for (const auto& rendering : chosen) {
      const Finding& finding = findings.emplace_back(try_case(one, rendering));
      ++count;
      failed += !finding.fault.empty();
      if (!options.is_markdown) print(one, study::rendering(rendering).scalar, finding);
    }
    if (options.is_markdown) print_markdown(one, chosen, findings);
  }
  std::printf("%s%d of %d as expected\n", options.is_markdown ? "\n" : "", count - failed, count);
  return failed == 0 ? 0 : 1;
}

/// Memory that the process holds [kB].
long memory() {
  std::ifstream in("/proc/self/statm");
  long all = 0, resident = 0;
  in >> all >> resident;
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

/// Ticks in a row on a few scenes, one motion again and again. Drift is how far the pose at one place of the motion is from what it was the first time there.
/// @return 1 where something penetrates, drifts or grows
int soak(long ticks) {
  int result = 0;
  for (const char* name : {"cavity_1mm", "wedge_4", "sulcus", "bore_24"}) {
    const study::Cell cell{.scene = name};
    const auto scene = study::make_scene(cell, 1);
    const auto player = study::rendering("double").make(scene, cell);
    if (player->reset(scene.start) != TickStatus::converged) throw std::runtime_error("the scene starts in penetration");
    const test::CheckedObject object(scene.vertices, scene.triangles);
    const auto tool = test::checked_tool(ConvexPolytope<double>::hull_of(scene.pieces.front()));
    constexpr long lap = 4000;
    // To and fro, so that each lap starts where the last one ended.
    const auto hand = [&](long k) { return scene.motion(1e-3 * double(k < lap / 2 ? k : lap - k)); };
    Pose<study::Wide> first;
    double drift = 0, deepest = 0;
    long converged = 0, grown = 0, start = 0;
    const long count = std::max(ticks / 4, 4 * lap) / lap * lap;
    constexpr long every = 64;  // ticks of which the time is kept; in memory that is there from the start
    std::vector<double> times(std::size_t(count / every + 1), 0);
    for (long k = 0; k < count; ++k) {
      const auto reading = player->update(hand(k % lap));
      converged += reading.status == TickStatus::converged;
      if (k % every == 0) times[std::size_t(k / every)] = reading.microseconds;
      if (k % lap != lap - 1) continue;
      // At the end of a lap the hand is held, so that the pose is the nearest.
      auto rest = reading;
      for (int i = 0; i < 100 && !(rest.status == TickStatus::converged && rest.is_at_rest); ++i) rest = player->update(hand(lap - 1));
      if (k == lap - 1) first = rest.pose, start = memory();
      drift = std::max(drift, double((rest.pose.translation - first.translation).norm()));
      deepest = std::max(deepest, double(test::deepest_penetration(object, tool, test::checked_pose(rest.pose)).depth));
      if (k == count / 2 / lap * lap + lap - 1) start = memory();
      grown = memory() - start;
    }
    const auto tenth = times.begin() + std::ptrdiff_t(times.size() / 10);
    std::printf(
        "%-12s %9ld ticks, converged %.2f %%, drift %.1e m, deepest %g m, memory %+ld kB in the second half, median %.1f µs at first and %.1f µs then\n",
        name, count, 100.0 * double(converged) / double(count), drift, deepest, grown, bench::quantile({times.begin(), tenth}, 0.5),
        bench::quantile({tenth, times.end()}, 0.5));
    std::fflush(stdout);
    constexpr long most_growth = 1024;  // [kB]
    if (deepest > 0 || drift > 1e-7 || grown > most_growth) result = 1;
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("feeler-extremes: what holds at the ends of what a renderer may be given", "feeler-extremes");
  app.add_option("--group", options.groups, "groups of cases; all where not given")->delimiter(',');
  app.add_option("--scalar", options.renderings, "float, double or long_double, as far as compiled in; all where not given")->delimiter(',');
  app.add_flag("--markdown", options.is_markdown, "the table of docs/extremes.md");
  app.add_option("--soak", options.soak, "run so many ticks in a row instead, and watch drift and memory")
      ->check(feeler::bench::within(1L, 10'000'000'000L));
  return bench::run_with_options(app, argc, argv, [&] { return options.soak > 0 ? soak(options.soak) : run_battery(options); });
}
