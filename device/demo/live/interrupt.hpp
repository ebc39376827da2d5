// Whether the user wants the program to end.
#pragma once

#include <csignal>

namespace feeler::demo {

/// While one lives, Ctrl-C and a request to terminate are noted instead of ending the program at once.
class Interrupt {
 public:
  Interrupt() : interrupt_(std::signal(SIGINT, note)), termination_(std::signal(SIGTERM, note)) { noted_ = 0; }
  ~Interrupt() {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, termination_);
  }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool has_come() const noexcept { return noted_ != 0; }

 private:
  static void note(int) { noted_ = 1; }
  static inline volatile std::sig_atomic_t noted_ = 0;

  void (*interrupt_)(int);
  void (*termination_)(int);
};

}  // namespace feeler::demo
