// Keeps one thread at a time in a maker's library, and knows when its device may push.
#include "direct_driver.hpp"

#include <cstring>
#include <utility>

#include "feeler/device/wrench_limit.hpp"

namespace feeler {

DirectDriver::DirectDriver(DeviceSpecification specification, Clock* clock)
    : specification_(std::move(specification)), clock_(clock != nullptr ? *clock : monotonic_clock_) {}

OpenResult DirectDriver::open() {
  if (is_open_) return {};
  if (std::string problem = connect(); !problem.empty()) return {std::move(problem)};
  is_open_ = true;
  is_lost_ = false;
  complaint_ = {};
  opened_at_ = clock_.now();
  if (std::string problem = switch_on(state_); !problem.empty()) {
    close();
    return {std::move(problem)};
  }
  return {};
}

DeviceStatus DirectDriver::read(DeviceState& state) noexcept {
  if (!is_open_) return DeviceStatus::not_open;
  const auto turn = library_calls_.turn();
  if (turn) {
    if (is_lost_) return DeviceStatus::fault;
    if (const char* const why = take_pose(state_)) return lose(why);
    is_let_go_.store(false, std::memory_order_relaxed);
  }
  state = state_;
  if (!turn) return DeviceStatus::ok;  // just now it is let go: the pose keeps its time
  if (hindrance() == nullptr) return DeviceStatus::ok;
  say(hindrance());
  return DeviceStatus::warning;
}

DeviceStatus DirectDriver::write(const DeviceWrench& wrench) noexcept {
  if (!is_open_) return DeviceStatus::not_open;
  const bool is_good = is_finite(wrench);
  const auto turn = library_calls_.turn();
  if (!turn) return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;  // just now it is let go
  const bool pushes = is_good && !is_lost_ && hindrance() == nullptr && !is_let_go_.load(std::memory_order_relaxed);
  const Answer answer = push(pushes ? limited(wrench, specification_.maximum_force, specification_.maximum_torque) : DeviceWrench{});
  if (is_lost_) return DeviceStatus::fault;
  if (!answer.is_taken) return lose(answer.complaint);
  if (answer.complaint != nullptr) say(answer.complaint);
  return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;
}

void DirectDriver::let_go() noexcept {
  is_let_go_.store(true, std::memory_order_relaxed);  // before the turn: a write that comes after it knows
  if (const auto turn = library_calls_.turn(); turn && is_open_) push({});
}

void DirectDriver::close() noexcept {
  if (!is_open_) return;
  push({});
  switch_off();
  is_open_ = false;
}

DeviceStatus DirectDriver::lose(const char* why) noexcept {
  is_lost_ = true;
  say(why);
  return DeviceStatus::fault;
}

void DirectDriver::say(const char* sentence) noexcept { std::strncpy(complaint_.data(), sentence, complaint_.size() - 1); }

}  // namespace feeler
