// What happens when construction is given input it cannot use: one sentence, thrown or printed.
#pragma once

#include <string>

#if defined(__cpp_exceptions)
#include <stdexcept>
#else
#include <cstdio>
#include <cstdlib>
#endif

namespace feeler {

/// Refuses bad input at construction: throws `std::invalid_argument` with the sentence, or, in a build without
/// exceptions, prints it and aborts. Never called from the tick.
[[noreturn]] inline void refuse(const std::string& sentence) {
#if defined(__cpp_exceptions)
  throw std::invalid_argument(sentence);
#else
  std::fprintf(stderr, "feeler: %s\n", sentence.c_str());
  std::abort();
#endif
}

/// The same where there is a reason, a sentence; not where it is empty.
inline void refuse_for(const std::string& reason) {
  if (!reason.empty()) refuse(reason);
}

}  // namespace feeler
