// The files of a report, but for the figures and the page.
#include "report.hpp"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include <nlohmann/json.hpp>

#include "bad_input.hpp"
#include "build_information.hpp"
#include "feeler/core/version.hpp"
#include "live/report_player.hpp"
#include "off_file.hpp"
#include "page.hpp"
#include "plots.hpp"
#include "text_file.hpp"

namespace feeler::demo {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Vector3<double>& v) { return {v.x(), v.y(), v.z()}; }
ordered_json json_of(const Pose<double>& pose) {
  const auto& q = pose.rotation;
  return {{"position", json_of(pose.translation)}, {"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}}};
}
ordered_json json_of(const Distribution& d) { return {{"median", d.median}, {"p99", d.p99}, {"p99_9", d.p999}, {"max", d.maximum}}; }

void print_pose(TextFile& text, const Pose<double>& pose) {
  const auto& p = pose.translation;
  const auto& q = pose.rotation;
  text.print(",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

/// The certified way, a pose a line; between two lines the tool moves straight and turns evenly.
void write_path(const std::filesystem::path& file, const Recording& recording) {
  TextFile text(file);
  text.print("tick,t,px,py,pz,qw,qx,qy,qz\n-1,0");
  print_pose(text, recording.way.front());
  text.print("\n");
  for (std::size_t tick = 0; tick < recording.ticks.size(); ++tick) {
    for (std::size_t i = recording.way_begin(tick) + 1; i < recording.ticks[tick].way_end; ++i) {
      text.print("%zu,%.17g", tick, recording.ticks[tick].time);
      print_pose(text, recording.way[i]);
      text.print("\n");
    }
  }
  text.close();
}

void write_ticks(const std::filesystem::path& file, const std::vector<TickRecord>& ticks) {
  TextFile text(file);
  text.print("t");
  for (const char* tool : {"haptic", "graphic"}) {
    for (const char* column : {"px", "py", "pz", "qw", "qx", "qy", "qz"}) text.print(",%s_%s", tool, column);
  }
  text.print(",fx,fy,fz,tx,ty,tz,contacts,rows,iterations,converged,tick_us\n");
  for (const TickRecord& tick : ticks) {
    const auto& f = tick.wrench.force;
    const auto& t = tick.wrench.torque;
    text.print("%.17g", tick.time);
    print_pose(text, tick.haptic);
    print_pose(text, tick.graphic);
    text.print(",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%d,%d,%d,%d,%.17g\n", f.x(), f.y(), f.z(), t.x(), t.y(), t.z(), tick.contacts, tick.rows,
               tick.iterations, int(tick.converged), tick.microseconds);
  }
  text.close();
}

/// Writes the recording that the viewer plays. @return the page that plays it; empty where there is no
/// viewer, or where it would be too large
std::string write_player(const std::filesystem::path& file, const Run& run) {
  constexpr std::size_t large = 12'000'000;  // a browser takes seconds for it
  const std::optional<std::string> recording = player_recording(run.chosen.scene, run.recording);
  if (!recording) return {};
  TextFile text(file);
  text.write(*recording);
  text.close();
  return recording->size() > large ? std::string() : player_page({*recording});
}

std::string processor_name() {
  std::ifstream information("/proc/cpuinfo");
  for (std::string line; std::getline(information, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

ordered_json renderer_json(const scenes::Scene& scene, double stiffness_share) {
  Settings<double> settings = scene.settings();
  settings.stiffness.translational *= stiffness_share;
  settings.stiffness.rotational *= stiffness_share;
  return {{"reference_point", json_of(settings.reference_point)},
          {"stiffness_translational_N_per_m", json_of(settings.stiffness.translational)},
          {"stiffness_rotational_Nm_per_rad", json_of(settings.stiffness.rotational)},
          {"metric_length_m", scene.length},
          {"margin_m", settings.margin},
          {"trust_radius_m", settings.trust_radius},
          {"step_tolerance_m", settings.step_tolerance},
          {"maximum_iterations", settings.maximum_iterations},
          {"work_budget", settings.work_budget}};
}

/// A real device has no hand that we know.
ordered_json real_device_json(const DeviceSpecification& s, const SessionSettings& session) {
  return {{"name", s.name},
          {"maximum_force_N", s.maximum_force},
          {"maximum_torque_Nm", s.maximum_torque},
          {"position_resolution_m", s.position_resolution},
          {"rotation_resolution_rad", s.rotation_resolution},
          {"workspace_scale", session.workspace_scale},
          {"period_s", 1.0 / session.rate}};
}

ordered_json device_json(const SessionSettings& session) {
  const SimulatedPhantomSettings device = device_settings(session);
  const DeviceSpecification& s = device.specification;
  return {{"name", s.name + ", simulated"},
          {"maximum_force_N", s.maximum_force},
          {"maximum_torque_Nm", s.maximum_torque},
          {"position_resolution_m", s.position_resolution},
          {"rotation_resolution_rad", s.rotation_resolution},
          {"apparent_mass_kg", s.apparent_mass},
          {"apparent_inertia_kgm2", s.apparent_inertia},
          {"grip_stiffness_N_per_m", device.grip.stiffness},
          {"grip_rotational_stiffness_Nm_per_rad", device.grip.rotational_stiffness},
          {"grip_damping_ratio", device.grip.damping_ratio},
          {"tremor_rms_m", device.grip.tremor},
          {"tremor_rms_rad", device.grip.rotational_tremor},
          {"period_s", device.period},
          {"substeps", device.substeps}};
}

ordered_json results_json(const Summary& s) {
  const Verification& v = s.verification;
  return {{"ticks", s.ticks},
          {"contact_ticks", s.contact_ticks},
          {"achieved_rate_Hz", s.achieved_rate},
          {"missed_deadlines", s.missed_deadlines},
          {"tick_time_us", json_of(s.tick_time)},
          {"rows", json_of(s.rows)},
          {"iterations", json_of(s.iterations)},
          {"converged_share", s.converged_share},
          {"largest_step_m", s.largest_translation},
          {"largest_step_rad", s.largest_rotation},
          {"largest_force_step_N", s.largest_force_step},
          {"largest_torque_step_Nm", s.largest_torque_step},
          {"peak_force_N", s.peak_force},
          {"peak_torque_Nm", s.peak_torque},
          {"penetration",
           {{"tolerance_m", Verification::tolerance},
            {"deepest_at_poses_m", v.pose_depth},
            {"deepest_at_poses_tick", v.pose_tick},
            {"deepest_on_way_m", v.way_depth},
            {"deepest_on_way_tick", v.way_tick},
            {"checked_ticks", v.checked_ticks},
            {"checked_places", v.checked_places},
            {"stride", v.stride},
            {"penetrated", v.penetrated()}}}};
}

void write_scene(const std::filesystem::path& file, const Run& run) {
  const scenes::Scene& scene = run.chosen.scene;
  const RealTimeSetup& setup = run.recording.servo.setup;
  const ordered_json json = {
      {"scene", scene.name},
      {"description", scene.description},
      {"object", {{"source", run.chosen.object_source}, {"triangles", scene.triangles.rows()}, {"vertices", scene.vertices.rows()}}},
      {"tool", {{"source", run.chosen.tool_source}}},
      {"start", json_of(scene.start)},
      {"rate_Hz", run.session.rate},
      {"seconds", run.session.seconds},
      {"seed", run.session.seed},
      {"renderer", renderer_json(scene, run.recording.stiffness_share)},
      {"device", run.recording.is_simulated ? device_json(run.session) : real_device_json(run.recording.device, run.session)},
      {"build", {{"version", FEELER_VERSION}, {"commit", build_commit}, {"compiler", build_compiler}, {"type", build_type}, {"flags", build_flags}}},
      {"machine",
       {{"processor", processor_name()},
        {"kernel", setup.kernel},
        {"preempt_rt", setup.is_preempt_rt},
        {"scheduler", setup.policy},
        {"priority", setup.priority},
        {"memory_locked", setup.is_memory_locked},
        {"refused", setup.refused}}},
      {"results", results_json(run.summary)}};
  TextFile text(file);
  text.write(json.dump(2) + "\n");
  text.close();
}

/// The topmost folder above `path` that does not exist yet.
std::filesystem::path topmost_missing(std::filesystem::path path) {
  std::filesystem::path missing;
  while (!path.empty() && !std::filesystem::exists(path)) {
    missing = path;
    path = path.parent_path();
  }
  return missing;
}

}  // namespace

ReportFolder::ReportFolder(const std::filesystem::path& target) : target_(std::filesystem::absolute(target).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  std::error_code error;
  const bool is_replaceable =
      !std::filesystem::exists(target_) || std::filesystem::is_empty(target_, error) || std::filesystem::exists(target_ / "scene.json");
  if (!is_replaceable || error) {
    throw BadInput(target_.string() + " exists and is no report of this program: choose another --out.");
  }
  partial_ = target_;
  partial_ += ".partial-" + std::to_string(getpid());
  created_parent_ = topmost_missing(target_.parent_path());
  std::filesystem::create_directories(partial_, error);
  if (error) {
    throw BadInput("The folder " + target_.string() + " cannot be made (" + error.message() + "): choose another --out.");
  }
}

ReportFolder::~ReportFolder() {
  std::error_code error;  // a destructor has nobody to tell
  if (!std::filesystem::exists(partial_, error)) return;
  std::filesystem::remove_all(partial_, error);
  // Parents made for this report go with it, unless something else is in them by now.
  for (std::filesystem::path parent = target_.parent_path(); !created_parent_.empty(); parent = parent.parent_path()) {
    if (!std::filesystem::remove(parent, error) || parent == created_parent_) break;
  }
}

void ReportFolder::publish() {
  std::filesystem::remove_all(target_);
  std::filesystem::rename(partial_, target_);
}

bool write_report(const std::filesystem::path& folder, const Run& run) {
  const scenes::Scene& scene = run.chosen.scene;
  write_off(folder / "object.off", polyhedron_of(scene.vertices, scene.triangles));
  write_off(folder / "tool.off", polyhedron_of(scene.tool));
  write_ticks(folder / "ticks.csv", run.recording.ticks);
  write_path(folder / "path.csv", run.recording);
  write_scene(folder / "scene.json", run);
  const std::vector<Figure> figures = draw_figures(folder, scene, run.recording.ticks, run.summary);
  write_page(folder / "report.html", folder, scene, run.summary, figures, write_player(folder / "replay.json", run));
  return !figures.empty();
}

}  // namespace feeler::demo
