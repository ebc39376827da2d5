#include "study/tables.hpp"

#include <cstdio>
#include <map>

#include "study/rows.hpp"
#include "times.hpp"

namespace feeler::study {
namespace {

std::string length(double metres) {
  char text[40];
  if (metres == 0) return "0";
  std::snprintf(text, sizeof text, "%.1e", metres);
  return text;
}
std::string plain(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// What the cells of one value of a choice, one of each scene, say together.
class Line {
 public:
  explicit Line(const std::vector<Row>& times) : times_(&times) {}
  void add(const Row& row) {
    if (!is_measured(row)) {
      ++refused_;
      return;
    }
    if (number(row, "solver_samples") > 0)
      for (const char* column : {"solver_error_median_m", "solver_error_p99_m"}) values_[column].push_back(number(row, column));
    for (const char* column : {"converged", "error_median_m", "error_p99_m", "force_jnd_p99", "work_p99", "deepest_m"})
      values_[column].push_back(number(row, column));
    if (number(row, "operations_p99") > 0)
      for (const char* column : {"operations_median", "operations_p99"}) values_[column].push_back(number(row, column) / 1000);
    for (const char* column : {"time_median_us", "time_p99_us"}) values_[column].push_back(number(times_of(row, *times_), column));
  }
  std::string text() const {
    if (values_.empty()) return " – | – | – | – | – | – | – | – | – | refused |";
    return " " + plain("%.1f", 100 * middle("converged")) + " / " + plain("%.1f", 100 * least("converged")) + " | " + solver_errors() + " | " +
           length(middle("error_median_m")) + " / " + length(most("error_median_m")) + " | " + plain("%.3f", most("force_jnd_p99")) + " | " +
           length(most("deepest_m")) + " | " + plain("%.0f", middle("work_p99")) + " | " + operations() + " | " +
           plain("%.1f", middle("time_median_us")) + " / " + plain("%.0f", middle("time_p99_us")) + " | " +
           std::to_string(values_.at("converged").size()) + (refused_ > 0 ? ", refused " + std::to_string(refused_) : "") + " |";
  }

 private:
  std::string solver_errors() const {
    if (!values_.contains("solver_error_median_m")) return "– | –";
    return length(middle("solver_error_median_m")) + " | " + length(middle("solver_error_p99_m")) + " / " + length(most("solver_error_p99_m"));
  }
  std::string operations() const {
    if (!values_.contains("operations_median")) return "–";
    return plain("%.0f", middle("operations_median")) + " / " + plain("%.0f", middle("operations_p99"));
  }
  double middle(const char* column) const { return bench::quantile(values_.at(column), 0.5); }
  double least(const char* column) const { return bench::quantile(values_.at(column), 0); }
  double most(const char* column) const { return bench::quantile(values_.at(column), 1); }

  const std::vector<Row>* times_;
  std::map<std::string, std::vector<double>> values_;
  int refused_ = 0;
};

constexpr const char* columns =
    " converged %, middle / least | solver error, median [m] | p99, middle / most | error, median, middle / most [m] | force error, p99, most [JND] | deepest [m] | work, p99 | operations, median / p99 [10³] | time, median / p99 [µs] | scenes |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|\n";

}  // namespace

std::string markdown_tables(const std::filesystem::path& folder) {
  const auto rows = read_rows(folder / results_name), times = read_rows(folder / times_name);
  std::string result;
  if (!rows.empty())
    result = "commit " + text(rows.front(), "commit") + ", " + text(rows.front(), "compiler") + ", " + text(rows.front(), "processor") + ", " +
             text(rows.front(), "seconds") + " s of motion\n";
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
  std::map<Key, Line> by_rendering;
  for (const Row& row : rows)
    // Of the scenes that all can render: one convex tool.
    if (is_standard_but_for(row, "") && !has_several_pieces(text(row, "scene")))
      by_rendering.try_emplace(Key(0, text(row, "rendering")), times).first->second.add(row);
  add_table("rendering", by_rendering);
  return result;
}

}  // namespace feeler::study
