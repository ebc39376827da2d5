// The driver of Haption against a library that stands in for libvirtuose.so: single precision, frames, and
// every fault.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "feeler/core/result.hpp"
#include "feeler/device/virtuose_device.hpp"
#include "stand_in/stand_in.hpp"
#include "stand_in/virtuose_stand_in.hpp"

BOOST_AUTO_TEST_SUITE(virtuose_device)

using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::VirtuoseDevice;

namespace {

feeler_test::VirtuoseStandIn& fresh() { return feeler_test::stand_in<feeler_test::VirtuoseStandIn>(FEELER_VIRTUOSE_STAND_IN); }

feeler::VirtuoseSettings settings() {
  feeler::VirtuoseSettings settings;
  settings.libraries = {FEELER_VIRTUOSE_STAND_IN};
  return settings;
}

bool is_silent(const feeler_test::VirtuoseStandIn& device) {
  return std::all_of(device.wrench, device.wrench + 6, [](float component) { return component == 0; });
}

bool says(const std::string& sentence, const char* words) { return sentence.find(words) != std::string::npos; }

constexpr DeviceWrench some_push{{1, 2, 3}, {0.25, 0.5, 0.125}};

}  // namespace

BOOST_AUTO_TEST_CASE(right_up_and_to_the_user_are_x_y_and_z_and_the_quaternion_is_a_unit_one) {
  auto& controller = fresh();
  const float half = float(std::sqrt(0.5));
  // To the user, right, up; a quarter turn about the maker's x, which is our z; x, y, z, w.
  const float pose[7] = {0.125f, 0.25f, 0.5f, half, 0, 0, half};
  std::copy(pose, pose + 7, controller.pose);
  controller.buttons[1] = controller.buttons[5] = 1;
  VirtuoseDevice device(settings());
  const auto opened = device.open();
  BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  BOOST_TEST(state.pose.position[0] == 0.25);
  BOOST_TEST(state.pose.position[1] == 0.5);
  BOOST_TEST(state.pose.position[2] == 0.125);
  BOOST_TEST(state.pose.orientation[0] == std::sqrt(0.5),
             boost::test_tools::tolerance(1e-15));  // not only to 1e-7
  BOOST_TEST(state.pose.orientation[3] == std::sqrt(0.5), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.orientation[1] == 0);
  BOOST_TEST(state.pose.orientation[2] == 0);
  BOOST_TEST(state.buttons == 34u);

  BOOST_TEST((device.write(some_push) == DeviceStatus::ok));
  const float expected[6] = {3, 1, 2, 0.125f, 0.25f, 0.5f};
  for (int i = 0; i < 6; ++i) BOOST_TEST(controller.wrench[i] == expected[i]);
}

BOOST_AUTO_TEST_CASE(it_runs_in_impedance_mode_without_indexing_and_saturated) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST(std::string(controller.address) == "localhost#5000");
  BOOST_TEST(controller.command_type == 3);
  BOOST_TEST(controller.indexing_mode == 2);
  BOOST_TEST(controller.time_step == 0.001f);
  BOOST_TEST(controller.saturation[0] == 15.0f);
  BOOST_TEST(controller.saturation[1] == 0.7f);
  BOOST_TEST(controller.is_powered);
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_named_with_the_remedy) {
  feeler::VirtuoseSettings elsewhere;
  elsewhere.libraries = {"/nowhere/libvirtuose.so"};
  VirtuoseDevice nowhere(elsewhere);
  const auto no_library = nowhere.open();
  BOOST_TEST(says(no_library.problem, "/nowhere/libvirtuose.so: cannot open shared object file"));
  BOOST_TEST(says(no_library.problem, "install the VirtuoseAPI"));

  elsewhere.libraries = {FEELER_VIRTUOSE_STAND_IN_OF_AN_OLDER_VERSION};
  VirtuoseDevice older(elsewhere);
  BOOST_TEST(says(older.open().problem, "has no function virtSetForce"));
}

BOOST_AUTO_TEST_CASE(a_device_that_cannot_start_is_refused_with_a_sentence_and_left_without_power) {
  struct Fault {
    void (*cause)(feeler_test::VirtuoseStandIn&);
    const char* words;
  };
  const Fault faults[] = {
      {[](auto& controller) { controller.refuses_to_open = true; }, "no controller answers at localhost#5000 (communication failure)"},
      {[](auto& controller) { controller.refuses_impedance = true; }, "refuses impedance mode (wrong mode)"},
      {[](auto& controller) { std::fill(controller.pose, controller.pose + 7, 0.0f); }, "gives no pose"},
      {[](auto& controller) { controller.failure = 4; }, "have it repaired"},
  };
  for (const Fault& fault : faults) {
    auto& controller = fresh();
    fault.cause(controller);
    VirtuoseDevice device(settings());
    const auto opened = device.open();
    BOOST_TEST(!opened);
    BOOST_TEST(says(opened.problem, fault.words), opened.problem);
    BOOST_TEST(opened.problem.back() == '.');
    BOOST_TEST(!controller.is_open);
    BOOST_TEST(!controller.is_powered);
    BOOST_TEST(is_silent(controller));
  }
}

BOOST_AUTO_TEST_CASE(while_the_device_must_not_push_it_pushes_nothing_and_says_why) {
  struct Hindrance {
    void (*cause)(feeler_test::VirtuoseStandIn&);
    void (*cure)(feeler_test::VirtuoseStandIn&);
    const char* words;
  };
  const Hindrance hindrances[] = {
      {[](auto& c) { c.is_emergency_stopped = true; }, [](auto& c) { c.is_emergency_stopped = false; }, "emergency stop"},
      {[](auto& c) { c.is_powered = false; }, [](auto& c) { c.is_powered = true; }, "power"},
      {[](auto& c) { c.is_held = false; }, [](auto& c) { c.is_held = true; }, "dead man's switch"},
  };
  for (const Hindrance& hindrance : hindrances) {
    auto& controller = fresh();
    VirtuoseDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    device.write(some_push);
    hindrance.cause(controller);
    DeviceState state;
    BOOST_TEST((device.read(state) == DeviceStatus::warning));
    BOOST_TEST(says(device.complaint(), hindrance.words));
    device.write(some_push);
    BOOST_TEST(is_silent(controller));
    hindrance.cure(controller);
    BOOST_TEST((device.read(state) == DeviceStatus::ok));
    device.write(some_push);
    BOOST_TEST(!is_silent(controller));
  }
}

BOOST_AUTO_TEST_CASE(an_overheated_motor_is_told_as_its_highest_temperature) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  for (const bool is_hot : {false, true, false}) {
    controller.alarm = is_hot ? 0x4000 : 0;
    BOOST_TEST((device.read(state) == DeviceStatus::ok));
    BOOST_TEST(state.motor_temperature == (is_hot ? 1 : 0));
  }
}

BOOST_AUTO_TEST_CASE(saturated_motors_are_told_and_are_no_fault) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  controller.alarm = 0x8000;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  BOOST_TEST((device.write(some_push) == DeviceStatus::ok));
  BOOST_TEST(says(device.complaint(), "less than was asked for"));
  BOOST_TEST(!is_silent(controller));
}

BOOST_AUTO_TEST_CASE(a_failed_motor_is_a_fault_for_good) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  device.write(some_push);
  controller.failure = 1;
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
  BOOST_TEST(says(device.complaint(), "has failed"));
  device.write(some_push);
  BOOST_TEST(is_silent(controller));
}

BOOST_AUTO_TEST_CASE(a_pose_that_the_controller_does_not_renew_keeps_its_time) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  double last = -1;
  for (int i = 0; i < 100; ++i) {
    BOOST_TEST((device.read(state) == DeviceStatus::ok));
    BOOST_TEST(state.time > last);
    last = state.time;
  }
  controller.seconds_late = 0.003;
  for (int i = 0; i < 100; ++i) {
    BOOST_TEST((device.read(state) == DeviceStatus::ok));
    BOOST_TEST(state.time == last);
  }
  controller.seconds_late = 0;
  device.read(state);
  BOOST_TEST(state.time > last);
}

BOOST_AUTO_TEST_CASE(a_period_that_is_none_is_refused) {
  for (const double period : {0.0, -1e-3, 1e-12, 1.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    auto settings_of_none = settings();
    settings_of_none.period = period;
    BOOST_CHECK_THROW(VirtuoseDevice{settings_of_none}, std::invalid_argument);
    const auto made = feeler::try_make<VirtuoseDevice>(settings_of_none);
    BOOST_TEST(!made);
    BOOST_TEST(says(made.reason(), "from 0.00001 to 1 s"));
  }
  BOOST_TEST(bool(feeler::try_make<VirtuoseDevice>(settings())));
}

BOOST_AUTO_TEST_CASE(a_lost_controller_is_a_fault_for_good_and_is_told_to_let_go_as_soon_as_it_listens) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  device.write(some_push);
  controller.is_unplugged = true;
  BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
  BOOST_TEST(says(device.complaint(), "network cable"));
  controller.is_unplugged = false;
  BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
  BOOST_TEST(is_silent(controller));
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
}

BOOST_AUTO_TEST_CASE(poses_and_wrenches_that_are_none_push_nothing) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  device.write(some_push);
  BOOST_TEST((device.write({{0, 0, 0}, {std::numeric_limits<double>::infinity(), 0, 0}}) == DeviceStatus::not_finite));
  BOOST_TEST(is_silent(controller));
  device.write(some_push);
  controller.pose[6] = 0.5f;
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
  device.write(some_push);
  BOOST_TEST(is_silent(controller));
}

BOOST_AUTO_TEST_CASE(closing_lets_go_and_opening_again_starts_afresh) {
  auto& controller = fresh();
  VirtuoseDevice device(settings());
  for (int session = 0; session < 3; ++session) {
    BOOST_REQUIRE(bool(device.open()));
    BOOST_TEST(is_silent(controller));
    device.write(some_push);
    device.close();
    BOOST_TEST(is_silent(controller));
    BOOST_TEST(!controller.is_powered);
    BOOST_TEST(!controller.is_open);
  }
}

BOOST_AUTO_TEST_SUITE_END()
