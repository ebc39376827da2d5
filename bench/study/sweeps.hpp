// Which cells make up the study.
#pragma once

#include <string>
#include <vector>

#include "study/cell.hpp"

namespace feeler::study {

/// A set of cells that answers one question.
struct Sweep {
  std::string name, question;
};
const std::vector<Sweep>& sweeps();

/// What is asked for; empty lists ask for all.
struct Selection {
  std::vector<std::string> scenes, motions, sweeps, renderings;
  std::vector<std::string> only;  ///< values of what is a number, such as "margin=1e-6,1e-5"
  bool is_quick = false;  ///< few values and few scenes
};

/// The cells of a selection, each once, in the order of the tables.
/// @throws std::invalid_argument  for a name or a value that there is not
std::vector<Cell> cells_of(const Selection& selection);

/// A number a cell, the same for those of one scene, motion, size, place and margin: they share their truth, which takes as long as all else, and so a shard.
std::vector<int> groups_of(const std::vector<Cell>& cells);

}  // namespace feeler::study
