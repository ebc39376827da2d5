// What a constructor says when it refuses its input.
#pragma once

#include <stdexcept>
#include <string>

namespace feeler_test {

/// The sentence of the std::invalid_argument that a call throws, or "accepted" where it throws none.
template <class Build>
std::string refusal(const Build& build) {
  try {
    build();
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "accepted";
}

inline bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace feeler_test
