// Asks Linux for its real-time scheduler, locked memory and a processor.
#include "feeler/device/real_time.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>

namespace feeler {
namespace {

std::string program() {
  std::array<char, 4096> path = {};
  const ssize_t length = readlink("/proc/self/exe", path.data(), path.size());
  return length > 0 ? std::string(path.data(), std::size_t(length)) : "<program>";
}

std::string refusal(const std::string& what, int error, const std::string& remedy) {
  return what + " was refused (" + std::strerror(error) + "): " + remedy + ".";
}

std::string capabilities_command() { return "grant it with `sudo setcap cap_sys_nice,cap_ipc_lock+ep " + program() + "`"; }

void describe_kernel(RealTimeSetup& setup) {
  utsname name = {};
  if (uname(&name) == 0) setup.kernel = name.release;
  char flag = '0';
  std::ifstream("/sys/kernel/realtime") >> flag;
  // Mainline kernels say it in their version line only.
  setup.is_preempt_rt = flag == '1' || std::strstr(name.version, "PREEMPT_RT") != nullptr;
}

void lock_memory(RealTimeSetup& setup) {
  // Under a finite limit, locking future memory too would make a later, innocent allocation fail.
  rlimit limit = {};
  const bool is_limited = geteuid() != 0 && getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  if (mlockall(is_limited ? MCL_CURRENT : MCL_CURRENT | MCL_FUTURE) == 0) {
    setup.is_memory_locked = true;
  } else {
    setup.refused.push_back(refusal("Locking memory", errno, capabilities_command()));
  }
}

void choose_scheduler(int priority, RealTimeSetup& setup) {
  sched_param parameters = {};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error != 0) {
    const std::string remedy = error == EINVAL ? "ask for a priority of 1 to 99; `chrt --max` lists them" : capabilities_command();
    setup.refused.push_back(refusal("SCHED_FIFO at priority " + std::to_string(priority), error, remedy));
  }
}

void choose_processor(int processor, RealTimeSetup& setup) {
  cpu_set_t set;
  CPU_ZERO(&set);
  int error = EINVAL;
  if (processor < CPU_SETSIZE) {
    CPU_SET(std::size_t(processor), &set);
    error = pthread_setaffinity_np(pthread_self(), sizeof set, &set);
  }
  if (error != 0) {
    setup.refused.push_back(refusal("Running on processor " + std::to_string(processor), error, "choose one of those that `taskset -cp $$` lists"));
  }
}

const char* name_of(int policy) noexcept {
  switch (policy & ~SCHED_RESET_ON_FORK) {
    case SCHED_FIFO: return "SCHED_FIFO";
    case SCHED_RR: return "SCHED_RR";
    case SCHED_OTHER: return "SCHED_OTHER";
    case SCHED_BATCH: return "SCHED_BATCH";
    case SCHED_IDLE: return "SCHED_IDLE";
    default: return "unknown";
  }
}

void describe_thread(RealTimeSetup& setup) {
  int policy = SCHED_OTHER;
  sched_param parameters = {};
  if (pthread_getschedparam(pthread_self(), &policy, &parameters) == 0) {
    setup.policy = name_of(policy);
    setup.priority = parameters.sched_priority;
  }
  cpu_set_t set;
  CPU_ZERO(&set);
  if (pthread_getaffinity_np(pthread_self(), sizeof set, &set) != 0) return;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(std::size_t(i), &set)) setup.processors.push_back(i);
  }
}

/// Faults in the stack that the loop will use: the first touch of a page is a call into the kernel.
[[gnu::noinline]] void touch_stack() noexcept {
  constexpr std::size_t page = 4096;
  volatile std::byte stack[64 * page];
  for (std::size_t i = 0; i < sizeof stack; i += page) stack[i] = std::byte(1);
}

}  // namespace

RealTimeSetup enter_real_time(const RealTimeRequest& request) {
  RealTimeSetup setup;
  describe_kernel(setup);
  if (request.lock_memory) lock_memory(setup);
  touch_stack();
  if (request.processor >= 0) choose_processor(request.processor, setup);
  if (request.fifo) choose_scheduler(request.priority, setup);
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);  // ordinary threads else wake up to 50 µs late, to save power
  describe_thread(setup);
  return setup;
}

}  // namespace feeler
