// The driver of Force Dimension against a library that stands in for libdhd.so: frames, force-only wrists,
// and every fault.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "feeler/device/force_dimension_device.hpp"
#include "stand_in/force_dimension_stand_in.hpp"
#include "stand_in/stand_in.hpp"

BOOST_AUTO_TEST_SUITE(force_dimension_device)

using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::ForceDimensionDevice;

namespace {

feeler_test::ForceDimensionStandIn& fresh() { return feeler_test::stand_in<feeler_test::ForceDimensionStandIn>(FEELER_FORCE_DIMENSION_STAND_IN); }

feeler::ForceDimensionSettings settings() { return {{FEELER_FORCE_DIMENSION_STAND_IN}}; }

bool is_silent(const feeler_test::ForceDimensionStandIn& dhd) {
  const auto is_zero = [](double component) { return component == 0; };
  return std::all_of(dhd.force, dhd.force + 3, is_zero) && std::all_of(dhd.torque, dhd.torque + 3, is_zero);
}

bool says(const std::string& sentence, const char* words) { return sentence.find(words) != std::string::npos; }

constexpr DeviceWrench some_push{{1, 2, 3}, {0.01, 0.02, 0.03}};

}  // namespace

BOOST_AUTO_TEST_CASE(right_up_and_to_the_user_are_x_y_and_z) {
  auto& dhd = fresh();
  const double place[3] = {0.01, 0.02, 0.03};  // to the user, right, up
  std::copy(place, place + 3, dhd.position);
  // A quarter turn about the maker's z, which is up: our y. It takes the direction to the user to the right.
  const double turn[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  std::copy(&turn[0][0], &turn[0][0] + 9, &dhd.frame[0][0]);
  dhd.buttons = 2;
  ForceDimensionDevice device(settings());
  const auto opened = device.open();
  BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  BOOST_TEST(state.pose.position[0] == 0.02);
  BOOST_TEST(state.pose.position[1] == 0.03);
  BOOST_TEST(state.pose.position[2] == 0.01);
  BOOST_TEST(state.pose.orientation[0] == std::sqrt(0.5), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.orientation[1] == 0);
  BOOST_TEST(state.pose.orientation[2] == std::sqrt(0.5), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.orientation[3] == 0);
  BOOST_TEST(state.buttons == 2u);

  BOOST_TEST((device.write(some_push) == DeviceStatus::ok));
  BOOST_TEST(dhd.force[0] == 3);  // to the user is our z
  BOOST_TEST(dhd.force[1] == 1);
  BOOST_TEST(dhd.force[2] == 2);
  BOOST_TEST(dhd.torque[0] == 0.03);  // newton metres on both sides
  BOOST_TEST(dhd.torque[1] == 0.01);
  BOOST_TEST(dhd.torque[2] == 0.02);
  BOOST_TEST(dhd.is_force_on);
  BOOST_TEST(dhd.compensates_gravity);
  BOOST_TEST(dhd.maximum_force == device.specification().maximum_force);
  BOOST_TEST(dhd.wrong_ids == 0);
}

BOOST_AUTO_TEST_CASE(the_type_of_the_system_chooses_the_preset_and_what_has_motors) {
  struct Model {
    int type;
    const char* name;
    bool senses_rotation;
    bool pushes_torque;
  };
  for (const Model& model :
       {Model{33, "omega.3", false, false}, Model{34, "omega.6", true, false}, Model{35, "omega.7", true, false}, Model{60, "Falcon", false, false},
        Model{63, "delta.3", false, false}, Model{104, "sigma.7", true, true}, Model{109, "lambda.7", true, true},
        Model{131, "lambda.6", true, false}, Model{999, "Force Dimension device of type 999", true, false}}) {
    auto& dhd = fresh();
    dhd.system_type = model.type;
    ForceDimensionDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    BOOST_TEST(device.specification().name == model.name);
    BOOST_TEST(device.specification().is_sensed[4] == model.senses_rotation);
    BOOST_TEST(device.specification().pushes_torque() == model.pushes_torque);
    device.write(some_push);
    BOOST_TEST((dhd.torque[0] != 0) == model.pushes_torque);
  }
}

BOOST_AUTO_TEST_CASE(a_time_guard_is_no_error_and_the_pose_keeps_its_time) {
  auto& dhd = fresh();
  ForceDimensionDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  DeviceState first;
  DeviceState second;
  BOOST_TEST((device.read(first) == DeviceStatus::ok));
  dhd.has_nothing_new = true;
  dhd.position[0] = 1;
  BOOST_TEST((device.read(second) == DeviceStatus::ok));
  BOOST_TEST(second.time == first.time);
  BOOST_TEST(second.pose.position[2] == first.pose.position[2]);
}

BOOST_AUTO_TEST_CASE(saturated_motors_are_told_and_are_no_fault) {
  auto& dhd = fresh();
  ForceDimensionDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  dhd.is_saturated = true;
  BOOST_TEST((device.write(some_push) == DeviceStatus::ok));
  BOOST_TEST(says(device.complaint(), "less than was asked for"));
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_named_with_the_remedy) {
  ForceDimensionDevice nowhere(feeler::ForceDimensionSettings{{"/nowhere/libdrd.so", "/nowhere/libdhd.so"}});
  const auto no_library = nowhere.open();
  BOOST_TEST(!no_library);
  BOOST_TEST(says(no_library.problem, "/nowhere/libdrd.so: cannot open shared object file"));
  BOOST_TEST(says(no_library.problem, "/nowhere/libdhd.so: cannot open shared object file"));
  BOOST_TEST(says(no_library.problem, "install the SDK"));

  ForceDimensionDevice older(feeler::ForceDimensionSettings{{FEELER_FORCE_DIMENSION_STAND_IN_OF_AN_OLDER_VERSION}});
  BOOST_TEST(says(older.open().problem, "has no function dhdErrorGetLastStr"));
}

BOOST_AUTO_TEST_CASE(a_device_that_cannot_start_is_refused_with_a_sentence_and_left_released) {
  struct Fault {
    void (*cause)(feeler_test::ForceDimensionStandIn&);
    const char* words;
  };
  const Fault faults[] = {
      {[](auto& dhd) { dhd.device_count = 0; }, "udev rule"},
      {[](auto& dhd) { dhd.refuses_to_open = true; }, "device not ready): close the other program"},
      {[](auto& dhd) { dhd.needs_calibration = true; }, "not calibrated: put its handle"},
      {[](auto& dhd) { dhd.needs_calibration = dhd.is_unknown_to_drd = true; }, "not calibrated: put its handle"},
      {[](auto& dhd) { dhd.needs_calibration = dhd.only_drd_knows = true; }, "not calibrated: put its handle"},
      {[](auto& dhd) { dhd.has_power = false; }, "no power: switch it on"},
      {[](auto& dhd) { dhd.has_error = true; }, "reports an error: switch it off and on"},
      {[](auto& dhd) { dhd.refuses_force = true; }, "refuses to push"},
      {[](auto& dhd) { dhd.has_nothing_new = true; }, "no pose came within a second"},
      {[](auto& dhd) { dhd.frame[0][0] = 0; }, "a pose that is none"},
  };
  for (const Fault& fault : faults) {
    auto& dhd = fresh();
    fault.cause(dhd);
    ForceDimensionDevice device(settings());
    const auto opened = device.open();
    BOOST_TEST(!opened);
    BOOST_TEST(says(opened.problem, fault.words), opened.problem);
    BOOST_TEST(opened.problem.back() == '.');
    BOOST_TEST(!dhd.is_open);
    BOOST_TEST(!dhd.is_force_on);
    BOOST_TEST(is_silent(dhd));
    BOOST_TEST(dhd.broken_rules == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_is_not_calibrated_initialises_itself_only_where_the_caller_asks_for_it) {
  auto& dhd = fresh();
  dhd.needs_calibration = true;
  auto moving = settings();
  moving.initialises = true;
  {
    ForceDimensionDevice device(moving);
    const auto opened = device.open();
    BOOST_TEST(bool(opened), opened.problem);
    BOOST_TEST(!dhd.needs_calibration);
    BOOST_TEST(!dhd.is_regulated);
    BOOST_TEST(dhd.is_force_on);
    BOOST_TEST(dhd.broken_rules == 0);
  }
  dhd.reset();
  dhd.needs_calibration = dhd.fails_to_initialise = true;
  BOOST_TEST(says(ForceDimensionDevice(moving).open().problem, "cannot initialise itself (device not ready)"));
  dhd.reset();
  dhd.needs_calibration = dhd.is_unknown_to_drd = true;
  BOOST_TEST(says(ForceDimensionDevice(moving).open().problem, "use libdrd"));
  BOOST_TEST(!dhd.is_force_on);
  BOOST_TEST(dhd.broken_rules == 0);
}

BOOST_AUTO_TEST_CASE(one_of_several_devices_is_chosen_by_its_serial_number_or_its_index) {
  struct Choice {
    std::optional<int> serial_number;
    std::optional<int> index;
    int id;
  };
  for (const Choice& choice : {Choice{{}, {}, 3}, Choice{1004, {}, 4}, Choice{{}, 4, 4}, Choice{1004, 3, 4}}) {
    auto& dhd = fresh();
    dhd.device_count = 2;
    auto chosen = settings();
    chosen.serial_number = choice.serial_number;
    chosen.index = choice.index;
    ForceDimensionDevice device(chosen);
    const auto opened = device.open();
    BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
    device.write(some_push);
    BOOST_TEST(dhd.id == choice.id);
    BOOST_TEST(dhd.wrong_ids == 0);
  }
  fresh();
  auto absent = settings();
  absent.serial_number = 1234;
  BOOST_TEST(says(ForceDimensionDevice(absent).open().problem, "the serial number 1234"));
  absent = settings();
  for (const int index : {7, -1, 256 + 3}) {
    absent.index = index;
    BOOST_TEST(says(ForceDimensionDevice(absent).open().problem, ("the index " + std::to_string(index)).c_str()));
  }
}

BOOST_AUTO_TEST_CASE(a_driven_gripper_is_left_free) {
  auto& dhd = fresh();
  ForceDimensionDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  dhd.gripper_force = 1;
  device.write(some_push);
  BOOST_TEST(dhd.gripper_force == 0);
}

BOOST_AUTO_TEST_CASE(while_the_device_must_not_push_it_pushes_nothing_and_says_why) {
  struct Hindrance {
    void (*cause)(feeler_test::ForceDimensionStandIn&);
    const char* words;
  };
  const Hindrance hindrances[] = {
      {[](auto& dhd) { dhd.force_off_cause = 1; }, "button of the device: press it again"},
      {[](auto& dhd) { dhd.force_off_cause = 2; }, "faster than the device allows"},
      {[](auto& dhd) { dhd.force_off_cause = 3; }, "told no force for too long"},
      {[](auto& dhd) { dhd.force_off_cause = 4; }, "is off: press its force button"},
      {[](auto& dhd) { dhd.force_off_cause = 5; }, "USB cable"},
      {[](auto& dhd) { dhd.force_off_cause = 6; }, "dead man's switch"},
      {[](auto& dhd) { dhd.is_braking = true; }, "is off: press its force button"},
      {[](auto& dhd) { dhd.has_wrist_motors_on = false; }, "motors of the wrist are off"},
      {[](auto& dhd) { dhd.has_power = false; }, "no power"},
      {[](auto& dhd) { dhd.has_error = true; }, "reports an error"},
      {[](auto& dhd) { dhd.needs_calibration = true; }, "lost its calibration"},
  };
  for (const Hindrance& hindrance : hindrances) {
    auto& dhd = fresh();
    ForceDimensionDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    device.write(some_push);
    hindrance.cause(dhd);
    DeviceState state;
    BOOST_TEST((device.read(state) == DeviceStatus::warning));
    BOOST_TEST(says(device.complaint(), hindrance.words), device.complaint());
    device.write(some_push);
    BOOST_TEST(is_silent(dhd));
    dhd.force_off_cause = 0;
    dhd.is_braking = dhd.has_error = dhd.needs_calibration = false;
    dhd.has_power = dhd.has_wrist_motors_on = true;
    BOOST_TEST((device.read(state) == DeviceStatus::ok));
    device.write(some_push);
    BOOST_TEST(!is_silent(dhd));
  }
}

BOOST_AUTO_TEST_CASE(a_lost_device_is_a_fault_for_good_and_is_told_to_let_go_as_soon_as_it_listens) {
  auto& dhd = fresh();
  ForceDimensionDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  device.write(some_push);
  dhd.is_unplugged = true;
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
  BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
  BOOST_TEST(says(device.complaint(), "communication error"));
  dhd.is_unplugged = false;  // the cable is back
  BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
  BOOST_TEST(is_silent(dhd));
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
}

BOOST_AUTO_TEST_CASE(poses_and_wrenches_that_are_none_push_nothing) {
  auto& dhd = fresh();
  ForceDimensionDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  device.write(some_push);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((device.write({{0, nan, 0}, {0, 0, 0}}) == DeviceStatus::not_finite));
  BOOST_TEST(is_silent(dhd));
  device.write(some_push);
  dhd.position[1] = nan;
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
  device.write(some_push);
  BOOST_TEST(is_silent(dhd));
}

BOOST_AUTO_TEST_CASE(closing_lets_go_and_opening_again_starts_afresh) {
  auto& dhd = fresh();
  ForceDimensionDevice device(settings());
  for (int session = 0; session < 3; ++session) {
    BOOST_REQUIRE(bool(device.open()));
    BOOST_TEST(is_silent(dhd));
    device.write(some_push);
    device.close();
    BOOST_TEST(is_silent(dhd));
    BOOST_TEST(!dhd.is_force_on);
    BOOST_TEST(!dhd.is_open);
    BOOST_TEST(dhd.wrong_ids == 0);
    BOOST_TEST(dhd.broken_rules == 0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
