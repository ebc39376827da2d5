// Sleeps until a write is late.
#include "feeler/device/force_watchdog.hpp"

#include <cmath>

namespace feeler {
namespace {

// The library was busy, or its gravity compensation lives on being written [ns].
constexpr std::int64_t between_repeats = 500'000;

}  // namespace

ForceWatchdog::ForceWatchdog(Device& device, double patience, const RealTimeRequest& request)
    : device_(device), patience_(std::llround(1e9 * patience)), thread_([this, request] { run(request); }) {
  is_ready_.wait();
}

ForceWatchdog::~ForceWatchdog() {
  is_stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void ForceWatchdog::run(const RealTimeRequest& request) {
  enter_real_time(request);
  is_ready_.count_down();
  while (!is_stopping_.load(std::memory_order_relaxed)) {
    const std::int64_t now = clock_.now();
    const std::int64_t fed_at = fed_at_.load(std::memory_order_acquire);
    const std::int64_t late_at = (fed_at == never ? now : fed_at) + patience_;
    if (now < late_at) {
      clock_.sleep_until(late_at);
      continue;
    }
    has_let_go_.store(true, std::memory_order_release);
    device_.let_go();
    clock_.sleep_until(now + between_repeats);
  }
}

}  // namespace feeler
