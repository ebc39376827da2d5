// Starts, pauses and stops the servo loop of libHD for all devices together.
#include "open_haptics_scheduler.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace feeler::open_haptics {
namespace {

constexpr double no_push[3] = {0, 0, 0};

void forget_errors(const Library& library) {
  for (int i = 0; i < most_errors && library.get_error().code != success; ++i) continue;
}

/// Disables a device whose loop stands still, with nothing left on.
void disable(const Library& library, Handle handle) {
  library.begin_frame(handle);
  library.set_doubles(current_force, no_push);
  library.set_doubles(current_torque, no_push);
  library.end_frame(handle);
  library.make_current_device(handle);
  library.disable(force_output);
  library.disable_device(handle);
  forget_errors(library);  // a torque without motors is one
}

}  // namespace

Scheduler& Scheduler::shared() {
  static auto& scheduler = *new Scheduler;  // never destroyed: a device may be closed as the program ends
  return scheduler;
}

Handle Scheduler::initialise(const Library& library, const std::string& name) {
  stop(library);
  if (const auto kept = kept_.extract(name); !kept.empty()) return kept.mapped();
  forget_errors(library);
  return library.init_device(name.empty() ? nullptr : name.c_str());
}

bool Scheduler::join(const Library& library, Framed& device) {
  const auto place = std::find(devices_.begin(), devices_.end(), nullptr);
  if (place == devices_.end()) return false;
  *place = &device;
  run(library);
  return true;
}

void Scheduler::leave(const Library& library, Framed& device, const std::string& name) {
  const auto place = std::find(devices_.begin(), devices_.end(), &device);
  if (place != devices_.end()) {
    const bool has_others = std::count(devices_.begin(), devices_.end(), nullptr) < std::ptrdiff_t(devices_.size()) - 1;
    const bool was_told = has_others && has_turned();
    *place = nullptr;
    if (was_told && has_turned()) {  // no frame of it is under way any more
      kept_[name] = device.handle();
      return;
    }
  }
  stop(library);
  if (!has_devices()) unschedule(library);
  if (device.handle() != invalid_handle) disable(library, device.handle());
  if (has_devices()) return run(library);
  for (const auto& [other, handle] : kept_) disable(library, handle);
  kept_.clear();
}

Framed* Scheduler::device_of(Handle handle) const noexcept {
  for (const auto& place : devices_) {
    if (Framed* const device = place.load(); device != nullptr && device->handle() == handle) return device;
  }
  return nullptr;
}

unsigned int Scheduler::turn_of(void* scheduler) noexcept {
  auto& self = *static_cast<Scheduler*>(scheduler);
  for (auto& place : self.devices_) {
    if (Framed* const device = place.load()) device->frame(self.is_pausing_);
  }
  ++self.turns_;
  return callback_continues;
}

bool Scheduler::has_devices() const noexcept {
  return std::any_of(devices_.begin(), devices_.end(), [](Framed* device) { return device != nullptr; });
}

/// Whether a whole turn of the loop passes, within a time in which a hundred should.
bool Scheduler::has_turned() const {
  const std::int64_t turns = turns_;
  for (int wait = 0; wait < 100; ++wait) {
    if (turns_ >= turns + 2) return true;  // the first of them may have begun earlier
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

void Scheduler::run(const Library& library) {
  if (!is_scheduled_) callback_ = library.schedule_asynchronous(&Scheduler::turn_of, this, highest_priority);
  is_scheduled_ = true;
  is_pausing_ = false;
  library.start_scheduler();
  is_running_ = true;
}

void Scheduler::unschedule(const Library& library) {
  if (is_scheduled_) library.unschedule(callback_);
  is_scheduled_ = false;
}

void Scheduler::stop(const Library& library) {
  if (!is_running_) return;
  is_pausing_ = true;
  if (has_devices()) has_turned();
  library.stop_scheduler();
  is_running_ = false;
}

}  // namespace feeler::open_haptics
