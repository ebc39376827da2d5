// A loop on a thread of its own that calls back at a fixed rate and tells the truth about when it was late.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <latch>
#include <thread>

#include "feeler/device/clock.hpp"
#include "feeler/device/real_time.hpp"
#include "feeler/device/servo_report.hpp"

namespace feeler {

/// Settings of a `ServoLoop`.
struct ServoSettings {
  double rate = 1000;             ///< ticks a second [Hz]; 0 runs as fast as it can, without waiting
  std::int64_t tick_limit = 0;    ///< ends after so many ticks; 0 runs until stopped
  RealTimeRequest real_time = {};  ///< a loop that does not wait is not given SCHED_FIFO: it would freeze its processor
};

/// What a callback is told about its tick.
struct ServoTick {
  std::int64_t index = 0;   ///< 0, 1, 2, …
  std::int64_t missed = 0;  ///< deadlines skipped just before this one
  double time = 0;          ///< of its deadline, since the first one [s]; without waiting, of its start
};

/// Runs a callback at a rate, with absolute deadlines, on a thread of its own.
///
/// A tick that ends after the next deadline makes the loop skip every deadline that has passed, and counts them: catching up would push
/// a device with old poses. After `start` returns, the loop itself does not allocate, lock or do I/O; the callback must not either.
class ServoLoop {
 public:
  /// Returns whether to go on. If it throws, the loop ends and the report says so.
  using Callback = std::function<bool(const ServoTick&)>;

  /// Refuses (`std::invalid_argument`) an empty callback and a rate other than 0 outside 0.001 to 1e9 Hz.
  /// @param clock  outlives the loop; none is CLOCK_MONOTONIC
  ServoLoop(const ServoSettings& settings, Callback callback, Clock* clock = nullptr);
  /// Stops and waits.
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Starts the thread and returns what the system granted it. Once only: a second call is refused.
  const RealTimeSetup& start();
  /// Asks the loop to end after this tick; from any thread, the callback's too. Takes at most one period.
  void stop() noexcept { is_stopping_.store(true, std::memory_order_relaxed); }
  /// Waits for the end. Not from the callback.
  const ServoReport& wait();

  bool is_running() const noexcept { return is_running_.load(std::memory_order_acquire); }
  /// While it runs, from any thread.
  std::int64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }
  std::int64_t missed() const noexcept { return missed_.load(std::memory_order_relaxed); }

 private:
  void run();
  void loop();

  ServoSettings settings_;
  Callback callback_;
  MonotonicClock monotonic_clock_;
  Clock& clock_;
  ServoReport report_;  // the loop's until it has ended, but for `setup`, which is everybody's after `is_set_up_`
  std::latch is_set_up_{1};
  std::atomic<bool> is_stopping_ = false;
  std::atomic<bool> is_running_ = false;
  std::atomic<std::int64_t> ticks_ = 0;
  std::atomic<std::int64_t> missed_ = 0;
  std::thread thread_;
  bool is_started_ = false;
};

}  // namespace feeler
