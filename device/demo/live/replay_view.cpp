// Reads recordings and serves the page that plays them.
#include "live/replay_view.hpp"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>

#include <nlohmann/json.hpp>

#include "bad_input.hpp"
#include "live/interrupt.hpp"
#include "live/report_player.hpp"
#include "live/serving.hpp"

namespace feeler::demo {
namespace {

/// The file that is meant: reports and the sessions in them have one of a fixed name.
std::filesystem::path recording_file(const std::filesystem::path& file) {
  constexpr const char* name = "replay.json";
  if (std::filesystem::is_directory(file)) return file / name;
  return file.extension() == ".feeler" ? file.parent_path() / name : file;
}

bool is_recording(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("feeler_recording", nlohmann::json()) != 1) return false;
  const auto has = [&](const char* key, bool (nlohmann::json::*is_type)() const noexcept) {
    const auto found = json.find(key);
    return found != json.end() && ((*found).*is_type)();
  };
  return has("stage", &nlohmann::json::is_object) && has("mesh", &nlohmann::json::is_string) && has("frames", &nlohmann::json::is_string);
}

}  // namespace

std::string load_player_recording(const std::filesystem::path& file) {
  const std::filesystem::path meant = recording_file(file);
  std::ifstream in(meant, std::ios::binary);
  if (!in) throw BadInput("The recording " + meant.string() + " cannot be read: give the replay.json of a report.");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!is_recording(text)) throw BadInput("The file " + meant.string() + " is no recording that the viewer plays: give the replay.json of a report.");
  return text;
}

void run_replay_view(const Options& options) {
  std::vector<std::string> recordings;
  for (const std::filesystem::path& file : options.replay) recordings.push_back(load_player_recording(file));
  const auto page = std::make_shared<const std::string>(player_page(recordings));
  viewer::ServerSettings settings;
  settings.resource = [page](std::string_view path) { return path == "/" ? viewer::Resource{"text/html; charset=utf-8", page} : viewer::Resource{}; };
  const std::unique_ptr<viewer::Server> server = serve(options, std::move(settings));
  const Interrupt interrupt;
  server->start();
  announce(*server, options, "recording");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.view_seconds.value_or(1e9));
  while (!interrupt.has_come() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace feeler::demo
