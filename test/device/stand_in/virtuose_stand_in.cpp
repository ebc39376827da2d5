// Stands in for libvirtuose.so: the same symbols, over a device that has the faults it is told to have.
#include "virtuose_stand_in.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

namespace {

feeler_test::VirtuoseStandIn device;
feeler_test::MotorLog motors;
std::string address;

int answer() { return device.is_unplugged || !device.is_open ? -1 : 0; }

void reset() {
  motors.told(0);
  device = {};
  device.motors = &motors;
  device.reset = &reset;
}

}  // namespace

extern "C" {

feeler_test::VirtuoseStandIn* feeler_stand_in() {
  device.motors = &motors;
  device.reset = &reset;
  return &device;
}

void* virtOpen(const char* name) {
  address = name;
  device.address = address.c_str();
  if (device.refuses_to_open) return nullptr;
  device.is_open = true;
  return &device;
}

int virtClose(void*) {
  device.is_open = false;
  std::fill(device.wrench, device.wrench + 6, 0.0f);
  return 0;
}

int virtGetErrorCode(void*) { return device.refuses_to_open || device.is_unplugged ? 2 : 17; }
const char* virtGetErrorMessage(int code) { return code == 2 ? "communication failure" : "wrong mode"; }

int virtSetIndexingMode(void*, int mode) {
  device.indexing_mode = mode;
  return answer();
}
int virtSetForceFactor(void*, float factor) { return factor == 1 ? answer() : -1; }
int virtSetSpeedFactor(void*, float factor) { return factor == 1 ? answer() : -1; }
int virtSetTimeStep(void*, float step) {
  device.time_step = step;
  return answer();
}
int virtSetBaseFrame(void*, float*) { return answer(); }
int virtSetObservationFrame(void*, float*) { return answer(); }

int virtSetCommandType(void*, int type) {
  if (device.refuses_impedance) return -1;
  device.command_type = type;
  return answer();
}

int virtSaturateTorque(void*, float force, float torque) {
  device.saturation[0] = force;
  device.saturation[1] = torque;
  return answer();
}

int virtSetPowerOn(void*, int power) {
  device.is_powered = power != 0;
  return answer();
}

int virtGetPowerOn(void*, int* power) {
  *power = device.is_powered ? 1 : 0;
  return answer();
}

int virtGetDeadMan(void*, int* is_held) {
  *is_held = device.is_held ? 1 : 0;
  return answer();
}

int virtGetEmergencyStop(void*, int* is_chain_closed) {
  *is_chain_closed = device.is_emergency_stopped ? 0 : 1;
  return answer();
}

int virtGetAlarm(void*, unsigned int* alarm) {
  *alarm = device.alarm;
  return answer();
}

int virtGetFailure(void*, unsigned int* failure) {
  *failure = device.failure;
  return answer();
}

// In ticks of a tenth of a microsecond; renewed every millisecond.
int virtGetTimeLastUpdate(void*, unsigned int* ticks) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  *ticks = static_cast<unsigned int>(1e7 * device.seconds_late) + static_cast<unsigned int>(std::chrono::nanoseconds(now).count() % 1'000'000 / 100);
  return answer();
}

int virtGetPosition(void*, float* pose) {
  std::copy(device.pose, device.pose + 7, pose);
  return answer();
}

int virtGetButton(void*, int button, int* state) {
  if (button < 0 || button >= 6) return -1;
  *state = device.buttons[button];
  return answer();
}

#ifndef FEELER_STAND_IN_LACKS_A_FUNCTION
int virtSetForce(void*, float* wrench) {
  if (answer() != 0) return -1;
  std::copy(wrench, wrench + 6, device.wrench);
  motors.told(double(std::hypot(wrench[0], wrench[1], wrench[2]) + std::hypot(wrench[3], wrench[4], wrench[5])));
  return 0;
}
#endif
}
