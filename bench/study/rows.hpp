// Rows of the study's files, and what is asked of them for tables and figures.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "study/cell.hpp"
#include "study/row_file.hpp"

namespace feeler::study {

/// NaN where it was not measured.
inline double number(const Row& row, const char* name) {
  const auto found = row.find(name);
  return found == row.end() || found->second.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(found->second.c_str(), nullptr);
}
inline const std::string& text(const Row& row, const char* name) { return row.at(name); }
inline bool is_refused(const Row& row) { return !text(row, "refused").empty(); }
/// Whether it was rendered and there is a truth to compare it with.
inline bool is_measured(const Row& row) { return !is_refused(row) && number(row, "samples") > 0; }

/// What is chosen, by the columns of the file, with what is chosen by default.
struct Choice {
  const char *column, *label;
  double standard;
};
inline const std::array<Choice, 6> choices{{{"margin_m", "margin  [m]", Cell().margin},
                                            {"budget", "work budget", double(Cell().budget)},
                                            {"iterations", "iterations a tick, at most", double(Cell().iterations)},
                                            {"rate_hz", "rate  [Hz]", double(Cell().rate)},
                                            {"scale", "scale of the scene", Cell().scale},
                                            {"offset_m", "distance of the scene from the origin  [m]", Cell().offset}}};

/// Whether all is chosen by default, but for one column.
inline bool is_standard_but_for(const Row& row, const std::string& column) {
  return (column == "motion" || text(row, "motion") == Cell().motion) && std::all_of(choices.begin(), choices.end(), [&](const Choice& choice) {
           return choice.column == column || number(row, choice.column) == choice.standard;
         });
}

/// The row of times of a cell; a row of nothing where it is missing.
inline const Row& times_of(const Row& row, const std::vector<Row>& times) {
  static const Row none;
  const auto found = std::find_if(times.begin(), times.end(), [&](const Row& other) { return text(other, "cell") == text(row, "cell"); });
  return found == times.end() ? none : *found;
}

}  // namespace feeler::study
