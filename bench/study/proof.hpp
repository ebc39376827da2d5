// Tests of the truth that the study measures against, on random cells.
#pragma once

#include <string>
#include <vector>

namespace feeler::study {

/// What was tried, and how far the truth was from what each method says.
struct ProofFigures {
  int asked = 0, found = 0, in_contact = 0;
  double tightened = 0;       ///< largest change by two further steps of Newton's method [m]
  double last_step = 0;       ///< largest last step [m]
  int searched = 0;           ///< free poses tried about a minimum
  int better = 0;             ///< of these, those nearer to the hand than the minimum
  int deep = 0;               ///< minima that penetrate, by the checker
  double least_curvature = 0;
  int formulas = 0;           ///< scenes with a closed form
  double off_formulas = 0;    ///< largest distance of the truth from those [m]
};

/// On random scenes, places and sizes: each minimum is tightened, and free poses around it, at distances of 1 nm to 0.1 mm, are searched for one that is nearer to the hand. Where a formula tells the
/// minimum it is compared with that: a cube on a plate, flush and on an edge, and in a corner, anywhere and turned anyhow.
/// @param scenes  all where empty
/// @throws std::invalid_argument  for a name that there is not
ProofFigures prove_truth(int cells, unsigned seed, const std::vector<std::string>& scenes = {});

}  // namespace feeler::study
