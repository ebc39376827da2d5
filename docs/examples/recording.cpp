// A session with a device, recorded, saved, loaded, and replayed to the last bit: to look at a bad moment again.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include <feeler/device/conversion.hpp>
#include <feeler/device/servo_loop.hpp>
#include <feeler/device/session_recorder.hpp>
#include <feeler/device/simulated_phantom.hpp>
#include <feeler/feeler.hpp>

namespace {
using Renderer = feeler::HapticRenderer<feeler::Sphere<double>>;

feeler::DeviceWrench render(Renderer& renderer, const feeler::DeviceState& state) {
  return feeler::to_device_wrench(renderer.update(feeler::from_device<feeler::Pose<double>>(state.pose)).wrench);
}
}  // namespace

int main() {
  feeler::Points<double> vertices(4, 3);
  vertices << -1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1;
  feeler::Triangles triangles(2, 3);
  triangles << 0, 2, 1, 0, 3, 2;
  const feeler::TriangleMesh<double> table(vertices, triangles);
  const feeler::Sphere<double> ball(0.01);
  const feeler::Pose<double> start{.translation = {0, 0.03, 0}};

  feeler::SimulatedPhantom device(
      [](double time) { return feeler::DevicePose{{0.02 * std::sin(9 * time), std::max(0.03 - 0.1 * time, 0.006), 0}, {1, 0, 0, 0}}; });
  if (const auto opened = device.open(); !opened) return std::cerr << opened.problem << "\n", 1;
  Renderer renderer(table, ball);
  renderer.reset(start);
  feeler::SessionRecorder recorder(2000);  // ticks, for which the room is made now
  feeler::ServoSettings settings;
  settings.rate = 0;  // as fast as it goes: nobody holds this device
  settings.tick_limit = 1000;
  settings.recorder = &recorder;
  feeler::ServoLoop loop(settings, device, [&](const feeler::ServoTick&, const feeler::DeviceState& state) { return render(renderer, state); });
  loop.start();
  loop.wait();
  device.close();

  const auto file = std::filesystem::temp_directory_path() / "feeler_example.session";
  feeler::save(recorder.recording(), file);
  const auto loaded = feeler::load_session(file);
  std::filesystem::remove(file);

  // A fresh renderer, the same poses: the same wrenches, bit for bit. Where one differs, the replay says in which tick.
  Renderer again(table, ball);
  again.reset(start);
  const auto replay = feeler::replay(loaded, [&](const feeler::DeviceState& state) { return render(again, state); });
  std::printf("%zu ticks, %s\n", replay.ticks, replay.is_exact() ? "the same to the last bit" : "with differences");
}  // prints: 1000 ticks, the same to the last bit
