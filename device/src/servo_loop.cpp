// Runs a callback at absolute deadlines and counts those it missed.
#include "feeler/device/servo_loop.hpp"

#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "feeler/core/requirement.hpp"

namespace feeler {

ServoLoop::ServoLoop(const ServoSettings& settings, Callback callback, Clock* clock)
    : settings_(settings), callback_(std::move(callback)), clock_(clock ? *clock : monotonic_clock_) {
  if (!callback_) refuse("servo loop: the callback is empty; give a callable from a ServoTick to whether to go on");
  if (settings.rate != 0 && !(settings.rate >= 1e-3 && settings.rate <= 1e9)) {
    refuse("servo loop: the rate must be 0 (as fast as possible) or from 0.001 to 1e9 ticks a second");
  }
  if (settings.rate > 0) report_.period = std::llround(1e9 / settings.rate);
}

ServoLoop::~ServoLoop() {
  stop();
  if (thread_.joinable()) thread_.join();
}

const RealTimeSetup& ServoLoop::start() {
  if (is_started_) refuse("servo loop: it was started before; make another one to run again");
  is_started_ = true;
  is_running_.store(true, std::memory_order_release);
  thread_ = std::thread([this] { run(); });
  is_set_up_.wait();
  return report_.setup;
}

const ServoReport& ServoLoop::wait() {
  if (thread_.joinable()) thread_.join();
  return report_;
}

void ServoLoop::run() {
  RealTimeRequest request = settings_.real_time;
  const bool withheld = report_.period == 0 && request.fifo;
  if (withheld) request.fifo = false;
  report_.setup = enter_real_time(request);
  if (withheld) {
    report_.setup.refused.push_back(
        "SCHED_FIFO was not asked for: a loop that never waits would freeze its processor; give it a rate.");
  }
  is_set_up_.count_down();
  try {
    loop();
  } catch (const std::exception& error) {
    report_.problem = std::string("The callback threw, so the loop ended: ") + error.what();
  } catch (...) {
    report_.problem = "The callback threw something that is no std::exception, so the loop ended.";
  }
  is_running_.store(false, std::memory_order_release);
}

void ServoLoop::loop() {
  const std::int64_t period = report_.period;
  const bool waits = period > 0;
  const std::int64_t first = clock_.now() + period;
  std::int64_t deadline = first;
  ServoTick tick;
  bool goes_on = true;
  while (goes_on && !is_stopping_.load(std::memory_order_relaxed) &&
         (settings_.tick_limit == 0 || tick.index < settings_.tick_limit)) {
    if (waits) clock_.sleep_until(deadline);
    const std::int64_t start = clock_.now();
    if (waits) report_.wake_up_latency.add(start - deadline);
    tick.time = double((waits ? deadline : start) - first) * 1e-9;
    goes_on = callback_(tick);
    const std::int64_t end = clock_.now();
    report_.compute_time.add(end - start);

    ++tick.index;
    report_.ticks = tick.index;
    ticks_.store(tick.index, std::memory_order_relaxed);

    deadline += period;
    tick.missed = waits && end > deadline ? (end - deadline - 1) / period + 1 : 0;
    deadline += tick.missed * period;
    report_.missed += tick.missed;
    missed_.store(report_.missed, std::memory_order_relaxed);
  }
}

}  // namespace feeler
