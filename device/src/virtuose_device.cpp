// Calls the Virtuose library, whose names and values are declared here from its documentation.
#include "feeler/device/virtuose_device.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "feeler/device/shared_library.hpp"
#include "feeler/device/wrench_limit.hpp"
#include "maker_frame.hpp"
#include "single_caller.hpp"

namespace feeler {
namespace {

using Context = void*;
constexpr int impedance = 3;    // a command type: force in, pose out
constexpr int no_indexing = 2;  // an indexing mode
constexpr int buttons = 2;

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
             file.find("virtGetPosition", get_position),
             file.find("virtGetButton", get_button),
             file.find("virtSetForce", set_force),
         }) {
      if (missing != nullptr) {
        return "Virtuose: " + file.path() + " has no function " + missing +
               ": install VirtuoseAPI 3.90 or later, or point to its library.";
      }
    }
    return {};
  }
};

class VirtuoseDriver final : public Device {
 public:
  VirtuoseDriver(VirtuoseSettings settings, Clock* clock)
      : settings_(std::move(settings)), clock_(clock != nullptr ? *clock : monotonic_clock_) {}

  OpenResult open() override {
    if (is_open_) return {};
    if (std::string problem = library_.load(settings_.libraries); !problem.empty())
      return {std::move(problem)};
    context_ = library_.open(settings_.address.c_str());
    if (context_ == nullptr) {
      return {"Virtuose: no controller answers at " + settings_.address + " (" + error() +
              "): switch it on, check the network, and start the Virtuose daemon."};
    }
    is_open_ = true;
    is_lost_ = false;
    is_hindered_ = false;
    complaint_ = "";
    opened_at_ = clock_.now();
    if (std::string problem = switch_on(); !problem.empty()) {
      close();
      return {std::move(problem)};
    }
    return {};
  }

  DeviceStatus read(DeviceState& state) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const auto turn = library_calls_.turn();
    if (turn && (is_lost_ || !take_pose())) return DeviceStatus::fault;
    state = state_;
    if (!turn) return DeviceStatus::ok;  // just now it is let go: the pose keeps its time
    is_let_go_.store(false, std::memory_order_relaxed);
    const char* const hindrance = what_hinders();
    if (is_lost_) return DeviceStatus::fault;
    is_hindered_ = hindrance != nullptr;
    if (!is_hindered_) return DeviceStatus::ok;
    complaint_ = hindrance;
    return DeviceStatus::warning;
  }

  DeviceStatus write(const DeviceWrench& wrench) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const bool is_good = is_finite(wrench);
    const auto turn = library_calls_.turn();
    if (!turn) return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;  // just now it is let go
    const bool pushes = is_good && !is_lost_ && !is_hindered_ && !is_let_go_.load(std::memory_order_relaxed);
    const bool is_done =
        push(pushes ? limited(wrench, specification_.maximum_force, specification_.maximum_torque)
                    : DeviceWrench{});
    if (is_lost_) return DeviceStatus::fault;
    if (!is_done)
      return lose("The controller does not take the force: check its network cable and its emergency stop.");
    return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;
  }

  void let_go() noexcept override {
    is_let_go_.store(true, std::memory_order_relaxed);  // before the turn: a write that comes after it knows
    if (const auto turn = library_calls_.turn(); turn && is_open_) push({});
  }

  void close() noexcept override {
    if (!is_open_) return;
    push({});
    library_.set_power_on(context_, 0);
    library_.close(context_);
    context_ = nullptr;
    is_open_ = false;
  }

  const char* complaint() const noexcept override { return complaint_; }

  const DeviceSpecification& specification() const noexcept override { return specification_; }

 private:
  std::string error() const {
    const char* const message = library_.error_message(library_.error_code(context_));
    return message != nullptr ? message : "no error given";
  }

  /// The modes in the order in which the controller wants them, power last; it ends at the first refusal.
  std::string switch_on() {
    float identity[7] = {0, 0, 0, 0, 0, 0, 1};
    const char* refused = nullptr;
    const auto step = [&refused](const char* what, const auto& call) {
      if (refused == nullptr && call() != 0) refused = what;
    };
    step("the indexing mode", [&] { return library_.set_indexing_mode(context_, no_indexing); });
    step("the force factor", [&] { return library_.set_force_factor(context_, 1); });
    step("the speed factor", [&] { return library_.set_speed_factor(context_, 1); });
    step("the time step",
         [&] { return library_.set_time_step(context_, static_cast<float>(settings_.period)); });
    step("the base frame", [&] { return library_.set_base_frame(context_, identity); });
    step("the observation frame", [&] { return library_.set_observation_frame(context_, identity); });
    step("impedance mode", [&] { return library_.set_command_type(context_, impedance); });
    step("the saturation", [&] {
      return library_.saturate_torque(context_, static_cast<float>(specification_.maximum_force),
                                      static_cast<float>(specification_.maximum_torque));
    });
    step("a force of zero", [&] { return push({}) ? 0 : 1; });
    step("power", [&] { return library_.set_power_on(context_, 1); });
    if (refused != nullptr) {
      return "Virtuose: the controller refuses " + std::string(refused) + " (" + error() +
             "): release its emergency stop and start it again.";
    }
    if (!take_pose()) {
      return "Virtuose: the controller gives no pose (" + error() +
             "): calibrate the device as its manual says.";
    }
    return {};
  }

  /// What keeps the device from pushing, or nullptr.
  const char* what_hinders() noexcept {
    int is_stopped = 0;
    int is_powered = 0;
    int is_held = 0;
    if (library_.get_emergency_stop(context_, &is_stopped) != 0 ||
        library_.get_power_on(context_, &is_powered) != 0 || library_.get_dead_man(context_, &is_held) != 0) {
      lose("The controller stopped answering: check its network cable.");
      return nullptr;
    }
    if (is_stopped != 0) return "The emergency stop of the device is pressed: release it.";
    if (is_powered == 0) return "The power of the motors is off: switch it on at the controller.";
    if (is_held == 0) return "The dead man's switch is released: hold the handle.";
    return nullptr;
  }

  bool take_pose() noexcept {
    float pose[7] = {0, 0, 0, 0, 0, 0, 1};
    if (library_.get_position(context_, pose) != 0) {
      lose("The controller stopped answering: check its network cable.");
      return false;
    }
    const double q[4] = {double(pose[6]), double(pose[3]), double(pose[4]), double(pose[5])};
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    const bool is_position = std::isfinite(pose[0]) && std::isfinite(pose[1]) && std::isfinite(pose[2]);
    if (!is_position || !(std::abs(length - 1) < 0.1)) {
      lose("The controller reports a pose that is none: calibrate the device as its manual says.");
      return false;
    }
    const double axis[3] = {q[1] / length, q[2] / length, q[3] / length};
    double vector[3];
    maker_frame::to_ours(pose, state_.pose.position);
    maker_frame::to_ours(axis, vector);
    state_.pose.orientation[0] = q[0] / length;
    std::copy(vector, vector + 3, state_.pose.orientation + 1);
    state_.buttons = 0;
    for (int button = 0; button < buttons; ++button) {
      int is_pressed = 0;
      if (library_.get_button(context_, button, &is_pressed) == 0 && is_pressed != 0)
        state_.buttons |= 1u << button;
    }
    state_.time = double(clock_.now() - opened_at_) * 1e-9;
    return true;
  }

  bool push(const DeviceWrench& wrench) noexcept {
    float both[6];
    float force[3];
    float torque[3];
    maker_frame::to_maker(wrench.force, force);
    maker_frame::to_maker(wrench.torque, torque);
    std::copy(force, force + 3, both);
    std::copy(torque, torque + 3, both + 3);
    return library_.set_force(context_, both) == 0;
  }

  DeviceStatus lose(const char* text) noexcept {
    is_lost_ = true;
    complaint_ = text;
    return DeviceStatus::fault;
  }

  VirtuoseSettings settings_;
  DeviceSpecification specification_ = virtuose_6d();
  MonotonicClock monotonic_clock_;
  Clock& clock_;
  Library library_;
  Context context_ = nullptr;
  bool is_open_ = false;
  bool is_lost_ = false;
  SingleCaller library_calls_;  // by `read` and `write`, and by the watchdog
  std::atomic<bool> is_let_go_ = false;
  bool is_hindered_ = false;  // by its emergency stop, its power or its dead man's switch
  std::int64_t opened_at_ = 0;
  DeviceState state_;
  const char* complaint_ = "";
};

}  // namespace

VirtuoseDevice::VirtuoseDevice(VirtuoseSettings settings, Clock* clock)
    : DrivenDevice(std::make_unique<VirtuoseDriver>(std::move(settings), clock)) {}

}  // namespace feeler
