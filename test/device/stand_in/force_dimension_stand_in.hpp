// The controls of the library that stands in for libdhd.so: what its hand does, which faults it has, and what
// its motors were told.
#pragma once

#include "motor_log.hpp"

namespace feeler_test {

/// One for the whole process; used by one thread at a time, but for the log of the motors.
struct ForceDimensionStandIn {
  // The hand, in the maker's frame: x to the user, y right, z up.
  double position[3] = {0, 0, 0};                          // [m]
  double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // row by row
  unsigned int buttons = 0;

  // The device.
  int system_type = 104;  // sigma.7
  int device_count = 1;

  // Faults.
  bool refuses_to_open = false;
  bool refuses_force = false;  // at start
  bool is_unplugged = false;
  bool has_nothing_new = false;  // answers with the time guard
  bool is_saturated = false;

  // The motors.
  double force[3] = {0, 0, 0};   // [N]
  double torque[3] = {0, 0, 0};  // [N·m]
  bool is_force_on = false;
  bool compensates_gravity = false;
  double maximum_force = 0;  // [N]
  bool is_open = false;
  int wrong_ids = 0;  // calls for another device than the one opened

  MotorLog* motors = nullptr;
  void (*reset)() = nullptr;
};

}  // namespace feeler_test
