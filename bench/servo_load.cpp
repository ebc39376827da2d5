// Runs the servo loop for minutes over the renderer and a simulated device, and says how late it was: to be
// run under load.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "command_line.hpp"
#include "feeler/device/conversion.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "feeler/feeler.hpp"
#include "scenes/cavity.hpp"
#include "scenes/renderers.hpp"
#include "text_file.hpp"

namespace {

/// Ticks by the microseconds that they woke up late, as cyclictest -h prints them.
void write_histogram(const feeler::Histogram& latency, const std::filesystem::path& path) {
  feeler::demo::TextFile file(path);
  file.print("up_to_us,ticks\n");
  for (int bin = 0; bin < feeler::Histogram::bins; ++bin) {
    if (latency.count_in(bin) == 0) continue;
    file.print("%.3f,%lld\n", double(feeler::Histogram::last_of(bin)) / 1000, static_cast<long long>(latency.count_in(bin)));
  }
  file.close();
}

int run(double rate, double seconds, int processor, const std::string& histogram) {
  const auto scene = feeler::scenes::cavity(1e-3);
  const feeler::TriangleMesh<double> object(scene.vertices, scene.triangles);
  feeler::HapticRenderer renderer(object, std::get<feeler::Box<double>>(scene.tool), scene.settings());
  if (renderer.reset(scene.start) != feeler::Status::converged) return 2;
  feeler::SimulatedPhantomSettings phantom_settings;
  phantom_settings.period = 1 / rate;
  feeler::SimulatedPhantom phantom([&](double time) { return feeler::to_device_pose(scene.motion(time)); }, phantom_settings);
  phantom.open();

  feeler::ServoSettings settings;
  settings.rate = rate;
  settings.tick_limit = std::int64_t(rate * seconds);
  settings.real_time.processor = processor;
  feeler::ServoLoop loop(settings, phantom, [&](const feeler::ServoTick&, const feeler::DeviceState& state) {
    return feeler::to_device_wrench(renderer.update(feeler::from_device<feeler::Pose<double>>(state.pose)).wrench);
  });
  loop.start();
  const feeler::ServoReport& report = loop.wait();
  std::fputs(to_string(report).c_str(), stdout);
  if (!histogram.empty()) write_histogram(report.wake_up_latency, histogram);
  return report.problem.empty() && report.missed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  double rate = 1000, seconds = 600;
  int processor = -1;
  std::string histogram;
  CLI::App app("How late the servo loop is, over minutes; load the machine beside it.", "feeler-servo-load");
  app.add_option("--rate", rate, "of the loop [Hz]")->check(feeler::bench::within(10.0, 20000.0))->capture_default_str();
  app.add_option("--seconds", seconds, "to run")->check(feeler::bench::within(0.01, 1e5))->capture_default_str();
  app.add_option("--processor", processor, "to run on; -1 for any")->check(feeler::bench::within(-1, 4095))->capture_default_str();
  app.add_option("--histogram", histogram, "file for the wake-up latencies as CSV");
  return feeler::bench::run_with_options(app, argc, argv, [&] { return run(rate, seconds, processor, histogram); });
}
