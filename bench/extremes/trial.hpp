// One case of the battery with one scalar.
#pragma once

#include <string>

#include "extremes/cases.hpp"

namespace feeler::extremes {

struct Finding {
  std::string refusal;        ///< the sentence; empty where the case was rendered
  double deepest = 0;         ///< penetration of poses, by the checker that shares no code with the library [m]
  double distance = -1;       ///< from the nearest pose in 50 digits, at rest [m]; −1 where none was proved
  bool is_at_rest = false;    ///< converged in the end, with the hand held
  double converged = 0;       ///< share of ticks
  double microseconds = 0;    ///< median of the ticks
  std::string fault;          ///< in what it is not as expected; empty where it is
};

/// @param rendering  of `study::renderings`
Finding try_case(const Case& one, const std::string& rendering);

}  // namespace feeler::extremes
