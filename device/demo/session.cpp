// The servo loop of the demo, and the thread that watches it.
#include "session.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "bad_input.hpp"
#include "feeler/device/conversion.hpp"
#include "feeler/device/latest_value.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/render/haptic_renderer.hpp"

namespace feeler::demo {
namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_between(SteadyClock::time_point from, SteadyClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// The few numbers of a tick that the watching thread prints; trivially copyable.
struct Snapshot {
  double time, microseconds, force;
  int contacts;
};

/// Prints what the loop hands over, until the loop ends.
void watch(ServoLoop& loop, LatestValue<Snapshot>& latest, const ProgressSink& report) {
  auto last_time = SteadyClock::now();
  std::int64_t last_ticks = 0;
  while (loop.is_running()) {
    for (int i = 0; i < 25 && loop.is_running(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    Snapshot snapshot;
    if (!latest.fetch(snapshot)) continue;
    const auto now = SteadyClock::now();
    const std::int64_t ticks = loop.ticks();
    report({snapshot.time, double(ticks - last_ticks) / seconds_between(last_time, now),
            snapshot.microseconds, snapshot.contacts, snapshot.force, loop.missed()});
    last_time = now;
    last_ticks = ticks;
  }
}

template <class Tool>
Recording run(const scenes::Scene& scene, const Tool& tool, const SessionSettings& settings,
              const ProgressSink& report) {
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer renderer(object, tool, scene.settings());
  if (renderer.reset(scene.start) != Status::converged) {
    throw BadInput(
        "The start pose of the scene " + scene.name +
        " penetrates the object: start outside (--start) or give a clearance of 0 or more (--clearance).");
  }
  SimulatedPhantom device([&](double t) { return to_device_pose(scene.motion(t)); },
                          device_settings(settings));
  if (const OpenResult opened = device.open(); !opened) throw std::runtime_error(opened.problem);

  Recording recording;
  // Touched before the loop, with room for the longest way.
  recording.ticks.resize(std::size_t(std::ceil(settings.rate * settings.seconds)));
  const int longest_way = std::min(scene.settings().maximum_iterations, Tick<double>::path_capacity);
  recording.way.resize(1 + recording.ticks.size() * std::size_t(longest_way));
  recording.way.front() = renderer.tick().graphic_pose;
  std::size_t way_end = 1;
  LatestValue<Snapshot> latest;
  SteadyClock::time_point first, last;
  std::size_t count = 0;

  ServoSettings servo;
  servo.rate = settings.rate;
  servo.tick_limit = std::int64_t(recording.ticks.size());
  ServoLoop loop(servo, [&](const ServoTick&) {
    DeviceState state;
    if (device.read(state) == DeviceStatus::fault) return false;
    const Pose<double> haptic = from_device<Pose<double>>(state.pose);
    const auto before = SteadyClock::now();
    const Tick<double>& tick = renderer.update(haptic);
    const auto after = SteadyClock::now();
    device.write(to_device_wrench(tick.wrench));

    for (int i = 0; i + 1 < tick.path.size(); ++i) recording.way[way_end++] = tick.path[i];
    recording.way[way_end++] = tick.graphic_pose;
    recording.ticks[count] = {state.time,
                              haptic,
                              tick.graphic_pose,
                              tick.wrench,
                              tick.contacts.size(),
                              tick.rows,
                              tick.iterations,
                              tick.converged(),
                              1e6 * seconds_between(before, after),
                              way_end};
    latest.store(
        {state.time, recording.ticks[count].microseconds, tick.wrench.force.norm(), tick.contacts.size()});
    if (count == 0) first = before;
    last = before;
    return ++count < recording.ticks.size();
  });
  loop.start();
  watch(loop, latest, report);
  recording.servo = loop.wait();
  device.close();
  if (!recording.servo.problem.empty()) throw std::runtime_error(recording.servo.problem);
  recording.ticks.resize(count);
  recording.way.resize(way_end);
  recording.wall_seconds = seconds_between(first, last);
  return recording;
}

}  // namespace

SimulatedPhantomSettings device_settings(const SessionSettings& settings) {
  SimulatedPhantomSettings device;
  device.period = 1.0 / settings.rate;
  device.grip.tremor = 3e-5;
  device.grip.rotational_tremor = 3e-4;
  device.grip.seed = settings.seed;
  return device;
}

Recording run_session(const scenes::Scene& scene, const SessionSettings& settings,
                      const ProgressSink& report) {
  try {
    return std::visit([&](const auto& tool) { return run(scene, tool, settings, report); }, scene.tool);
  } catch (const std::invalid_argument& refusal) {
    throw BadInput(refusal.what());
  }
}

}  // namespace feeler::demo
