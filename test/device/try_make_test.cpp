// What the device module makes without refusals, for hosts without exceptions: the same values, and the same sentences.
#include <boost/test/unit_test.hpp>

#include <limits>
#include <string>

#include "feeler/core/result.hpp"
#include "feeler/device/servo_loop.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "feeler/device/workspace_map.hpp"
#include "feeler/device/wrench_guard.hpp"
#include "support/refusal.hpp"

BOOST_AUTO_TEST_SUITE(device_made_or_not)

using feeler_test::refusal;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Its sentence is the constructor's, and there is a value where there is none.
template <class T, class... Arguments>
bool agrees(const Arguments&... arguments) {
  const auto result = feeler::try_make<T>(arguments...);
  const std::string sentence = refusal([&] { T{arguments...}; });
  return bool(result) == (sentence == "accepted") && (result || result.reason() == sentence);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_guard_is_made_or_not_for_the_same_reason) {
  for (const double most : {3.3, 0.0, 1e300, not_a_number}) {
    auto device = feeler::touch();
    device.maximum_force = most;
    for (const double rate : {60.0, 1000.0, 0.0, -1.0, 1e5, not_a_number}) {
      BOOST_TEST((agrees<feeler::WrenchGuard>(device, rate)));
      auto limits = feeler::limits_of(device);
      BOOST_TEST((agrees<feeler::WrenchGuard>(device, rate, limits)));
      limits.fade_time = 1;
      BOOST_TEST((agrees<feeler::WrenchGuard>(device, rate, limits)));
      BOOST_TEST((agrees<feeler::ForceSafety>(limits, device)));
    }
  }
  BOOST_TEST(bool(feeler::try_make<feeler::WrenchGuard>(feeler::touch(), 60)));
}

BOOST_AUTO_TEST_CASE(a_map_and_a_passivity_control_are_made_or_not_for_the_same_reason) {
  for (const double number : {1.0, 0.0, -1.0, not_a_number}) {
    feeler::WorkspaceSettings workspace;
    workspace.scale = number;
    BOOST_TEST(agrees<feeler::WorkspaceMap>(workspace));
    workspace.scale = 1;
    workspace.scene_from_device[0] = number;
    BOOST_TEST(agrees<feeler::WorkspaceMap>(workspace));
    feeler::PassivitySettings passivity;
    passivity.damping = number;
    BOOST_TEST(agrees<feeler::PassivityControl>(passivity));
  }
}

BOOST_AUTO_TEST_CASE(a_servo_loop_is_made_and_started_or_not_for_the_same_reason) {
  feeler::SimulatedPhantom device([](double) { return feeler::DevicePose(); });
  BOOST_TEST(bool(device.open()));
  const auto render = [](const feeler::ServoTick&, const feeler::DeviceState&) { return feeler::DeviceWrench(); };
  feeler::ServoSettings settings;
  settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
  settings.tick_limit = 1;
  for (const double rate : {1000.0, 0.0, -1.0, not_a_number}) {
    settings.rate = rate;
    const std::string sentence = refusal([&] { feeler::ServoLoop(settings, device, render); });
    const auto made = feeler::try_make<feeler::ServoLoop>(settings, device, render);
    BOOST_TEST((made ? "accepted" : made.reason()) == sentence);
  }
  settings.rate = 1000;
  BOOST_TEST(!feeler::try_make<feeler::ServoLoop>(settings, device, feeler::ServoLoop::Render()));
  BOOST_TEST(!feeler::try_make<feeler::ServoLoop>(settings, feeler::ServoLoop::Callback()));

  for (int fault = 0; fault < 4; ++fault) {
    auto faulty = settings;
    if (fault == 1) faulty.rate = 1;
    if (fault == 2) faulty.force_limits.emplace().maximum_force = -1;
    if (fault == 3) faulty.passivity.emplace().delay = 2;
    auto loop = feeler::try_make<feeler::ServoLoop>(faulty, device, render);
    BOOST_TEST_REQUIRE(bool(loop));
    const std::string reason = loop->reason_against_start();
    BOOST_TEST((reason.empty() ? "accepted" : reason) == refusal([&] { loop->start(); }));
    BOOST_TEST(reason.empty() == (fault == 0));
    if (fault == 0) BOOST_TEST(loop->reason_against_start() != "");  // once only
  }
}

BOOST_AUTO_TEST_SUITE_END()
