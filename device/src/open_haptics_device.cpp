// Joins the servo thread of libHD with the servo loop.
#include "feeler/device/open_haptics_device.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "feeler/device/latest_value.hpp"
#include "feeler/device/rotation_matrix.hpp"
#include "feeler/device/wrench_limit.hpp"
#include "open_haptics_library.hpp"
#include "open_haptics_scheduler.hpp"

namespace feeler {
namespace {

using namespace open_haptics;

constexpr int patience = 2;            // frames without a new wrench before the device goes silent
constexpr double longest_pause = 0.02;  // without a frame, before it is told [s]
constexpr std::size_t most_motors = 16;

/// What the frame hands to `read`.
struct Sample {
  DeviceState state;
  double frame_time = 0;  // when it was made, since `open` [s]
  const char* complaint = "";
  const char* hindrance = nullptr;  // why it must not push now
  std::int64_t errors = 0;  // counted since `open`
  unsigned int calibration = 0;
  bool has_pose = false;
  bool is_lost = false;
};

/// What `write` hands to the frame.
struct Command {
  DeviceWrench wrench;
  std::int64_t errors_known = 0;  // to the writer
};

DeviceSpecification preset_of(const std::string& model) {
  const auto says = [&model](const char* word) { return model.find(word) != std::string::npos; };
  if (says("Premium 3")) return phantom_premium_3_0_6dof();
  if (says("Premium 1.5 H") || says("1.5HF") || says("1.5 High")) return phantom_premium_1_5_high_force_6dof();
  if (says("Premium")) return phantom_premium_1_5_6dof();
  if (says("Touch X") || says("Desktop")) return touch_x();
  return touch();
}

bool is_plausible(double figure) noexcept { return figure > 0 && figure < 1e6; }

class OpenHapticsDriver final : public Device, private Framed {
 public:
  OpenHapticsDriver(OpenHapticsSettings settings, Clock* clock)
      : settings_(std::move(settings)), clock_(clock != nullptr ? *clock : monotonic_clock_) {}

  OpenResult open() override {
    if (is_open_) return {};
    if (std::string problem = library_.load(settings_.libraries); !problem.empty()) return {std::move(problem)};
    const std::lock_guard lock(scheduler_.opening);
    if (std::string problem = claim(); !problem.empty()) {
      release();
      return {std::move(problem)};
    }
    is_open_ = true;
    return {};
  }

  DeviceStatus read(DeviceState& state) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    samples_.fetch(sample_);
    if (sample_.is_lost) return DeviceStatus::fault;
    state = sample_.state;
    const bool complains = sample_.errors != errors_read_;
    errors_read_ = sample_.errors;
    if (time() - sample_.frame_time > longest_pause) {
      sample_.complaint =
          "The servo loop of libHD stands still: wait while another device is opened, or open this one "
          "again.";
      return DeviceStatus::warning;
    }
    return complains || sample_.hindrance != nullptr ? DeviceStatus::warning : DeviceStatus::ok;
  }

  DeviceStatus write(const DeviceWrench& wrench) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const bool is_good = is_finite(wrench);
    Command command;
    if (is_good) command.wrench = limited(wrench, specification_.maximum_force, specification_.maximum_torque);
    command.errors_known = errors_read_;
    commands_.store(command);
    if (sample_.is_lost) return DeviceStatus::fault;
    return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;
  }

  void close() noexcept override {
    if (!is_open_) return;
    commands_.store({});
    is_open_ = false;
    const std::lock_guard lock(scheduler_.opening);
    release();
  }

  const char* complaint() const noexcept override { return sample_.complaint; }

  const DeviceSpecification& specification() const noexcept override { return specification_; }

 private:
  /// Everything from the handle to the first pose. @return what went wrong
  std::string claim() {
    // What is left of an earlier session; nobody else is here before the device is in the servo loop.
    samples_.fetch(sample_);
    commands_.fetch(command_);
    sample_ = {};
    command_ = {};
    frame_ = {};
    errors_read_ = 0;
    frames_unfed_ = 0;
    opened_at_ = clock_.now();
    handle_ = scheduler_.initialise(library_, settings_.device_name);
    if (const unsigned int error = drain_errors(); error != success || handle_ == invalid_handle) {
      return "OpenHaptics: the device cannot be opened: " + text_of(error);
    }
    library_.make_current_device(handle_);
    if (std::string problem = ask(); !problem.empty()) return problem;
    library_.enable(force_output);
    if (!scheduler_.join(library_, *this)) return "OpenHaptics: eight devices are open, and the servo loop has room for no more: close one of them.";
    return await_session();
  }

  /// Waits until the frames have calibrated the device and found its pose. @return what went wrong
  std::string await_session() {
    for (int wait = 0; wait < 1000; ++wait) {
      if (samples_.fetch(sample_)) {
        if (sample_.is_lost) return "OpenHaptics: the device failed with its first pose: " + std::string(sample_.complaint);
        errors_read_ = sample_.errors;
        if (sample_.calibration == calibrated && sample_.has_pose) return {};
        if (sample_.calibration == needs_manual_input || (sample_.calibration == needs_update && calibration_style_ == 0)) break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (sample_.calibration == 0) {  // not one frame, so nobody else asks for errors
      if (const unsigned int error = drain_errors(); error != success) return "OpenHaptics: the servo thread cannot be started: " + text_of(error);
    }
    const std::string complaint = sample_.complaint;
    if (sample_.calibration == calibrated || sample_.calibration == 0) {
      return "OpenHaptics: no pose came within a second" + (complaint.empty() ? "" : " (" + complaint + ")") +
             ": check the cable, and that no other program uses the device.";
    }
    if (!complaint.empty()) return "OpenHaptics: the device cannot be calibrated: " + complaint;
    return std::string("OpenHaptics: the device is not calibrated: ") +
           (sample_.calibration == needs_manual_input ? "put the stylus into its inkwell, or hold the arm as the manual shows, "
                                                      : "move the handle through its workspace and put it to rest, ") +
           "run the calibration of the driver's setup program, then start again.";
  }

  /// The model and its figures; inside a frame, as libHD demands.
  std::string ask() {
    library_.begin_frame(handle_);
    const char* const model = library_.get_string(device_model_type);
    int degrees = 3;
    int styles = 0;
    int rate = 0;
    double stiffness = 0;
    double force = 0;
    double continuous = 0;
    library_.get_integers(output_degrees, &degrees);
    library_.get_integers(calibration_styles, &styles);
    library_.get_integers(update_rate, &rate);
    library_.get_doubles(nominal_max_stiffness, &stiffness);
    library_.get_doubles(nominal_max_force, &force);
    library_.get_doubles(nominal_continuous_force, &continuous);
    drain_errors();
    double temperatures[most_motors] = {};
    library_.get_doubles(motor_temperature, temperatures);
    tells_temperature_ = drain_errors() == success;
    is_on(current_safety_switch);
    has_safety_switch_ = drain_errors() == success;
    is_on(current_inkwell_switch);
    has_inkwell_ = drain_errors() == success && (unsigned(styles) & inkwell) != 0;
    library_.end_frame(handle_);
    if (const unsigned int error = drain_errors(); error >= first_device_error) {
      return "OpenHaptics: the device does not say what it is: " + text_of(error);
    }
    const unsigned int own = unsigned(styles) & (automatic | inkwell);
    calibration_style_ = (own & automatic) != 0 ? unsigned(automatic) : own;
    const std::string name = model != nullptr ? model : "";
    specification_ = preset_of(name);
    if (!name.empty()) specification_.name = name;
    if (is_plausible(stiffness)) specification_.stiffness = std::min(specification_.stiffness, 1000 * stiffness);
    if (is_plausible(force)) specification_.maximum_force = force;
    if (is_plausible(continuous)) specification_.continuous_force = std::min(continuous, specification_.maximum_force);
    if (rate > 0) specification_.nominal_rate = rate;
    if (degrees < 6) specification_.lose_torque();
    return {};
  }

  void release() noexcept {
    scheduler_.leave(library_, *this, settings_.device_name);
    handle_ = invalid_handle;
  }

  double time() noexcept { return double(clock_.now() - opened_at_) * 1e-9; }

  Handle handle() const noexcept override { return handle_; }

  void frame(bool must_be_silent) noexcept override {
    library_.make_current_device(handle_);
    if (frame_.calibration != calibrated) calibrate();
    library_.begin_frame(handle_);
    double transform[16] = {};
    int buttons = 0;
    library_.get_doubles(current_transform, transform);
    library_.get_integers(current_buttons, &buttons);
    if (tells_temperature_) {
      double temperatures[most_motors] = {};
      library_.get_doubles(motor_temperature, temperatures);
      frame_.state.motor_temperature = *std::max_element(temperatures, temperatures + most_motors);
    }
    look_for_hindrances();
    if (note_errors()) {
      if (!take_pose(transform)) lose("The device reports a pose that is none: check its encoders, then calibrate it.");
      frame_.has_pose = true;
      frame_.state.buttons = std::uint32_t(buttons);
      frame_.state.time = time();
    }

    frames_unfed_ = commands_.fetch(command_) ? 0 : frames_unfed_ + 1;
    const bool may_push = !must_be_silent && !frame_.is_lost && frame_.hindrance == nullptr;
    const bool is_fed = frames_unfed_ <= patience && command_.errors_known == frame_.errors;
    push(may_push && is_fed ? command_.wrench : DeviceWrench{});
    library_.end_frame(handle_);
    note_errors();
    frame_.frame_time = time();
    samples_.store(frame_);
  }

  /// Lets the device calibrate itself where it needs nobody's hand for it. Never by an encoder reset: nobody
  /// knows here that the arm is held in its reset position. In the servo loop, because libHD does it nowhere
  /// else, outside of a frame, and only before a session, because poses jump.
  void calibrate() noexcept {
    frame_.calibration = library_.check_calibration();
    if (frame_.calibration == needs_update && calibration_style_ != 0) library_.update_calibration(calibration_style_);
  }

  /// What switches the motors off behind libHD's back. It counts as an error too: who has not read of it must not push on when it is over.
  void look_for_hindrances() noexcept {
    const char* const before = frame_.hindrance;
    frame_.hindrance = nullptr;
    if (frame_.calibration != calibrated) return;  // in the inkwell, perhaps
    if (has_inkwell_ && !is_on(current_inkwell_switch)) frame_.hindrance = "The stylus is in its inkwell: take it out.";
    else if (has_safety_switch_ && is_on(current_safety_switch))
      frame_.hindrance = "The safety switch of the device is on: hold the stylus as its manual says.";
    if (frame_.hindrance == nullptr || frame_.is_lost) return;
    if (before == nullptr) ++frame_.errors;
    frame_.complaint = frame_.hindrance;
  }

  bool is_on(Parameter parameter) noexcept {
    unsigned char answer = 0;
    library_.get_booleans(parameter, &answer);
    return answer != 0;
  }

  void push(const DeviceWrench& wrench) noexcept {
    library_.set_doubles(current_force, wrench.force);
    if (!specification_.pushes_torque()) return;
    const double millinewton_metres[3] = {1000 * wrench.torque[0], 1000 * wrench.torque[1], 1000 * wrench.torque[2]};
    library_.set_doubles(current_torque, millinewton_metres);
  }

  bool take_pose(const double (&transform)[16]) noexcept {
    double rotation[3][3];
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) rotation[row][column] = transform[4 * column + row];
      if (!std::isfinite(transform[12 + row])) return false;
    }
    if (!nearest_rotation(rotation, frame_.state.pose.orientation)) return false;
    for (int axis = 0; axis < 3; ++axis) frame_.state.pose.position[axis] = 1e-3 * transform[12 + axis];
    return true;
  }

  /// Sorts the errors that libHD has in store by their devices. @return whether this one answered all the
  /// same
  bool note_errors() noexcept {
    unsigned int worst = success;
    for (int i = 0; i < most_errors; ++i) {
      const Error error = library_.get_error();
      if (error.code == success) break;
      Framed* const other = error.handle == handle_ ? nullptr : scheduler_.device_of(error.handle);
      if (other != nullptr) other->take_error(error.code);
      else if (severity(error.code) > severity(worst)) worst = error.code;
    }
    take_error(worst);
    return severity(worst) <= 1;
  }

  void take_error(unsigned int code) noexcept override {
    if (code == success) return;
    const char* text = sentence_of(code);
    if (text == nullptr) text = library_.get_error_string(code);
    if (text == nullptr) text = "libHD reports an error that it has no words for.";
    if (ends_session(code)) return lose(text);
    ++frame_.errors;
    if (!frame_.is_lost) frame_.complaint = text;
  }

  /// 0 none, 1 a force error, 2 one without an answer, 3 one that ends the session.
  static int severity(unsigned int code) noexcept {
    const bool is_force_error = code >= first_force_error && code < first_device_error;
    return code == success ? 0 : is_force_error ? 1 : ends_session(code) ? 3 : 2;
  }

  void lose(const char* complaint) noexcept {
    ++frame_.errors;
    if (frame_.is_lost) return;
    frame_.is_lost = true;
    frame_.complaint = complaint;
  }

  /// The worst error that libHD has in store; the store is emptied.
  unsigned int drain_errors() noexcept {
    unsigned int worst = success;
    for (int i = 0; i < most_errors; ++i) {
      const unsigned int code = library_.get_error().code;
      if (code == success) break;
      if (severity(code) > severity(worst)) worst = code;
    }
    return worst;
  }

  std::string text_of(unsigned int code) const {
    if (code == success) return "libHD gave no handle: run the setup program of its driver and choose a default device.";
    if (const char* const text = sentence_of(code)) return text;
    const char* const text = library_.get_error_string(code);
    return text != nullptr ? "libHD says: " + std::string(text) + "." : "libHD does not say why.";
  }

  OpenHapticsSettings settings_;
  DeviceSpecification specification_ = phantom_premium_3_0_6dof();
  MonotonicClock monotonic_clock_;
  Clock& clock_;
  Library library_;
  Scheduler& scheduler_ = Scheduler::shared();
  Handle handle_ = invalid_handle;
  bool is_open_ = false;
  bool tells_temperature_ = false;
  bool has_inkwell_ = false;
  bool has_safety_switch_ = false;
  unsigned int calibration_style_ = 0;  // 0 where it needs a hand
  std::int64_t opened_at_ = 0;

  LatestValue<Sample> samples_;    // from the frame to `read`
  LatestValue<Command> commands_;  // from `write` to the frame

  Sample sample_;                 // of the thread that reads and writes
  std::int64_t errors_read_ = 0;  // of the same

  Sample frame_;          // of the servo thread of libHD
  Command command_;       // of the same
  int frames_unfed_ = 0;  // of the same
};

}  // namespace

OpenHapticsDevice::OpenHapticsDevice(OpenHapticsSettings settings, Clock* clock)
    : DrivenDevice(std::make_unique<OpenHapticsDriver>(std::move(settings), clock)) {}

}  // namespace feeler
