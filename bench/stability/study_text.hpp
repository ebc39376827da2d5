// How the studies write numbers, and what they say while they run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "stability/situations.hpp"

namespace feeler::stability {

inline const char* unit_of(const Situation& situation) noexcept { return situation.turns() ? "N·m/rad" : "N/m"; }

/// Least and largest of what was seen.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
};

/// For tables: what is nothing but rounding is nothing.
inline double shown(double value) noexcept { return std::abs(value) < 1e-3 ? 0.0 : value; }

/// A cell of a table, without decimals.
inline std::string rounded_cell(double value) {
  char text[32];
  std::snprintf(text, sizeof text, " %.0f |", value);
  return text;
}

inline std::string at_rate(const std::string& what, double rate) { return what + " at " + std::to_string(int(rate)) + " Hz"; }

inline void say(const char* what, const std::string& of) {
  std::printf("%s: %s\n", what, of.c_str());
  std::fflush(stdout);
}

}  // namespace feeler::stability
