// The controls of the library that stands in for libHD.so: what its hand does, which faults it has, and what
// its motors were told.
#pragma once

#include <mutex>

#include "motor_log.hpp"

namespace feeler_test {

/// One for the whole process. While `own_thread` runs the frames, take the mutex.
struct OpenHapticsStandIn {
  std::mutex mutex;

  // The hand.
  double transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // column by column [mm]
  int buttons = 0;
  bool is_in_inkwell = false;
  bool is_safety_switch_on = false;
  double temperatures[6] = {0, 0, 0, 0, 0, 0};

  // The device.
  const char* model = "PHANTOM Premium 3.0";
  int output_degrees = 6;
  unsigned int calibration_styles = 2;  // bits: encoder reset, automatic, inkwell

  // Faults.
  unsigned int error_at_init = 0;        // with an invalid handle
  unsigned int error_at_start = 0;       // of the scheduler
  unsigned int calibration = 0x5000;     // OK
  int updates_missing = 1;               // until a calibration that needs an update is OK
  unsigned int error_at_update = 0;      // of the calibration
  unsigned int error_in_next_frame = 0;  // once
  unsigned int error_in_every_frame = 0;
  unsigned int error_after_push = 0;  // once, found by hdEndFrame
  bool has_no_temperature = false;    // asking is an error
  bool has_no_switches = false;       // the same
  bool never_calls_back = false;

  // The motors, and the rules that were kept.
  double force[3] = {0, 0, 0};         // [N]
  double torque[3] = {0, 0, 0};        // base axes [mN·m]
  double joint_torque[3] = {0, 0, 0};  // of the gimbal: what nobody may set with base axes
  bool is_output_on = false;
  bool is_initialised = false;
  bool is_scheduler_running = false;
  int frames = 0;
  int starts = 0;                  // of the scheduler
  unsigned int calibrated_by = 0;  // the style of the last update
  int broken_rules = 0;  // a get, a set or an end outside a frame, a device initialised or disabled while the
                         // scheduler runs, and the like

  // A second device, named "second", in the same hand.
  double second_force[3] = {0, 0, 0};  // [N]
  bool is_second_initialised = false;
  unsigned int error_of_second_in_next_frame = 0;  // once, found in the frame of the first

  int others = 0;  // devices named "other…": they are initialised, and that is all

  // Runs the scheduled frames once, as the servo thread does.
  void (*tick)() = nullptr;
  bool own_thread = false;  // set before the scheduler starts: frames run on a thread of the stand-in, once a millisecond
  MotorLog* motors = nullptr;
  void (*reset)() = nullptr;
};

}  // namespace feeler_test
