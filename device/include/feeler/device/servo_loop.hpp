// A loop on a thread of its own that calls back at a fixed rate and tells the truth about when it was late.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <latch>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "feeler/device/clock.hpp"
#include "feeler/device/device.hpp"
#include "feeler/device/force_safety.hpp"
#include "feeler/device/force_watchdog.hpp"
#include "feeler/device/passivity_control.hpp"
#include "feeler/device/real_time.hpp"
#include "feeler/device/servo_report.hpp"

namespace feeler {

class SessionRecorder;

/// Settings of a `ServoLoop`.
struct ServoSettings {
  double rate = 1000;             ///< ticks a second [Hz]; 0 runs as fast as it can, without waiting
  std::int64_t tick_limit = 0;    ///< ends after so many ticks; 0 runs until stopped
  RealTimeRequest real_time = {};  ///< a loop that does not wait is not given SCHED_FIFO: it would freeze its processor

  std::optional<ForceLimits> force_limits = {};  ///< of a loop with a device; none are those that suit the device
  std::optional<PassivitySettings> passivity = {};  ///< of a loop with a device: damps the renderer's wish before `ForceSafety`; none does not exist
  SessionRecorder* recorder = nullptr;  ///< of a loop with a device: takes every tick; outlives the loop
};

/// What a callback is told about its tick.
struct ServoTick {
  std::int64_t index = 0;  ///< 0, 1, 2, …
  std::int64_t missed = 0;  ///< deadlines skipped just before this one
  double time = 0;  ///< of its deadline, since the first one [s]; without waiting, of its start
  std::int64_t late = 0;  ///< from its deadline to its start [ns]; 0 without waiting
};

/// Runs a callback at a rate, with absolute deadlines, on a thread of its own.
///
/// With a device a tick is: read, render, `PassivityControl` if asked for, `ForceSafety`, write. The safety is always on. Whatever ends the loop, a force of zero is the last
/// thing written; a device that is lost ends it. While the renderer hangs, a `ForceWatchdog` on a thread of its own takes the force away, three quarters of the way from the
/// period to `latest_tick` after the last write; not with a clock that a test moves, and not from a simulated device.
///
/// A tick that ends after the next deadline makes the loop skip every deadline that has passed, and counts them: catching up would push
/// a device with old poses. After `start` returns, the loop itself does not allocate, lock or do I/O; the callback must not either.
class ServoLoop {
 public:
  /// Returns whether to go on. If it throws, the loop ends and the report says so.
  using Callback = std::function<bool(const ServoTick&)>;

  /// The wrench that the hand should feel at this pose. It must not allocate, lock or do I/O; if it throws, the loop ends.
  using Render = std::function<DeviceWrench(const ServoTick&, const DeviceState&)>;

  /// A loop that only keeps time. Refuses (`std::invalid_argument`) an empty callback and a rate other than 0 outside 0.001 to 1e9 Hz.
  /// @param clock  outlives the loop; none is CLOCK_MONOTONIC
  ServoLoop(const ServoSettings& settings, Callback callback, Clock* clock = nullptr);
  /// A loop that renders to a device, which is open before `start` and outlives the loop.
  /// @param clock  outlives the loop; none is CLOCK_MONOTONIC
  ServoLoop(const ServoSettings& settings, Device& device, Render render, Clock* clock = nullptr);
  /// The sentence with which a constructor refuses; empty where it does not. For `try_make<ServoLoop>`.
  static std::string reason_against(const ServoSettings& settings, const Callback& callback, const Clock* clock = nullptr);
  static std::string reason_against(const ServoSettings& settings, const Device& device, const Render& render, const Clock* clock = nullptr);
  /// Stops and waits.
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Starts the thread and returns what the system granted it. Once only: a second call is refused, and so are force
  /// limits that are none and a rate below what the device accepts.
  const RealTimeSetup& start();
  /// The sentence with which `start` refuses; empty where it does not.
  std::string reason_against_start() const;
  /// Asks the loop to end after this tick; from any thread, the callback's too. Takes at most one period.
  void stop() noexcept { is_stopping_.store(true, std::memory_order_relaxed); }
  /// Waits for the end. Not from the callback.
  const ServoReport& wait();

  /// Emergency stop: from the next tick on the device pushes nothing, until `restart_force`. From any thread.
  void stop_force() noexcept { force_request_.store(ForceRequest::stop, std::memory_order_relaxed); }
  /// Ends a stop by the program or by a wrench that was not finite; the force comes back by the ramp, once the pose is free. It does not
  /// overtake a stop that no tick has seen yet. From any thread.
  void restart_force() noexcept;
  /// While it runs, from any thread; of a loop with a device.
  ForcePhase force_phase() const noexcept { return force_phase_.load(std::memory_order_relaxed); }
  ForceFault force_fault() const noexcept { return force_fault_.load(std::memory_order_relaxed); }  ///< the latest

  bool is_running() const noexcept { return is_running_.load(std::memory_order_acquire); }
  /// While it runs, from any thread.
  std::int64_t ticks() const noexcept { return ticks_.load(std::memory_order_relaxed); }
  std::int64_t missed() const noexcept { return missed_.load(std::memory_order_relaxed); }

 private:
  void run();
  void loop();
  double period() const noexcept;
  ForceLimits force_limits() const;
  bool render_to_device(const ServoTick& tick);
  void end_force() noexcept;
  void watch(double latest_tick);
  bool note_let_go() noexcept;

  ServoSettings settings_;
  Callback callback_;
  MonotonicClock monotonic_clock_;
  Clock& clock_;
  Device* device_ = nullptr;
  Render render_;
  std::unique_ptr<PassivityControl> passivity_;
  std::unique_ptr<ForceSafety> safety_;
  std::unique_ptr<ForceWatchdog> watchdog_;
  bool is_let_go_ = false;  // by the watchdog, and not even the rest of a fade may be pushed
  ForceSafety::Tick force_tick_;  // of the loop's thread
  std::atomic<ForceRequest> force_request_ = ForceRequest::none;
  std::atomic<ForcePhase> force_phase_ = ForcePhase::waiting;
  std::atomic<ForceFault> force_fault_ = ForceFault::none;
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
