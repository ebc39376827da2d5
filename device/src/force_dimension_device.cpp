// Calls the DHD library, whose names and values are declared here from its documentation.
#include "feeler/device/force_dimension_device.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include "direct_driver.hpp"
#include "feeler/device/rotation_matrix.hpp"
#include "feeler/device/shared_library.hpp"
#include "maker_frame.hpp"

namespace feeler {
namespace {

// Answers of a call; below 0 is an error, above is none.
constexpr int time_guard = 1;
constexpr int motors_saturated = 2;

/// Places in the answer of dhdGetStatus.
enum Status : int { has_power = 0, waits_for_calibration = 3, pushes = 5, brakes = 6, turns = 7, has_error = 9, force_off_cause = 14 };
constexpr int most_status = 32;  // 16 or 17, by the version

/// What switched the force off, as the status tells it.
const char* sentence_of_cause(int cause) noexcept {
  switch (cause) {
    case 1: return "The force was switched off by the button of the device: press it again.";
    case 2: return "The handle moved faster than the device allows, so its force is off: hold it firmly and press its force button.";
    case 3: return "The device was told no force for too long, so its force is off: press its force button.";
    case 5: return "The USB cable was off, so the force of the device is off: press its force button.";
    case 6: return "The dead man's switch of the device is released: hold the handle.";
    default: return "The force of the device is off: press its force button.";
  }
}

/// The functions, fetched by name. The last argument is the device; default arguments exist in C++ headers
/// only.
struct Library {
  SharedLibrary file;
  int (*open)() = nullptr;
  int (*open_index)(char) = nullptr;
  int (*open_serial_number)(int) = nullptr;
  int (*close)(char) = nullptr;
  int (*device_count)() = nullptr;
  int (*system_type)(char) = nullptr;
  int (*get_status)(int*, char) = nullptr;
  bool (*has_wrist)(char) = nullptr;
  bool (*has_active_wrist)(char) = nullptr;
  int (*get_pose)(double*, double*, double*, double (*)[3], char) = nullptr;
  unsigned int (*button_mask)(char) = nullptr;
  int (*set_wrench)(double, double, double, double, double, double, double, char) = nullptr;
  int (*set_max_force)(double, char) = nullptr;
  int (*set_gravity_compensation)(int, char) = nullptr;
  int (*enable_force)(unsigned char, char) = nullptr;
  const char* (*last_error)() = nullptr;

  /// What libdrd has over libdhd.
  struct Robotics {
    int (*open)(char) = nullptr;
    int (*close)(char) = nullptr;
    bool (*is_initialised)(char) = nullptr;
    int (*initialise)(char) = nullptr;
    int (*stop)(bool, char) = nullptr;
  } robotics;
  bool has_robotics = false;

  /// @return a sentence that says what is missing and how to get it; empty once all is there
  std::string load(const std::vector<std::string>& candidates) {
    const std::string refusal = file.load(candidates);
    if (!refusal.empty()) {
      const bool lacks_usb = refusal.find("libusb") != std::string::npos;
      return "Force Dimension: neither libdrd.so nor libdhd.so can be loaded (" + refusal + "): " +
             (lacks_usb ? "install libusb-1.0-0, which they need."
                        : "install the SDK of Force Dimension and copy lib/release/lin-*/libdrd.so.* to "
                          "/usr/local/lib, then run ldconfig.");
    }
    for (const char* const missing : {
             file.find("dhdOpen", open),
             file.find("dhdOpenID", open_index),
             file.find("dhdOpenSerial", open_serial_number),
             file.find("dhdClose", close),
             file.find("dhdGetDeviceCount", device_count),
             file.find("dhdGetSystemType", system_type),
             file.find("dhdGetStatus", get_status),
             file.find("dhdHasWrist", has_wrist),
             file.find("dhdHasActiveWrist", has_active_wrist),
             file.find("dhdGetPositionAndOrientationFrame", get_pose),
             file.find("dhdGetButtonMask", button_mask),
             file.find("dhdSetForceAndTorqueAndGripperForce", set_wrench),
             file.find("dhdSetMaxForce", set_max_force),
             file.find("dhdSetGravityCompensation", set_gravity_compensation),
             file.find("dhdEnableForce", enable_force),
             file.find("dhdErrorGetLastStr", last_error),
         }) {
      if (missing != nullptr) {
        return "Force Dimension: " + file.path() + " has no function " + missing + ": install SDK 3.10 or later, or point to its library.";
      }
    }
    has_robotics = file.find("drdOpenID", robotics.open) == nullptr && file.find("drdClose", robotics.close) == nullptr &&
                   file.find("drdIsInitialized", robotics.is_initialised) == nullptr && file.find("drdAutoInit", robotics.initialise) == nullptr &&
                   file.find("drdStop", robotics.stop) == nullptr;
    return {};
  }
};

DeviceSpecification preset_of(int system_type) {
  switch (system_type) {
    case 33: return omega_3();
    case 34:
    case 36: return omega_6();
    case 35:
    case 37: return omega_7();
    case 60: return falcon();
    case 63:
    case 64: return delta_3();
    case 104:
    case 105: return sigma_7();
    case 108:
    case 109: return lambda_7();
    case 131:
    case 132: {
      DeviceSpecification device = lambda_7();
      device.name = "lambda.6";
      return device;
    }
    case 203: {
      DeviceSpecification device = lambda_7();
      device.name = "lambda.3";
      return device;
    }
    case 206: {
      DeviceSpecification device = sigma_7();
      device.name = "sigma.3";
      return device;
    }
    default: {
      DeviceSpecification device = omega_6();  // the weakest of those it could be
      device.name = "Force Dimension device of type " + std::to_string(system_type);
      return device;
    }
  }
}

class ForceDimensionDriver final : public DirectDriver {
 public:
  ForceDimensionDriver(ForceDimensionSettings settings, Clock* clock) : DirectDriver(omega_6(), clock), settings_(std::move(settings)) {}

 private:
  std::string connect() override {
    if (std::string problem = library_.load(settings_.libraries); !problem.empty()) return problem;
    const int opened = open_chosen();
    if (opened < 0) return refusal();
    device_ = static_cast<char>(opened);
    is_robot_ = library_.has_robotics && library_.robotics.open(device_) >= 0;
    DeviceSpecification device = preset_of(library_.system_type(device_));
    if (!library_.has_wrist(device_)) device.is_sensed = {true, true, true, false, false, false};
    if (!library_.has_active_wrist(device_)) device.lose_torque();
    specify(std::move(device));
    return {};
  }

  /// @return its ID, or below 0
  int open_chosen() {
    if (settings_.serial_number) return library_.open_serial_number(*settings_.serial_number);
    if (!settings_.index) return library_.open();
    const int index = *settings_.index;
    return index >= 0 && index <= 127 ? library_.open_index(static_cast<char>(index)) : -1;  // the library takes -1 for any
  }

  std::string refusal() const {
    std::string sentence = "Force Dimension: no device can be opened (" + error() + "): ";
    if (library_.device_count() <= 0) {
      return sentence +
             "check its power and USB cable, and that a udev rule lets you write to it: "
             "SUBSYSTEM==\"usb\", ATTRS{idVendor}==\"1451\", MODE=\"0666\" in /etc/udev/rules.d/.";
    }
    if (settings_.serial_number) sentence += "look if it has the serial number " + std::to_string(*settings_.serial_number) + ", and ";
    else if (settings_.index) sentence += "look if there is one with the index " + std::to_string(*settings_.index) + ", counted from 0, and ";
    return sentence + "close the other program that uses it.";
  }
  std::string error() const {
    const char* const text = library_.last_error();
    return text != nullptr ? text : "no error given";
  }

  /// Calibration, where it is missing and the caller asks for it. @return what keeps the device from being used
  std::string calibrate() {
    int status[most_status] = {};
    if (library_.get_status(status, device_) < 0)
      return "Force Dimension: the device does not tell its status (" + error() + "): check its USB cable.";
    if (status[has_power] == 0) return "Force Dimension: the device has no power: switch it on, and check its power supply.";
    if (status[has_error] != 0) return "Force Dimension: the device reports an error: switch it off and on.";
    if (is_calibrated(status)) return {};
    if (!settings_.initialises) {
      return "Force Dimension: the device is not calibrated: put its handle where its manual shows and follow it (a Falcon: pull it out and push it in), or "
             "set ForceDimensionSettings::initialises and take your hands off, because it moves.";
    }
    if (!is_robot_)
      return "Force Dimension: the device cannot initialise itself with " + library_.file.path() +
             ": use libdrd, or calibrate it as its manual says.";
    if (library_.robotics.initialise(device_) < 0 || library_.robotics.stop(true, device_) < 0 || library_.get_status(status, device_) < 0 ||
        !is_calibrated(status))
      return "Force Dimension: the device cannot initialise itself (" + error() + "): free its handle, or calibrate it as its manual says.";
    return {};
  }
  bool is_calibrated(const int (&status)[most_status]) const {
    return status[waits_for_calibration] == 0 && (!is_robot_ || library_.robotics.is_initialised(device_));
  }

  /// Limits, gravity compensation, force on at zero, after the first pose.
  std::string switch_on(DeviceState& state) override {
    if (std::string problem = calibrate(); !problem.empty()) return problem;
    for (int wait = 0;; ++wait) {
      if (const char* const why = take_pose(state))
        return "Force Dimension: the device gives no pose (" + std::string(why) + "): calibrate it as its manual says.";
      if (is_renewed_) break;
      if (wait == 1000) return "Force Dimension: no pose came within a second: check the USB cable.";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (library_.set_max_force(specification().maximum_force, device_) < 0 || library_.set_gravity_compensation(1, device_) < 0 ||
        !push({}).is_taken || library_.enable_force(1, device_) < 0) {
      return "Force Dimension: the device refuses to push (" + error() + "): press its force button.";
    }
    // It takes its time to switch the force on. What keeps it off is told by every read.
    for (int wait = 0; wait < 100 && look_for_hindrances() && hindrance_ != nullptr; ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {};
  }

  void switch_off() noexcept override {
    library_.enable_force(0, device_);
    (is_robot_ ? library_.robotics.close : library_.close)(device_);
  }

  const char* take_pose(DeviceState& state) noexcept override {
    double position[3] = {0, 0, 0};
    double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int answer = library_.get_pose(&position[0], &position[1], &position[2], frame, device_);
    if (answer < 0 || !look_for_hindrances()) return reason();
    is_renewed_ = answer != time_guard;
    if (!is_renewed_) return nullptr;
    double ours[3][3];
    maker_frame::to_ours(frame, ours);
    const bool is_position = std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
    if (!is_position || !nearest_rotation(ours, state.pose.orientation))
      return "The device reports a pose that is none: calibrate it as its manual says.";
    maker_frame::to_ours(position, state.pose.position);
    state.buttons = library_.button_mask(device_);
    state.time = time();
    return nullptr;
  }

  /// Whether the device says what keeps it from pushing.
  bool look_for_hindrances() noexcept {
    int status[most_status] = {};
    if (library_.get_status(status, device_) < 0) return false;
    hindrance_ = status[has_power] == 0               ? "The device has no power: check its power supply."
                 : status[has_error] != 0             ? "The device reports an error: switch it off and on."
                 : status[waits_for_calibration] != 0 ? "The device lost its calibration: calibrate it as its manual says, then open it again."
                 : status[pushes] == 0 || status[brakes] != 0            ? sentence_of_cause(status[force_off_cause])
                 : specification().pushes_torque() && status[turns] == 0 ? "The motors of the wrist are off: press the force button of the device."
                                                                         : nullptr;
    return true;
  }
  const char* hindrance() const noexcept override { return hindrance_; }

  /// A driven gripper is left free: it has a force of its own, which only this call sets.
  Answer push(const DeviceWrench& wrench) noexcept override {
    double f[3];
    double t[3];
    maker_frame::to_maker(wrench.force, f);
    maker_frame::to_maker(wrench.torque, t);
    if (!specification().pushes_torque()) std::fill(t, t + 3, 0.0);
    const int answer = library_.set_wrench(f[0], f[1], f[2], t[0], t[1], t[2], 0, device_);
    if (answer < 0) return {false, reason()};
    if (answer == motors_saturated) return {true, "The motors give all they can and less than was asked for: lower the stiffness."};
    return {true};
  }

  /// Why the library refused.
  const char* reason() const noexcept {
    const char* const text = library_.last_error();
    return text != nullptr ? text : "The device stopped answering: check its cable.";
  }

  ForceDimensionSettings settings_;
  Library library_;
  char device_ = -1;
  bool is_robot_ = false;            // libdrd knows it, and can calibrate it
  bool is_renewed_ = false;          // the pose, since it was taken before
  const char* hindrance_ = nullptr;  // its power, its calibration, its force button and the like
};

}  // namespace

ForceDimensionDevice::ForceDimensionDevice(ForceDimensionSettings settings, Clock* clock)
    : DrivenDevice(std::make_unique<ForceDimensionDriver>(std::move(settings), clock)) {}

}  // namespace feeler
