// The study's two files: results, which are the same bytes however they came about, and times, which are not.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/figures_of_cell.hpp"
#include "study/row_file.hpp"

namespace feeler::study {

/// Said in each row: which program, on which machine.
struct Provenance {
  std::string commit, compiler, processor;
  double seconds = 2;  ///< of the motion
  unsigned seed = 1;
};
Provenance provenance(double seconds, unsigned seed);

/// Nobody else works in a folder as long as this is there.
class FolderLock {
 public:
  /// @throws std::runtime_error  where the folder cannot be made, or another program works in it
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

/// A row of each file for every cell that is done, by the cell's number. Rows are added as cells end and are on disk at once; a run that was killed goes on
/// from them.
class Table {
 public:
  /// Opens the files of a folder, makes them where they are not, and keeps their rows. A row that was cut short is dropped.
  /// @throws std::runtime_error  where they cannot be read or written, or hold rows of another study
  Table(const std::filesystem::path& folder, const std::vector<Cell>& cells, const Provenance& provenance);

  bool has(int number) const { return results_.contains(number) && times_.contains(number); }
  /// @throws std::runtime_error  where the row does not reach the disk: what was there before is there still
  void add(int number, const Cell& cell, const CellFigures& figures);
  /// Writes both files anew, in the order of the cells.
  void sort() const;

 private:
  FolderLock lock_;
  std::filesystem::path folder_;
  std::string results_tail_, times_tail_;  // columns that are the same in each row
  Lines results_, times_;
};

/// The files of several folders as one.
/// @throws std::runtime_error  where a file is missing or cut short, a row is in two with other figures or in none, the folders are not of one study, or `into` holds
///                             another
void merge(const std::vector<std::filesystem::path>& from, const std::filesystem::path& into);

}  // namespace feeler::study
