// The study's two files of rows: what their columns are, and reading and writing them whole.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace feeler::study {

struct RowFile {
  const char *name, *head;
};
inline constexpr RowFile results_file{
    "study.csv",
    "cell,scene,motion,rendering,scalar,solver,method,margin_m,budget,iterations,rate_hz,scale,offset_m,samples,samples_without_truth,converged,error_median_m,error_p99_m,"
    "error_most_m,solver_samples,solver_error_median_m,solver_error_p99_m,within_0.1um,within_1um,deepest_m,separation_m,force_error_median_n,force_error_p99_n,force_jnd_p99,torque_jnd_p99,jitter_p99_n,lag_s,work_median,"
    "work_p99,work_most,operations_median,operations_p99,seconds,seed,cells,study,commit,compiler,processor,refused"};
inline constexpr RowFile times_file{
    "study_times.csv",
    "cell,scene,motion,rendering,margin_m,budget,iterations,rate_hz,scale,offset_m,time_median_us,time_p99_us,time_p99.9_us,time_most_us,study,processor"};

/// Rows as they are in the file, by the number of their cell.
using Lines = std::map<int, std::string>;
/// A row as names and values.
using Row = std::map<std::string, std::string>;

/// The whole rows of a file; nothing where there is no file.
/// @param is_cut  whether one was not whole
/// @throws std::runtime_error  where the file cannot be read, is of another program, or has text where a number belongs
Lines read_lines(const std::filesystem::path& folder, const RowFile& kind, bool& is_cut);
Row row_of(const RowFile& kind, const std::string& line);

/// Both files as rows.
struct Rows {
  std::vector<Row> results, times;
};
/// @throws std::runtime_error  as `read_lines`, and where a row was cut short or there is none
Rows read_rows(const std::filesystem::path& folder);

/// Writes a file anew; the old one stays until the new one is whole.
/// @throws std::runtime_error  where it does not reach the disk
void write_lines(const std::filesystem::path& folder, const RowFile& kind, const Lines& lines);
/// @throws std::runtime_error  likewise
void append_line(const std::filesystem::path& folder, const RowFile& kind, const std::string& line);

}  // namespace feeler::study
