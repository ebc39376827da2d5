// Reads the performance counter, and waits by a timer of high resolution.
#include "feeler/device/clock.hpp"

#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

namespace feeler {
namespace {

constexpr std::int64_t second = 1'000'000'000;  // [ns]

std::int64_t counts_per_second() noexcept {
  LARGE_INTEGER frequency = {};
  QueryPerformanceFrequency(&frequency);
  return frequency.QuadPart;
}

/// One for each thread that waits. Without the flag of Windows 10 (1803) a wait ends with a tick of the system, up to 16 ms late.
class Timer {
 public:
  Timer() noexcept {
    constexpr DWORD high_resolution = 0x2;
    handle_ = CreateWaitableTimerExW(nullptr, nullptr, high_resolution, TIMER_ALL_ACCESS);
    if (handle_ == nullptr) handle_ = CreateWaitableTimerExW(nullptr, nullptr, 0, TIMER_ALL_ACCESS);
  }
  ~Timer() {
    if (handle_ != nullptr) CloseHandle(handle_);
  }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  void wait(std::int64_t nanoseconds) noexcept {
    LARGE_INTEGER due = {};
    due.QuadPart = -(nanoseconds / 100 > 0 ? nanoseconds / 100 : 1);  // from now on, in units of 100 ns
    if (handle_ == nullptr || SetWaitableTimer(handle_, &due, 0, nullptr, nullptr, FALSE) == 0) {
      Sleep(1);
      return;
    }
    WaitForSingleObject(handle_, INFINITE);
  }

 private:
  HANDLE handle_;
};

}  // namespace

std::int64_t MonotonicClock::now() noexcept {
  static const std::int64_t frequency = counts_per_second();
  LARGE_INTEGER count = {};
  QueryPerformanceCounter(&count);
  return count.QuadPart / frequency * second + count.QuadPart % frequency * second / frequency;
}

void MonotonicClock::sleep_until(std::int64_t moment) noexcept {
  thread_local Timer timer;
  for (std::int64_t left = moment - now(); left > 0; left = moment - now()) timer.wait(left);
}

}  // namespace feeler
