#include "study/table.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "golden/bits.hpp"
#include "study/commit.hpp"
#include "study/player.hpp"

namespace feeler::study {
namespace {

namespace fs = std::filesystem;

/// Text that stays in its column.
std::string plain(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string start_of_row(int number, const Cell& cell) {
  return std::to_string(number) + "," + cell.scene + "," + cell.motion + "," + cell.rendering + ",";
}

std::string choices(const Cell& cell) {
  char text[160];
  std::snprintf(text, sizeof text, "%g,%d,%d,%d,%g,%g", cell.margin, cell.budget, cell.iterations, cell.rate, cell.scale, cell.offset);
  return text;
}

/// Each value after a comma; nothing where it was not measured.
std::string fields(const char* format, std::initializer_list<double> values) {
  std::string result;
  for (const double value : values) {
    char text[40] = "";
    if (!std::isnan(value)) std::snprintf(text, sizeof text, format, value);
    result += std::string(",") + text;
  }
  return result;
}

std::string results_row(int number, const Cell& cell, const CellFigures& f, const std::string& tail) {
  const Rendering& how = rendering(cell.rendering);
  return start_of_row(number, cell) + how.scalar + "," + how.solver + "," + plain(how.method) + "," + choices(cell) +
         fields("%.0f", {double(f.samples), double(f.samples_without_truth)}) + fields("%.6g", {f.converged}) +
         fields("%.4g", {f.error_median, f.error_99, f.error_most}) + fields("%.0f", {double(f.solver_samples)}) +
         fields("%.4g", {f.solver_error_median, f.solver_error_99}) + fields("%.6g", {f.within_tenth_micrometre, f.within_micrometre}) +
         fields("%.4g", {f.deepest, f.separation, f.force_error_median, f.force_error_99, f.force_jnd_99, f.torque_jnd_99, f.jitter_99, f.lag}) +
         fields("%g", {f.work_median, f.work_99, f.work_most}) + fields("%.0f", {f.operations_median, f.operations_99}) + "," + tail + "," +
         plain(f.refusal);
}

std::string times_row(int number, const Cell& cell, const CellFigures& f, const std::string& tail) {
  return start_of_row(number, cell) + choices(cell) + fields("%.2f", {f.time_median, f.time_99, f.time_999, f.time_most}) + "," + tail;
}

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return plain(line.substr(line.find(':') + 2));
  return "unknown";
}

/// One number for all that makes a study: its cells, their motion and the build.
std::string study_of(const std::vector<Cell>& cells, const Provenance& provenance) {
  char text[80];
  std::snprintf(text, sizeof text, "%.9g/%u/", provenance.seconds, provenance.seed);
  std::string all = text + provenance.commit + "/" + provenance.compiler;
  for (const Cell& cell : cells) all += "\n" + cell.key();
  bench::BitHash hash;
  for (const char letter : all) hash.add(letter);
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}

using Columns = std::vector<const char*>;
const Columns built_and_moved{"seconds", "seed", "commit", "compiler", "study"};

/// In what a row is not of the study of another one, as "seed is 2 and not 1"; nothing where it is.
std::string difference(const Row& row, Row expected, const Columns& columns) {
  for (const std::string column : columns) {
    if (row.at(column) == expected[column]) continue;
    if (column != "study") return column + " is " + row.at(column) + " and not " + expected[column];
    return "the cells, motion or build are others (--scene, --sweep, --rendering, --motion, --only, --quick; the renderings that are compiled in)";
  }
  return "";
}

}  // namespace

Provenance provenance(double seconds, unsigned seed) {
#if defined(__clang__)
  const std::string compiler = std::string("clang ") + __clang_version__;
#elif defined(__GNUC__)
  const std::string compiler = std::string("gcc ") + __VERSION__;
#else
  const std::string compiler = "unknown";
#endif
  return {commit, plain(compiler), processor_name(), seconds, seed};
}

FolderLock::FolderLock(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw std::runtime_error("The folder " + folder.string() + " cannot be made (" + problem.message() + "); give another with --out.");
  file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (file_ < 0)
    throw std::runtime_error("The folder " + folder.string() + " cannot be read (" + std::strerror(errno) + "); give another with --out.");
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    close(file_);
    throw std::runtime_error("Another feeler-study works in the folder " + folder.string() +
                             "; give each shard a folder of its own with --out, and --merge them.");
  }
}
FolderLock::~FolderLock() { close(file_); }

Table::Table(const fs::path& folder, const std::vector<Cell>& cells, const Provenance& provenance) : lock_(folder), folder_(folder) {
  const std::string study = study_of(cells, provenance);
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, "%.9g,%u,%zu,", provenance.seconds, provenance.seed, cells.size());
  results_tail_ = numbers + study + "," + provenance.commit + "," + provenance.compiler + "," + provenance.processor;
  times_tail_ = study + "," + provenance.processor;
  const Row expected = row_of(results_file, results_row(0, cells.front(), {}, results_tail_));
  bool is_cut = false;
  results_ = read_lines(folder, results_file, is_cut);
  times_ = read_lines(folder, times_file, is_cut);
  for (const auto& [kind, lines] : {std::pair(&results_file, &results_), std::pair(&times_file, &times_)})
    for (const auto& [number, line] : *lines) {
      std::string other = difference(row_of(*kind, line), expected, kind == &results_file ? built_and_moved : Columns{"study"});
      if (other.empty()) other = difference(row_of(*kind, line), expected, {"processor"});
      if (other.empty() && (std::size_t(number) >= cells.size() || !line.starts_with(start_of_row(number, cells[std::size_t(number)]))))
        other = "cell " + std::to_string(number) + " is another";
      if (!other.empty())
        throw std::runtime_error("The file " + (folder / kind->name).string() + " holds rows of another study: " + other +
                                 "; give another folder with --out, or remove it.");
    }
  sort();
}

void Table::add(int number, const Cell& cell, const CellFigures& figures) {
  const std::string times = times_row(number, cell, figures, times_tail_), results = results_row(number, cell, figures, results_tail_);
  append_line(folder_, times_file, times);
  append_line(folder_, results_file, results);
  times_[number] = times;
  results_[number] = results;
}

void Table::sort() const {
  write_lines(folder_, results_file, results_);
  write_lines(folder_, times_file, times_);
}

void merge(const std::vector<fs::path>& from, const fs::path& into) {
  Lines results, times;
  Row first;  // of all results
  for (const fs::path& folder : from)
    for (const auto& [kind, all] : {std::pair(&results_file, &results), std::pair(&times_file, &times)}) {
      const std::string file = (folder / kind->name).string();
      std::error_code problem;
      if (!fs::exists(file, problem)) throw std::runtime_error("The file " + file + " is not there: the shard has not run, or elsewhere.");
      bool is_cut = false;
      const Lines part = read_lines(folder, *kind, is_cut);
      if (is_cut) throw std::runtime_error("The file " + file + " was cut short; run its shard again: it goes on from the rows that are there.");
      for (const auto& [number, line] : part) {
        const Row row = row_of(*kind, line);
        if (first.empty() && kind == &results_file) first = row;
        const auto other = difference(row, first, kind == &results_file ? built_and_moved : Columns{"study"});
        if (!other.empty()) throw std::runtime_error("The folders are not of one study: " + other + " in " + file + ".");
        const auto [place, is_new] = all->try_emplace(number, line);
        if (!is_new && place->second != line)
          throw std::runtime_error("Cell " + std::to_string(number) + " is in two of the folders with other figures; run one of the shards once.");
      }
    }
  const int cells = first.empty() ? 1 : std::stoi(first["cells"]);
  for (int i = 0; i < cells; ++i)
    if (!results.contains(i) || !times.contains(i))
      throw std::runtime_error("Cell " + std::to_string(i) + " of " + std::to_string(cells) +
                               " is in none of the folders; a shard is missing, or has not ended.");
  const FolderLock lock(into);
  bool is_cut = false;
  for (const auto& [number, line] : read_lines(into, results_file, is_cut))
    if (const auto found = results.find(number); found == results.end() || found->second != line)
      throw std::runtime_error("The folder " + into.string() + " holds another study; give another with --out.");
  write_lines(into, results_file, results);
  write_lines(into, times_file, times);
}

}  // namespace feeler::study
