// The table's probes, each judged by a closed form or by the independent checker.
#include "experiments/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "experiments/measures.hpp"
#include "experiments/motions.hpp"
#include "text_file.hpp"

namespace feeler::experiments {
namespace {

Settings<double> with_stiffness(Method method, double rotational) {
  Settings<double> settings;
  settings.closed_means_solid = false;  // the paper's cavity faces outwards
  settings.stiffness = Stiffness<double>::uniform(1000.0, rotational);
  const bool is_shared = method == Method::shared_metric || method == Method::all_corrections || method == Method::standard;
  if (!is_shared) settings.metric = Metric<double>::with_length(0.01);
  return settings;
}

/// How far the tool ends from the foot of the perpendicular of the hand on the slope: the worst of four headings [m].
double lag_on_slope(Method method, double degrees) {
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double slope = degrees * std::numbers::pi / 180.0;
    const auto scene = slope_drag(slope, double(i) * std::numbers::pi / 2.0);
    const auto ticks = run(scene, stiff_settings(method), method, scene.duration, false).ticks;
    const Vector normal = exp_rotation(Vector(0.0, slope, 0.0)) * Vector::UnitZ();
    const Vector hand = ticks.back().haptic.translation;
    const Vector foot = hand + (0.005 - normal.dot(hand)) * normal;
    worst = std::max(worst, (ticks.back().graphic.translation - foot).norm());
  }
  return worst;
}

struct Arm {
  double error = 0;  ///< of the height of the held point against the closed form [m]
  double felt = 0;   ///< torque by force [m]
  double real = 0;   ///< [m]
};

/// min ½(z − z_h)² + ½L²(φ − φ_h)² with the end on the floor, z = a sin φ: one equation, by bisection.
Arm arm_of(Method method) {
  constexpr double a = 0.1;
  const auto scene = long_arm();
  const auto settings = paper_settings(method);
  const auto record = run(scene, settings, method, scene.duration, false).ticks.back();
  const auto metric = settings.metric ? *settings.metric : Metric<double>::proportional_to(settings.stiffness);
  const double height = record.haptic.translation.z(), angle = 0.2, weight = metric.rotational.x();
  double low = -0.2, high = 0.4;
  for (int i = 0; i < 100; ++i) {
    const double phi = (low + high) / 2.0;
    const double slope = (a * std::sin(phi) - height) * a * std::cos(phi) + weight * (phi - angle);
    (slope < 0.0 ? low : high) = phi;
  }
  return {std::abs(record.graphic.translation.z() - a * std::sin(low)), record.wrench.torque.norm() / record.wrench.force.norm(), a * std::cos(low)};
}

}  // namespace

Settings<double> paper_settings(Method method) { return with_stiffness(method, 0.03); }
Settings<double> stiff_settings(Method method) { return with_stiffness(method, 0.3); }

void make_table(const std::filesystem::path& folder) {
  demo::TextFile csv(folder / "table.csv"), text(folder / "table.md");
  csv.print(
      "method,deepest_um,lag_10_mm,lag_30_mm,lag_45_mm,lag_60_mm,closed_form_error_um,pose_step_mm,wrench_step_N,arm_felt_m,"
      "arm_real_m,force_without_contact_ticks,p50_us,p99_us\n");
  text.print(
      "| method | deepest [µm] | behind on 10°, 30°, 45°, 60° [mm] | error [µm] | pose step [mm] | force step [N] | arm felt (real) [m] "
      "| force without contact [ticks] | p50, p99 [µs] |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const Method method : all_methods) {
    const auto cavity = cavity_states(1e-3), steps = steps_states(), hand = scenes::steps();
    Measures worst = measure(run(cavity, paper_settings(method), method, cavity.duration, true).ticks, 1000.0);
    worst = worst_of(worst, measure(run(steps, stiff_settings(method), method, steps.duration, true).ticks, 1000.0));
    worst = worst_of(worst, measure(run(hand, stiff_settings(method), method, 4.0, true).ticks, 1000.0));
    double lag[4];
    const double slopes[4] = {10.0, 30.0, 45.0, 60.0};
    for (int i = 0; i < 4; ++i) lag[i] = 1e3 * lag_on_slope(method, slopes[i]);
    const Arm arm = arm_of(method);
    const char* name = name_of(method);
    csv.print("%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%d,%.4g,%.4g\n", name, 1e6 * worst.deepest, lag[0], lag[1], lag[2], lag[3],
              1e6 * arm.error, 1e3 * worst.pose_step, worst.wrench_step, arm.felt, arm.real, worst.force_without_contact, worst.p50, worst.p99);
    text.print("| %s | %.3g | %.3f, %.3f, %.3f, %.3f | %.3g | %.2f | %.2f | %.4f (%.4f) | %d | %.1f, %.0f |\n", name, 1e6 * worst.deepest, lag[0],
               lag[1], lag[2], lag[3], 1e6 * arm.error, 1e3 * worst.pose_step, worst.wrench_step, arm.felt, arm.real, worst.force_without_contact,
               worst.p50, worst.p99);
    std::printf(
        "%-20s deepest %9.3g um | behind %.3f %.3f %.3f %.3f mm | error %.3g um | steps %.2f mm %.2f N | arm %.4f of %.4f m | "
        "no contact %d | %.1f %.0f us\n",
        name, 1e6 * worst.deepest, lag[0], lag[1], lag[2], lag[3], 1e6 * arm.error, 1e3 * worst.pose_step, worst.wrench_step, arm.felt, arm.real,
        worst.force_without_contact, worst.p50, worst.p99);
    std::fflush(stdout);
  }
  csv.close();
  text.close();
}

}  // namespace feeler::experiments
