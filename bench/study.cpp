// The study of accuracy and speed: every scene with every choice, measured against the rigid problem solved in 50 digits.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include <CLI/CLI.hpp>

#include "command_line.hpp"
#include "study/figures.hpp"
#include "study/figures_of_cell.hpp"
#include "study/proof.hpp"
#include "study/scenes.hpp"
#include "study/sweeps.hpp"
#include "study/table.hpp"
#include "study/tables.hpp"

namespace {

using namespace feeler::study;

struct Options {
  Selection selection;
  std::filesystem::path out = "out/study";
  double seconds = 0;  // of the motion; 0: 2, and 0.5 of a quick one
  unsigned seed = 1;
  int shard = 1, shards = 1;
  std::vector<std::string> merged;
  int proofs = 0;
  bool is_listed = false, draws = true, draws_only = false, prints_tables = false;
};

/// "2/8" as numbers.
void read_shard(const std::string& text, Options& options) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%6d/%6d%n", &options.shard, &options.shards, &end) != 2 || std::size_t(end) != text.size() || options.shard < 1 ||
      options.shard > options.shards)
    throw std::invalid_argument("--shard is " + text + "; give one of so many, such as 2/8.");
}

/// One line on the standard error: where the study is and how long it will take.
class Progress {
 public:
  explicit Progress(int total) : total_(total), is_screen_(isatty(STDERR_FILENO) != 0) {}
  void say(int done, const std::string& key) {
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const int left = done > 0 ? int(elapsed / done * (total_ - done)) : 0;
    char text[60] = "";  // nothing is known before the first cell has ended
    if (done > 0) std::snprintf(text, sizeof text, " %d:%02d left", left / 60, left % 60);
    if (is_screen_) {
      std::fprintf(stderr, "\r\033[K[%d/%d]%s  %.90s", done, total_, text, key.c_str());
    } else if (total_ >= 100 && done * 20 / total_ != told_) {
      told_ = done * 20 / total_;
      std::fprintf(stderr, "[%d/%d]%s\n", done, total_, text);
    }
  }
  void end() const {
    if (is_screen_) std::fprintf(stderr, "\r\033[K");
  }

 private:
  int total_, told_ = -1;
  bool is_screen_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int list(const std::vector<Cell>& cells, const std::vector<int>& chosen) {
  std::printf("renderings:\n");
  for (const auto& rendering : renderings())
    std::printf("  %-16s %s, %s, %s\n", rendering.name.c_str(), rendering.scalar.c_str(), rendering.solver.c_str(), rendering.method.c_str());
  std::printf("motions:\n");
  for (const auto& motion : motions()) std::printf("  %-16s %g times as fast, tremor of %g m\n", motion.name.c_str(), motion.speed, motion.tremor);
  std::printf("sweeps:\n");
  for (const auto& sweep : sweeps()) std::printf("  %-16s %s\n", sweep.name.c_str(), sweep.question.c_str());
  std::printf("cells:\n");
  for (const int i : chosen) std::printf("  %4d %s\n", i, cells[std::size_t(i)].key().c_str());
  return 0;
}

/// @return the number of figures
std::size_t draw(const std::filesystem::path& folder) {
  const auto names = draw_figures(folder);
  for (const auto& name : names) std::printf("%s\n", (folder / (name + ".svg")).c_str());
  return names.size();
}

int study(const Options& options) {
  const auto cells = cells_of(options.selection);
  const std::vector<int> groups = groups_of(cells);
  std::vector<int> chosen;
  for (int i = 0; i < int(cells.size()); ++i)
    if (groups[std::size_t(i)] % options.shards == options.shard - 1) chosen.push_back(i);
  if (options.is_listed) return list(cells, chosen);
  const double seconds = options.seconds > 0 ? options.seconds : options.selection.is_quick ? 0.5 : 2;
  Table table(options.out, cells, provenance(seconds, options.seed));
  std::vector<int> todo = chosen;
  std::erase_if(todo, [&](int i) { return table.has(i); });
  TruthPaths paths(seconds);
  Progress progress(int(todo.size()));
  for (std::size_t i = 0; i < todo.size(); ++i) {
    const Cell& cell = cells[std::size_t(todo[i])];
    progress.say(int(i), cell.key());
    table.add(todo[i], cell, figures_of(cell, seconds, options.seed, paths));
  }
  progress.end();
  table.sort();
  std::printf("%s: %zu cells measured, %zu were there\n", (options.out / results_file.name).c_str(), todo.size(), chosen.size() - todo.size());
  if (options.draws && options.shards == 1) draw(options.out);
  return 0;
}

/// @return 1 where the truth is not proved
int prove(const Options& options) {
  const ProofFigures figures = prove_truth(options.proofs, options.seed, options.selection.scenes);
  std::printf("cells %d, with a minimum %d, in contact %d\n", figures.asked, figures.found, figures.in_contact);
  std::printf("changed by two more steps of Newton's method: %.2g m at most; last step %.2g m; least curvature %.2g\n", figures.tightened,
              figures.last_step, figures.least_curvature);
  std::printf("minima that penetrate, by the checker: %d; poses tried that are nearer to the hand: %d; free: %d\n", figures.deep, figures.searched,
              figures.better);
  std::printf("scenes with a closed form: %d; off it: %.2g m at most\n", figures.formulas, figures.off_formulas);
  // Where the search fails there is no truth; that may be rare, and no more.
  return figures.found * 10 >= figures.asked * 9 && figures.in_contact > 0 && figures.deep == 0 && figures.tightened < 1e-20 && figures.better == 0 &&
                 figures.off_formulas < 1e-20
             ? 0
             : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a sentence, not an end
  Options options;
  std::string shard;
  CLI::App app("feeler-study: what accuracy costs, and what speed: every cell measured against the rigid problem solved in 50 digits",
               "feeler-study");
  app.add_option("--scene", options.selection.scenes, "scenes, by name; all where not given")->delimiter(',');
  app.add_option("--motion", options.selection.motions, "how the hand goes along the scene's motion, by name; all where not given")->delimiter(',');
  app.add_option("--sweep", options.selection.sweeps, "what is varied, by name; everything where not given")->delimiter(',');
  app.add_option("--rendering", options.selection.renderings, "scalar, QP solver and contact method, by name; all where not given")->delimiter(',');
  app.add_option("--only", options.selection.only, "values of margin, budget, iterations, rate, scale or offset, such as margin=1e-6,1e-5 rate=1000");
  app.add_flag("--quick", options.selection.is_quick, "few values, few scenes and half a second: under two minutes");
  app.add_flag("--list", options.is_listed, "name renderings, motions, sweeps and the cells of the selection, and end");
  app.add_option("--out", options.out, "folder of study.csv, study_times.csv and the figures; what is there is gone on with");
  app.add_option("--seconds", options.seconds, "length of the motion")->check(feeler::bench::within(0.1, 1000.0));
  app.add_option("--seed", options.seed, "of how generated surfaces are cut");
  app.add_option("--shard", shard, "one part of several, such as 2/8: every eighth truth from the second on, and its cells");
  app.add_option("--merge", options.merged, "folders of shards to make one of, in --out; nothing is measured");
  app.add_flag("!--no-figures", options.draws, "draw nothing");
  app.add_flag("--figures", options.draws_only, "draw the figures of --out again, and measure nothing");
  app.add_flag("--tables", options.prints_tables, "print what --out holds as tables in Markdown, and measure nothing");
  app.add_option("--prove", options.proofs, "test the truth itself on so many random cells, and measure nothing")
      ->check(feeler::bench::within(1, 1'000'000));
  return feeler::bench::run_with_options(app, argc, argv, [&] {
    if (app.count("--shard") > 0) read_shard(shard, options);
    if (options.proofs > 0) return prove(options);
    if (!options.merged.empty()) merge({options.merged.begin(), options.merged.end()}, options.out);
    if (options.prints_tables) std::fputs(markdown_tables(options.out).c_str(), stdout);
    if (options.prints_tables || options.draws_only || !options.merged.empty()) {
      const bool draws = options.draws_only || (options.draws && !options.prints_tables);
      if (draws && draw(options.out) == 0 && options.draws_only)
        throw std::runtime_error("the rows of " + (options.out / results_file.name).string() + " do not vary what a figure shows");
      return 0;
    }
    return study(options);
  });
}
