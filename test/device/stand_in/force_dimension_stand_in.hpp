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

  // The device. Its ID is its index; the first three are in use by others.
  int system_type = 104;  // sigma.7
  int device_count = 1;   // of those that are free; the first has the serial number 1003

  // Faults.
  bool refuses_to_open = false;
  bool refuses_force = false;  // at start
  bool is_unplugged = false;
  bool needs_calibration = false;
  bool only_drd_knows = false;  // that it needs one
  bool fails_to_initialise = false;
  bool is_unknown_to_drd = false;
  bool has_power = true;
  bool has_error = false;
  bool is_braking = false;
  bool has_wrist_motors_on = true;  // while the force is on
  int force_off_cause = 0;       // other than 0: the force is off, whatever was asked for
  bool has_nothing_new = false;  // answers with the time guard
  bool is_saturated = false;

  // The motors.
  double force[3] = {0, 0, 0};   // [N]
  double torque[3] = {0, 0, 0};  // [N·m]
  double gripper_force = 1;      // [N], left by another program
  bool is_force_on = false;
  bool compensates_gravity = false;
  double maximum_force = 0;  // [N]
  bool is_open = false;
  int id = -1;                  // of the one opened
  bool is_open_in_drd = false;  // then drd closes it
  bool is_regulated = false;    // drd moves it
  int wrong_ids = 0;            // calls for another device than the one opened
  int broken_rules = 0;  // force on without a calibration or under the regulation of drd, and a wrong way to close

  MotorLog* motors = nullptr;
  void (*reset)() = nullptr;
};

}  // namespace feeler_test
