// The driver of OpenHaptics against a library that stands in for libHD.so: units, frames, and every fault.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "device/scripted_makers.hpp"
#include "feeler/device/open_haptics_device.hpp"
#include "feeler/device/servo_loop.hpp"
#include "stand_in/open_haptics_stand_in.hpp"
#include "stand_in/stand_in.hpp"

BOOST_AUTO_TEST_SUITE(open_haptics_device)

using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::OpenHapticsDevice;

namespace {

feeler_test::OpenHapticsStandIn& fresh() { return feeler_test::stand_in<feeler_test::OpenHapticsStandIn>(FEELER_OPEN_HAPTICS_STAND_IN); }

feeler::OpenHapticsSettings settings() { return {{FEELER_OPEN_HAPTICS_STAND_IN}, ""}; }

bool is_silent(const feeler_test::OpenHapticsStandIn& hd) {
  const auto is_zero = [](double component) { return component == 0; };
  return std::all_of(hd.force, hd.force + 3, is_zero) && std::all_of(hd.torque, hd.torque + 3, is_zero);
}

bool says(const std::string& sentence, const char* words) { return sentence.find(words) != std::string::npos; }

constexpr DeviceWrench some_push{{1, -2, 3}, {0.01, 0.02, -0.03}};

feeler::OpenHapticsSettings settings_of_second() { return {{FEELER_OPEN_HAPTICS_STAND_IN}, "second"}; }

/// Reads and writes as a servo loop does, on a thread of its own.
class Loop {
 public:
  explicit Loop(OpenHapticsDevice& device) : thread_([this, &device] { run(device); }) {}
  ~Loop() {
    is_ending_ = true;
    thread_.join();
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  /// Whether the device gave a new pose and took a force since this was asked last; waits for it up to a second.
  bool goes_on() {
    const int ticks = good_ticks_;
    for (int wait = 0; wait < 1000 && good_ticks_ < ticks + 3; ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return good_ticks_ >= ticks + 3;
  }

 private:
  void run(OpenHapticsDevice& device) {
    DeviceState state;
    double last = -1;
    while (!is_ending_) {
      const bool is_good = device.read(state) == DeviceStatus::ok && state.time > last;
      last = state.time;
      if (is_good && device.write(some_push) == DeviceStatus::ok) ++good_ticks_;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::atomic<bool> is_ending_ = false;
  std::atomic<int> good_ticks_ = 0;
  std::thread thread_;
};

double locked(feeler_test::OpenHapticsStandIn& hd, const double& value) {
  const std::lock_guard<std::mutex> lock(hd.mutex);
  return value;
}

/// One tick of the servo loop between two frames of the device.
DeviceStatus push_once(OpenHapticsDevice& device, feeler_test::OpenHapticsStandIn& hd) {
  DeviceState state;
  const DeviceStatus status = device.read(state);
  device.write(some_push);
  hd.tick();
  return status;
}

}  // namespace

BOOST_AUTO_TEST_CASE(millimetres_in_columns_become_metres_and_a_quaternion) {
  auto& hd = fresh();
  // A quarter turn about z, which takes x to y: its first column is y. Row by row it would be the opposite
  // turn.
  const double quarter_turn[16] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 120, -30, 7.5, 1};
  std::copy(quarter_turn, quarter_turn + 16, hd.transform);
  hd.buttons = 5;
  OpenHapticsDevice device(settings());
  const auto opened = device.open();
  BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  BOOST_TEST(state.pose.position[0] == 0.120, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.position[1] == -0.030, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.position[2] == 0.0075, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.orientation[0] == std::sqrt(0.5), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.orientation[3] == std::sqrt(0.5), boost::test_tools::tolerance(1e-15));
  BOOST_TEST(state.pose.orientation[1] == 0);
  BOOST_TEST(state.pose.orientation[2] == 0);
  BOOST_TEST(state.buttons == 5u);
  BOOST_TEST(hd.broken_rules == 0);
}

BOOST_AUTO_TEST_CASE(a_skewed_rotation_becomes_a_unit_quaternion) {
  auto& hd = fresh();
  hd.transform[0] = 1.01;
  hd.transform[1] = 0.02;
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  device.read(state);
  const double* q = state.pose.orientation;
  BOOST_TEST(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == 1, boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(newton_metres_become_millinewton_metres_in_base_axes_and_never_joint_torques) {
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  push_once(device, hd);
  for (int i = 0; i < 3; ++i) {
    BOOST_TEST(hd.force[i] == some_push.force[i]);
    BOOST_TEST(hd.torque[i] == 1000 * some_push.torque[i], boost::test_tools::tolerance(1e-15));
    BOOST_TEST(hd.joint_torque[i] == 0);
  }
  BOOST_TEST(hd.is_output_on);
  BOOST_TEST(hd.broken_rules == 0);
}

BOOST_AUTO_TEST_CASE(the_device_says_its_own_figures) {
  fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  const auto& figures = device.specification();
  BOOST_TEST(figures.name == "PHANTOM Premium 3.0");
  BOOST_TEST(figures.maximum_force == 20);      // the stand-in's
  BOOST_TEST(figures.continuous_force == 2.5);  // the stand-in's
  BOOST_TEST(figures.stiffness == 1000);        // 1 N/mm
  BOOST_TEST(figures.pushes_torque());
}

BOOST_AUTO_TEST_CASE(a_device_with_three_motors_is_force_only_and_is_sent_no_torque) {
  auto& hd = fresh();
  hd.model = "Touch";
  hd.output_degrees = 3;
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST(!device.specification().pushes_torque());
  BOOST_TEST(device.specification().maximum_torque == 0);
  BOOST_TEST((push_once(device, hd) == DeviceStatus::ok));
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));  // a torque would have been an error
  BOOST_TEST(hd.force[2] == 3);
}

BOOST_AUTO_TEST_CASE(a_missing_library_is_said_with_the_words_of_the_linker_and_the_remedy) {
  OpenHapticsDevice device(feeler::OpenHapticsSettings{{"/nowhere/libHD.so"}, ""});
  const auto opened = device.open();
  BOOST_TEST(!opened);
  BOOST_TEST(says(opened.problem, "/nowhere/libHD.so: cannot open shared object file"));
  BOOST_TEST(says(opened.problem, "install OpenHaptics"));
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::not_open));
  BOOST_TEST((device.write({}) == DeviceStatus::not_open));
}

BOOST_AUTO_TEST_CASE(a_missing_function_is_named) {
  OpenHapticsDevice device(feeler::OpenHapticsSettings{{FEELER_OPEN_HAPTICS_STAND_IN_OF_AN_OLDER_VERSION}, ""});
  const auto opened = device.open();
  BOOST_TEST(!opened);
  BOOST_TEST(says(opened.problem, "has no function hdCheckCalibration"));
}

BOOST_AUTO_TEST_CASE(a_device_that_cannot_start_is_refused_with_a_sentence_and_left_released) {
  struct Fault {
    void (*cause)(feeler_test::OpenHapticsStandIn&);
    const char* words;
  };
  const Fault faults[] = {
      {[](auto& hd) { hd.error_at_init = 0x302; }, "check its power and cable"},
      {[](auto& hd) { hd.error_at_init = 0x600; }, "licence"},
      {[](auto& hd) { hd.error_at_init = 0x301; }, "in use already"},
      {[](auto& hd) { hd.error_at_init = 0x777; }, "an error in the words of libHD"},
      {[](auto& hd) { hd.error_at_start = 0x304; }, "servo timer"},
      {[](auto& hd) { hd.calibration = 0x5002; }, "inkwell"},
      {[](auto& hd) { hd.calibration = 0x5001, hd.updates_missing = 1'000'000, hd.own_thread = true; }, "not calibrated"},
      // An encoder reset is for who holds the arm in its reset position.
      {[](auto& hd) { hd.calibration = 0x5001, hd.calibration_styles = 1; }, "not calibrated"},
      {[](auto& hd) { hd.calibration = 0x5001, hd.error_at_update = 0x300; }, "cannot be calibrated: The device reports a fault"},
      {[](auto& hd) { hd.calibration = 0x5001, hd.error_at_update = 0x302; }, "check its power and cable"},
      {[](auto& hd) { hd.error_in_every_frame = 0x101; }, "no pose came within a second (an error in the words of libHD)"},
      {[](auto& hd) { hd.never_calls_back = true; }, "no pose came within a second"},
      {[](auto& hd) { std::fill(hd.transform, hd.transform + 16, 0.0); }, "a pose that is none"},
  };
  for (const Fault& fault : faults) {
    auto& hd = fresh();
    fault.cause(hd);
    OpenHapticsDevice device(settings());
    const auto opened = device.open();
    BOOST_TEST(!opened);
    BOOST_TEST(says(opened.problem, fault.words), opened.problem);
    BOOST_TEST(opened.problem.back() == '.');
    BOOST_TEST(!hd.is_initialised);
    BOOST_TEST(!hd.is_scheduler_running);
    BOOST_TEST(!hd.is_output_on);
    BOOST_TEST(is_silent(hd));
    BOOST_TEST(hd.broken_rules == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_can_calibrate_itself_does_so_in_the_servo_loop_before_the_session) {
  for (const unsigned int styles : {2u, 4u, 7u}) {
    auto& hd = fresh();
    hd.calibration = 0x5001;
    hd.calibration_styles = styles;
    hd.updates_missing = 3;
    hd.own_thread = true;
    OpenHapticsDevice device(settings());
    const auto opened = device.open();
    BOOST_TEST(bool(opened), opened.problem);
    DeviceState state;
    BOOST_TEST((device.read(state) == DeviceStatus::ok));
    device.close();
    BOOST_TEST(hd.calibrated_by == (styles == 4 ? 4u : 2u));  // automatic before inkwell, and no encoder reset
    BOOST_TEST(hd.updates_missing == 0);
    BOOST_TEST(hd.broken_rules == 0);
  }
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST(hd.calibrated_by == 0);  // a good calibration is left alone
}

BOOST_AUTO_TEST_CASE(force_errors_silence_the_device_by_the_next_frame_are_told_once_and_pass) {
  for (const unsigned int error : {0x200u, 0x201u, 0x202u, 0x203u, 0x204u}) {
    for (const bool after_push : {false, true}) {
      auto& hd = fresh();
      OpenHapticsDevice device(settings());
      BOOST_REQUIRE(bool(device.open()));
      push_once(device, hd);
      BOOST_REQUIRE(!is_silent(hd));
      (after_push ? hd.error_after_push : hd.error_in_next_frame) = error;
      push_once(device, hd);  // the frame with the error
      if (after_push) push_once(device, hd);  // told by this read; the wrench follows that knows of it
      else BOOST_TEST(is_silent(hd));  // in the same frame
      DeviceState state;
      if (!after_push) BOOST_TEST((device.read(state) == DeviceStatus::warning));
      BOOST_TEST(says(device.complaint(), "(0x020"), device.complaint());
      BOOST_TEST((device.read(state) == DeviceStatus::ok));
      device.write(some_push);
      hd.tick();
      BOOST_TEST(!is_silent(hd));  // whoever read of the error may push again
    }
  }
}

BOOST_AUTO_TEST_CASE(a_force_written_by_who_has_not_read_of_an_error_is_not_pushed) {
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  push_once(device, hd);
  hd.error_after_push = 0x202;
  hd.tick();
  for (int i = 0; i < 5; ++i) {
    device.write(some_push);
    hd.tick();
    BOOST_TEST(is_silent(hd));
  }
}

BOOST_AUTO_TEST_CASE(an_error_that_libhd_recovers_from_silences_the_device_and_does_not_end_the_session) {
  for (const unsigned int error : {0x300u, 0x101u, 0x102u, 0x400u, 0x401u, 0x402u}) {
    auto& hd = fresh();
    OpenHapticsDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    push_once(device, hd);
    DeviceState before;
    device.read(before);
    for (int i = 0; i < 5; ++i) {
      hd.error_in_next_frame = error;
      hd.transform[12] += 1;
      push_once(device, hd);
      BOOST_TEST(is_silent(hd));
      DeviceState state;
      BOOST_TEST((device.read(state) == DeviceStatus::warning));
      BOOST_TEST(std::string(device.complaint()) != "");
      BOOST_TEST(state.time == before.time);  // the pose of such a frame may be none
      BOOST_TEST(state.pose.position[0] == before.pose.position[0]);
    }
    push_once(device, hd);
    push_once(device, hd);
    BOOST_TEST(!is_silent(hd));
    DeviceState after;
    BOOST_TEST((device.read(after) == DeviceStatus::ok));
    BOOST_TEST(after.time > before.time);
  }
}

BOOST_AUTO_TEST_CASE(a_lost_device_is_a_fault_for_good_and_silent) {
  for (const unsigned int error : {0x302u, 0x303u, 0x304u, 0x500u, 0x501u, 0x104u}) {
    auto& hd = fresh();
    OpenHapticsDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    push_once(device, hd);
    hd.error_in_next_frame = error;
    push_once(device, hd);
    BOOST_TEST(is_silent(hd));
    for (int i = 0; i < 5; ++i) {
      DeviceState state;
      BOOST_TEST((device.read(state) == DeviceStatus::fault));
      BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
      hd.tick();
      BOOST_TEST(is_silent(hd));
    }
    BOOST_TEST(std::string(device.complaint()) != "");
  }
}

BOOST_AUTO_TEST_CASE(a_loop_that_stalls_is_silenced_within_three_frames) {
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  push_once(device, hd);
  hd.tick();
  hd.tick();
  BOOST_TEST(!is_silent(hd));  // two frames without a wrench: within the jitter of a loop
  hd.tick();
  BOOST_TEST(is_silent(hd));
  push_once(device, hd);
  BOOST_TEST(!is_silent(hd));
}

BOOST_AUTO_TEST_CASE(a_pose_that_is_none_is_a_fault) {
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  push_once(device, hd);
  hd.transform[13] = std::numeric_limits<double>::quiet_NaN();
  push_once(device, hd);
  BOOST_TEST(is_silent(hd));
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::fault));
}

BOOST_AUTO_TEST_CASE(a_wrench_that_is_not_finite_is_no_push) {
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  push_once(device, hd);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((device.write({{nan, 0, 0}, {0, 0, 0}}) == DeviceStatus::not_finite));
  hd.tick();
  BOOST_TEST(is_silent(hd));
}

BOOST_AUTO_TEST_CASE(the_hottest_motor_is_told_by_those_that_measure_it) {
  auto& hd = fresh();
  hd.temperatures[4] = 0.7;
  DeviceState state;
  {
    OpenHapticsDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    device.read(state);
    BOOST_TEST(state.motor_temperature == 0.7);
  }
  hd.reset();
  hd.has_no_temperature = true;
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST((push_once(device, hd) == DeviceStatus::ok));
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  BOOST_TEST(state.motor_temperature == 0);
}

BOOST_AUTO_TEST_CASE(while_a_switch_keeps_the_motors_off_it_pushes_nothing_and_says_why) {
  struct Switch {
    bool feeler_test::OpenHapticsStandIn::* is_on;
    const char* words;
  };
  for (const auto& [is_on, words] : {Switch{&feeler_test::OpenHapticsStandIn::is_in_inkwell, "take it out"},
                                     Switch{&feeler_test::OpenHapticsStandIn::is_safety_switch_on, "safety switch"}}) {
    auto& hd = fresh();
    hd.calibration_styles = 6;
    OpenHapticsDevice device(settings());
    BOOST_REQUIRE(bool(device.open()));
    push_once(device, hd);
    BOOST_TEST(!is_silent(hd));
    hd.*is_on = true;
    DeviceState state;
    for (int i = 0; i < 5; ++i) {
      push_once(device, hd);
      BOOST_TEST(is_silent(hd));
      BOOST_TEST((device.read(state) == DeviceStatus::warning));
      BOOST_TEST(says(device.complaint(), words), device.complaint());
      BOOST_TEST(state.time > 0);  // poses go on
    }
    hd.*is_on = false;
    hd.tick();
    BOOST_TEST((push_once(device, hd) == DeviceStatus::ok));
    BOOST_TEST(!is_silent(hd));
    // On and off again between two ticks of a slow loop: the force that was wished before does not come back.
    hd.*is_on = true;
    hd.tick();
    hd.*is_on = false;
    device.write(some_push);
    hd.tick();
    BOOST_TEST(is_silent(hd));
    BOOST_TEST((device.read(state) == DeviceStatus::warning));
  }
}

BOOST_AUTO_TEST_CASE(a_device_is_opened_and_calibrated_in_its_inkwell) {
  auto& hd = fresh();
  hd.calibration_styles = 4;
  hd.calibration = 0x5001;
  hd.is_in_inkwell = hd.own_thread = true;
  OpenHapticsDevice device(settings());
  const auto opened = device.open();
  BOOST_TEST(bool(opened), opened.problem);
  BOOST_TEST(hd.calibrated_by == 4u);
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::warning));
}

BOOST_AUTO_TEST_CASE(a_device_without_switches_is_not_asked_for_them) {
  auto& hd = fresh();
  hd.has_no_switches = true;
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST((push_once(device, hd) == DeviceStatus::ok));
  BOOST_TEST(!is_silent(hd));
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
}

BOOST_AUTO_TEST_CASE(the_servo_thread_of_the_library_the_loop_and_a_watcher_get_along) {
  auto& hd = fresh();
  hd.own_thread = true;
  OpenHapticsDevice device(settings());
  BOOST_REQUIRE(bool(device.open()));
  feeler::ServoSettings servo;
  servo.rate = 2000;
  servo.tick_limit = 400;
  servo.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
  feeler::ServoLoop loop(servo, device, [](const feeler::ServoTick& tick, const DeviceState& state) {
    return DeviceWrench{{tick.index < 20 ? 0 : 1 + state.pose.position[0], 0, 0}, {0, 0, 0.01}};
  });
  loop.start();
  bool was_stopped = false;
  while (loop.is_running()) {
    if (loop.ticks() > 200 && !was_stopped) {
      loop.stop_force();
      was_stopped = true;
    }
    if (loop.force_phase() == feeler::ForcePhase::stopped) loop.restart_force();
    std::this_thread::yield();
  }
  const auto& report = loop.wait();
  BOOST_TEST(report.ticks == 400);
  BOOST_TEST(report.problem == "");
  BOOST_TEST(report.force.ticks_with[std::size_t(feeler::ForceFault::emergency_stop)] == 1);
  device.close();
  BOOST_TEST(is_silent(hd));
  BOOST_TEST(hd.broken_rules == 0);
}

BOOST_AUTO_TEST_CASE(a_device_that_closes_leaves_the_other_in_the_servo_loop) {
  auto& hd = fresh();
  hd.own_thread = true;
  OpenHapticsDevice one(settings());
  OpenHapticsDevice other(settings_of_second());
  BOOST_REQUIRE(bool(one.open()));
  BOOST_REQUIRE(bool(other.open()));
  BOOST_TEST(hd.starts == 2);  // it paused for the second
  {
    Loop loop_of_one(one);
    Loop loop_of_other(other);
    BOOST_TEST(loop_of_one.goes_on());
    BOOST_TEST(loop_of_other.goes_on());
  }
  {
    Loop loop(other);
    BOOST_TEST(loop.goes_on());
    one.close();
    BOOST_TEST(locked(hd, hd.force[2]) == 0);
    BOOST_TEST(loop.goes_on());
    BOOST_TEST(locked(hd, hd.second_force[2]) == some_push.force[2]);
    BOOST_TEST(hd.starts == 2);  // and not for this
    BOOST_REQUIRE(bool(one.open()));
    BOOST_TEST(loop.goes_on());
    one.close();
    BOOST_TEST(loop.goes_on());
  }
  other.close();
  BOOST_TEST(!hd.is_scheduler_running);
  BOOST_TEST(!hd.is_initialised);
  BOOST_TEST(!hd.is_second_initialised);
  BOOST_TEST(!hd.is_output_on);
  BOOST_TEST(hd.second_force[2] == 0);
  BOOST_TEST(hd.broken_rules == 0);
}

BOOST_AUTO_TEST_CASE(a_device_that_cannot_be_opened_leaves_the_other_in_the_servo_loop) {
  struct Fault {
    void (*cause)(feeler_test::OpenHapticsStandIn&);
    const char* words;
  };
  const Fault faults[] = {
      {[](auto& hd) { hd.error_at_init = 0x302; }, "check its power and cable"},
      {[](auto& hd) { hd.error_at_start = 0x304; }, "servo timer"},
      {[](auto& hd) { hd.calibration = 0x5002; }, "inkwell"},
  };
  for (const Fault& fault : faults) {
    auto& hd = fresh();
    hd.own_thread = true;
    OpenHapticsDevice one(settings());
    OpenHapticsDevice other(settings_of_second());
    BOOST_REQUIRE(bool(one.open()));
    Loop loop(one);
    BOOST_TEST(loop.goes_on());
    {
      const std::lock_guard<std::mutex> lock(hd.mutex);
      fault.cause(hd);
    }
    const auto opened = other.open();
    BOOST_TEST(!opened);
    BOOST_TEST(says(opened.problem, fault.words), opened.problem);
    BOOST_TEST(loop.goes_on());
    BOOST_TEST(locked(hd, hd.second_force[2]) == 0);
    BOOST_TEST(hd.broken_rules == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_ninth_device_is_refused_and_leaves_the_others_in_the_servo_loop) {
  auto& hd = fresh();
  hd.own_thread = true;
  const auto other = [](int i) { return feeler::OpenHapticsSettings{{FEELER_OPEN_HAPTICS_STAND_IN}, "other " + std::to_string(i)}; };
  std::vector<std::unique_ptr<OpenHapticsDevice>> devices;
  for (int i = 0; i < 8; ++i) {
    devices.push_back(std::make_unique<OpenHapticsDevice>(i == 0 ? settings() : other(i)));
    const auto opened = devices.back()->open();
    BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
  }
  OpenHapticsDevice ninth(other(8));
  BOOST_TEST(says(ninth.open().problem, "eight devices are open"));
  BOOST_TEST(hd.others == 7);
  {
    Loop loop(*devices[0]);
    BOOST_TEST(loop.goes_on());
  }
  devices.clear();
  BOOST_TEST(hd.others == 0);
  BOOST_TEST(hd.broken_rules == 0);
}

BOOST_AUTO_TEST_CASE(an_error_of_one_device_does_not_end_the_session_of_the_other) {
  auto& hd = fresh();
  OpenHapticsDevice one(settings());
  OpenHapticsDevice other(settings_of_second());
  BOOST_REQUIRE(bool(one.open()));
  BOOST_REQUIRE(bool(other.open()));
  push_once(one, hd);
  hd.error_of_second_in_next_frame = 0x302;
  hd.tick();
  hd.tick();
  DeviceState state;
  BOOST_TEST((one.read(state) == DeviceStatus::ok));
  BOOST_TEST((other.read(state) == DeviceStatus::fault));
  BOOST_TEST(says(other.complaint(), "0x0302"));
}

BOOST_AUTO_TEST_CASE(a_servo_loop_that_stands_still_is_told) {
  feeler_test::World world;
  auto& hd = fresh();
  OpenHapticsDevice device(settings(), &world);
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  world.spend(15);
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
  world.spend(15);
  BOOST_TEST((device.read(state) == DeviceStatus::warning));
  BOOST_TEST(says(device.complaint(), "stands still"));
  hd.tick();
  BOOST_TEST((device.read(state) == DeviceStatus::ok));
}

BOOST_AUTO_TEST_CASE(closing_lets_go_and_opening_again_starts_afresh) {
  auto& hd = fresh();
  OpenHapticsDevice device(settings());
  for (int session = 0; session < 3; ++session) {
    BOOST_REQUIRE(bool(device.open()));
    BOOST_TEST(is_silent(hd));  // nothing of the session before
    push_once(device, hd);
    BOOST_TEST(!is_silent(hd));
    device.close();
    device.close();
    BOOST_TEST(is_silent(hd));
    BOOST_TEST(!hd.is_initialised);
    BOOST_TEST(hd.broken_rules == 0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
