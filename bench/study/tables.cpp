#include "study/tables.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "study/figures_of_cell.hpp"
#include "study/rows.hpp"
#include "study/scenes.hpp"
#include "times.hpp"

namespace feeler::study {
namespace {

std::string plain(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return std::isnan(value) ? "–" : text;
}
std::string length(double metres) { return metres == 0 ? "0" : plain("%.1e", metres); }

/// What the cells of one value of a choice, one of each scene, say together.
class Line {
 public:
  explicit Line(const std::vector<Row>& times) : times_(&times) {}
  void add(const Row& row) {
    ++(is_refused(row) ? refused_ : rendered_);
    if (is_refused(row)) return;
    if (!is_measured(row)) ++without_truth_;
    for (const char* column : {"samples", "converged", "solver_error_median_m", "solver_error_p99_m", "error_median_m", "error_p99_m",
                               "force_jnd_p99", "deepest_m", "work_p99", "operations_median", "operations_p99"})
      add(column, number(row, column));
    for (const char* column : {"time_median_us", "time_p99_us"}) add(column, number(times_of(row, *times_), column));
  }
  std::string text() const {
    return " " + plain("%.1f", 100 * middle("converged")) + " / " + plain("%.1f", 100 * least("converged")) + " | " +
           length(middle("solver_error_median_m")) + " | " + length(middle("solver_error_p99_m")) + " / " + length(most("solver_error_p99_m")) +
           " | " + length(middle("error_median_m")) + " / " + length(most("error_median_m")) + " | " + plain("%.3f", most("force_jnd_p99")) + " | " +
           length(most("deepest_m")) + " | " + plain("%.0f", middle("work_p99")) + " | " + plain("%.0f", middle("operations_median") / 1000) + " / " +
           plain("%.0f", middle("operations_p99") / 1000) + " | " + plain("%.1f", middle("time_median_us")) + " / " +
           plain("%.0f", middle("time_p99_us")) + " | " + std::to_string(rendered_) + (refused_ > 0 ? ", refused " + std::to_string(refused_) : "") +
           (without_truth_ > 0 ? ", no truth " + std::to_string(without_truth_) : "") + " | " + plain("%.0f", least("samples")) + " to " +
           plain("%.0f", most("samples")) + " |";
  }

 private:
  void add(const char* column, double value) {
    if (!std::isnan(value)) values_[column].push_back(value);
  }
  double quantile(const char* column, double share) const {
    const auto found = values_.find(column);
    return found == values_.end() ? CellFigures::none : bench::quantile(found->second, share);
  }
  double middle(const char* column) const { return quantile(column, 0.5); }
  double least(const char* column) const { return quantile(column, 0); }
  double most(const char* column) const { return quantile(column, 1); }

  const std::vector<Row>* times_;
  std::map<std::string, std::vector<double>> values_;  // of those that were measured
  int rendered_ = 0, refused_ = 0, without_truth_ = 0;
};

constexpr const char* columns =
    " converged %, middle / least | solver error, median [m] | p99, middle / most | error, median, middle / most [m] | force error, p99, most [JND] | deepest [m] | work, p99 | operations, median / p99 [10³] | time, median / p99 [µs] | scenes | samples of each |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|\n";

}  // namespace

std::string markdown_tables(const std::filesystem::path& folder) {
  const Rows read = read_rows(folder);
  const auto &rows = read.results, &times = read.times;
  std::string result;
  const auto add_table = [&](const std::string& head, const auto& lines) {
    if (lines.size() < 2) return;
    result += "\n| " + head + " |" + columns;
    for (const auto& [value, line] : lines)
      result += "| " + (value.second.empty() ? plain("%g", value.first) : value.second) + " |" + line.text() + "\n";
  };
  using Key = std::pair<double, std::string>;
  for (const Choice& choice : choices) {
    std::map<std::string, std::map<Key, Line>> tables;  // by rendering
    for (const Row& row : rows)
      if (is_standard_but_for(row, choice.column))
        tables[text(row, "rendering")].try_emplace(Key(number(row, choice.column), ""), times).first->second.add(row);
    for (const auto& [rendering, lines] : tables) add_table(std::string(choice.label) + ", `" + rendering + "`", lines);
  }
  const auto add_table_by_name = [&](const std::string& head, const char* column, const auto& is_in) {
    std::map<Key, Line> lines;
    for (const Row& row : rows)
      if (is_in(row)) lines.try_emplace(Key(0, text(row, column)), times).first->second.add(row);
    add_table(head, lines);
  };
  // Of the scenes that all can render: one convex tool.
  add_table_by_name("rendering", "rendering", [](const Row& row) { return is_standard_but_for(row, "") && !has_several_pieces(text(row, "scene")); });
  add_table_by_name("motion of the hand, `double`", "motion",
                    [](const Row& row) { return is_standard_but_for(row, "motion") && text(row, "rendering") == Cell().rendering; });
  if (result.empty())
    throw std::runtime_error("In " + (folder / results_file.name).string() +
                             " nothing is varied with all else by default: there is no table to make of it.");
  return "commit " + text(rows.front(), "commit") + ", " + text(rows.front(), "compiler") + ", " + text(rows.front(), "processor") + ", " +
         text(rows.front(), "seconds") + " s of motion\n" + result;
}

}  // namespace feeler::study
