// Calls the DHD library, whose names and values are declared here from its documentation.
#include "feeler/device/force_dimension_device.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>
#include <utility>

#include "feeler/device/rotation_matrix.hpp"
#include "feeler/device/shared_library.hpp"
#include "feeler/device/wrench_limit.hpp"
#include "maker_frame.hpp"
#include "single_caller.hpp"

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

class ForceDimensionDriver final : public Device {
 public:
  ForceDimensionDriver(ForceDimensionSettings settings, Clock* clock)
      : settings_(std::move(settings)), clock_(clock != nullptr ? *clock : monotonic_clock_) {}

  OpenResult open() override {
    if (is_open_) return {};
    if (std::string problem = library_.load(settings_.libraries); !problem.empty())
      return {std::move(problem)};
    const int opened = library_.open();
    if (opened < 0) return {refusal()};
    device_ = static_cast<char>(opened);
    is_open_ = true;
    is_lost_ = false;
    complaint_ = {};
    opened_at_ = clock_.now();
    specification_ = preset_of(library_.system_type(device_));
    if (!library_.has_wrist(device_)) specification_.is_sensed = {true, true, true, false, false, false};
    if (!library_.has_active_wrist(device_)) specification_.lose_torque();
    if (std::string problem = switch_on(); !problem.empty()) {
      close();
      return {std::move(problem)};
    }
    return {};
  }

  DeviceStatus read(DeviceState& state) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const auto turn = library_calls_.turn();
    if (turn && (is_lost_ || take_pose() < 0)) return DeviceStatus::fault;
    state = state_;
    if (turn) is_let_go_.store(false, std::memory_order_relaxed);  // else it is let go just now
    return DeviceStatus::ok;
  }

  DeviceStatus write(const DeviceWrench& wrench) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const bool is_good = is_finite(wrench);
    const auto turn = library_calls_.turn();
    if (!turn) return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;  // just now it is let go
    const bool pushes = is_good && !is_lost_ && !is_let_go_.load(std::memory_order_relaxed);
    // A lost device is told to let go as long as somebody asks it to push.
    const int answer =
        push(pushes ? limited(wrench, specification_.maximum_force, specification_.maximum_torque)
                    : DeviceWrench{});
    if (is_lost_) return DeviceStatus::fault;
    if (answer < 0) return lose(library_.last_error());
    if (answer == motors_saturated)
      say("The motors give all they can and less than was asked for: lower the stiffness.");
    return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;
  }

  void let_go() noexcept override {
    is_let_go_.store(true, std::memory_order_relaxed);  // before the turn: a write that comes after it knows
    if (const auto turn = library_calls_.turn(); turn && is_open_) push({});
  }

  void close() noexcept override {
    if (!is_open_) return;
    push({});
    library_.enable_force(0, device_);
    library_.close(device_);
    is_open_ = false;
  }

  const char* complaint() const noexcept override { return complaint_.data(); }

  const DeviceSpecification& specification() const noexcept override { return specification_; }

 private:
  std::string refusal() const {
    const char* const error = library_.last_error();
    std::string sentence = "Force Dimension: no device can be opened (" +
                           std::string(error != nullptr ? error : "no error given") + "): ";
    if (library_.device_count() <= 0) {
      return sentence +
             "check its power and USB cable, and that a udev rule lets you write to it: "
             "SUBSYSTEM==\"usb\", ATTRS{idVendor}==\"1451\", MODE=\"0666\" in /etc/udev/rules.d/.";
    }
    return sentence + "calibrate it as its manual says, and close the other program that uses it.";
  }

  /// Limits, gravity compensation, force on at zero, and the first pose.
  std::string switch_on() {
    for (int wait = 0;; ++wait) {
      const int answer = take_pose();
      if (answer < 0)
        return "Force Dimension: the device gives no pose (" + std::string(complaint()) +
               "): calibrate it as its manual says.";
      if (answer != time_guard) break;
      if (wait == 1000) return "Force Dimension: no pose came within a second: check the USB cable.";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (library_.set_max_force(specification_.maximum_force, device_) < 0 ||
        library_.set_gravity_compensation(1, device_) < 0 || push({}) < 0 ||
        library_.enable_force(1, device_) < 0) {
      const char* const error = library_.last_error();
      return "Force Dimension: the device refuses to push (" +
             std::string(error != nullptr ? error : "no error given") +
             "): press its force button, and calibrate it as its manual says.";
    }
    return {};
  }

  /// @return what the library answered; below 0 the device is lost
  int take_pose() noexcept {
    double position[3] = {0, 0, 0};
    double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int answer = library_.get_pose(&position[0], &position[1], &position[2], frame, device_);
    if (answer < 0) {
      lose(library_.last_error());
      return answer;
    }
    if (answer == time_guard) return answer;
    double ours[3][3];
    maker_frame::to_ours(frame, ours);
    const bool is_position =
        std::isfinite(position[0]) && std::isfinite(position[1]) && std::isfinite(position[2]);
    if (!is_position || !nearest_rotation(ours, state_.pose.orientation)) {
      lose("The device reports a pose that is none: calibrate it as its manual says.");
      return -1;
    }
    maker_frame::to_ours(position, state_.pose.position);
    state_.buttons = library_.button_mask(device_);
    state_.time = double(clock_.now() - opened_at_) * 1e-9;
    return answer;
  }

  int push(const DeviceWrench& wrench) noexcept {
    double f[3];
    double t[3];
    maker_frame::to_maker(wrench.force, f);
    maker_frame::to_maker(wrench.torque, t);
    if (!specification_.pushes_torque()) std::fill(t, t + 3, 0.0);
    return library_.set_wrench(f[0], f[1], f[2], t[0], t[1], t[2], device_);
  }

  DeviceStatus lose(const char* text) noexcept {
    is_lost_ = true;
    say(text != nullptr ? text : "The device stopped answering: check its cable.");
    return DeviceStatus::fault;
  }

  /// Copied, because the library may write its next error in the same place.
  void say(const char* text) noexcept { std::strncpy(complaint_.data(), text, complaint_.size() - 1); }

  ForceDimensionSettings settings_;
  DeviceSpecification specification_ = omega_6();
  MonotonicClock monotonic_clock_;
  Clock& clock_;
  Library library_;
  char device_ = -1;
  bool is_open_ = false;
  bool is_lost_ = false;
  SingleCaller library_calls_;  // by `read` and `write`, and by the watchdog
  std::atomic<bool> is_let_go_ = false;
  std::int64_t opened_at_ = 0;
  DeviceState state_;
  std::array<char, 200> complaint_ = {};
};

}  // namespace

ForceDimensionDevice::ForceDimensionDevice(ForceDimensionSettings settings, Clock* clock)
    : DrivenDevice(std::make_unique<ForceDimensionDriver>(std::move(settings), clock)) {}

}  // namespace feeler
