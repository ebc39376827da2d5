// The driver of Haply against a server that stands in for its Inverse Service: frames, choices, and every fault. On the real clock, because the exchange
// has a thread of its own; no test asks how long anything takes, but for limits of seconds.
#ifdef FEELER_DEVICE_HAPLY
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "feeler/core/result.hpp"
#include "feeler/device/device_catalogue.hpp"
#include "feeler/device/haply_device.hpp"
#include "feeler/device/servo_loop.hpp"
#include "stand_in/haply_stand_in.hpp"
#include "support/allocation_count.hpp"

BOOST_AUTO_TEST_SUITE(haply_device)

using feeler::DeviceState;
using feeler::DeviceStatus;
using feeler::DeviceWrench;
using feeler::HaplyDevice;
using feeler_test::HaplyStandIn;

namespace {

feeler::HaplySettings settings(const HaplyStandIn& service) {
  feeler::HaplySettings settings;
  settings.port = service.port();
  return settings;
}

bool says(const std::string& sentence, const std::string& words) { return sentence.find(words) != std::string::npos; }

/// Waits for what must come, 5 s at most.
bool comes(const std::function<bool()>& is_there) {
  for (int i = 0; i < 5000; ++i) {
    if (is_there()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

/// A good read, which may take two on a busy machine.
bool reads(HaplyDevice& device, DeviceState& state) {
  return comes([&] { return device.read(state) == DeviceStatus::ok; });
}

constexpr DeviceWrench some_push{{1, 2, 3}, {0.25, 0.5, 0.125}};

/// A loop's ticks, until what must come has come.
bool push_until(HaplyDevice& device, const std::function<bool()>& is_there) {
  return comes([&] {
    DeviceState state;
    device.read(state);
    device.write(some_push);
    return is_there();
  });
}

/// The first status other than `ok`, which must come.
DeviceStatus first_complaint(HaplyDevice& device) {
  DeviceStatus status = DeviceStatus::ok;
  comes([&] {
    DeviceState state;
    status = device.read(state);
    device.write(some_push);
    return status != DeviceStatus::ok;
  });
  return status;
}

}  // namespace

BOOST_AUTO_TEST_CASE(right_up_and_to_the_user_are_x_y_and_z_and_forces_go_the_other_way_round) {
  HaplyStandIn service;
  HaplyStandIn::World world;
  world.position[0] = 0.01;  // right
  world.position[1] = 0.02;  // forward, away from the user
  world.position[2] = 0.03;  // up
  const double half = std::sqrt(0.5);
  world.orientation[0] = half;  // a quarter turn about the maker's z, which is our y
  world.orientation[3] = half;
  world.buttons[0] = world.buttons[2] = true;
  for (const bool is_wired : {false, true}) {
    world.is_wired = is_wired;
    service.set(world);
    HaplyDevice device(settings(service));
    const auto opened = device.open();
    BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
    BOOST_TEST(device.specification().name == "Inverse3");
    BOOST_TEST(!device.specification().pushes_torque());
    BOOST_TEST(device.specification().is_sensed[4]);
    DeviceState state;
    BOOST_TEST(reads(device, state));
    BOOST_TEST(state.pose.position[0] == 0.01);
    BOOST_TEST(state.pose.position[1] == 0.03);
    BOOST_TEST(state.pose.position[2] == -0.02);
    BOOST_TEST(state.pose.orientation[0] == half, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(state.pose.orientation[1] == 0);
    BOOST_TEST(state.pose.orientation[2] == half, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(state.pose.orientation[3] == 0);
    BOOST_TEST(state.buttons == 5u);
    BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
    double pushed[3];
    service.last_push(pushed);
    BOOST_TEST(pushed[0] == 1);
    BOOST_TEST(pushed[1] == -3);
    BOOST_TEST(pushed[2] == 2);
  }
  BOOST_TEST(service.wrong_messages() == 0);
}

BOOST_AUTO_TEST_CASE(what_cannot_start_is_refused_with_a_sentence_and_pushes_nothing) {
  struct Fault {
    std::function<void(HaplyStandIn::World&)> cause;
    const char* words;
  };
  const Fault faults[] = {
      {[](auto& w) { w.declines = true; }, "no Inverse Service answers"},
      {[](auto& w) { w.is_silent = true; }, "does not list its devices"},
      {[](auto& w) { w.says_instead = "{\"inverse3\": [{\"device_id\""; }, "is no list of devices"},
      {[](auto& w) { w.says_instead = "{\"temperature\": 21}"; }, "is no list of devices"},
      {[](auto& w) { w.says_instead = std::string(std::size_t(2) << 20, ' '); }, "does not list its devices"},
      {[](auto& w) { w.arms.clear(); }, "knows no Inverse3"},
      {[](auto& w) { w.arms = {"049D", "049D"}; }, "two devices answer to the serial number 049D"},
      {[](auto& w) { w.is_calibrated = false; }, "not calibrated"},
      {[](auto& w) { w.tells_calibration = false; }, "not calibrated"},
      {[](auto& w) { w.has_power = false; }, "no power"},
      {[](auto& w) { w.is_ready = false; }, "not ready"},
      {[](auto& w) { w.grips.clear(); }, "no VerseGrip answers"},
      {[](auto& w) { w.grips = {"A", "B"}; }, "choose one of A B"},
      {[](auto& w) { w.is_grip_awake = false; }, "wake it"},
      {[](auto& w) { w.is_grip_told = false; }, "no pose came within a second"},
      {[](auto& w) { w.position[2] = std::numeric_limits<double>::quiet_NaN(); }, "a pose that is none"},
      {[](auto& w) { w.orientation[0] = 0.5; }, "a pose that is none"},
  };
  for (const Fault& fault : faults) {
    BOOST_TEST_CONTEXT(fault.words) {
      HaplyStandIn service;
      HaplyStandIn::World world;
      fault.cause(world);
      service.set(world);
      HaplyDevice device(settings(service));
      const auto opened = device.open();
      BOOST_TEST(!opened);
      BOOST_TEST(says(opened.problem, fault.words), opened.problem);
      BOOST_TEST(opened.problem.back() == '.');
      BOOST_TEST(service.peak() == 0);
      DeviceState state;
      BOOST_TEST((device.read(state) == DeviceStatus::not_open));
      BOOST_TEST((device.write(some_push) == DeviceStatus::not_open));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_period_that_is_none_is_refused) {
  for (const double period : {0.0, -1e-3, 1e-12, 1.1, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    feeler::HaplySettings none;
    none.period = period;
    BOOST_CHECK_THROW(HaplyDevice{none}, std::invalid_argument);
    const auto made = feeler::try_make<HaplyDevice>(none);
    BOOST_TEST(!made);
    BOOST_TEST(says(made.reason(), "from 0.00001 to 1 s"));
  }
  BOOST_TEST(bool(feeler::try_make<HaplyDevice>(feeler::HaplySettings())));
}

BOOST_AUTO_TEST_CASE(a_service_that_does_not_run_is_named_with_the_remedy) {
  std::uint16_t port = 0;
  {
    const HaplyStandIn service;
    port = service.port();
  }
  feeler::HaplySettings nobody;
  nobody.port = port;
  const auto opened = HaplyDevice(nobody).open();
  BOOST_TEST(says(opened.problem, "no Inverse Service answers at localhost:" + std::to_string(port)), opened.problem);
  BOOST_TEST(says(opened.problem, "Connection refused"), opened.problem);
  BOOST_TEST(says(opened.problem, "install Haply Hub"), opened.problem);
}

BOOST_AUTO_TEST_CASE(one_of_several_arms_is_chosen_by_its_serial_number_or_its_index) {
  HaplyStandIn service;
  HaplyStandIn::World world;
  world.arms = {"049D", "0A11", "0B22"};
  service.set(world);
  struct Choice {
    const char* serial_number;
    std::optional<int> index;
    const char* arm;
  };
  for (const Choice& choice : {Choice{"", {}, "049D"}, Choice{"0A11", {}, "0A11"}, Choice{"", 2, "0B22"}, Choice{"0A11", 2, "0A11"}}) {
    auto chosen = settings(service);
    chosen.serial_number = choice.serial_number;
    chosen.index = choice.index;
    HaplyDevice device(chosen);
    const auto opened = device.open();
    BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
    BOOST_TEST(push_until(device, [&] { return service.pushed_arm() == choice.arm; }), choice.arm);
  }
  auto absent = settings(service);
  absent.serial_number = "FFFF";
  BOOST_TEST(says(HaplyDevice(absent).open().problem, "no Inverse3 has the serial number FFFF; the Inverse Service knows 049D, 0A11, 0B22."));
  absent.serial_number.clear();
  for (const int index : {3, -1}) {
    absent.index = index;
    BOOST_TEST(says(HaplyDevice(absent).open().problem, "the index " + std::to_string(index)));
  }
  // By the catalogue, as a program chooses.
  feeler::DeviceChoice choice;
  choice.address = "localhost:" + std::to_string(service.port());
  choice.serial_number = "0B22";
  const auto device = feeler::make_device(feeler::Maker::haply, choice);
  BOOST_TEST(bool(device->open()));
}

BOOST_AUTO_TEST_CASE(without_a_grip_where_none_is_needed_it_senses_positions_only) {
  HaplyStandIn service;
  HaplyStandIn::World world;
  world.grips.clear();
  service.set(world);
  auto lone = settings(service);
  lone.needs_grip = false;
  HaplyDevice device(lone);
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST(device.specification().is_sensed[2]);
  BOOST_TEST(!device.specification().is_sensed[3]);
  DeviceState state;
  BOOST_TEST(reads(device, state));
  BOOST_TEST(state.pose.orientation[0] == 1);
}

BOOST_AUTO_TEST_CASE(what_ends_a_session_is_told_as_a_fault_for_good_and_pushes_nothing) {
  struct Fault {
    std::function<void(HaplyStandIn&, HaplyStandIn::World&)> cause;
    const char* words;
  };
  const Fault faults[] = {
      {[](auto& service, auto&) { service.die(); }, "closed the connection"},
      {[](auto&, auto& w) { w.closes = true; }, "closed the connection"},
      {[](auto&, auto& w) { w.says_instead = std::string(std::size_t(2) << 20, ' '); }, "closed the connection"},
      {[](auto&, auto& w) { w.is_unplugged = true; }, "lost the Inverse3"},
      {[](auto&, auto& w) { w.position[0] = std::numeric_limits<double>::infinity(); }, "a pose that is none"},
      {[](auto&, auto& w) { w.says_instead = R"({"inverse3": [{"device_id": "049D", "state": {"cursor_position": {"x": "0", "y": 0, "z": 0}}}]})"; },
       "a pose that is none"},
      {[](auto&, auto& w) { w.orientation[1] = 3; }, "a pose that is none"},
  };
  for (const Fault& fault : faults) {
    BOOST_TEST_CONTEXT(fault.words) {
      HaplyStandIn service;
      HaplyDevice device(settings(service));
      BOOST_REQUIRE(bool(device.open()));
      BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
      HaplyStandIn::World world;
      fault.cause(service, world);
      service.set(world);
      BOOST_TEST(comes([&] {
        DeviceState state;
        return device.read(state) == DeviceStatus::fault;
      }));
      BOOST_TEST(says(device.complaint(), fault.words), device.complaint());
      BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
      BOOST_TEST(comes([&] { return service.is_silent(); }));
      service.set({});  // well again
      DeviceState state;
      for (int i = 0; i < 50; ++i) {
        BOOST_TEST((device.read(state) == DeviceStatus::fault));
        BOOST_TEST((device.write(some_push) == DeviceStatus::fault));
        BOOST_TEST(service.is_silent());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_service_that_is_silent_or_babbles_gives_no_new_pose_and_says_so_and_then_ends_the_session) {
  for (const bool babbles : {false, true}) {
    HaplyStandIn service;
    HaplyDevice device(settings(service));
    BOOST_REQUIRE(bool(device.open()));
    HaplyStandIn::World world;
    (babbles ? world.says_instead : world.type) = "{\"inverse3\": [";
    world.is_silent = !babbles;
    service.set(world);
    BOOST_TEST((first_complaint(device) == DeviceStatus::warning));
    BOOST_TEST(says(device.complaint(), "sends no pose"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // for what was under way
    DeviceState state;
    device.read(state);
    const double last = state.time;
    BOOST_TEST(comes([&] { return service.is_silent(); }));
    bool is_new = false;
    BOOST_TEST(comes([&] {
      const DeviceStatus status = device.read(state);
      is_new = is_new || state.time != last || status == DeviceStatus::ok;
      return status == DeviceStatus::fault;
    }));
    BOOST_TEST(!is_new);
    BOOST_TEST(says(device.complaint(), "for a second"));
  }
}

BOOST_AUTO_TEST_CASE(while_the_arm_must_not_push_or_the_grip_does_not_answer_it_pushes_nothing_and_says_why) {
  struct Hindrance {
    std::function<void(HaplyStandIn::World&)> cause;
    const char* words;
  };
  const Hindrance hindrances[] = {
      {[](auto& w) { w.is_calibrated = false; }, "not calibrated"},
      {[](auto& w) { w.has_power = false; }, "no power"},
      {[](auto& w) { w.is_ready = false; }, "not ready"},
      {[](auto& w) { w.is_grip_awake = false; }, "VerseGrip does not answer"},
      {[](auto& w) { w.is_grip_told = false; }, "VerseGrip does not answer"},
  };
  for (const Hindrance& hindrance : hindrances) {
    BOOST_TEST_CONTEXT(hindrance.words) {
      HaplyStandIn service;
      HaplyDevice device(settings(service));
      BOOST_REQUIRE(bool(device.open()));
      BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
      HaplyStandIn::World world;
      hindrance.cause(world);
      service.set(world);
      BOOST_TEST(push_until(device, [&] { return service.is_silent() && says(device.complaint(), hindrance.words); }), device.complaint());
      service.set({});
      BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_service_that_answers_late_does_not_hold_the_loop_up) {
  HaplyStandIn service;
  HaplyDevice device(settings(service));
  BOOST_REQUIRE(bool(device.open()));
  HaplyStandIn::World world;
  world.late = 300;
  service.set(world);
  BOOST_TEST((first_complaint(device) == DeviceStatus::warning));
  // So many ticks take less than one answer.
  const auto start = std::chrono::steady_clock::now();
  DeviceState state;
  for (int i = 0; i < 1000; ++i) {
    device.read(state);
    device.write(some_push);
  }
  BOOST_TEST((std::chrono::steady_clock::now() - start < std::chrono::milliseconds(200)));
}

BOOST_AUTO_TEST_CASE(after_it_is_let_go_it_pushes_only_for_a_pose_that_was_read_later) {
  HaplyStandIn service;
  HaplyDevice device(settings(service));
  device.let_go();  // nothing is open
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
  device.let_go();
  BOOST_TEST(comes([&] {
    device.write(some_push);
    return service.is_silent();
  }));
  for (int i = 0; i < 50; ++i) {
    device.write(some_push);
    BOOST_TEST(service.is_silent());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
}

BOOST_AUTO_TEST_CASE(a_loop_that_writes_no_wrench_any_more_is_silenced_while_the_exchange_goes_on) {
  HaplyStandIn service;
  HaplyDevice device(settings(service));
  BOOST_REQUIRE(bool(device.open()));
  BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
  BOOST_TEST(comes([&] { return service.is_silent(); }));
  const int before = service.messages();
  BOOST_TEST(comes([&] { return service.messages() > before + 10; }));
  BOOST_TEST(service.is_silent());
}

BOOST_AUTO_TEST_CASE(no_wrench_is_more_than_the_device_may_give_and_none_that_is_not_finite_goes_out) {
  HaplyStandIn service;
  HaplyDevice device(settings(service));
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  BOOST_TEST(comes([&] {
    device.read(state);
    BOOST_TEST((device.write({{1e300, -1e300, 0}, {0, 0, 0}}) == DeviceStatus::ok));
    return service.pushed() > 9.99;
  }));
  BOOST_TEST(service.peak() <= 10.000001);
  double pushed[3];
  service.last_push(pushed);
  BOOST_TEST(pushed[0] == 10 * std::sqrt(0.5), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(pushed[2] == -10 * std::sqrt(0.5), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(comes([&] {
    device.read(state);
    BOOST_TEST((device.write({{0, std::numeric_limits<double>::quiet_NaN(), 0}, {0, 0, 0}}) == DeviceStatus::not_finite));
    return service.is_silent();
  }));
  BOOST_TEST(service.wrong_messages() == 0);
}

BOOST_AUTO_TEST_CASE(closing_lets_go_and_opening_again_starts_afresh) {
  HaplyStandIn service;
  HaplyDevice device(settings(service));
  for (int session = 0; session < 3; ++session) {
    BOOST_REQUIRE(bool(device.open()));
    BOOST_TEST(bool(device.open()));
    BOOST_TEST(service.is_silent());
    BOOST_TEST(push_until(device, [&] { return !service.is_silent(); }));
    device.close();
    BOOST_TEST(service.is_silent());
    device.close();
  }
}

BOOST_AUTO_TEST_CASE(every_fault_of_a_servo_loop_ends_in_silence_at_the_service_and_a_sentence) {
  using feeler::ForceFault;
  using feeler::ServoLoop;
  static constexpr DeviceWrench contact{{0, 2, 0}, {0, 0, 0}};
  struct Fault {
    const char* what;
    std::function<DeviceWrench(HaplyStandIn&, ServoLoop&)> cause;  // by the renderer, while it pushes
    ForceFault told;
    const char* words;  // of the report
    bool ends = false;  // the loop
    bool comes_back = false;
  };
  std::atomic<bool> was_silent = false;
  const auto with = [](auto change) {
    return [change](HaplyStandIn& service, ServoLoop&) {
      HaplyStandIn::World world;
      change(world);
      service.set(world);
      return contact;
    };
  };
  const Fault faults[] = {
      {"the service dies", [&](auto& service, auto&) { return service.die(), contact; }, ForceFault::device_lost, "closed the connection", true},
      {"the arm is unplugged", with([](auto& world) { world.is_unplugged = true; }), ForceFault::device_lost, "lost the Inverse3", true},
      {"the grip sleeps", with([](auto& world) { world.is_grip_awake = false; }), ForceFault::device_warning, "the device complains"},
      {"the arm has no power", with([](auto& world) { world.has_power = false; }), ForceFault::device_warning, "the device complains"},
      {"a NaN", [](auto&, auto&) { return DeviceWrench{{0, std::numeric_limits<double>::quiet_NaN(), 0}, {0, 0, 0}}; }, ForceFault::not_finite,
       "was not finite"},
      {"an emergency stop", [&](auto&, auto& loop) { return loop.stop_force(), contact; }, ForceFault::emergency_stop, "stopped the force"},
      {"the renderer throws", [](auto&, auto&) -> DeviceWrench { throw std::runtime_error("out of ideas"); }, ForceFault::none, "out of ideas", true},
      {"the renderer hangs",
       [&](auto& service, auto&) {
         std::this_thread::sleep_for(std::chrono::milliseconds(100));
         was_silent = service.is_silent();
         return contact;
       },
       ForceFault::late_tick, "a tick was late", false, true},
  };
  for (const Fault& fault : faults) {
    BOOST_TEST_CONTEXT(fault.what) {
      HaplyStandIn service;
      HaplyDevice device(settings(service));
      BOOST_REQUIRE(bool(device.open()));
      feeler::ServoSettings servo;
      servo.real_time.lock_memory = false;  // of this whole test program
      servo.force_limits = feeler::limits_of(device.specification());
      servo.force_limits->latest_tick = 0.05;  // the machine of a test may be busy
      servo.force_limits->ramp_time = 0.05;
      std::atomic<bool> has_failed = false;
      ServoLoop* self = nullptr;
      ServoLoop loop(servo, device, [&](const feeler::ServoTick&, const DeviceState&) {
        if (has_failed) return contact;
        if (service.pushed() > 1.9) {
          has_failed = true;
          return fault.cause(service, *self);
        }
        return self->force_phase() == feeler::ForcePhase::waiting ? DeviceWrench{} : contact;
      });
      self = &loop;
      was_silent = false;
      loop.start();
      BOOST_TEST(comes([&] { return has_failed.load(); }));
      BOOST_TEST(comes([&] { return fault.comes_back ? was_silent.load() : service.is_silent(); }));
      for (int i = 0; i < 50 && !fault.comes_back; ++i) {
        BOOST_TEST(service.is_silent());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      if (fault.ends) BOOST_TEST(comes([&] { return !loop.is_running(); }));
      else BOOST_TEST(loop.is_running());
      loop.stop();
      const auto& report = loop.wait();
      if (fault.told != ForceFault::none) BOOST_TEST(report.force.ticks_with[std::size_t(fault.told)] > 0);
      BOOST_TEST(says(report.problem + to_string(report), fault.words), to_string(report));
      BOOST_TEST(service.is_silent());
    }
  }
}

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_allocates_nothing) {
  HaplyStandIn service;
  HaplyDevice device(settings(service));
  BOOST_REQUIRE(bool(device.open()));
  DeviceState state;
  const auto before = feeler_test::allocations;
  for (int i = 0; i < 1000; ++i) {
    device.read(state);
    device.write(some_push);
    device.let_go();
  }
  BOOST_TEST(feeler_test::allocations == before);
}
#endif

BOOST_AUTO_TEST_SUITE_END()
#endif
