// What the system grants a thread that must not be late: its scheduler, its memory and its processors.
#pragma once

#include <string>
#include <vector>

namespace feeler {

/// What to ask the system for.
struct RealTimeRequest {
  bool fifo = true;  ///< SCHED_FIFO, before every ordinary thread; the kernel's own threads stay above 80. On Windows a time-critical thread
  int priority = 80;  ///< of SCHED_FIFO, 1 to 99
  bool lock_memory = true;  ///< keep the memory of the whole process from being paged out
  int processor = -1;  ///< run on this one only; −1 runs on any
};

/// What the system granted, and a sentence for everything it refused.
struct RealTimeSetup {
  std::string kernel;  ///< release
  bool is_preempt_rt = false;  ///< a kernel with bounded latency
  std::string policy;  ///< "SCHED_FIFO", "SCHED_OTHER", …
  int priority = 0;  ///< real-time priority; 0 for ordinary threads
  bool is_memory_locked = false;  ///< by this call
  std::vector<int> processors;  ///< that the thread may run on
  std::vector<std::string> refused;  ///< each names what was refused, why, and the command that grants it
};

/// Asks for the calling thread, touches its stack, and says what it got.
///
/// Scheduler and processor are the thread's and end with it. Locked memory is the process's and stays locked, since another part of the
/// program may have asked for it too. Allocates: call it before the loop.
RealTimeSetup enter_real_time(const RealTimeRequest& request);

}  // namespace feeler
