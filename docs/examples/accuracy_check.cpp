// How exact are the default settings on your scene? The same hand, rendered again in wider numbers, with a tighter margin and no limit to the work.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <feeler/feeler.hpp>

namespace {

/// A ramp of 30 degrees that ends at a wall: put your mesh here.
template <class Scalar>
feeler::TriangleMesh<Scalar> object() {
  feeler::Points<double> vertices(6, 3);
  vertices << -0.1, -0.1, 0.0577, -0.1, 0.1, 0.0577, 0, -0.1, 0, 0, 0.1, 0, 0.02, -0.1, 0.1, 0.02, 0.1, 0.1;
  feeler::Triangles triangles(4, 3);
  triangles << 0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5;
  return {feeler::Points<Scalar>(vertices.cast<Scalar>()), triangles};
}

/// Your hand, at a time [s].
feeler::Pose<double> hand(double time) {
  return {.translation = {-0.03 + 0.02 * time, 0.005 * std::sin(3 * time), 0.024 + 0.014 * std::cos(2 * time)},
          .rotation = feeler::Quaternion<double>(Eigen::AngleAxisd(0.2 * std::sin(time), feeler::Vector3<double>::UnitY()))};
}

}  // namespace

int main() {
  using Wide = long double;
  const feeler::Box<double> tool({0.008, 0.006, 0.01});
  const auto mesh = object<double>();
  const auto wide_mesh = object<Wide>();
  feeler::Settings<Wide> tight;
  tight.margin = 1e-9L;
  tight.step_tolerance = 1e-11L;
  tight.maximum_iterations = 32;
  tight.work_budget = 1'000'000;

  feeler::HapticRenderer renderer(mesh, tool);
  feeler::HapticRenderer reference(wide_mesh, tool.cast<Wide>(), tight);
  if (renderer.reset(hand(0)) != feeler::Status::converged || reference.reset(hand(0).cast<Wide>()) != feeler::Status::converged) return 1;
  int ticks = 0, converged = 0;
  double farthest = 0, force_error = 0;
  for (int i = 1; i <= 3000; ++i) {
    const auto pose = hand(1e-3 * i);
    const auto& tick = renderer.update(pose);
    const auto& truth = reference.update(pose.cast<Wide>());
    ++ticks;
    converged += tick.converged() ? 1 : 0;
    if (!tick.converged() || !truth.converged()) continue;
    farthest = std::max(farthest, (tick.graphic_pose.translation - truth.graphic_pose.translation.cast<double>()).norm());
    force_error = std::max(force_error, (tick.wrench.force - truth.wrench.force.cast<double>()).norm());
  }
  std::printf("converged in %d of %d ticks, at most %.2f um and %.1f mN off\n", converged, ticks, 1e6 * farthest, 1e3 * force_error);
  std::printf("%s\n", farthest < 5e-6 ? "within five margins" : "farther off than five margins: look at that tick");
}  // prints: within five margins
