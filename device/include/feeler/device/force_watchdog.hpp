// A second thread that takes the force away when the servo loop does not come back from its renderer.
#pragma once

#include <atomic>
#include <cstdint>
#include <latch>
#include <limits>
#include <thread>

#include "feeler/device/clock.hpp"
#include "feeler/device/device.hpp"
#include "feeler/device/real_time.hpp"

namespace feeler {

/// Watches over the writes to a device: where the next one does not come, `Device::let_go` is called, again
/// and again, until one does. It starts to watch with the first write.
///
/// Its thread sleeps until the moment at which a write would be late, so a loop in time wakes it about once
/// in `patience`.
class ForceWatchdog {
 public:
  /// Starts the thread, and returns once it watches.
  /// @param device    outlives the watchdog
  /// @param patience  from one write to the next, at most; longer than the period of the loop [s]
  /// @param request   of its thread; what the system refuses is not said again
  ForceWatchdog(Device& device, double patience, const RealTimeRequest& request);
  /// Ends the thread and waits for it, at most for `patience`.
  ~ForceWatchdog();
  ForceWatchdog(const ForceWatchdog&) = delete;
  ForceWatchdog& operator=(const ForceWatchdog&) = delete;

  /// A write is done. By the loop; wait-free.
  void feed() noexcept { fed_at_.store(clock_.now(), std::memory_order_release); }
  /// Whether it took the force away since this was asked last. By the loop; wait-free.
  bool has_let_go() noexcept { return has_let_go_.exchange(false, std::memory_order_acq_rel); }

 private:
  static constexpr std::int64_t never = (std::numeric_limits<std::int64_t>::max)();

  void run(const RealTimeRequest& request);

  Device& device_;
  MonotonicClock clock_;
  std::int64_t patience_;  // [ns]
  std::atomic<std::int64_t> fed_at_ = never;
  std::atomic<bool> has_let_go_ = false;
  std::atomic<bool> is_stopping_ = false;
  std::latch is_ready_{1};
  std::thread thread_;
};

}  // namespace feeler
