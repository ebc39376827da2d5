// A device at 1 kHz: the renderer in the servo loop, and between it and the motors limits, a ramp and a watchdog.
#include <algorithm>
#include <cstdio>
#include <iostream>

#include <feeler/device/conversion.hpp>
#include <feeler/device/servo_loop.hpp>
#include <feeler/device/simulated_phantom.hpp>
#include <feeler/feeler.hpp>

int main() {
  // The world of a device has x to the right, y up and z to the user: the table lies in y = 0.
  feeler::Points<double> vertices(4, 3);
  vertices << -1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1;
  feeler::Triangles triangles(2, 3);
  triangles << 0, 2, 1, 0, 3, 2;
  const feeler::TriangleMesh<double> table(vertices, triangles);

  // A hand that comes down from 40 mm and presses to 5 mm below where the table stops the ball. For a real device, `make_device` in
  // feeler/device/device_catalogue.hpp makes one by name.
  feeler::SimulatedPhantom device([](double time) { return feeler::DevicePose{{0, std::max(0.040 - 0.1 * time, 0.005), 0}, {1, 0, 0, 0}}; });
  if (const auto opened = device.open(); !opened) {
    std::cerr << opened.problem << "\n";
    return 1;
  }
  feeler::Settings<double> settings;
  settings.stiffness = feeler::Stiffness<double>::uniform(device.specification().stiffness, device.specification().rotational_stiffness);
  feeler::HapticRenderer renderer(table, feeler::Sphere<double>(0.01), settings);
  if (renderer.reset({.translation = {0, 0.040, 0}}) != feeler::Status::converged) return 1;

  feeler::ServoSettings servo;  // 1000 Hz
  servo.tick_limit = 1500;      // 0 runs until stop()
  feeler::ServoLoop loop(servo, device, [&](const feeler::ServoTick&, const feeler::DeviceState& state) {
    return feeler::to_device_wrench(renderer.update(feeler::from_device<feeler::Pose<double>>(state.pose)).wrench);
  });
  loop.start();
  std::cout << to_string(loop.wait()) << "\n";  // what the system refused, ticks, missed deadlines, tails, what the safety did
  device.close();
  const auto& tick = renderer.tick();
  std::printf("the ball rests at %.0f mm and is pushed up\n", 1e3 * tick.graphic_pose.translation.y());
}  // prints: the ball rests at 10 mm and is pushed up
