// A number as a sentence has it.
#pragma once

#include <cstdio>
#include <string>

namespace feeler::detail {

/// To three digits: 0.02, 1e-10, 100, inf.
inline std::string number_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

}  // namespace feeler::detail
