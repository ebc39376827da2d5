// Times the recognition of contacts on the poses that the renderer gives in scenes: the table in docs/contacts.md.
//
// Usage: feeler-contact-latency. One line a scene; times are of ticks in contact only.
#include <chrono>
#include <cstdio>
#include <variant>
#include <vector>

#include "feeler/recognition/contact_recogniser.hpp"
#include "scenes/cavity.hpp"
#include "scenes/renderers.hpp"
#include "scenes/steps.hpp"
#include "scenes/terrain.hpp"
#include "times.hpp"

namespace {

using feeler::bench::quantile;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

template <class Tool>
void run(const feeler::scenes::Scene& scene, const Tool& tool, int ticks) {
  auto start = Clock::now();
  const feeler::TriangleMesh<double> object(scene.vertices, scene.triangles);
  const double mesh_seconds = seconds_since(start);
  start = Clock::now();
  const feeler::SurfaceFeatures<double> surface(object);
  const double features_seconds = seconds_since(start);

  feeler::ContactRecogniser recogniser(object, surface, tool);
  feeler::FormationTracker<double> tracker;
  feeler::HapticRenderer renderer(object, tool, scene.settings());
  renderer.reset(scene.start);
  std::vector<double> times;
  int missed = 0, incomplete = 0, switches = 0;
  for (int i = 0; i < ticks; ++i) {
    const auto tick = renderer.update(scene.motion(1e-3 * i));
    start = Clock::now();
    const auto& formation = recogniser.recognise(tick.graphic_pose);
    const double seconds = seconds_since(start);
    if (!formation.empty()) times.push_back(1e6 * seconds);
    if (formation.empty() && tick.contacts.size() > 0) ++missed;
    if (!formation.is_complete()) ++incomplete;
    if (tracker.observe(formation) != nullptr) ++switches;
  }
  std::printf(
      "%s: %d triangles, mesh %.3f s, features %.3f s; %d ticks in contact: median %.1f, p99 %.1f, max %.1f us; %d switches, %d incomplete, "
      "%d ticks where the renderer has contacts and the tolerance none\n",
      scene.name.c_str(), object.triangle_count(), mesh_seconds, features_seconds, int(times.size()), quantile(times, 0.5), quantile(times, 0.99),
      quantile(times, 1.0), switches, incomplete, missed);
}

void run(const feeler::scenes::Scene& scene, int ticks) {
  std::visit([&](const auto& tool) { run(scene, tool, ticks); }, scene.tool);
}

}  // namespace

int main() {
  run(feeler::scenes::steps(), 5000);
  run(feeler::scenes::steps_with_prism(), 5000);
  run(feeler::scenes::cavity(1e-3), 4000);
  run(feeler::scenes::cavity(1e-5), 4000);
  run(feeler::scenes::cavity(0.0), 4000);
  run(feeler::scenes::terrain(71), 4000);
  run(feeler::scenes::terrain(707), 1500);
}
