// Stands in for libHD.so: the same symbols, over a device that has the faults it is told to have.
//
// Nothing here calls an exported function, because the loader may bind it to another library's.
#include "open_haptics_stand_in.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <thread>
#include <utility>

namespace {

using Lock = std::lock_guard<std::mutex>;

struct ErrorInformation {
  unsigned int code;
  int internal_code;
  unsigned int handle;
};

feeler_test::OpenHapticsStandIn device;
feeler_test::MotorLog motors;
std::deque<ErrorInformation> errors;
constexpr unsigned int first = 7, second = 8, other = 100, nobody = 0xFFFFFFFF;  // handles; of all others from `other` on
unsigned int current = nobody;
unsigned int (*callback)(void*) = nullptr;
void* callback_argument = nullptr;
unsigned int in_frame = nobody;
std::thread servo_thread;
std::atomic<bool> is_stopping = false;

void run_frame() {
  if (callback != nullptr && !device.never_calls_back && callback(callback_argument) == 0) callback = nullptr;
}

void keep_rule(bool is_kept) {
  if (!is_kept) ++device.broken_rules;
}

bool is_initialised(unsigned int handle) {
  return handle == first ? device.is_initialised : handle == second ? device.is_second_initialised : handle >= other && handle != nobody;
}

void fail(unsigned int code, unsigned int handle = current) { errors.push_back({code, -1, handle}); }

void let_go(unsigned int handle) {
  if (handle == second) return void(std::fill(device.second_force, device.second_force + 3, 0.0));
  std::fill(device.force, device.force + 3, 0.0);
  std::fill(device.torque, device.torque + 3, 0.0);
}

void reset() {
  const Lock lock(device.mutex);
  const feeler_test::OpenHapticsStandIn fresh;
  std::copy(fresh.transform, fresh.transform + 16, device.transform);
  std::copy(fresh.temperatures, fresh.temperatures + 6, device.temperatures);
  device.buttons = 0;
  device.model = fresh.model;
  device.output_degrees = fresh.output_degrees;
  device.error_in_every_frame = 0;
  device.error_at_init = device.error_at_start = device.error_in_next_frame = device.error_after_push = 0;
  device.calibration = fresh.calibration;
  device.calibration_styles = fresh.calibration_styles;
  device.updates_missing = fresh.updates_missing;
  device.error_at_update = device.calibrated_by = 0;
  device.has_no_temperature = device.has_no_switches = device.never_calls_back = device.own_thread = false;
  device.is_in_inkwell = device.is_safety_switch_on = false;
  let_go(first);
  let_go(second);
  motors.told(0);
  std::fill(device.joint_torque, device.joint_torque + 3, 0.0);
  device.is_output_on = device.is_initialised = device.is_scheduler_running = false;
  device.is_second_initialised = false;
  device.others = 0;
  device.error_of_second_in_next_frame = 0;
  device.frames = device.starts = device.broken_rules = 0;
  errors.clear();
  callback = nullptr;
  in_frame = current = nobody;
}

}  // namespace

extern "C" {

feeler_test::OpenHapticsStandIn* feeler_stand_in() {
  device.tick = &run_frame;
  device.motors = &motors;
  device.reset = &reset;
  return &device;
}

// Not while the servo loop runs, and not while another device holds a force that nobody updates meanwhile.
unsigned int hdInitDevice(const char* name) {
  const Lock lock(device.mutex);
  keep_rule(!device.is_scheduler_running);
  if (name != nullptr && std::strncmp(name, "other", 5) == 0) return current = other + unsigned(device.others++);
  const unsigned int handle = name != nullptr && std::strcmp(name, "second") == 0 ? second : first;
  if (handle == second) keep_rule(std::hypot(device.force[0], device.force[1], device.force[2]) == 0);
  const unsigned int error = is_initialised(handle) ? 0x301 : device.error_at_init;
  if (error != 0) {
    fail(error, nobody);
    return nobody;
  }
  (handle == first ? device.is_initialised : device.is_second_initialised) = true;
  current = handle;
  return handle;
}

// The last one not while its callback is scheduled.
void hdDisableDevice(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(is_initialised(handle) && !device.is_scheduler_running);
  if (handle >= other) --device.others;
  else (handle == first ? device.is_initialised : device.is_second_initialised) = false;
  keep_rule(callback == nullptr || device.is_initialised || device.is_second_initialised || device.others > 0);
}

void hdMakeCurrentDevice(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(is_initialised(handle));
  current = handle;
}

void hdBeginFrame(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(is_initialised(handle) && in_frame == nobody);
  in_frame = current = handle;
  if (handle != first) return;
  ++device.frames;
  if (device.error_in_next_frame != 0) fail(std::exchange(device.error_in_next_frame, 0));
  if (device.error_in_every_frame != 0) fail(device.error_in_every_frame);
  if (device.error_of_second_in_next_frame != 0) fail(std::exchange(device.error_of_second_in_next_frame, 0), second);
}

void hdEndFrame(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(handle != nobody && in_frame == handle);
  in_frame = nobody;
  if (handle == first && device.error_after_push != 0) fail(std::exchange(device.error_after_push, 0));
}

ErrorInformation hdGetError() {
  const Lock lock(device.mutex);
  if (errors.empty()) return {0, 0, nobody};
  const ErrorInformation error = errors.front();
  errors.pop_front();
  return error;
}

const char* hdGetErrorString(unsigned int) { return "an error in the words of libHD"; }

void hdEnable(unsigned int capability) {
  const Lock lock(device.mutex);
  if (capability == 0x4000 && current == first) device.is_output_on = true;
}

void hdDisable(unsigned int capability) {
  const Lock lock(device.mutex);
  if (capability != 0x4000) return;
  if (current == first) device.is_output_on = false;
  let_go(current);
}

void hdGetBooleanv(unsigned int parameter, unsigned char* value) {
  const Lock lock(device.mutex);
  keep_rule(in_frame != nobody);
  if (device.has_no_switches) return fail(0x103);
  switch (parameter) {
    case 0x2001: *value = device.is_safety_switch_on ? 1 : 0; break;
    case 0x2002: *value = device.is_in_inkwell || (device.calibration_styles & 4) == 0 ? 0 : 1; break;  // 0 too where there is no inkwell
    default: fail(0x100);
  }
}

void hdGetIntegerv(unsigned int parameter, int* value) {
  const Lock lock(device.mutex);
  keep_rule(in_frame != nobody);
  switch (parameter) {
    case 0x2000: *value = device.buttons; break;
    case 0x2554: *value = current == first ? device.output_degrees : 3; break;
    case 0x2555: *value = int(device.calibration_styles); break;
    case 0x2600: *value = 1000; break;
    default: fail(0x100);
  }
}

void hdGetDoublev(unsigned int parameter, double* values) {
  const Lock lock(device.mutex);
  keep_rule(in_frame != nobody);
  switch (parameter) {
    case 0x2052: std::copy(device.transform, device.transform + 16, values); break;
    case 0x2602: *values = 1.0; break;
    case 0x2603: *values = 20.0; break;
    case 0x2604: *values = 2.5; break;
    case 0x2605:
      if (device.has_no_temperature) {
        fail(0x103);
      } else {
        std::copy(device.temperatures, device.temperatures + 6, values);
      }
      break;
    default: fail(0x100);
  }
}

const char* hdGetString(unsigned int parameter) { return parameter == 0x2501 ? device.model : nullptr; }

void hdSetDoublev(unsigned int parameter, const double* values) {
  const Lock lock(device.mutex);
  keep_rule(in_frame != nobody);
  double* axes = nullptr;
  if (current >= other) return;
  if (current == second) {  // without motors for torques
    if (parameter != 0x2700) return fail(0x100);
    return void(std::copy(values, values + 3, device.second_force));
  }
  if (parameter == 0x2700) axes = device.force;
  if (parameter == 0x2701) axes = device.torque;
  if (parameter == 0x2704) axes = device.joint_torque;
  if (axes == nullptr || (parameter != 0x2700 && device.output_degrees < 6)) {
    fail(0x100);
  } else {
    std::copy(values, values + 3, axes);
    if (parameter == 0x2700) motors.told(std::hypot(values[0], values[1], values[2]));
  }
}

#ifndef FEELER_STAND_IN_LACKS_A_FUNCTION
unsigned int hdCheckCalibration() {
  const Lock lock(device.mutex);
  keep_rule(device.is_scheduler_running);
  return device.calibration;
}
#endif

void hdUpdateCalibration(unsigned int style) {
  const Lock lock(device.mutex);
  keep_rule((style == 1) != device.is_scheduler_running);  // an encoder reset comes before the loop, all else in it
  if (device.error_at_update != 0) return fail(device.error_at_update);
  if ((style & device.calibration_styles) == 0) return fail(0x100);
  device.calibrated_by = style;
  if (device.calibration == 0x5001 && --device.updates_missing <= 0) device.calibration = 0x5000;
}

unsigned long hdScheduleAsynchronous(unsigned int (*function)(void*), void* argument, unsigned short) {
  keep_rule(callback == nullptr);
  callback = function;
  callback_argument = argument;
  return 42;
}

void hdUnschedule(unsigned long handle) {
  keep_rule(handle == 42);
  callback = nullptr;
}

void hdStartScheduler() {
  {
    const Lock lock(device.mutex);
    if (device.error_at_start != 0) {
      fail(std::exchange(device.error_at_start, 0), nobody);
      return;
    }
    keep_rule(!device.is_scheduler_running);
    if (std::exchange(device.is_scheduler_running, true)) return;
    ++device.starts;
  }
  // The variable is for programs that do not know that this is a stand-in.
  if (!device.own_thread && std::getenv("FEELER_STAND_IN_RUNS_BY_ITSELF") == nullptr) return run_frame();
  is_stopping = false;
  servo_thread = std::thread([] {
    while (!is_stopping) {
      run_frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
}

void hdStopScheduler() {
  is_stopping = true;
  if (servo_thread.joinable()) servo_thread.join();
  const Lock lock(device.mutex);
  device.is_scheduler_running = false;
}
}
