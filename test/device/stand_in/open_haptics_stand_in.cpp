// Stands in for libHD.so: the same symbols, over a device that has the faults it is told to have.
//
// Nothing here calls an exported function, because the loader may bind it to another library's.
#include "open_haptics_stand_in.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
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
std::deque<unsigned int> errors;
unsigned int (*callback)(void*) = nullptr;
void* callback_argument = nullptr;
bool is_in_frame = false;
std::thread servo_thread;
std::atomic<bool> is_stopping = false;

void run_frame() {
  if (callback != nullptr && !device.never_calls_back && callback(callback_argument) == 0) callback = nullptr;
}

void keep_rule(bool is_kept) {
  if (!is_kept) ++device.broken_rules;
}

void let_go() {
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
  device.has_no_temperature = device.never_calls_back = device.own_thread = false;
  let_go();
  motors.told(0);
  std::fill(device.joint_torque, device.joint_torque + 3, 0.0);
  device.is_output_on = device.is_initialised = device.is_scheduler_running = false;
  device.frames = device.broken_rules = 0;
  errors.clear();
  callback = nullptr;
  is_in_frame = false;
}

}  // namespace

extern "C" {

feeler_test::OpenHapticsStandIn* feeler_stand_in() {
  device.tick = &run_frame;
  device.motors = &motors;
  device.reset = &reset;
  return &device;
}

unsigned int hdInitDevice(const char*) {
  const Lock lock(device.mutex);
  if (device.error_at_init != 0) {
    errors.push_back(device.error_at_init);
    return 0xFFFFFFFF;
  }
  device.is_initialised = true;
  return 7;
}

void hdDisableDevice(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(handle == 7 && device.is_initialised && !device.is_scheduler_running);
  device.is_initialised = false;
}

void hdMakeCurrentDevice(unsigned int handle) {
  keep_rule(handle == 7);
}

void hdBeginFrame(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(handle == 7 && !is_in_frame);
  is_in_frame = true;
  ++device.frames;
  if (device.error_in_next_frame != 0) errors.push_back(std::exchange(device.error_in_next_frame, 0));
  if (device.error_in_every_frame != 0) errors.push_back(device.error_in_every_frame);
}

void hdEndFrame(unsigned int handle) {
  const Lock lock(device.mutex);
  keep_rule(handle == 7 && is_in_frame);
  is_in_frame = false;
  if (device.error_after_push != 0) errors.push_back(std::exchange(device.error_after_push, 0));
}

ErrorInformation hdGetError() {
  const Lock lock(device.mutex);
  if (errors.empty()) return {0, 0, 7};
  const unsigned int code = errors.front();
  errors.pop_front();
  return {code, -1, 7};
}

const char* hdGetErrorString(unsigned int) {
  return "an error in the words of libHD";
}

void hdEnable(unsigned int capability) {
  const Lock lock(device.mutex);
  if (capability == 0x4000) device.is_output_on = true;
}

void hdDisable(unsigned int capability) {
  const Lock lock(device.mutex);
  if (capability == 0x4000) {
    device.is_output_on = false;
    let_go();
  }
}

void hdGetIntegerv(unsigned int parameter, int* value) {
  const Lock lock(device.mutex);
  keep_rule(is_in_frame);
  switch (parameter) {
    case 0x2000:
      *value = device.buttons;
      break;
    case 0x2554:
      *value = device.output_degrees;
      break;
    case 0x2555:
      *value = int(device.calibration_styles);
      break;
    case 0x2600:
      *value = 1000;
      break;
    default:
      errors.push_back(0x100);
  }
}

void hdGetDoublev(unsigned int parameter, double* values) {
  const Lock lock(device.mutex);
  keep_rule(is_in_frame);
  switch (parameter) {
    case 0x2052:
      std::copy(device.transform, device.transform + 16, values);
      break;
    case 0x2602:
      *values = 1.0;
      break;
    case 0x2603:
      *values = 20.0;
      break;
    case 0x2604:
      *values = 2.5;
      break;
    case 0x2605:
      if (device.has_no_temperature) {
        errors.push_back(0x103);
      } else {
        std::copy(device.temperatures, device.temperatures + 6, values);
      }
      break;
    default:
      errors.push_back(0x100);
  }
}

const char* hdGetString(unsigned int parameter) {
  return parameter == 0x2501 ? device.model : nullptr;
}

void hdSetDoublev(unsigned int parameter, const double* values) {
  const Lock lock(device.mutex);
  keep_rule(is_in_frame);
  double* axes = nullptr;
  if (parameter == 0x2700) axes = device.force;
  if (parameter == 0x2701) axes = device.torque;
  if (parameter == 0x2704) axes = device.joint_torque;
  if (axes == nullptr || (parameter != 0x2700 && device.output_degrees < 6)) {
    errors.push_back(0x100);
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
  keep_rule((style == 1) !=
            device.is_scheduler_running);  // an encoder reset comes before the loop, all else in it
  if (device.error_at_update != 0) return errors.push_back(device.error_at_update);
  if ((style & device.calibration_styles) == 0) return errors.push_back(0x100);
  device.calibrated_by = style;
  if (device.calibration == 0x5001 && --device.updates_missing <= 0) device.calibration = 0x5000;
}

unsigned long hdScheduleAsynchronous(unsigned int (*function)(void*), void* argument, unsigned short) {
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
      errors.push_back(device.error_at_start);
      return;
    }
    device.is_scheduler_running = true;
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
