// Stands in for libdhd.so: the same symbols, over a device that has the faults it is told to have.
#include "force_dimension_stand_in.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace {

constexpr int first_free = 3;  // not 0, so that a driver that forgets it is found out
constexpr int time_guard = 1;
constexpr int saturated = 2;

feeler_test::ForceDimensionStandIn device;
feeler_test::MotorLog motors;

/// 0, or −1 for a device that is not there.
int answer_for(char id) {
  if (id != device.id) ++device.wrong_ids;
  return device.is_unplugged || !device.is_open || id != device.id ? -1 : 0;
}

int open_index(int index) {
  if (device.refuses_to_open || index < first_free || index >= first_free + device.device_count) return -1;
  device.is_open = true;
  device.id = index;
  return index;
}

int close(char id, bool is_in_drd) {
  const int answer = answer_for(id);
  if (device.is_open_in_drd != is_in_drd) ++device.broken_rules;
  device.is_open = device.is_open_in_drd = false;
  std::fill(device.force, device.force + 3, 0.0);
  std::fill(device.torque, device.torque + 3, 0.0);
  return answer;
}

bool pushes() { return device.is_force_on && device.force_off_cause == 0; }

void reset() {
  motors.told(0);
  device = {};
  device.motors = &motors;
  device.reset = &reset;
}

bool is_any_of(int type, std::initializer_list<int> types) { return std::find(types.begin(), types.end(), type) != types.end(); }
bool has_active_wrist() { return is_any_of(device.system_type, {104, 105, 108, 109}); }

}  // namespace

extern "C" {

feeler_test::ForceDimensionStandIn* feeler_stand_in() {
  device.motors = &motors;
  device.reset = &reset;
  return &device;
}

int dhdOpen() { return open_index(first_free); }
int dhdOpenID(char index) { return open_index(index == -1 ? first_free : index); }
int dhdOpenSerial(int serial_number) { return open_index(serial_number - 1000); }
int dhdClose(char id) { return close(id, false); }

int drdOpenID(char id) {
  if (device.is_unknown_to_drd) return -1;
  device.is_open_in_drd = true;
  return answer_for(id) < 0 ? -1 : id;
}
int drdClose(char id) { return close(id, true); }
bool drdIsInitialized(char id) { return answer_for(id) == 0 && !device.needs_calibration; }
int drdAutoInit(char id) {
  if (device.fails_to_initialise) return -1;
  device.needs_calibration = false;
  device.is_regulated = true;
  return answer_for(id);
}
int drdStop(bool, char id) {
  device.is_regulated = false;
  return answer_for(id);
}

int dhdGetStatus(int* status, char id) {
  std::fill(status, status + 17, 0);
  status[0] = device.has_power ? 1 : 0;
  status[1] = status[2] = 1;  // connected, started
  status[3] = device.needs_calibration && !device.only_drd_knows ? 1 : 0;
  status[4] = pushes() ? 0 : 1;
  status[5] = pushes() ? 1 : 0;
  status[6] = device.is_braking ? 1 : 0;
  status[7] = pushes() && device.has_wrist_motors_on && has_active_wrist() ? 1 : 0;
  status[9] = device.has_error ? 1 : 0;
  status[10] = device.compensates_gravity ? 1 : 0;
  status[14] = device.force_off_cause;
  return answer_for(id);
}

int dhdGetDeviceCount() { return device.device_count; }
int dhdGetSystemType(char id) { return answer_for(id) < 0 ? -1 : device.system_type; }
bool dhdHasWrist(char) { return !is_any_of(device.system_type, {33, 60, 63, 203, 206}); }
bool dhdHasActiveWrist(char) { return has_active_wrist(); }

int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double (*frame)[3], char id) {
  if (answer_for(id) < 0) return -1;
  if (device.has_nothing_new) return time_guard;
  *x = device.position[0];
  *y = device.position[1];
  *z = device.position[2];
  std::copy(&device.frame[0][0], &device.frame[0][0] + 9, &frame[0][0]);
  return 0;
}

unsigned int dhdGetButtonMask(char) { return device.buttons; }

int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz, double gripper, char id) {
  const int answer = answer_for(id);
  // A device that is unplugged holds what it was told last, for the worst case; its amplifiers lose power in
  // truth.
  if (device.is_unplugged) return -1;
  const double force[3] = {fx, fy, fz};
  const double torque[3] = {tx, ty, tz};
  std::copy(force, force + 3, device.force);
  std::copy(torque, torque + 3, device.torque);
  device.gripper_force = gripper;
  motors.told(std::hypot(fx, fy, fz) + std::hypot(tx, ty, tz));
  return answer < 0 ? answer : (device.is_saturated ? saturated : 0);
}

int dhdSetMaxForce(double limit, char id) {
  device.maximum_force = limit;
  return answer_for(id);
}

int dhdSetGravityCompensation(int value, char id) {
  device.compensates_gravity = value != 0;
  return answer_for(id);
}

int dhdEnableForce(unsigned char value, char id) {
  if (device.refuses_force && value != 0) return -1;
  if (value != 0 && (device.needs_calibration || device.is_regulated)) ++device.broken_rules;
  device.is_force_on = value != 0;
  return answer_for(id);
}

#ifndef FEELER_STAND_IN_LACKS_A_FUNCTION
const char* dhdErrorGetLastStr() { return device.is_unplugged ? "communication error" : "device not ready"; }
#endif
}
