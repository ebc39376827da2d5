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

/// The functions, fetched by name. The last argument is the device; default arguments exist in C++ headers
/// only.
struct Library {
  SharedLibrary file;
  int (*open)() = nullptr;
  int (*close)(char) = nullptr;
  int (*device_count)() = nullptr;
  int (*system_type)(char) = nullptr;
  bool (*has_wrist)(char) = nullptr;
  bool (*has_active_wrist)(char) = nullptr;
  int (*get_pose)(double*, double*, double*, double (*)[3], char) = nullptr;
  unsigned int (*button_mask)(char) = nullptr;
  int (*set_wrench)(double, double, double, double, double, double, char) = nullptr;
  int (*set_max_force)(double, char) = nullptr;
  int (*set_gravity_compensation)(int, char) = nullptr;
  int (*enable_force)(unsigned char, char) = nullptr;
  const char* (*last_error)() = nullptr;

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
             file.find("dhdClose", close),
             file.find("dhdGetDeviceCount", device_count),
             file.find("dhdGetSystemType", system_type),
             file.find("dhdHasWrist", has_wrist),
             file.find("dhdHasActiveWrist", has_active_wrist),
             file.find("dhdGetPositionAndOrientationFrame", get_pose),
             file.find("dhdGetButtonMask", button_mask),
             file.find("dhdSetForceAndTorque", set_wrench),
             file.find("dhdSetMaxForce", set_max_force),
             file.find("dhdSetGravityCompensation", set_gravity_compensation),
             file.find("dhdEnableForce", enable_force),
             file.find("dhdErrorGetLastStr", last_error),
         }) {
      if (missing != nullptr) {
        return "Force Dimension: " + file.path() + " has no function " + missing +
               ": install SDK 3.10 or later, or point to its library.";
      }
    }
    return {};
  }
};

DeviceSpecification preset_of(int system_type) {
  switch (system_type) {
    case 33:
      return omega_3();
    case 34:
    case 36:
      return omega_6();
    case 35:
    case 37:
      return omega_7();
    case 60:
      return falcon();
    case 63:
    case 64:
      return delta_3();
    case 104:
    case 105:
      return sigma_7();
    case 108:
    case 109:
      return lambda_7();
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
    const int opened = library_.open();
    if (opened < 0) return refusal();
    device_ = static_cast<char>(opened);
    DeviceSpecification device = preset_of(library_.system_type(device_));
    if (!library_.has_wrist(device_)) device.is_sensed = {true, true, true, false, false, false};
    if (!library_.has_active_wrist(device_)) device.lose_torque();
    specify(std::move(device));
    return {};
  }

  std::string refusal() const {
    std::string sentence = "Force Dimension: no device can be opened (" + error() + "): ";
    if (library_.device_count() <= 0) {
      return sentence +
             "check its power and USB cable, and that a udev rule lets you write to it: "
             "SUBSYSTEM==\"usb\", ATTRS{idVendor}==\"1451\", MODE=\"0666\" in /etc/udev/rules.d/.";
    }
    return sentence + "calibrate it as its manual says, and close the other program that uses it.";
  }
  std::string error() const {
    const char* const text = library_.last_error();
    return text != nullptr ? text : "no error given";
  }

  /// Limits, gravity compensation, force on at zero, after the first pose.
  std::string switch_on(DeviceState& state) override {
    for (int wait = 0;; ++wait) {
      if (const char* const why = take_pose(state))
        return "Force Dimension: the device gives no pose (" + std::string(why) + "): calibrate it as its manual says.";
      if (is_renewed_) break;
      if (wait == 1000) return "Force Dimension: no pose came within a second: check the USB cable.";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (library_.set_max_force(specification().maximum_force, device_) < 0 ||
        library_.set_gravity_compensation(1, device_) < 0 || !push({}).is_taken ||
        library_.enable_force(1, device_) < 0) {
      return "Force Dimension: the device refuses to push (" + error() +
             "): press its force button, and calibrate it as its manual says.";
    }
    return {};
  }

  void switch_off() noexcept override {
    library_.enable_force(0, device_);
    library_.close(device_);
  }

  const char* take_pose(DeviceState& state) noexcept override {
    double position[3] = {0, 0, 0};
    double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int answer = library_.get_pose(&position[0], &position[1], &position[2], frame, device_);
    if (answer < 0) return reason();
    is_renewed_ = answer != time_guard;
    if (!is_renewed_) return nullptr;
    double ours[3][3];
    maker_frame::to_ours(frame, ours);
    const bool is_position =
        std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
    if (!is_position || !nearest_rotation(ours, state.pose.orientation))
      return "The device reports a pose that is none: calibrate it as its manual says.";
    maker_frame::to_ours(position, state.pose.position);
    state.buttons = library_.button_mask(device_);
    state.time = time();
    return nullptr;
  }

  Answer push(const DeviceWrench& wrench) noexcept override {
    double f[3];
    double t[3];
    maker_frame::to_maker(wrench.force, f);
    maker_frame::to_maker(wrench.torque, t);
    if (!specification().pushes_torque()) std::fill(t, t + 3, 0.0);
    const int answer = library_.set_wrench(f[0], f[1], f[2], t[0], t[1], t[2], device_);
    if (answer < 0) return {false, reason()};
    if (answer == motors_saturated)
      return {true, "The motors give all they can and less than was asked for: lower the stiffness."};
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
  bool is_renewed_ = false;  // the pose, since it was taken before
};

}  // namespace

ForceDimensionDevice::ForceDimensionDevice(ForceDimensionSettings settings, Clock* clock)
    : DrivenDevice(std::make_unique<ForceDimensionDriver>(std::move(settings), clock)) {}

}  // namespace feeler
