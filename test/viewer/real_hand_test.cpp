// A handle as the hand of a live view: it pushes, it is pushed back, and another scene begins at its start without a force.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <memory>

#include "live/real_hand.hpp"
#include "scenes/cavity.hpp"
#include "support/allocation_count.hpp"

BOOST_AUTO_TEST_SUITE(real_hand)

using feeler::DeviceState;
using feeler::DeviceWrench;
using feeler::demo::RealHand;
using feeler::demo::Stage;
using feeler::demo::StageSwitch;
using feeler::viewer::HandMode;
using feeler::viewer::LiveFeed;
using feeler::viewer::Snapshot;

namespace {

std::shared_ptr<Stage> cavity_stage(int number) {
  feeler::demo::LiveScene scene = feeler::demo::live(feeler::scenes::cavity());
  const auto settings = scene.setting.settings();
  return feeler::demo::make_stage({number, std::move(scene), settings, {}, 1e-3, true});
}

/// Half a metre beside the scene, as handles are, and as high above their middle as is said.
DeviceState handle_at(double height, std::uint32_t buttons = 0) {
  DeviceState state;
  state.pose = {{0.5, 0.1, height}, {0.8, 0, 0, 0.6}};
  state.buttons = buttons;
  return state;
}

feeler::WorkspaceSettings with_a_clutch(double scale = 1) {
  feeler::WorkspaceSettings workspace;
  workspace.scale = scale;
  workspace.clutch_buttons = 1;
  return workspace;
}

struct View {
  explicit View(double scale = 1) : hand(stages, feed, with_a_clutch(scale)) {}

  LiveFeed feed;
  StageSwitch stages{cavity_stage(1)};
  RealHand hand;

  DeviceWrench tick(double height, std::uint32_t buttons = 0) { return hand.render({}, handle_at(height, buttons)); }
  Snapshot seen() {
    Snapshot snapshot;
    BOOST_REQUIRE(feed.fetch(snapshot));
    return snapshot;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_handle_pushes_the_tool_into_a_wall_and_is_pushed_back) {
  View view;
  BOOST_TEST(view.tick(0).force[2] == 0.0);
  for (int i = 1; i <= 100; ++i) view.tick(1e-4 * i);
  const DeviceWrench wrench = view.tick(0.01);
  const Snapshot seen = view.seen();
  BOOST_TEST((seen.mode == HandMode::device));
  // The cube of 20 mm has 5 mm above it.
  BOOST_TEST(std::abs(seen.haptic.position[2] - 0.01) < 1e-12);
  BOOST_TEST(seen.graphic.position[2] < 0.00501);
  BOOST_TEST(seen.graphic.position[2] > 0.00498);
  BOOST_TEST(wrench.force[2] < -1.0);
  BOOST_TEST(std::abs(wrench.force[2] - seen.wrench.force[2]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_scale_magnifies_the_way_of_the_handle) {
  View view(0.1);
  view.tick(0);
  view.tick(0.02);
  BOOST_TEST(std::abs(view.seen().haptic.position[2] - 0.002) < 1e-12);
}

BOOST_AUTO_TEST_CASE(with_its_first_button_the_handle_moves_alone) {
  View view;
  view.tick(0);
  for (int i = 1; i <= 100; ++i) BOOST_TEST(view.tick(1e-3 * i, 1).force[2] == 0.0);
  BOOST_TEST(std::abs(view.seen().haptic.position[2]) < 1e-12);
  view.tick(0.1);
  view.tick(0.101);
  BOOST_TEST(std::abs(view.seen().haptic.position[2] - 0.001) < 1e-12);
}

BOOST_AUTO_TEST_CASE(another_stage_begins_at_its_start_without_a_force_wherever_the_handle_is) {
  View view;
  for (int i = 0; i <= 100; ++i) view.tick(1e-4 * i);
  BOOST_TEST(view.tick(0.01).force[2] < -1.0);
  view.stages.offer(cavity_stage(2), [] { return false; });  // the loop stands still
  const DeviceWrench wrench = view.tick(0.01);
  const Snapshot seen = view.seen();
  BOOST_TEST(seen.stage == 2);
  BOOST_TEST(std::hypot(wrench.force[0], wrench.force[1], wrench.force[2]) < 1e-9);
  BOOST_TEST(std::abs(seen.haptic.position[2]) < 1e-12);
}

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_allocates_nothing) {
  View view;
  view.tick(0);
  const std::int64_t before = feeler_test::allocations;
  for (int i = 0; i < 200; ++i) view.tick(1e-4 * i, i > 150 ? 1u : 0u);
  BOOST_TEST(feeler_test::allocations - before == 0);
}
#endif

BOOST_AUTO_TEST_SUITE_END()
