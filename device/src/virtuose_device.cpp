// Calls the Virtuose library, whose names and values are declared here from its documentation.
#include "feeler/device/virtuose_device.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include "direct_driver.hpp"
#include "feeler/core/requirement.hpp"
#include "feeler/device/shared_library.hpp"
#include "loop_period.hpp"
#include "maker_frame.hpp"

namespace feeler {
namespace {

using Context = void*;
constexpr int impedance = 3;    // a command type: force in, pose out
constexpr int no_indexing = 2;  // an indexing mode
constexpr int buttons = 6;

// Bits of virtGetAlarm.
constexpr unsigned int overheated = 0x4000;
constexpr unsigned int saturated = 0x8000;

/// The functions, fetched by name. Those that return an int return 0 when all is well.
struct Library {
  SharedLibrary file;
  Context (*open)(const char*) = nullptr;
  int (*close)(Context) = nullptr;
  int (*error_code)(Context) = nullptr;
  const char* (*error_message)(int) = nullptr;
  int (*set_indexing_mode)(Context, int) = nullptr;
  int (*set_force_factor)(Context, float) = nullptr;
  int (*set_speed_factor)(Context, float) = nullptr;
  int (*set_time_step)(Context, float) = nullptr;
  int (*set_base_frame)(Context, float*) = nullptr;
  int (*set_observation_frame)(Context, float*) = nullptr;
  int (*set_command_type)(Context, int) = nullptr;
  int (*saturate_torque)(Context, float, float) = nullptr;
  int (*set_power_on)(Context, int) = nullptr;
  int (*get_power_on)(Context, int*) = nullptr;
  int (*get_dead_man)(Context, int*) = nullptr;
  int (*get_emergency_stop)(Context, int*) = nullptr;
  int (*get_alarm)(Context, unsigned int*) = nullptr;
  int (*get_failure)(Context, unsigned int*) = nullptr;
  int (*get_time_last_update)(Context, unsigned int*) = nullptr;
  int (*get_position)(Context, float*) = nullptr;
  int (*get_button)(Context, int, int*) = nullptr;
  int (*set_force)(Context, float*) = nullptr;

  /// @return a sentence that says what is missing and how to get it; empty once all is there
  std::string load(const std::vector<std::string>& candidates) {
    const std::string refusal = file.load(candidates);
    if (!refusal.empty()) {
      return "Virtuose: libvirtuose.so cannot be loaded (" + refusal +
             "): install the VirtuoseAPI that Haption delivers with the device, then run ldconfig.";
    }
    for (const char* const missing : {
             file.find("virtOpen", open),
             file.find("virtClose", close),
             file.find("virtGetErrorCode", error_code),
             file.find("virtGetErrorMessage", error_message),
             file.find("virtSetIndexingMode", set_indexing_mode),
             file.find("virtSetForceFactor", set_force_factor),
             file.find("virtSetSpeedFactor", set_speed_factor),
             file.find("virtSetTimeStep", set_time_step),
             file.find("virtSetBaseFrame", set_base_frame),
             file.find("virtSetObservationFrame", set_observation_frame),
             file.find("virtSetCommandType", set_command_type),
             file.find("virtSaturateTorque", saturate_torque),
             file.find("virtSetPowerOn", set_power_on),
             file.find("virtGetPowerOn", get_power_on),
             file.find("virtGetDeadMan", get_dead_man),
             file.find("virtGetEmergencyStop", get_emergency_stop),
             file.find("virtGetAlarm", get_alarm),
             file.find("virtGetFailure", get_failure),
             file.find("virtGetTimeLastUpdate", get_time_last_update),
             file.find("virtGetPosition", get_position),
             file.find("virtGetButton", get_button),
             file.find("virtSetForce", set_force),
         }) {
      if (missing != nullptr) {
        return "Virtuose: " + file.path() + " has no function " + missing + ": install VirtuoseAPI 3.90 or later, or point to its library.";
      }
    }
    return {};
  }
};

class VirtuoseDriver final : public DirectDriver {
 public:
  VirtuoseDriver(VirtuoseSettings settings, Clock* clock) : DirectDriver(virtuose_6d(), clock), settings_(std::move(settings)) {
    refuse_for(VirtuoseDevice::reason_against(settings_));
  }

 private:
  std::string connect() override {
    if (std::string problem = library_.load(settings_.libraries); !problem.empty()) return problem;
    context_ = library_.open(settings_.address.c_str());
    if (context_ == nullptr) {
      return "Virtuose: no controller answers at " + settings_.address + " (" + error() +
             "): switch it on, check the network, and start the Virtuose daemon.";
    }
    return {};
  }

  std::string error() const {
    const char* const message = library_.error_message(library_.error_code(context_));
    return message != nullptr ? message : "no error given";
  }

  /// The modes in the order in which the controller wants them, power last; it ends at the first refusal.
  std::string switch_on(DeviceState& state) override {
    float identity[7] = {0, 0, 0, 0, 0, 0, 1};
    const char* refused = nullptr;
    const auto step = [&refused](const char* what, const auto& call) {
      if (refused == nullptr && call() != 0) refused = what;
    };
    step("the indexing mode", [&] { return library_.set_indexing_mode(context_, no_indexing); });
    step("the force factor", [&] { return library_.set_force_factor(context_, 1); });
    step("the speed factor", [&] { return library_.set_speed_factor(context_, 1); });
    step("the time step", [&] { return library_.set_time_step(context_, static_cast<float>(settings_.period)); });
    step("the base frame", [&] { return library_.set_base_frame(context_, identity); });
    step("the observation frame", [&] { return library_.set_observation_frame(context_, identity); });
    step("impedance mode", [&] { return library_.set_command_type(context_, impedance); });
    step("the saturation", [&] {
      return library_.saturate_torque(context_, static_cast<float>(specification().maximum_force),
                                      static_cast<float>(specification().maximum_torque));
    });
    step("a force of zero", [&] { return push({}).is_taken ? 0 : 1; });
    step("power", [&] { return library_.set_power_on(context_, 1); });
    if (refused != nullptr) {
      return "Virtuose: the controller refuses " + std::string(refused) + " (" + error() + "): release its emergency stop and start it again.";
    }
    measure_ticks();
    if (const char* const why = take_pose(state)) return "Virtuose: the controller gives no pose (" + error() + "): " + std::string(why);
    return {};
  }

  /// How fast the ticks run in which the controller tells the age of its poses, which its documentation does not say: as fast as an age is ever
  /// seen to grow, because one that was renewed meanwhile grows less.
  void measure_ticks() {
    ticks_per_second_ = 0;
    for (int i = 0; i < 50; ++i) {
      unsigned int before = 0;
      unsigned int after = 0;
      const auto start = std::chrono::steady_clock::now();
      if (library_.get_time_last_update(context_, &before) != 0) return;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      if (library_.get_time_last_update(context_, &after) != 0) return;
      const std::chrono::duration<double> between = std::chrono::steady_clock::now() - start;
      if (after > before) ticks_per_second_ = std::max(ticks_per_second_, double(after - before) / between.count());
    }
  }

  void switch_off() noexcept override {
    library_.set_power_on(context_, 0);
    library_.close(context_);
    context_ = nullptr;
  }

  const char* take_pose(DeviceState& state) noexcept override {
    constexpr const char* is_silent = "The controller stopped answering: check its network cable.";
    float pose[7] = {0, 0, 0, 0, 0, 0, 1};
    unsigned int age = 0;
    unsigned int failure = 0;
    if (library_.get_time_last_update(context_, &age) != 0 || library_.get_position(context_, pose) != 0 ||
        library_.get_failure(context_, &failure) != 0 || !look_for_hindrances())
      return is_silent;
    if (failure != 0) return "A motor of the device or its encoder has failed: switch the device off and have it repaired.";
    const double q[4] = {double(pose[6]), double(pose[3]), double(pose[4]), double(pose[5])};
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    const bool is_position = std::isfinite(pose[0]) && std::isfinite(pose[1]) && std::isfinite(pose[2]);
    if (!is_position || !(std::abs(length - 1) < 0.1)) return "The controller reports a pose that is none: calibrate the device as its manual says.";
    const double axis[3] = {q[1] / length, q[2] / length, q[3] / length};
    double vector[3];
    maker_frame::to_ours(pose, state.pose.position);
    maker_frame::to_ours(axis, vector);
    state.pose.orientation[0] = q[0] / length;
    std::copy(vector, vector + 3, state.pose.orientation + 1);
    state.buttons = 0;
    for (int button = 0; button < buttons; ++button) {
      int is_pressed = 0;
      if (library_.get_button(context_, button, &is_pressed) == 0 && is_pressed != 0) state.buttons |= 1u << button;
    }
    state.motor_temperature = (alarm_ & overheated) != 0 ? 1 : 0;
    const bool is_old = ticks_per_second_ > 0 && age > 2 * settings_.period * ticks_per_second_;
    if (!is_old) state.time = time();
    return nullptr;
  }

  /// Whether the controller says what keeps the device from pushing.
  bool look_for_hindrances() noexcept {
    int is_chain_closed = 0;  // of the emergency stop: 1 lets the device run
    int is_powered = 0;
    int is_held = 0;
    if (library_.get_emergency_stop(context_, &is_chain_closed) != 0 || library_.get_power_on(context_, &is_powered) != 0 ||
        library_.get_dead_man(context_, &is_held) != 0 || library_.get_alarm(context_, &alarm_) != 0)
      return false;
    hindrance_ = is_chain_closed == 0 ? "The emergency stop of the device is pressed, or not plugged in: release it."
                 : is_powered == 0    ? "The power of the motors is off: switch it on at the controller."
                 : is_held == 0       ? "The dead man's switch is released: hold the handle."
                                      : nullptr;
    return true;
  }
  const char* hindrance() const noexcept override { return hindrance_; }

  Answer push(const DeviceWrench& wrench) noexcept override {
    float both[6];
    float force[3];
    float torque[3];
    maker_frame::to_maker(wrench.force, force);
    maker_frame::to_maker(wrench.torque, torque);
    std::copy(force, force + 3, both);
    std::copy(torque, torque + 3, both + 3);
    if (library_.set_force(context_, both) != 0)
      return {false, "The controller does not take the force: check its network cable and its emergency stop."};
    return {true, (alarm_ & saturated) != 0 ? "The motors give all they can and less than was asked for: lower the stiffness." : nullptr};
  }

  VirtuoseSettings settings_;
  Library library_;
  Context context_ = nullptr;
  const char* hindrance_ = nullptr;  // its emergency stop, its power or its dead man's switch
  unsigned int alarm_ = 0;           // since the last pose
  double ticks_per_second_ = 0;      // of the age of a pose; 0 where it tells none
};

}  // namespace

VirtuoseDevice::VirtuoseDevice(VirtuoseSettings settings, Clock* clock)
    : DrivenDevice(std::make_unique<VirtuoseDriver>(std::move(settings), clock)) {}

std::string VirtuoseDevice::reason_against(const VirtuoseSettings& settings, const Clock*) { return reason_against_period(settings.period); }

}  // namespace feeler
