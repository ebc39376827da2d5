// Hands poses and forces over between the servo loop and the thread that speaks with the Inverse Service of Haply.
#include "feeler/device/haply_device.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "feeler/core/requirement.hpp"
#include "feeler/device/clock.hpp"
#include "feeler/device/latest_value.hpp"
#include "feeler/device/wrench_limit.hpp"
#include "inverse_service.hpp"
#include "loop_period.hpp"

namespace feeler {
namespace {

// The service: x right, y forward, z up. Ours: x right, y up, z to the user. A turn about x, so right-handed stays right-handed.
void to_ours(const double (&service)[3], double (&ours)[3]) noexcept {
  ours[0] = service[0];
  ours[1] = service[2];
  ours[2] = -service[1];
}
void to_service(const double (&ours)[3], double (&service)[3]) noexcept {
  service[0] = ours[0];
  service[1] = -ours[2];
  service[2] = ours[1];
}

/// What keeps the arm from pushing, or ends the session.
enum class Trouble : std::uint8_t { none, uncalibrated, powerless, unready, without_grip, silent, unplugged, poseless, disconnected, mute };

/// Whether the session is over with it.
constexpr bool is_loss(Trouble trouble) noexcept { return trouble >= Trouble::unplugged; }

const char* sentence_of(Trouble trouble) noexcept {
  switch (trouble) {
    case Trouble::none: return "";
    case Trouble::uncalibrated: return "The Inverse3 is not calibrated: let it do so, or put its end into the rest until its light stays on.";
    case Trouble::powerless: return "The motors of the Inverse3 have no power: plug in its power supply.";
    case Trouble::unready: return "The Inverse3 is not ready: wait, or unplug it and plug it in again.";
    case Trouble::without_grip: return "The VerseGrip does not answer: press a button to wake it, or charge it.";
    case Trouble::silent: return "The Inverse Service sends no pose: the computer is busy, or the service hangs.";
    case Trouble::unplugged: return "The Inverse Service has lost the Inverse3: check its USB cable and its power supply.";
    case Trouble::poseless: return "The Inverse Service reports a pose that is none: calibrate the Inverse3 and its grip.";
    case Trouble::disconnected: return "The Inverse Service has closed the connection: check if it still runs, and start it again.";
    case Trouble::mute: return "The Inverse Service has sent no pose for a second: check if it still runs, and start it again.";
  }
  return "";
}

/// What the messages that came in say, for the loop.
struct Sample {
  DevicePose pose;
  std::uint32_t buttons = 0;
  double time = 0;       // when the position came, since `open` [s]
  double grip_time = 0;  // the same of the orientation
  bool is_whole = false;  // there was a position, and an orientation where one is needed
  Trouble trouble = Trouble::none;
};

/// What the loop wants to be pushed.
struct Push {
  double force[3] = {0, 0, 0};  // x right, y forward, z up [N]
  double time = 0;              // when it was written, since `open` [s]
  std::uint32_t watch = 0;      // how often the device had been let go of when the pose for it was read
};

class HaplyDriver final : public Device, private InverseService::Client {
 public:
  explicit HaplyDriver(HaplySettings settings) : settings_(std::move(settings)), specification_(specification_of("")) {
    refuse_for(HaplyDevice::reason_against(settings_));
  }

  OpenResult open() override {
    if (is_open_) return {};
    ServiceMessage inventory;
    std::string problem = service_.connect(settings_.host, settings_.port, inventory);
    if (problem.empty()) problem = choose(inventory);
    if (problem.empty()) {
      begin();
      problem = wait_for_pose();
    }
    is_open_ = problem.empty();
    if (!is_open_) service_.stop();
    return {std::move(problem)};
  }

  DeviceStatus read(DeviceState& state) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const std::uint32_t watch = watch_.load(std::memory_order_acquire);
    received_.fetch(sample_);
    trouble_ = is_loss(trouble_) ? trouble_ : trouble_of(sample_);
    if (is_loss(trouble_)) return DeviceStatus::fault;
    watch_of_pose_ = watch;
    state.pose = sample_.pose;
    state.buttons = sample_.buttons;
    state.time = sample_.time;
    state.motor_temperature = 0;
    return trouble_ == Trouble::none ? DeviceStatus::ok : DeviceStatus::warning;
  }

  DeviceStatus write(const DeviceWrench& wrench) noexcept override {
    if (!is_open_) return DeviceStatus::not_open;
    const bool is_good = is_finite(wrench);
    Push push;
    if (is_good && trouble_ == Trouble::none)
      to_service(limited(wrench, specification_.maximum_force, specification_.maximum_torque).force, push.force);
    push.time = time();
    push.watch = watch_of_pose_;
    wanted_.store(push);
    if (is_loss(trouble_)) return DeviceStatus::fault;
    return is_good ? DeviceStatus::ok : DeviceStatus::not_finite;
  }

  void let_go() noexcept override { watch_.fetch_add(1, std::memory_order_acq_rel); }

  void close() noexcept override {
    if (!is_open_) return;
    service_.stop();
    is_open_ = false;
  }

  const DeviceSpecification& specification() const noexcept override { return specification_; }
  const char* complaint() const noexcept override { return sentence_of(trouble_); }

 private:
  static constexpr double longest_silence = 0.02;  // until a pose is no longer taken for the latest [s]
  static constexpr double longest_wait = 1;        // for the service [s]
  static constexpr double grip_patience = 0.1;     // [s]; its radio is slower than the arm

  static DeviceSpecification specification_of(const std::string& type) {
    DeviceSpecification device = inverse3();
    if (type == "minverse") {
      device.name = "Minverse";
      device.maximum_force = 3;               // assumed
      device.continuous_force = 0.75;         // assumed: a quarter
      device.workspace = {0.08, 0.08, 0.08};  // confirmed: its maker's examples stay in a sphere of 0.04 m
    }
    return device;
  }

  // By the thread of `open`, before the exchange starts.

  std::string choose(const ServiceMessage& inventory) {
    const auto refused = [](const char* what) { return std::string("Haply: ") + what; };
    if (inventory.arms.empty()) return refused("the Inverse Service knows no Inverse3: check its USB cable and its power supply.");
    std::string names;
    for (const ServiceArm& arm : inventory.arms) names += (names.empty() ? "" : ", ") + arm.id;
    const auto known = [&names] { return "; the Inverse Service knows " + names + "."; };

    const ServiceArm* chosen = &inventory.arms.front();
    if (!settings_.serial_number.empty()) {
      const auto found =
          std::find_if(inventory.arms.begin(), inventory.arms.end(), [this](const ServiceArm& arm) { return arm.id == settings_.serial_number; });
      if (found == inventory.arms.end()) return refused("no Inverse3 has the serial number ") + settings_.serial_number + known();
      chosen = &*found;
    } else if (settings_.index) {
      if (*settings_.index < 0 || std::size_t(*settings_.index) >= inventory.arms.size())
        return refused("no Inverse3 has the index ") + std::to_string(*settings_.index) + known();
      chosen = &inventory.arms[std::size_t(*settings_.index)];
    }
    const auto same = [chosen](const ServiceArm& arm) { return arm.id == chosen->id; };
    if (std::count_if(inventory.arms.begin(), inventory.arms.end(), same) != 1 || chosen->id.empty())
      return refused("two devices answer to the serial number ") + chosen->id + ", so forces might go to the wrong one: unplug one of them.";
    arm_ = chosen->id;

    // Told once, and again when it changes. What is not told is not so: a wrong zero would be felt as a wall.
    if (!chosen->is_calibrated.value_or(false)) return refused(sentence_of(Trouble::uncalibrated));
    if (!chosen->has_power.value_or(true)) return refused(sentence_of(Trouble::powerless));
    if (!chosen->is_ready.value_or(true)) return refused(sentence_of(Trouble::unready));
    specification_ = specification_of(chosen->type);
    return choose_grip(inventory);
  }

  std::string choose_grip(const ServiceMessage& inventory) {
    grip_.clear();
    if (!settings_.needs_grip) {
      specification_.is_sensed = specification_.is_pushed;
      return {};
    }
    std::vector<std::string> names;
    for (const ServiceGrip& grip : inventory.grips) {
      const bool is_wanted = settings_.grip.empty() || grip.id == settings_.grip;
      if (is_wanted && !grip.id.empty() && grip.is_connected.value_or(true)) names.push_back(grip.id);
    }
    if (names.empty()) {
      return "Haply: no VerseGrip " + (settings_.grip.empty() ? std::string("answers") : "of the name " + settings_.grip + " answers") +
             ": wake it by a button, pair it in Haply Hub, or do without it (needs_grip = false).";
    }
    if (names.size() > 1) {
      std::string sentence = "Haply: several grips answer, and the wrong one would turn the tool: choose one of";
      for (const std::string& name : names) sentence += " " + name;
      return sentence + ".";
    }
    grip_ = names.front();
    return {};
  }

  void begin() {
    opened_at_ = clock_.now();
    received_.fetch(sample_);  // what the last session left
    sample_ = {};
    incoming_ = {};
    push_ = {};
    trouble_ = Trouble::none;
    wanted_.store({});
    watch_of_pose_ = watch_.load(std::memory_order_relaxed);
    is_calibrated_ = has_power_ = is_ready_ = is_grip_connected_ = is_grip_awake_ = true;
    has_orientation_ = false;
    service_.start(*this, arm_, settings_.period / 2);
  }

  std::string wait_for_pose() {
    while (!sample_.is_whole && !is_loss(sample_.trouble) && time() < longest_wait) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      received_.fetch(sample_);
    }
    if (sample_.trouble != Trouble::none) return std::string("Haply: ") + sentence_of(sample_.trouble);
    if (!sample_.is_whole) return "Haply: no pose came within a second: wake the grip by a button, and start the Inverse Service again.";
    return {};
  }

  // By the thread of the loop.

  Trouble trouble_of(const Sample& sample) noexcept {
    if (sample.trouble != Trouble::none) return sample.trouble;
    const double now = time();
    if (now - sample.time > longest_wait) return Trouble::mute;
    if (now - sample.time > longest_silence) return Trouble::silent;
    if (!grip_.empty() && now - sample.grip_time > grip_patience) return Trouble::without_grip;
    return Trouble::none;
  }

  // By the thread of the exchange.

  void take(const ServiceMessage& message) noexcept override {
    const double now = time();
    const auto found = std::find_if(message.arms.begin(), message.arms.end(), [this](const ServiceArm& arm) { return arm.id == arm_; });
    Sample& sample = incoming_;
    if (is_loss(sample.trouble)) return;
    if (found == message.arms.end()) {
      sample.trouble = Trouble::unplugged;
    } else {
      is_calibrated_ = found->is_calibrated.value_or(is_calibrated_);
      has_power_ = found->has_power.value_or(has_power_);
      is_ready_ = found->is_ready.value_or(is_ready_);
      if (found->has_position) {
        to_ours(found->position, sample.pose.position);
        sample.time = now;
        if (!is_position(sample.pose.position)) sample.trouble = Trouble::poseless;
      }
      take_grip(message, now);
      sample.is_whole = sample.is_whole || (found->has_position && (grip_.empty() || has_orientation_));
    }
    if (!is_loss(sample.trouble)) {
      sample.trouble = !is_calibrated_                           ? Trouble::uncalibrated
                       : !has_power_                             ? Trouble::powerless
                       : !is_ready_                              ? Trouble::unready
                       : !(is_grip_connected_ && is_grip_awake_) ? Trouble::without_grip
                                                                 : Trouble::none;
    }
    received_.store(sample);
  }

  void take_grip(const ServiceMessage& message, double now) noexcept {
    for (const ServiceGrip& grip : message.grips) {
      if (grip_.empty() || grip.id != grip_) continue;
      is_grip_connected_ = grip.is_connected.value_or(is_grip_connected_);
      is_grip_awake_ = grip.is_awake.value_or(is_grip_awake_);
      if (!grip.has_orientation) continue;
      const double(&q)[4] = grip.orientation;
      const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
      if (!(std::abs(length - 1) < 0.1)) {
        incoming_.trouble = Trouble::poseless;
        return;
      }
      const double axis[3] = {q[1] / length, q[2] / length, q[3] / length};
      double vector[3];
      to_ours(axis, vector);  // the axes of the handle too, so that a handle at rest stays the identity
      incoming_.pose.orientation[0] = q[0] / length;
      std::copy(vector, vector + 3, incoming_.pose.orientation + 1);
      incoming_.buttons = grip.buttons;
      incoming_.grip_time = now;
      has_orientation_ = true;
    }
  }

  static bool is_position(const double (&p)[3]) noexcept { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

  void give_force(double (&force)[3]) noexcept override {
    wanted_.fetch(push_);
    const bool is_old = time() - push_.time > std::max(5 * settings_.period, 0.005);
    const bool is_let_go = push_.watch != watch_.load(std::memory_order_acquire);
    for (int i = 0; i < 3; ++i) force[i] = is_old || is_let_go ? 0 : push_.force[i];
  }

  void end() noexcept override {
    if (!is_loss(incoming_.trouble)) incoming_.trouble = Trouble::disconnected;
    received_.store(incoming_);
  }

  /// Since the device was opened [s].
  double time() noexcept { return double(clock_.now() - opened_at_) * 1e-9; }

  HaplySettings settings_;
  DeviceSpecification specification_;
  MonotonicClock clock_;
  std::int64_t opened_at_ = 0;
  bool is_open_ = false;
  std::string arm_;
  std::string grip_;  // empty where none is needed

  LatestValue<Sample> received_;
  LatestValue<Push> wanted_;
  std::atomic<std::uint32_t> watch_ = 0;  // how often it was let go of

  Sample sample_;  // of the loop
  Trouble trouble_ = Trouble::none;
  std::uint32_t watch_of_pose_ = 0;

  Sample incoming_;  // of the exchange
  Push push_;
  bool is_calibrated_ = true;
  bool has_power_ = true;
  bool is_ready_ = true;
  bool is_grip_connected_ = true;
  bool is_grip_awake_ = true;
  bool has_orientation_ = false;

  InverseService service_;  // last, so that its thread ends first
};

}  // namespace

HaplyDevice::HaplyDevice(HaplySettings settings) : DrivenDevice(std::make_unique<HaplyDriver>(std::move(settings))) {}

std::string HaplyDevice::reason_against(const HaplySettings& settings) { return reason_against_period(settings.period); }

}  // namespace feeler
