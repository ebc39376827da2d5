// Sessions to a file and back, and through the safety again: bit for bit.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include <unistd.h>

#include "feeler/device/servo_loop.hpp"
#include "feeler/device/session_recorder.hpp"
#include "feeler/device/simulated_phantom.hpp"

BOOST_AUTO_TEST_SUITE(session_recorder)

namespace {

/// A file of this process, gone with the test.
struct ScratchFile {
  ScratchFile() : path(std::filesystem::temp_directory_path() / ("feeler-session-" + std::to_string(getpid()))) {}
  ~ScratchFile() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

feeler::DeviceWrench wall(const feeler::DeviceState& state) {
  return {{0, -1000 * std::min(0.0, state.pose.position[1]), 0}, {0.01 * state.pose.position[0], 0, 0}};
}

/// A hand that presses into a wall, with an emergency stop, a restart and a NaN on the way.
feeler::SessionRecording record(std::size_t capacity) {
  feeler::SimulatedPhantom device([](double t) { return feeler::DevicePose{{0.02 * std::sin(3 * t), 0.01 * std::cos(5 * t), 0}, {1, 0, 0, 0}}; });
  BOOST_REQUIRE(bool(device.open()));
  feeler::SessionRecorder recorder(capacity);
  feeler::ServoSettings settings;
  settings.rate = 0;
  settings.tick_limit = 3000;
  settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
  settings.recorder = &recorder;
  feeler::ServoLoop* self = nullptr;
  feeler::ServoLoop loop(settings, device, [&self](const feeler::ServoTick& tick, const feeler::DeviceState& state) {
    if (tick.index == 1500) self->stop_force();
    if (tick.index == 1700 || tick.index == 2600) self->restart_force();
    feeler::DeviceWrench wrench = wall(state);
    if (tick.index == 2500) wrench.force[2] = std::numeric_limits<double>::quiet_NaN();
    return wrench;
  });
  self = &loop;
  loop.start();
  loop.wait();
  return recorder.recording();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_session_is_replayed_from_its_file_bit_for_bit) {
  const auto recording = record(3000);
  BOOST_REQUIRE(recording.ticks.size() == 3000u);
  BOOST_TEST(recording.lost == 0);
  BOOST_TEST((recording.ticks[1600].fault == feeler::ForceFault::emergency_stop));
  BOOST_TEST((recording.ticks[2550].fault == feeler::ForceFault::not_finite));
  double peak = 0;
  for (const auto& tick : recording.ticks) peak = std::max(peak, tick.pushed.force[1]);
  BOOST_TEST(peak > 1);  // not a session of nothing

  const ScratchFile file;
  feeler::save(recording, file.path);
  const auto loaded = feeler::load_session(file.path);
  BOOST_TEST(loaded.device.name == recording.device.name);
  BOOST_REQUIRE(loaded.ticks.size() == recording.ticks.size());
  for (std::size_t i = 0; i < loaded.ticks.size(); ++i) {
    BOOST_REQUIRE(std::memcmp(&loaded.ticks[i].pushed, &recording.ticks[i].pushed, sizeof(feeler::DeviceWrench)) == 0);
    BOOST_REQUIRE(std::memcmp(&loaded.ticks[i].tick.state.pose, &recording.ticks[i].tick.state.pose, sizeof(feeler::DevicePose)) == 0);
  }
  const auto safety_alone = feeler::replay(loaded);
  BOOST_TEST(safety_alone.ticks == 3000u);
  BOOST_TEST(safety_alone.is_exact());
  const auto rendered = feeler::replay(loaded, wall);
  BOOST_TEST(rendered.first_other_wish == 2500);  // the NaN was not the renderer's
}

BOOST_AUTO_TEST_CASE(a_replay_finds_the_smallest_difference) {
  auto recording = record(3000);
  recording.ticks[1000].pushed.force[1] = std::nextafter(recording.ticks[1000].pushed.force[1], 1e9);
  BOOST_TEST(feeler::replay(recording).first_other_push == 1000);
  const auto off = [](const feeler::DeviceState& state) {
    auto wrench = wall(state);
    wrench.torque[0] *= 1 + 1e-15;
    return wrench;
  };
  BOOST_TEST(feeler::replay(recording, off).first_other_wish >= 0);
}

BOOST_AUTO_TEST_CASE(ticks_without_room_are_counted) {
  const auto recording = record(100);
  BOOST_TEST(recording.ticks.size() == 100u);
  BOOST_TEST(recording.lost == 2900);
}

BOOST_AUTO_TEST_CASE(files_that_are_no_recordings_are_refused_with_a_sentence) {
  const ScratchFile file;
  const auto refusal = [&file] {
    try {
      feeler::load_session(file.path);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(refusal().find("cannot be read") != std::string::npos);
  std::ofstream(file.path) << "some words that are no recording";
  BOOST_TEST(refusal().find("is no recording") != std::string::npos);
  feeler::save(record(10), file.path);
  std::filesystem::resize_file(file.path, std::filesystem::file_size(file.path) - 8);
  BOOST_TEST(refusal().find("was cut off") != std::string::npos);
  BOOST_CHECK_THROW(feeler::save({}, "/nowhere/session"), std::runtime_error);
}

BOOST_AUTO_TEST_SUITE_END()
