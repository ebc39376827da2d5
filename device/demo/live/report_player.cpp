// Writes recordings with the words of the wire, as floats: a run of ten seconds has some nanometres to spare.
#include "live/report_player.hpp"

#include <algorithm>
#include <memory>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base64.hpp"
#include "feeler/core/status.hpp"
#include "feeler/device/conversion.hpp"
#include "feeler/viewer/page.hpp"
#include "feeler/viewer/wire.hpp"
#include "live/contact_watch.hpp"
#include "live/stage_description.hpp"

namespace feeler::demo {
namespace {

constexpr std::size_t most_pictures = 2000;
constexpr int stage_number = 1;

viewer::TickSample sample_of(const TickRecord& tick) {
  const auto apart = motion_between(tick.haptic, tick.graphic);
  return {tick.time,
          to_device_wrench(tick.wrench),
          apart.linear.norm(),
          apart.angular.norm(),
          tick.microseconds,
          tick.late_microseconds,
          tick.contacts,
          tick.iterations,
          tick.missed,
          tick.converged,
          false};
}

viewer::Snapshot snapshot_of(const TickRecord& tick, std::size_t index) {
  viewer::Snapshot snapshot;
  snapshot.tick = std::int64_t(index);
  snapshot.time = tick.time;
  snapshot.stage = stage_number;
  snapshot.mode = viewer::HandMode::motion;
  snapshot.haptic = to_device_pose(tick.haptic);
  snapshot.graphic = to_device_pose(tick.graphic);
  snapshot.wrench = to_device_wrench(tick.wrench);
  snapshot.status = static_cast<std::int32_t>(tick.converged ? TickStatus::converged : TickStatus::unconverged);
  snapshot.iterations = tick.iterations;
  snapshot.rows = tick.rows;
  return snapshot;
}

/// All pictures one after the other.
std::string frames_of(const std::vector<TickRecord>& ticks, ContactWatch& watch) {
  const std::size_t stride = std::max<std::size_t>(1, (ticks.size() + most_pictures - 1) / most_pictures);
  std::string bytes;
  viewer::Frame frame;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    frame.samples.push_back(sample_of(ticks[i]));
    frame.snapshot.missed += ticks[i].missed;
    if ((i + 1) % stride != 0 && i + 1 != ticks.size()) continue;
    const std::int64_t missed = frame.snapshot.missed;
    frame.snapshot = snapshot_of(ticks[i], i);
    frame.snapshot.missed = missed;
    frame.recognised = watch.recognise(ticks[i].graphic);
    bytes += viewer::encoded_as_floats(frame);
    frame.samples.clear();
  }
  return bytes;
}

/// What ends no script element of a page.
std::string within_script(const std::string& json) {
  std::string result;
  result.reserve(json.size());
  for (const char c : json) {
    if (c == '/' && !result.empty() && result.back() == '<') result += '\\';
    result += c;
  }
  return result;
}

}  // namespace

std::optional<std::string> player_recording(const scenes::Scene& scene, const Recording& recording) {
  const LiveScene live_scene = live(scenes::Scene(scene));
  Settings<double> settings = scene.settings();
  settings.stiffness.translational *= recording.stiffness_share;
  settings.stiffness.rotational *= recording.stiffness_share;
  ContactWatch watch(std::make_shared<const TriangleMesh<double>>(scene.vertices, scene.triangles), live_scene.tool, settings.margin);
  nlohmann::ordered_json json;
  json["feeler_recording"] = 1;
  json["stage"] =
      nlohmann::ordered_json::parse(stage_text(stage_number, live_scene, {settings}, {scene.name, scene.name, scene.description, "", {}}));
  json["mesh"] = base64(viewer::encoded_mesh(stage_number, scene.vertices, scene.triangles));
  json["frames"] = base64(frames_of(recording.ticks, watch));
  return json.dump();
}

std::string player_page(const std::vector<std::string>& recordings) {
  constexpr std::string_view place = "<!--recordings-->";
  const std::string_view page = viewer::page_html();
  const std::size_t at = page.find(place);
  std::string result(page.substr(0, at));
  for (const std::string& recording : recordings) {
    result += R"(<script type="application/json" class="recording">)";
    result += within_script(recording);
    result += "</script>\n";
  }
  result += page.substr(at + place.size());
  return result;
}

}  // namespace feeler::demo
