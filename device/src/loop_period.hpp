// The period of the servo loop, for devices that are told it.
#pragma once

#include <string>

namespace feeler {

/// What is wrong with a period [s], as a sentence; empty where nothing is.
inline std::string reason_against_period(double period) {
  return period >= 1e-5 && period <= 1 ? std::string() : "The period of the servo loop must be from 0.00001 to 1 s.";
}

}  // namespace feeler
