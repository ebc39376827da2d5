// Runs a callback at absolute deadlines and counts those it missed.
#include "feeler/device/servo_loop.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "feeler/core/requirement.hpp"
#include "feeler/device/session_recorder.hpp"

namespace feeler {

ServoLoop::ServoLoop(const ServoSettings& settings, Callback callback, Clock* clock)
    : settings_(settings), callback_(std::move(callback)), clock_(clock ? *clock : monotonic_clock_) {
  refuse_for(reason_against(settings, callback_));
  if (settings.rate > 0) report_.period = std::llround(1e9 / settings.rate);
}

ServoLoop::ServoLoop(const ServoSettings& settings, Device& device, Render render, Clock* clock)
    : ServoLoop(settings, [this](const ServoTick& tick) { return render_to_device(tick); }, clock) {
  refuse_for(reason_against(settings, device, render));
  device_ = &device;
  render_ = std::move(render);
}

std::string ServoLoop::reason_against(const ServoSettings& settings, const Callback& callback, const Clock*) {
  if (!callback) return "servo loop: the callback is empty; give a callable from a ServoTick to whether to go on";
  if (settings.rate != 0 && !(settings.rate >= 1e-3 && settings.rate <= 1e9))
    return "servo loop: the rate must be 0 (as fast as possible) or from 0.001 to 1e9 ticks a second";
  return {};
}

std::string ServoLoop::reason_against(const ServoSettings& settings, const Device&, const Render& render, const Clock*) {
  if (!render) return "servo loop: the renderer is empty; give a callable from a ServoTick and a DeviceState to a DeviceWrench";
  return reason_against(settings, Callback([](const ServoTick&) { return true; }));
}

ServoLoop::~ServoLoop() {
  stop();
  if (thread_.joinable()) thread_.join();
}

double ServoLoop::period() const noexcept { return report_.period > 0 ? double(report_.period) * 1e-9 : 1 / device_->specification().nominal_rate; }

ForceLimits ServoLoop::force_limits() const { return settings_.force_limits.value_or(limits_of(device_->specification(), period())); }

std::string ServoLoop::reason_against_start() const {
  if (is_started_) return "servo loop: it was started before; make another one to run again";
  if (device_ == nullptr) return {};
  const DeviceSpecification& device = device_->specification();
  if (settings_.rate > 0 && settings_.rate < device.minimum_rate)
    return "servo loop: the rate is below what the device accepts; see minimum_rate of its specification";
  const ForceLimits limits = force_limits();
  if (!(limits.latest_tick > period()))
    return "servo loop: the latest tick of the force limits must be longer than the period, or every tick is late";
  std::string reason = feeler::reason_against(limits, device);
  return !reason.empty() || !settings_.passivity ? reason : PassivityControl::reason_against(*settings_.passivity);
}

const RealTimeSetup& ServoLoop::start() {
  refuse_for(reason_against_start());
  if (device_ != nullptr) {
    const DeviceSpecification& device = device_->specification();
    const ForceLimits limits = force_limits();
    force_tick_.period = period();
    safety_ = std::make_unique<ForceSafety>(limits, device);
    if (settings_.passivity) passivity_ = std::make_unique<PassivityControl>(*settings_.passivity);
    if (settings_.recorder != nullptr) settings_.recorder->describe(device, limits);
    if (&clock_ == &monotonic_clock_ && device_->lives_by_the_clock()) watch(limits.latest_tick);
  }
  is_started_ = true;
  is_running_.store(true, std::memory_order_release);
  thread_ = std::thread([this] { run(); });
  is_set_up_.wait();
  return report_.setup;
}

void ServoLoop::watch(double latest_tick) {
  RealTimeRequest request = settings_.real_time;
  request.fifo = request.fifo && report_.period > 0;
  request.priority = std::min(request.priority + 1, 99);  // before a renderer that does not give the processor back
  request.lock_memory = false;                            // the loop does
  request.processor = -1;
  const double period = force_tick_.period;
  watchdog_ = std::make_unique<ForceWatchdog>(*device_, period + 0.75 * (latest_tick - period), request);
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
    report_.setup.refused.push_back("SCHED_FIFO was not asked for: a loop that never waits would freeze its processor; give it a rate.");
  }
  is_set_up_.count_down();
  try {
    loop();
  } catch (const std::exception& error) {
    report_.problem = std::string("The callback threw, so the loop ended: ") + error.what();
  } catch (...) {
    report_.problem = "The callback threw something that is no std::exception, so the loop ended.";
  }
  end_force();
  is_running_.store(false, std::memory_order_release);
}

bool ServoLoop::render_to_device(const ServoTick& tick) {
  const std::int64_t read_at = clock_.now();
  const DeviceStatus status = device_->read(force_tick_.state);
  // A device that failed to push stays failed, even if it can still be read.
  if (force_tick_.status != DeviceStatus::fault) force_tick_.status = status;
  const bool has_pose = force_tick_.status == DeviceStatus::ok || force_tick_.status == DeviceStatus::warning;
  force_tick_.wanted = has_pose ? render_(tick, force_tick_.state) : DeviceWrench{};
  if (passivity_ && has_pose) force_tick_.wanted = passivity_->damped(force_tick_.state, force_tick_.wanted);
  force_tick_.request = force_request_.exchange(ForceRequest::none, std::memory_order_relaxed);
  const std::int64_t now = clock_.now();
  force_tick_.now = double(now) * 1e-9;
  force_tick_.age = device_->lives_by_the_clock() ? double(now - read_at) * 1e-9 : 0;
  if (note_let_go()) force_tick_.age = std::numeric_limits<double>::infinity();  // late, whatever this clock says

  const DeviceWrench pushed = safety_->step(force_tick_);
  is_let_go_ = is_let_go_ && safety_->phase() == ForcePhase::fading;
  const DeviceWrench given = is_let_go_ ? DeviceWrench{} : pushed;
  const DeviceStatus written = device_->write(given);
  if (watchdog_) watchdog_->feed();
  if (passivity_) passivity_->pushed(given);
  force_phase_.store(safety_->phase(), std::memory_order_relaxed);
  force_fault_.store(safety_->fault(), std::memory_order_relaxed);
  if (settings_.recorder != nullptr) settings_.recorder->add({force_tick_, pushed, safety_->phase(), safety_->fault()});
  if (written == DeviceStatus::fault || written == DeviceStatus::not_open) force_tick_.status = DeviceStatus::fault;
  return force_tick_.status != DeviceStatus::fault && force_tick_.status != DeviceStatus::not_open;
}

bool ServoLoop::note_let_go() noexcept {
  if (!watchdog_ || !watchdog_->has_let_go()) return false;
  ++report_.let_go;
  return is_let_go_ = true;
}

void ServoLoop::end_force() noexcept {
  if (device_ == nullptr) return;
  device_->write({});
  watchdog_.reset();
  // What cannot be reached holds what it was told last, if its amplifiers let it: it is told to let go as soon as it listens again.
  for (int i = 0; force_tick_.status == DeviceStatus::fault && i < 100; ++i) {
    clock_.sleep_until(clock_.now() + 1'000'000);
    device_->write({});
  }
  const bool is_lost = force_tick_.status == DeviceStatus::fault || force_tick_.status == DeviceStatus::not_open;
  if (is_lost && safety_->fault() != ForceFault::device_lost) {  // it failed to push, and no tick has told the safety
    safety_->step(force_tick_);
    force_phase_.store(safety_->phase(), std::memory_order_relaxed);
    force_fault_.store(safety_->fault(), std::memory_order_relaxed);
  }
  report_.force = safety_->report();
  if (passivity_) report_.passivity = passivity_->report();
  if (is_lost) {
    report_.problem = std::string("The device was lost, so the force is off and the loop ended. ") + device_->complaint();
  }
}

void ServoLoop::restart_force() noexcept {
  ForceRequest nothing = ForceRequest::none;
  force_request_.compare_exchange_strong(nothing, ForceRequest::restart, std::memory_order_relaxed);
}

void ServoLoop::loop() {
  const std::int64_t period = report_.period;
  const bool waits = period > 0;
  const std::int64_t first = clock_.now() + period;
  std::int64_t deadline = first;
  ServoTick tick;
  bool goes_on = true;
  while (goes_on && !is_stopping_.load(std::memory_order_relaxed) && (settings_.tick_limit == 0 || tick.index < settings_.tick_limit)) {
    if (waits) clock_.sleep_until(deadline);
    const std::int64_t start = clock_.now();
    tick.late = waits ? start - deadline : 0;
    if (waits) report_.wake_up_latency.add(tick.late);
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
