// feeler-demo: runs scenes on a haptic device, simulated or real, and reports what happened.
//
// Exit code 0: nothing penetrated; 1: something did, or a replayed session differs; 2: the input cannot be used; 3: the program failed.
#include <cstdio>
#include <exception>
#include <new>

#include "bad_input.hpp"
#include "feeler/device/device_catalogue.hpp"
#include "feeler/device/session_recorder.hpp"
#include "live/live_view.hpp"
#include "live/replay_view.hpp"
#include "mesh_reader.hpp"
#include "options.hpp"
#include "report.hpp"
#include "scene_choice.hpp"
#include "session.hpp"
#include "summary.hpp"

namespace feeler::demo {
namespace {

constexpr int success = 0, penetrated = 1, bad_input = 2, failure = 3;

constexpr double checking_seconds = 15.0;

void print_progress(const Progress& p) {
  std::printf("  %6.2f s   %7.1f Hz   tick %7.1f µs   contacts %d   force %6.2f N   missed %lld\n", p.time, p.rate, p.microseconds, p.contacts,
              p.force, static_cast<long long>(p.missed));
  std::fflush(stdout);
}

void print_table(const Summary& summary) {
  std::printf("\n");
  for (const auto& [name, value] : table_of(summary)) std::printf("  %-28s %s\n", name.c_str(), value.c_str());
}

/// What every maker's library and device say.
int list_all_devices() {
  for (const DeviceListing& listing : list_devices()) std::printf("%s", to_string(listing).c_str());
  std::printf("simulated: %s\n", phantom_premium_3_0_6dof().name.c_str());
  return success;
}

/// Exit code 1 where the force safety pushes otherwise than recorded.
int replay_session(const std::filesystem::path& file) {
  SessionRecording session;
  try {
    session = load_session(file);
  } catch (const std::runtime_error& problem) {
    throw BadInput(problem.what());
  }
  const Replay result = replay(session);
  std::printf("%s: %zu ticks of a session with a %s, ", file.c_str(), result.ticks, session.device.name.c_str());
  if (result.is_exact()) {
    std::printf("every wrench the same to the last bit\n");
    return success;
  }
  std::printf("another wrench from tick %lld on\n", static_cast<long long>(result.first_other_push));
  return penetrated;
}

/// Runs one scene from start to report.
int run_scene(const ChosenScene& chosen, const Options& options, const std::filesystem::path& out) {
  const scenes::Scene& scene = chosen.scene;
  const SessionSettings session{options.rate,       options.seconds,         options.seed,  options.device,
                                choice_of(options), options.workspace_scale, options.record};
  ReportFolder folder(out);
  std::printf("%s: %s %lld triangles.\n", scene.name.c_str(), scene.description.c_str(), static_cast<long long>(scene.triangles.rows()));

  const Recording recording = run_session(scene, session, print_progress);
  for (const std::string& refusal : recording.servo.setup.refused) std::printf("  note: %s\n", refusal.c_str());
  std::printf("  checking the way of the tool against every triangle …\n");
  std::fflush(stdout);
  const Verification verification = verify(scene, recording, checking_seconds);
  const Summary summary = summarise(scene, recording, verification, options.rate);
  print_table(summary);

  if (!write_report(folder.partial(), {chosen, session, recording, summary})) {
    std::printf("  note: no figures, because gnuplot did not run; install gnuplot-nox to have them.\n");
  }
  if (recording.session) save(*recording.session, folder.partial() / "session.feeler");
  folder.publish();
  std::printf("  report: %s\n\n", (folder.target() / "report.html").c_str());
  std::fflush(stdout);
  return verification.penetrated() ? penetrated : success;
}

int run(int argument_count, const char* const* arguments) {
  if (argument_count == 3 && arguments[1] == std::string(mesh_reader_argument)) return run_mesh_reader(arguments[2]);
  const auto [options, exit_code] = read_command_line(argument_count, arguments);
  if (exit_code) return *exit_code;
  if (options.list_devices) return list_all_devices();
  if (!options.replay.empty() && !options.views) return replay_session(options.replay.front());
  if (options.views) {
    options.replay.empty() ? run_live_view(options) : run_replay_view(options);
    return success;
  }
  int worst = success;
  for (const ChosenScene& chosen : choose_scenes(options)) {
    const bool is_alone = options.scene.has_value();
    const std::filesystem::path out = options.out.value_or("out");
    const int code = run_scene(chosen, options, is_alone && options.out ? out : out / chosen.scene.name);
    worst = std::max(worst, code);
  }
  std::printf("Move the tool yourself: ./run demo --view\n");
  return worst;
}

}  // namespace
}  // namespace feeler::demo

int main(int argument_count, char** arguments) {
  try {
    return feeler::demo::run(argument_count, arguments);
  } catch (const feeler::demo::BadInput& problem) {
    std::fprintf(stderr, "feeler-demo: %s\n", problem.what());
    return feeler::demo::bad_input;
  } catch (const std::bad_alloc& problem) {
    std::fprintf(stderr, "feeler-demo: %s\n", feeler::demo::sentence_of(problem).c_str());
    return feeler::demo::failure;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "feeler-demo: %s\n", problem.what());
    return feeler::demo::failure;
  }
}
