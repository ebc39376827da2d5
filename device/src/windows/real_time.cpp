// Asks Windows for the highest priority of a thread and for a processor.
#include "feeler/device/real_time.hpp"

#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

namespace feeler {
namespace {

std::string refusal(const std::string& what, const std::string& remedy) {
  return what + " was refused (error " + std::to_string(GetLastError()) + "): " + remedy + ".";
}

void describe_system(RealTimeSetup& setup) {
  OSVERSIONINFOA version = {};
  version.dwOSVersionInfoSize = sizeof version;
  setup.kernel = GetVersionExA(&version) != 0 ? "Windows " + std::to_string(version.dwMajorVersion) + "." + std::to_string(version.dwMinorVersion) +
                                                    "." + std::to_string(version.dwBuildNumber)
                                              : "Windows";
}

void choose_priority(RealTimeSetup& setup) {
  if (SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_TIME_CRITICAL) == 0)
    setup.refused.push_back(refusal("The priority of a time-critical thread", "run the program as an administrator"));
}

void choose_processor(int processor, RealTimeSetup& setup) {
  constexpr int most = 8 * int(sizeof(DWORD_PTR));
  const bool is_one = processor < most && SetThreadAffinityMask(GetCurrentThread(), DWORD_PTR(1) << processor) != 0;
  if (!is_one)
    setup.refused.push_back(refusal("Running on processor " + std::to_string(processor), "choose one of those that the Task Manager lists"));
}

void describe_thread(RealTimeSetup& setup) {
  const int priority = GetThreadPriority(GetCurrentThread());
  setup.policy = priority == THREAD_PRIORITY_TIME_CRITICAL ? "time critical" : "normal";
  setup.priority = priority == THREAD_PRIORITY_TIME_CRITICAL ? priority : 0;
  DWORD_PTR process = 0;
  DWORD_PTR system = 0;
  if (GetProcessAffinityMask(GetCurrentProcess(), &process, &system) == 0) return;
  const DWORD_PTR own = SetThreadAffinityMask(GetCurrentThread(), process);  // there is no call that only asks
  if (own == 0) return;
  SetThreadAffinityMask(GetCurrentThread(), own);
  for (int i = 0; i < 8 * int(sizeof own); ++i) {
    if ((own >> i & 1) != 0) setup.processors.push_back(i);
  }
}

}  // namespace

RealTimeSetup enter_real_time(const RealTimeRequest& request) {
  RealTimeSetup setup;
  describe_system(setup);
  if (request.lock_memory)
    setup.refused.push_back("Locking memory was not asked for: Windows locks no whole process; set real_time.lock_memory = false.");
  if (request.processor >= 0) choose_processor(request.processor, setup);
  if (request.fifo) choose_priority(setup);
  describe_thread(setup);
  return setup;
}

}  // namespace feeler
