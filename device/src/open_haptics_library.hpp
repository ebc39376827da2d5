// The part of libHD.so that Feeler uses, declared from its documented names, values and units.
#pragma once

#include <string>
#include <vector>

#include "feeler/device/shared_library.hpp"

namespace feeler::open_haptics {

using Handle = unsigned int;
constexpr Handle invalid_handle = 0xFFFFFFFF;

/// Parameters of hdGet…v and hdSet…v.
enum Parameter : unsigned int {
  current_buttons = 0x2000,           // int, bit n is button n + 1
  current_safety_switch = 0x2001,     // boolean: 1 where the device gives no force
  current_inkwell_switch = 0x2002,    // boolean: 0 with the stylus in its inkwell, where the device gives no force
  current_transform = 0x2052,         // 16 doubles, column by column [mm]
  device_model_type = 0x2501,         // string
  output_degrees = 0x2554,            // int, 3 or 6
  calibration_styles = 0x2555,        // int, a bit for each that the device supports
  update_rate = 0x2600,               // int [Hz]
  nominal_max_stiffness = 0x2602,     // double [N/mm]
  nominal_max_force = 0x2603,         // double [N]
  nominal_continuous_force = 0x2604,  // double [N]
  motor_temperature = 0x2605,         // doubles, one a motor, 0 to 1
  current_force = 0x2700,             // 3 doubles, base axes [N]
  current_torque = 0x2701,            // 3 doubles, base axes [mN·m]
};

/// Switches of hdEnable and hdDisable.
enum Capability : unsigned int { force_output = 0x4000 };

/// Answers of hdCheckCalibration.
enum Calibration : unsigned int { calibrated = 0x5000, needs_update = 0x5001, needs_manual_input = 0x5002 };

/// Ways to calibrate, as bits.
enum CalibrationStyle : unsigned int {
  encoder_reset = 1,  // where the arm is now becomes the reset position: only for who holds it there
  automatic = 2,      // by what the device knows of itself
  inkwell = 4,        // by the stylus in its inkwell
};

enum ErrorCode : unsigned int {
  success = 0,
  bad_handle = 0x104,
  first_force_error = 0x200,  // up to 0x2ff: the device complains and goes on
  warm_motors = 0x200,
  exceeded_max_force = 0x201,
  exceeded_max_force_impulse = 0x202,
  exceeded_max_velocity = 0x203,
  force_error = 0x204,
  first_device_error = 0x300,
  device_fault = 0x300,
  device_already_initiated = 0x301,
  communication_error = 0x302,
  communication_configuration = 0x303,
  timer_error = 0x304,
  invalid_priority = 0x500,
  scheduler_full = 0x501,
  invalid_license = 0x600,
};

/// Returned by value.
struct Error {
  unsigned int code;
  int internal_code;
  Handle handle;
};
static_assert(sizeof(Error) == 12);

using Callback = unsigned int (*)(void*);
constexpr unsigned int callback_continues = 1;
constexpr unsigned short highest_priority = 65535;
constexpr int most_errors = 64;  // in store at once

/// The functions, fetched by name.
struct Library {
  SharedLibrary file;
  Handle (*init_device)(const char*) = nullptr;
  void (*disable_device)(Handle) = nullptr;
  void (*make_current_device)(Handle) = nullptr;
  void (*begin_frame)(Handle) = nullptr;
  void (*end_frame)(Handle) = nullptr;
  Error (*get_error)() = nullptr;
  const char* (*get_error_string)(unsigned int) = nullptr;
  void (*enable)(unsigned int) = nullptr;
  void (*disable)(unsigned int) = nullptr;
  void (*get_booleans)(unsigned int, unsigned char*) = nullptr;
  void (*get_integers)(unsigned int, int*) = nullptr;
  void (*get_doubles)(unsigned int, double*) = nullptr;
  const char* (*get_string)(unsigned int) = nullptr;
  void (*set_doubles)(unsigned int, const double*) = nullptr;
  unsigned int (*check_calibration)() = nullptr;
  void (*update_calibration)(unsigned int) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  unsigned long (*schedule_asynchronous)(Callback, void*, unsigned short) = nullptr;
  void (*unschedule)(unsigned long) = nullptr;

  /// @return a sentence that says what is missing and how to get it; empty once all is there
  std::string load(const std::vector<std::string>& candidates);
};

/// What an error of the device means to its user, in a sentence that is never freed; nullptr for one without
/// a sentence of ours.
const char* sentence_of(unsigned int code) noexcept;

/// Whether libHD serves the device no longer: what the maker's own utilities call an error of the scheduler,
/// and a handle of no device. From all others it recovers by itself.
bool ends_session(unsigned int code) noexcept;

}  // namespace feeler::open_haptics
