#include "study/table.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "study/commit.hpp"
#include "study/player.hpp"

namespace feeler::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* results_head =
    "cell,scene,rendering,scalar,solver,method,margin_m,budget,iterations,rate_hz,scale,offset_m,samples,samples_without_truth,converged,error_median_m,error_p99_m,"
    "error_most_m,solver_samples,solver_error_median_m,solver_error_p99_m,within_0.1um,within_1um,deepest_m,separation_m,force_error_median_n,force_error_p99_n,force_jnd_p99,torque_jnd_p99,jitter_p99_n,lag_s,work_median,"
    "work_p99,work_most,operations_median,operations_p99,seconds,seed,cells,commit,compiler,processor,refused";
constexpr const char* times_head =
    "cell,scene,rendering,margin_m,budget,iterations,rate_hz,scale,offset_m,time_median_us,time_p99_us,time_p99.9_us,time_most_us,processor";

/// Text that stays in its column.
std::string plain(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string choices(const Cell& cell) {
  char text[160];
  std::snprintf(text, sizeof text, "%g,%d,%d,%d,%g,%g", cell.margin, cell.budget, cell.iterations, cell.rate, cell.scale, cell.offset);
  return text;
}

std::string results_row(int number, const Cell& cell, const CellFigures& f, const std::string& tail) {
  const Rendering& how = rendering(cell.rendering);
  char text[600], operations[60] = ",,";
  if (f.operations_99 > 0) std::snprintf(operations, sizeof operations, "%.0f,%.0f,", f.operations_median, f.operations_99);
  std::snprintf(text, sizeof text, ",%d,%d,%.6g,%.4g,%.4g,%.4g,%d,%.4g,%.4g,%.6g,%.6g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%g,%g,%g,", f.samples,
                f.samples_without_truth, f.converged, f.error_median, f.error_99, f.error_most, f.solver_samples, f.solver_error_median,
                f.solver_error_99, f.within_tenth_micrometre, f.within_micrometre, f.deepest, f.separation, f.force_error_median, f.force_error_99,
                f.force_jnd_99, f.torque_jnd_99, f.jitter_99, f.lag, f.work_median, f.work_99, f.work_most);
  return std::to_string(number) + "," + cell.scene + "," + how.name + "," + how.scalar + "," + how.solver + "," + plain(how.method) + "," +
         choices(cell) + text + operations + tail + "," + plain(f.refusal);
}

std::string times_row(int number, const Cell& cell, const CellFigures& f, const std::string& processor) {
  char text[160];
  std::snprintf(text, sizeof text, ",%.2f,%.2f,%.2f,%.2f,", f.time_median, f.time_99, f.time_999, f.time_most);
  return std::to_string(number) + "," + cell.scene + "," + cell.rendering + "," + choices(cell) + text + processor;
}

[[noreturn]] void fail_to_write(const fs::path& file) {
  throw std::runtime_error("The file " + file.string() + " cannot be written (" + std::strerror(errno) +
                           "); make room or give another folder, and run again: it goes on from the rows that are there.");
}

void write_whole(const fs::path& file, const char* head, const std::map<int, std::string>& rows) {
  const fs::path fresh = file.string() + ".new";
  {
    std::ofstream out(fresh, std::ios::binary);
    out << head << '\n';
    for (const auto& [number, row] : rows) out << row << '\n';
    out.close();
    if (!out) fail_to_write(fresh);
  }
  fs::rename(fresh, file);
}

void append(const fs::path& file, const std::string& row) {
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << row << '\n';
  out.close();
  if (!out) fail_to_write(file);
}

std::size_t columns(const std::string& row) { return std::size_t(std::count(row.begin(), row.end(), ',')); }

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::stringstream text(line);
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

/// A column of a row of results.
std::string value_of(const std::string& row, const std::string& column) {
  const auto names = split(results_head), values = split(row);
  const auto at = std::size_t(std::find(names.begin(), names.end(), column) - names.begin());
  return at < values.size() ? values[at] : "";
}

/// Whole rows of a file, by number; nothing where there is no file. `is_cut`: whether the last was not whole.
std::map<int, std::string> whole_rows(const fs::path& file, const char* head, bool& is_cut) {
  std::map<int, std::string> rows;
  is_cut = false;
  if (!fs::exists(file)) return rows;
  if (!fs::is_regular_file(file)) throw std::runtime_error("The file " + file.string() + " is not a file of rows; give another folder with --out.");
  if (fs::file_size(file) == 0) return rows;
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("The file " + file.string() + " cannot be read; check its rights.");
  std::string line;
  if (!std::getline(text, line) || line != head) {
    if (text.eof() && std::string(head).starts_with(line)) return is_cut = true, rows;
    throw std::runtime_error("The file " + file.string() +
                             " is not of this program: its first line names other columns; give another folder with --out.");
  }
  while (std::getline(text, line)) {
    if (text.eof() || columns(line) != columns(head)) {
      is_cut = true;  // what follows a row that was cut short is whole again
      continue;
    }
    rows[std::atoi(line.c_str())] = line;
  }
  return rows;
}

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return plain(line.substr(line.find(':') + 2));
  return "unknown";
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
  char numbers[80];
  std::snprintf(numbers, sizeof numbers, "%.9g,%u,%zu,", provenance.seconds, provenance.seed, cells.size());
  tail_ = numbers + provenance.commit + "," + provenance.compiler + "," + provenance.processor;
  bool is_cut = false, are_times_cut = false;
  results_ = whole_rows(folder / results_name, results_head, is_cut);
  times_ = whole_rows(folder / times_name, times_head, are_times_cut);
  for (const auto& [number, row] : results_) {
    const bool is_known = number >= 0 && std::size_t(number) < cells.size();
    const Cell& cell = cells[is_known ? std::size_t(number) : 0];
    if (!is_known || row.find("," + tail_ + ",") == std::string::npos ||
        row.find("," + cell.scene + "," + cell.rendering + ",") == std::string::npos || row.find("," + choices(cell) + ",") == std::string::npos)
      throw std::runtime_error("The file " + (folder / results_name).string() +
                               " holds rows of another build, machine, motion or selection; give another folder with --out, or remove it.");
  }
  for (const auto& [number, row] : times_) {
    const bool is_known = number >= 0 && std::size_t(number) < cells.size();
    const Cell& cell = cells[is_known ? std::size_t(number) : 0];
    if (!is_known || !row.starts_with(std::to_string(number) + "," + cell.scene + "," + cell.rendering + "," + choices(cell) + ","))
      throw std::runtime_error("The file " + (folder / times_name).string() +
                               " holds times of another selection; give another folder with --out, or remove it.");
  }
  sort();
}

void Table::add(int number, const Cell& cell, const CellFigures& figures) {
  const std::string times = times_row(number, cell, figures, tail_.substr(tail_.rfind(',') + 1)), results = results_row(number, cell, figures, tail_);
  append(folder_ / times_name, times);
  append(folder_ / results_name, results);
  times_[number] = times;
  results_[number] = results;
}

void Table::sort() const {
  write_whole(folder_ / results_name, results_head, results_);
  write_whole(folder_ / times_name, times_head, times_);
}

void merge(const std::vector<fs::path>& from, const fs::path& into) {
  std::map<int, std::string> results, times;
  for (const fs::path& folder : from) {
    for (const auto& [name, head, rows] : {std::tuple(results_name, results_head, &results), std::tuple(times_name, times_head, &times)}) {
      const fs::path file = folder / name;
      if (!fs::exists(file)) throw std::runtime_error("The file " + file.string() + " is not there: the shard has not run, or elsewhere.");
      bool is_cut = false;
      for (const auto& [number, row] : whole_rows(file, head, is_cut)) {
        const auto [place, is_new] = rows->try_emplace(number, row);
        if (!is_new && place->second != row)
          throw std::runtime_error("Cell " + std::to_string(number) +
                                   " is in two of the folders with other figures; merge the shards of one study only.");
      }
      if (is_cut)
        throw std::runtime_error("The file " + file.string() + " was cut short; run its shard again: it goes on from the rows that are there.");
    }
  }
  for (const auto& [number, row] : results)
    for (const char* column : {"seconds", "seed", "cells", "commit", "compiler"})
      if (value_of(row, column) != value_of(results.begin()->second, column))
        throw std::runtime_error("The folders are not of one study: " + std::string(column) + " of cell " + std::to_string(number) + " is " +
                                 value_of(row, column) + ", and of cell " + std::to_string(results.begin()->first) + " " +
                                 value_of(results.begin()->second, column) + ".");
  const std::size_t cells = results.empty() ? 1 : std::stoul(value_of(results.begin()->second, "cells"));
  for (std::size_t i = 0; i < cells; ++i)
    if (!results.contains(int(i)) || !times.contains(int(i)))
      throw std::runtime_error("Cell " + std::to_string(i) + " of " + std::to_string(cells) +
                               " is in none of the folders; a shard is missing, or has not ended.");
  const FolderLock lock(into);
  bool is_cut = false;
  for (const auto& [number, row] : whole_rows(into / results_name, results_head, is_cut))
    if (const auto found = results.find(number); found == results.end() || found->second != row)
      throw std::runtime_error("The folder " + into.string() + " holds another study; give another with --out.");
  write_whole(into / results_name, results_head, results);
  write_whole(into / times_name, times_head, times);
}

std::vector<Row> read_rows(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("The file " + file.string() + " cannot be read.");
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  const auto names = split(line);
  const std::size_t wanted = columns(line);
  while (std::getline(in, line)) {
    if (in.eof() || columns(line) != wanted)
      throw std::runtime_error("The file " + file.string() +
                               " has a row that was cut short; run the study again: it goes on from the rows that are there.");
    const auto values = split(line);
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = i < values.size() ? values[i] : "";
  }
  return rows;
}

}  // namespace feeler::study
