// What happens when construction is given input it cannot use: one sentence, thrown or printed.
#pragma once

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace feeler {

namespace detail {
/// Throws a refusal, or null in a program without a file that has exceptions. So `refuse`, and all that call it, are the same in files with
/// exceptions and in those without, and it does not matter whose the linker takes.
inline constinit std::atomic<void (*)(const std::string&)> throw_refusal = nullptr;

#if defined(__cpp_exceptions)
[[noreturn]] inline void throw_invalid_argument(const std::string& sentence) { throw std::invalid_argument(sentence); }
struct ThrowsRefusals {
  ThrowsRefusals() noexcept { throw_refusal = throw_invalid_argument; }
};
#if defined(__GNUC__)
[[gnu::init_priority(101)]]  // before other globals, which may be refused too, whichever file is linked first
#endif
inline const ThrowsRefusals throws_refusals;
#endif
}  // namespace detail

/// Refuses bad input at construction: throws `std::invalid_argument` with the sentence or, in a program of which no file has exceptions, prints it
/// and aborts. Never called from the tick. Who wants neither asks with `try_make`.
[[noreturn]] inline void refuse(const std::string& sentence) {
  if (const auto throw_it = detail::throw_refusal.load()) throw_it(sentence);
  std::fprintf(stderr, "feeler: %s\n", sentence.c_str());
  std::abort();
}

/// The same where there is a reason, a sentence; not where it is empty.
inline void refuse_for(const std::string& reason) {
  if (!reason.empty()) refuse(reason);
}

}  // namespace feeler
