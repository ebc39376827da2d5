// A scene on show: its tool never in the wall, its tick without allocation, and its place taken without a
// tick lost.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include "live/stage.hpp"
#include "live/stage_switch.hpp"
#include "live/tool_choice.hpp"
#include "scenes/cavity.hpp"
#include "scenes/spline.hpp"
#include "support/allocation_count.hpp"
#include "support/penetration_checker.hpp"

BOOST_AUTO_TEST_SUITE(stage)

using feeler::demo::make_stage;
using feeler::demo::Stage;
using feeler::demo::StagedDevice;
using feeler::demo::StageSwitch;
using feeler::viewer::HandMode;
using feeler::viewer::LiveFeed;
using feeler::viewer::Snapshot;

namespace {

std::unique_ptr<Stage> cavity_stage(int number, feeler::demo::RenderChoice choice = {}) {
  feeler::demo::LiveScene scene = feeler::demo::live(feeler::scenes::cavity());
  const auto settings = scene.setting.settings();
  return make_stage({number, std::move(scene), settings, std::move(choice), 1e-3});
}

/// One tick as the servo loop makes it.
void tick(StagedDevice& device, LiveFeed& feed, std::int64_t index) {
  feeler::DeviceState state;
  device.read(state);
  device.write(device.stage().render({index, 0, double(index) * 1e-3, 0}, state, feed));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hand_pulled_through_the_wall_is_pushed_back_and_the_tool_stays_in_the_room) {
  const feeler::scenes::Scene scene = feeler::scenes::cavity();
  const feeler::test::CheckedObject object(scene.vertices, scene.triangles);
  const auto tool = std::visit([](const auto& shape) { return feeler::test::checked_tool(shape); }, scene.tool);
  LiveFeed feed;
  StageSwitch stages{std::shared_ptr<Stage>(cavity_stage(1))};
  StagedDevice device(stages, feed);
  feed.ask({HandMode::person, 1, {{0.0, 0.0, 0.03}, {0.9, 0.3, 0.2, 0.1}}});
  Snapshot snapshot;
  for (int i = 0; i < 800; ++i) {
    tick(device, feed, i);
    BOOST_REQUIRE(feed.fetch(snapshot));
    if (i % 20 != 0) continue;
    const auto pose = feeler::test::checked_pose(feeler::from_device<feeler::Pose<double>>(snapshot.graphic));
    BOOST_TEST(double(feeler::test::deepest_penetration(object, tool, pose).depth) <= 1e-11);
  }
  BOOST_TEST(snapshot.haptic.position[2] > snapshot.graphic.position[2] + 1e-3);
  BOOST_TEST(snapshot.wrench.force[2] < -1.0);
  BOOST_TEST(!stages.current().watch().recognise(feeler::from_device<feeler::Pose<double>>(snapshot.graphic)).empty());
}

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_with_hand_renderer_and_hand_off_allocates_nothing) {
  LiveFeed feed;
  StageSwitch stages{std::shared_ptr<Stage>(cavity_stage(1))};
  StagedDevice device(stages, feed);
  tick(device, feed, 0);
  const std::int64_t before = feeler_test::allocations;
  feed.ask({HandMode::motion, 1, {}});
  for (int i = 1; i < 1500; ++i) tick(device, feed, i);
  feed.ask({HandMode::person, 1, {{0.0, 0.01, 0.03}, {1, 0, 0, 0}}});
  for (int i = 1500; i < 2000; ++i) tick(device, feed, i);
  BOOST_TEST(feeler_test::allocations - before == 0);
}
#endif

BOOST_AUTO_TEST_CASE(a_stage_is_taken_between_two_ticks_of_a_loop_that_runs_and_requests_of_the_old_one_are_not_heeded) {
  LiveFeed feed;
  StageSwitch stages{std::shared_ptr<Stage>(cavity_stage(1))};
  StagedDevice device(stages, feed);
  std::atomic<bool> is_running = true;
  std::atomic<int> latest = 0;
  std::thread loop([&] {
    for (std::int64_t i = 0; is_running; ++i) {
      tick(device, feed, i);
      latest = device.stage().number();
      std::this_thread::yield();
    }
  });
  for (int number = 2; number < 8; ++number) {
    stages.offer(std::shared_ptr<Stage>(cavity_stage(number)), [&] { return is_running.load(); });
    feed.ask({HandMode::person, number - 1, {{0, 0, 0.03}, {1, 0, 0, 0}}});
    while (latest != number) std::this_thread::yield();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  is_running = false;
  loop.join();
  Snapshot snapshot;
  BOOST_REQUIRE(feed.fetch(snapshot));
  BOOST_TEST(snapshot.stage == 7);
  BOOST_TEST((snapshot.mode == HandMode::still));
}

BOOST_AUTO_TEST_CASE(every_scalar_and_method_renders_and_what_there_is_not_is_refused) {
  for (const feeler::demo::RenderChoice& choice : {feeler::demo::RenderChoice{"closest", "double"}, {"closest", "float"}, {"paper", "double"}}) {
    LiveFeed feed;
    StageSwitch stages{std::shared_ptr<Stage>(cavity_stage(1, choice))};
    StagedDevice device(stages, feed);
    feed.ask({HandMode::person, 1, {{0.0, 0.0, 0.03}, {1, 0, 0, 0}}});
    for (int i = 0; i < 400; ++i) tick(device, feed, i);
    Snapshot snapshot;
    BOOST_REQUIRE(feed.fetch(snapshot));
    BOOST_TEST(snapshot.graphic.position[2] < 0.00502, choice.method << ' ' << choice.scalar);
    BOOST_TEST(snapshot.wrench.force[2] < -1.0, choice.method << ' ' << choice.scalar);
  }
  BOOST_CHECK_THROW(cavity_stage(1, {"magic", "double"}), std::invalid_argument);
  BOOST_CHECK_THROW(cavity_stage(1, {"paper", "float"}), std::invalid_argument);
  feeler::demo::LiveScene spline = feeler::demo::live(feeler::scenes::spline());
  const auto settings = spline.setting.settings();
  BOOST_CHECK_THROW(make_stage({1, spline, settings, {"paper", "double"}, 1e-3}), std::invalid_argument);
  BOOST_CHECK_THROW(make_stage({1, feeler::demo::live(feeler::scenes::cavity(-1e-3)), settings, {}, 1e-3}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(another_tool_stops_at_the_wall_that_is_as_far_as_it_is_small) {
  for (const auto& [kind, half_height] : {std::pair("own", 0.01), {"cube", 0.005}, {"needle", 0.005 * std::sqrt(3.0)}, {"pebble", 0.0}}) {
    feeler::demo::LiveScene scene = feeler::demo::live(feeler::scenes::cavity());  // 30 mm high
    const double pressed = 0.018 - half_height;  // not so hard that a needle tips over
    feeler::demo::choose_tool(scene, kind);
    const auto settings = scene.setting.settings();
    LiveFeed feed;
    StageSwitch stages{std::shared_ptr<Stage>(make_stage({1, std::move(scene), settings, {}, 1e-3}))};
    StagedDevice device(stages, feed);
    feed.ask({HandMode::person, 1, {{0.0, 0.0, pressed}, {1, 0, 0, 0}}});
    for (int i = 0; i < 400; ++i) tick(device, feed, i);
    Snapshot snapshot;
    BOOST_REQUIRE(feed.fetch(snapshot));
    BOOST_TEST(snapshot.wrench.force[2] < -0.1, kind);
    if (half_height > 0) BOOST_TEST(std::abs(snapshot.graphic.position[2] - (0.015 - half_height)) < 1e-4, kind);
  }
  feeler::demo::LiveScene scene = feeler::demo::live(feeler::scenes::cavity());
  BOOST_CHECK_THROW(feeler::demo::choose_tool(scene, "spoon"), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
