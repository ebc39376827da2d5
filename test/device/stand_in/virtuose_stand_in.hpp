// The controls of the library that stands in for libvirtuose.so: what its hand does, which faults it has, and
// what its motors were told.
#pragma once

#include "motor_log.hpp"

namespace feeler_test {

/// One for the whole process; used by one thread at a time, but for the log of the motors.
struct VirtuoseStandIn {
  // The hand, in the maker's frame: x to the user, y right, z up.
  float pose[7] = {0, 0, 0, 0, 0, 0, 1};  // x, y, z [m], then the quaternion x, y, z, w
  int buttons[6] = {0, 0, 0, 0, 0, 0};

  // Faults.
  bool refuses_to_open = false;
  bool refuses_impedance = false;
  bool is_unplugged = false;
  bool is_emergency_stopped = false;
  bool is_held = true;
  unsigned int alarm = 0;    // bits: 0x4000 overheat, 0x8000 saturation
  unsigned int failure = 0;  // a bit a motor
  double seconds_late = 0;   // of its state: how long ago it should have been renewed

  // The motors.
  float wrench[6] = {0, 0, 0, 0, 0, 0};  // [N], [N·m]
  float saturation[2] = {0, 0};          // [N], [N·m]
  float time_step = 0;                   // [s]
  int command_type = 0;
  int indexing_mode = 0;
  bool is_powered = false;
  bool is_open = false;
  const char* address = "";

  MotorLog* motors = nullptr;
  void (*reset)() = nullptr;
};

}  // namespace feeler_test
