// Reads and waits for CLOCK_MONOTONIC.
#include "feeler/device/clock.hpp"

#include <cerrno>
#include <ctime>

namespace feeler {
namespace {
constexpr std::int64_t second = 1'000'000'000;
}

std::int64_t MonotonicClock::now() noexcept {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t(time.tv_sec) * second + time.tv_nsec;
}

void MonotonicClock::sleep_until(std::int64_t moment) noexcept {
  timespec time = {};
  time.tv_sec = static_cast<decltype(time.tv_sec)>(moment / second);
  time.tv_nsec = static_cast<decltype(time.tv_nsec)>(moment % second);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {}
}

}  // namespace feeler
