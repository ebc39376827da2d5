// Inside an engine's own loop, at 90 frames a second: its arrays, its clock, a wrench that is never more than the device may push, and another tool for a
// hand that goes on pressing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <feeler/device/conversion.hpp>
#include <feeler/device/wrench_guard.hpp>
#include <feeler/feeler.hpp>

namespace engine {  // what yours has: meshes in millimetres, a clock, a device that knows no limits

const float vertices[] = {-100, -100, 0, 100, -100, 0, 100, 100, 0, -100, 100, 0};
const unsigned indices[] = {0, 1, 2, 0, 2, 3};

struct Device {
  double pushed = 0, strongest = 0;  // [N]

  /// Where the hand is at a time: down to half a metre below the table.
  feeler::DevicePose pose(double time) const { return {{0, 0, std::max(0.03 - 0.1 * time, time < 2 ? -0.002 : -0.5)}, {1, 0, 0, 0}}; }
  void push(const feeler::DeviceWrench& wrench) {
    pushed = std::hypot(wrench.force[0], wrench.force[1], wrench.force[2]);
    strongest = std::max(strongest, pushed);
  }
};

}  // namespace engine

/// What the engine keeps for one hand.
class Hand {
 public:
  using Tool = feeler::Sphere<double>;
  static constexpr double rate = 90;  // frames a second

  explicit Hand(const feeler::TriangleMesh<double>& object) : object_(object) {}

  /// At the start where the device is; later where the tool was, not where the hand is: that is below the table. False where the tool has no room.
  bool take(const Tool& tool, const feeler::DevicePose& device) {
    const auto last = renderer_ ? renderer_->tick().graphic_pose : feeler::from_device<feeler::Pose<double>>(device);
    renderer_.emplace(object_, tool, settings());
    return feeler::nearest_free_pose(*renderer_, last).is_found;
  }

  /// One frame: what to push. Draw the tool at `drawn()`.
  feeler::DeviceWrench frame(const feeler::DevicePose& device, double now) {
    const auto& tick = renderer_->update_until_converged(feeler::from_device<feeler::Pose<double>>(device), 1500);  // a millisecond of work
    wanted_ = tick.wrench.force.norm();
    return guard_.allowed({.pose = device, .time = now}, feeler::to_device_wrench(tick.wrench), now);
  }
  const feeler::Pose<double>& drawn() const { return renderer_->tick().graphic_pose; }
  double wanted() const { return wanted_; }

 private:
  static feeler::Settings<double> settings() {
    return {.stiffness = feeler::Stiffness<double>::uniform(feeler::touch().stiffness / 4, 0.05)};  // what is stable at 1 kHz buzzes at 90 Hz
  }

  const feeler::TriangleMesh<double>& object_;
  std::optional<feeler::HapticRenderer<Tool>> renderer_;
  feeler::WrenchGuard guard_{feeler::touch(), rate};
  double wanted_ = 0;
};

int main() {
  const feeler::TriangleMesh<double> table(engine::vertices, 4, engine::indices, 2, 0.001);
  engine::Device device;
  Hand hand(table);
  if (!hand.take(feeler::Sphere<double>(0.002), device.pose(0))) return 1;
  for (int i = 0; i < 300; ++i) {
    const double now = i / Hand::rate;
    if (i == 100 && !hand.take(feeler::Sphere<double>(0.005), device.pose(now))) return 1;  // the next frames push more, by a ramp
    device.push(hand.frame(device.pose(now), now));
    if (i == 99 || i == 150) std::printf("tool at %.1f mm, ", 1e3 * hand.drawn().translation.z());
  }
  std::printf("wanted %s, pushed up to %.1f N\n", hand.wanted() > 30 ? "far too much" : "little", device.strongest);
}  // prints: tool at 2.0 mm, tool at 5.0 mm, wanted far too much, pushed up to 3.3 N
