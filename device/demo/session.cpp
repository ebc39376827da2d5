// The servo loop of the demo, and the thread that watches it.
#include "session.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <type_traits>

#include "bad_input.hpp"
#include "feeler/device/conversion.hpp"
#include "feeler/device/latest_value.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/workspace_map.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/render/unit_warning.hpp"
#include "real_device.hpp"
#include "scenes/renderers.hpp"

namespace feeler::demo {
namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_between(SteadyClock::time_point from, SteadyClock::time_point to) { return std::chrono::duration<double>(to - from).count(); }

/// The few numbers of a tick that the watching thread prints; trivially copyable.
struct Snapshot {
  double time, microseconds, force;
  int contacts;
};

volatile std::sig_atomic_t is_interrupted = 0;

/// While it lives, an interrupt from the keyboard lets a real device go before the program ends.
class InterruptGuard {
 public:
  InterruptGuard() : previous_(std::signal(SIGINT, [](int) { is_interrupted = 1; })) {}
  ~InterruptGuard() { std::signal(SIGINT, previous_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*previous_)(int);
};

/// Prints what the loop hands over, until the loop ends.
void watch(ServoLoop& loop, LatestValue<Snapshot>& latest, const ProgressSink& report) {
  auto last_time = SteadyClock::now();
  std::int64_t last_ticks = 0;
  while (loop.is_running()) {
    for (int i = 0; i < 25 && loop.is_running(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (is_interrupted != 0) {
        loop.stop_force();
        loop.stop();
      }
    }
    Snapshot snapshot;
    if (!latest.fetch(snapshot)) continue;
    const auto now = SteadyClock::now();
    const std::int64_t ticks = loop.ticks();
    report({snapshot.time, double(ticks - last_ticks) / seconds_between(last_time, now), snapshot.microseconds, snapshot.contacts, snapshot.force,
            loop.missed()});
    last_time = now;
    last_ticks = ticks;
  }
}

template <class Tool>
Recording run(const scenes::Scene& scene, const Tool& tool, const SessionSettings& settings, const ProgressSink& report) {
  SimulatedPhantom phantom([&](double t) { return to_device_pose(scene.motion(t)); }, device_settings(settings));
  const std::unique_ptr<Device> real_device = open_real_device(settings.device, settings.choice);
  Device& device = real_device ? *real_device : phantom;
  if (const OpenResult opened = device.open(); !opened) throw std::runtime_error(opened.problem);

  Recording recording;
  recording.device = device.specification();
  recording.is_simulated = real_device == nullptr;
  WorkspaceSettings workspace;
  Settings<double> renderer_settings = scene.settings();
  if (real_device) {
    check_rate(recording.device, settings.rate);
    workspace = real_workspace(settings.workspace_scale);
    recording.stiffness_share = renderable_share(renderer_settings.stiffness, recording.device, WorkspaceMap(workspace));
    renderer_settings.stiffness.translational *= recording.stiffness_share;
    renderer_settings.stiffness.rotational *= recording.stiffness_share;
  }
  WorkspaceMap map(workspace);

  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  if (const std::string warning = unit_warning(object, tool); !warning.empty()) std::printf("  note: %s\n", warning.c_str());
  HapticRenderer renderer(object, tool, renderer_settings);
  const Status start = renderer.reset(scene.start);
  if (start == Status::inside)
    throw BadInput("The start pose of the scene " + scene.name + " is in the solid that the object encloses: start outside (--start).");
  if (start != Status::converged) {
    throw BadInput("The start pose of the scene " + scene.name +
                   " penetrates the object: start outside (--start) or give a clearance of 0 or more (--clearance).");
  }
  // Touched before the loop, with room for the longest way.
  recording.ticks.resize(std::size_t(std::ceil(settings.rate * settings.seconds)));
  const int longest_way =
      std::min(scene.settings().maximum_iterations + IdleTurns<std::remove_cvref_t<decltype(tool)>>::legs, Tick<double>::path_capacity);
  recording.way.resize(1 + recording.ticks.size() * std::size_t(longest_way));
  recording.way.front() = renderer.tick().graphic_pose;
  std::size_t way_end = 1;
  LatestValue<Snapshot> latest;
  SteadyClock::time_point first, last;
  std::size_t count = 0;

  ServoSettings servo;
  servo.rate = settings.rate;
  servo.tick_limit = std::int64_t(recording.ticks.size());
  SessionRecorder recorder(settings.record ? recording.ticks.size() : 0);
  if (settings.record) servo.recorder = &recorder;
  double first_time = 0;
  ServoLoop loop(servo, device, [&](const ServoTick& deadline, const DeviceState& state) {
    if (count == 0) {
      first_time = state.time;
      if (real_device) map.place(state.pose, to_device_pose(scene.start));
    }
    const Pose<double> haptic = from_device<Pose<double>>(map.to_scene(state));
    const auto before = SteadyClock::now();
    const Tick<double>& tick = renderer.update(haptic);
    const auto after = SteadyClock::now();
    for (int i = 0; i + 1 < tick.path.size(); ++i) recording.way[way_end++] = tick.path[i];
    recording.way[way_end++] = tick.graphic_pose;
    recording.ticks[count] = {state.time - first_time,
                              haptic,
                              tick.graphic_pose,
                              tick.wrench,
                              tick.contacts.size(),
                              tick.rows,
                              tick.iterations,
                              tick.converged(),
                              1e6 * seconds_between(before, after),
                              1e-3 * double(deadline.late),
                              int(deadline.missed),
                              way_end};
    latest.store({recording.ticks[count].time, recording.ticks[count].microseconds, tick.wrench.force.norm(), tick.contacts.size()});
    if (count == 0) first = before;
    last = before;
    ++count;
    return map.to_device(to_device_wrench(tick.wrench));
  });
  const InterruptGuard guard;
  loop.start();
  watch(loop, latest, report);
  recording.servo = loop.wait();
  device.close();
  if (!recording.servo.problem.empty()) throw std::runtime_error(recording.servo.problem);
  if (is_interrupted != 0) throw std::runtime_error("Stopped from the keyboard: the force is off, and there is no report.");
  if (settings.record) recording.session = recorder.recording();
  recording.ticks.resize(count);
  recording.way.resize(way_end);
  recording.wall_seconds = seconds_between(first, last);
  return recording;
}

}  // namespace

SimulatedPhantomSettings device_settings(const SessionSettings& settings) {
  SimulatedPhantomSettings device;
  device.period = 1.0 / settings.rate;
  device.specification.minimum_rate = std::min(device.specification.minimum_rate, settings.rate);
  device.grip.tremor = 3e-5;
  device.grip.rotational_tremor = 3e-4;
  device.grip.seed = settings.seed;
  return device;
}

Recording run_session(const scenes::Scene& scene, const SessionSettings& settings, const ProgressSink& report) {
  try {
    return std::visit([&](const auto& tool) { return run(scene, tool, settings, report); }, scene.tool);
  } catch (const std::invalid_argument& refusal) {
    throw BadInput(refusal.what());
  }
}

}  // namespace feeler::demo
