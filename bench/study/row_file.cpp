#include "study/row_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace feeler::study {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const fs::path& file, const std::string& why) {
  throw std::runtime_error("The file " + file.string() + " cannot be written (" + why +
                           "); make room or give another folder, and run again: it goes on from the rows that are there.");
}

std::ptrdiff_t columns(const std::string& row) { return std::count(row.begin(), row.end(), ','); }

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::stringstream text(line);
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

template <class Number>
bool is_number(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(text.data(), end, number);
  return stop == end && problem == std::errc() && std::isfinite(double(number)) && (std::is_floating_point_v<Number> || number >= 0);
}

/// Columns of text may hold anything, those of counts whole numbers, figures that were not measured nothing, all others numbers.
bool is_legible(const std::string& column, const std::string& value) {
  static const std::set<std::string> texts{"scene", "motion", "rendering", "scalar",    "solver", "method",
                                           "study", "commit", "compiler",  "processor", "refused"};
  static const std::set<std::string> counts{"cell", "budget", "iterations", "rate_hz", "samples", "samples_without_truth", "solver_samples", "cells"};
  static const std::set<std::string> settings{"margin_m", "scale", "offset_m", "seconds", "seed"};
  if (texts.contains(column)) return true;
  if (counts.contains(column)) return is_number<int>(value);
  return (value.empty() && !settings.contains(column)) || is_number<double>(value);
}

}  // namespace

Row row_of(const RowFile& kind, const std::string& line) {
  const auto names = split(kind.head), values = split(line);
  Row row;
  for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = i < values.size() ? values[i] : "";
  return row;
}

Lines read_lines(const fs::path& folder, const RowFile& kind, bool& is_cut) {
  const fs::path file = folder / kind.name;
  Lines lines;
  is_cut = false;
  std::error_code problem;
  if (!fs::exists(file, problem)) return lines;
  if (!fs::is_regular_file(file, problem))
    throw std::runtime_error("The file " + file.string() + " is not a file of rows; give another folder with --out.");
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad()) throw std::runtime_error("The file " + file.string() + " cannot be read; check its rights.");
  std::string line;
  if (!std::getline(text, line)) return lines;
  if (line != kind.head) {
    if (text.eof() && std::string(kind.head).starts_with(line)) return is_cut = true, lines;
    throw std::runtime_error("The file " + file.string() +
                             " is not of this program: its first line names other columns; give another folder with --out.");
  }
  for (int number = 2; std::getline(text, line); ++number) {
    if (text.eof() || columns(line) != columns(kind.head)) {
      is_cut = true;  // what follows a row that was cut short is whole again
      continue;
    }
    for (const auto& [column, value] : row_of(kind, line))
      if (!is_legible(column, value))
        throw std::runtime_error("The file " + file.string() + " has in line " + std::to_string(number) + ", column " + column + ", '" + value +
                                 "' where a number belongs; remove the line, and run the study again: it goes on from the rows that are there.");
    lines[std::stoi(line)] = line;
  }
  return lines;
}

Rows read_rows(const fs::path& folder) {
  Rows rows;
  for (const auto& [kind, into] : {std::pair(results_file, &rows.results), std::pair(times_file, &rows.times)}) {
    bool is_cut = false;
    for (const auto& [number, line] : read_lines(folder, kind, is_cut)) into->push_back(row_of(kind, line));
    const std::string file = (folder / kind.name).string();
    if (is_cut)
      throw std::runtime_error("The file " + file + " has a row that was cut short; run the study again: it goes on from the rows that are there.");
    if (into->empty())
      throw std::runtime_error("The file " + file + " is missing or holds no rows; give the folder of a study with --out, or run one.");
  }
  return rows;
}

void write_lines(const fs::path& folder, const RowFile& kind, const Lines& lines) {
  const fs::path file = folder / kind.name, fresh = file.string() + ".new";
  std::ofstream out(fresh, std::ios::binary);
  out << kind.head << '\n';
  for (const auto& [number, line] : lines) out << line << '\n';
  out.close();
  if (!out) fail_to_write(fresh, std::strerror(errno));
  std::error_code problem;
  fs::rename(fresh, file, problem);
  if (problem) fail_to_write(file, problem.message());
}

void append_line(const fs::path& folder, const RowFile& kind, const std::string& line) {
  const fs::path file = folder / kind.name;
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out << line << '\n';
  out.close();
  if (!out) fail_to_write(file, std::strerror(errno));
}

}  // namespace feeler::study
