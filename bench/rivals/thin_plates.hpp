// How often a tool is pushed through a plate of zero thickness.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rivals/coupled_tool.hpp"

namespace feeler::rivals {

/// Crossings of one contender.
struct PlateScore {
  std::string name;
  int trials = 0;
  int crossed = 0;
};

/// 90 trials a contender: a box, a slender probe and a line, each in five orientations above a plate of 0.1
/// m. The device pushes the tool through, three times at 0.1 to 1 m/s to a depth of 20 mm and three times by
/// a jump of 15 to 60 mm within one tick, and holds it for 0.2 s.
/// @return Feeler first; a trial is lost when the middle of the tool is below the plate at its end
std::vector<PlateScore> push_through_plates(double rate);

}  // namespace feeler::rivals
