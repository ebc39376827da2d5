// Runs hand, device and renderer in step.
#include "stability/closed_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "feeler/device/conversion.hpp"
#include "feeler/device/passivity_control.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "feeler/device/wrench_extrapolator.hpp"
#include "feeler/device/wrench_limit.hpp"
#include "stability/high_pass.hpp"

namespace feeler::stability {
namespace {

constexpr double arrival = 0.2;       // of the hand [s]
constexpr double kick_at = 0.45;      // [s]
constexpr double kick_time = 0.005;   // [s]
constexpr double hold_end = 2.5;      // [s]
constexpr double runaway = 0.05;      // from the contact: no hold comes here [m]
constexpr double slide_from = 0.3;    // [s]
constexpr double slide_speed = 0.05;  // [m/s]
constexpr double cutoff = 50;         // [Hz]

/// Smallest and largest of three numbers over time.
class Swing {
 public:
  void add(const Vector3<double>& v) noexcept {
    low_ = low_.cwiseMin(v);
    high_ = high_.cwiseMax(v);
  }
  double size() const noexcept { return (high_ - low_).maxCoeff(); }

 private:
  Vector3<double> low_ = Vector3<double>::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
};

Vector3<double> vector(const double (&v)[3]) noexcept { return {v[0], v[1], v[2]}; }

double smooth(double s) noexcept {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Where the hand wants to be: from a little before the contact to where its grip presses as hard as it
/// should.
DevicePath path_of(const Situation& situation, const Pose<double>& contact, const LoopSetup& setup) {
  const bool turns = situation.turns();
  const double press = press_of(setup.device, turns);
  const double beyond =
      turns ? press / setup.grip.rotational_stiffness + press / setup.rotational_stiffness : press / setup.grip.stiffness + press / setup.stiffness;
  const double before = turns ? -0.01 : -2e-4;
  return [=, slide = situation.slide, direction = situation.press](double time) {
    Pose<double> pose = moved(contact, direction * (before + (beyond - before) * smooth(time / arrival)));
    if (situation.slides()) {
      const double way = std::clamp((time - slide_from) * slide_speed, 0.0, slide.norm());
      pose.translation += way * slide.normalized();
    }
    return to_device_pose(pose);
  };
}

/// A renderer that is slower than the loop, and what of it has arrived.
class SlowRendering {
 public:
  SlowRendering(Rendering& rendering, const LoopSetup& setup) : rendering_(rendering), setup_(setup) {}

  DeviceWrench tick(const DevicePose& device_pose) {
    if (count_++ % setup_.divider == 0) {
      WrenchModel model;
      model.pose = device_pose;
      model.wrench = to_device_wrench(rendering_.update(from_device<Pose<double>>(device_pose)));
      if (setup_.handover == Handover::extrapolated) rendering_.derivative(model.derivative);
      under_way_.push_back({count_ + setup_.latency, model});
    }
    while (!under_way_.empty() && under_way_.front().arrives <= count_) {
      latest_ = under_way_.front().model;
      under_way_.pop_front();
    }
    return setup_.handover == Handover::extrapolated ? extrapolated(latest_, device_pose) : latest_.wrench;
  }

 private:
  struct Parcel {
    long arrives;
    WrenchModel model;
  };

  Rendering& rendering_;
  const LoopSetup& setup_;
  long count_ = 0;
  std::deque<Parcel> under_way_;
  WrenchModel latest_;
};

}  // namespace

Rest rest_of(const DeviceSpecification& device) noexcept {
  return {std::max(5e-6, 2 * device.position_resolution), std::max(1e-4, 2 * device.rotation_resolution), 0.05 * press_of(device, false),
          0.05 * press_of(device, true)};
}

double press_of(const DeviceSpecification& device, bool turns) noexcept {
  return turns ? std::min(0.02, device.continuous_torque / 2) : std::min(1.0, device.continuous_force / 2);
}

LoopResult run_loop(const Situation& situation, const Pose<double>& contact, const LoopSetup& setup, bool with_trace) {
  const double period = 1 / setup.rate;
  scenes::Scene scene = scene_named(situation.scene);
  scene.hardness = setup.stiffness;
  scene.length = std::sqrt(setup.rotational_stiffness / setup.stiffness);
  const auto rendering = make_rendering(setup.engine, scene, period * setup.divider);
  if (!rendering) throw std::runtime_error(std::string("the engine ") + name_of(setup.engine) + " was not built");

  SimulatedPhantomSettings phantom_settings;
  phantom_settings.specification = setup.device;
  phantom_settings.grip = setup.grip;
  phantom_settings.period = period;
  phantom_settings.substeps = std::max(10, int(std::ceil(period / 2.5e-5)));
  phantom_settings.has_friction = setup.has_friction;
  SimulatedPhantom phantom(path_of(situation, contact, setup), phantom_settings);
  phantom.open();

  std::optional<PassivityControl> passivity;
  if (setup.is_passive) {
    PassivitySettings settings = passivity_of(setup.device, period);
    settings.delay = 1;
    passivity.emplace(settings);
  }
  const double end = situation.slides() ? slide_from + situation.slide.norm() / slide_speed : hold_end;
  const bool senses_rotation = setup.device.is_sensed[3];
  const Vector3<double> press = situation.turns() ? situation.press.angular : situation.press.linear;

  LoopResult result;
  Swing kicked, kicked_turn, last, last_turn;
  HighPass force_filter(cutoff, setup.rate), torque_filter(cutoff, setup.rate);
  RootMeanSquare force_buzz, torque_buzz, last_force_buzz, last_torque_buzz;
  Vector3<double> last_force = Vector3<double>::Zero();
  SlowRendering slow(*rendering, setup);
  DeviceState state;
  phantom.read(state);
  rendering->reset(from_device<Pose<double>>(state.pose));
  const Pose<double> start = from_device<Pose<double>>(state.pose);
  const long ticks = std::lround(end * setup.rate);
  for (long i = 0; i < ticks; ++i) {
    if (i > 0) phantom.read(state);
    if (!senses_rotation) std::copy_n(to_device_pose(start).orientation, 4, state.pose.orientation);
    DeviceWrench wrench = slow.tick(state.pose);
    if (!is_finite(wrench)) {
      result.is_finite = false;
      return result;
    }
    if (passivity) wrench = passivity->damped(state, wrench);
    wrench = limited(wrench, setup.device.maximum_force, setup.device.maximum_torque);
    if (passivity) passivity->pushed(wrench);
    const bool is_kicked = !situation.slides() && state.time >= kick_at && state.time < kick_at + kick_time;
    DeviceWrench written = wrench;
    for (int k = 0; is_kicked && k < 3; ++k)
      (situation.turns() ? written.torque : written.force)[k] += setup.kick * (situation.turns() ? 0.02 : 1.0) * press[k];
    phantom.write(written);

    const Pose<double> exact = from_device<Pose<double>>(phantom.exact_pose());
    const Twist<double> away = motion_between(contact, exact);
    const Vector3<double> force = vector(wrench.force);
    const Vector3<double> fast = force_filter.step(force), fast_torque = torque_filter.step(vector(wrench.torque));
    const bool is_heard = situation.slides() ? state.time >= slide_from : state.time >= 0.35 && state.time < kick_at;
    if (is_heard) {
      force_buzz.add(fast);
      torque_buzz.add(fast_torque);
      result.greatest_force_step = std::max(result.greatest_force_step, (force - last_force).norm());
    }
    last_force = force;
    if (state.time >= end - 2 * window && state.time < end - window) kicked.add(away.linear), kicked_turn.add(away.angular);
    if (state.time >= end - window) {
      last.add(away.linear), last_turn.add(away.angular);
      last_force_buzz.add(fast), last_torque_buzz.add(fast_torque);
    }
    if (!situation.slides() && !(away.linear.norm() <= runaway)) {
      result.is_finite = false;
      result.swing_end = away.linear.norm();
      return result;
    }
    if (with_trace) {
      result.trace.push_back(
          {state.time, press.dot(situation.turns() ? away.angular : away.linear), press.dot(situation.turns() ? vector(wrench.torque) : force)});
    }
  }
  const Rest rest = rest_of(setup.device);
  if (!situation.slides()) {
    result.swing_start = kicked.size();
    result.turn_start = kicked_turn.size();
  }
  result.swing_end = last.size();
  result.turn_end = last_turn.size();
  result.buzz = force_buzz.value();
  result.torque_buzz = torque_buzz.value();
  result.buzz_end = last_force_buzz.value();
  result.torque_buzz_end = last_torque_buzz.value();
  const bool is_calm = result.buzz_end <= rest.buzz && (!setup.device.pushes_torque() || result.torque_buzz_end <= rest.torque_buzz);
  const bool rests = result.swing_end <= std::max(rest.swing, decay_of_a_stable_loop * result.swing_start);
  const bool rests_turned = !senses_rotation || result.turn_end <= std::max(rest.turn, decay_of_a_stable_loop * result.turn_start);
  result.is_stable = result.is_finite && is_calm && rests && rests_turned;
  return result;
}

}  // namespace feeler::stability
