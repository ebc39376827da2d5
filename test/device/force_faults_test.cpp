// Every fault of every maker's device, through the whole of loop, safety, driver and library: no force is
// left on, and a sentence says why.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "device/scripted_makers.hpp"
#include "feeler/device/servo_loop.hpp"

BOOST_AUTO_TEST_SUITE(force_faults)

using feeler::DeviceState;
using feeler::DeviceWrench;
using feeler::ForceFault;
using feeler::ServoLoop;
using feeler::ServoTick;
using feeler_test::Maker;
using feeler_test::World;

namespace {

/// What happens in the tick of the fault, from within the renderer; it may return a wrench of its own.
using Fault = std::function<DeviceWrench(Maker&, ServoLoop&, World&)>;

constexpr DeviceWrench contact{{1, 2, -1}, {0.01, 0, 0.02}};
constexpr int fault_tick = 500;  // long after the ramp
constexpr int last_tick = 560;

struct Outcome {
  feeler::ServoReport report;
  bool pushed_before = false;
  int silent_at = 0;                     // after the fault, in half milliseconds of the world
  int half_milliseconds_to_silence = 0;  // from the fault on
  bool stayed_silent = false;            // up to the end, or to `ticks_watched` after the fault
};

/// Runs a session in contact, with the fault in its tick 500; the renderer wants force on and on.
Outcome run(Maker (*make)(World&), const Fault& fault) {
  World world;
  Maker maker = make(world);
  const auto opened = maker.device->open();
  BOOST_REQUIRE_MESSAGE(bool(opened), opened.problem);
  int fault_at = 0;
  feeler::ServoSettings settings;
  settings.tick_limit = last_tick;
  settings.real_time = {.fifo = false, .priority = 80, .lock_memory = false, .processor = -1};
  ServoLoop* self = nullptr;
  ServoLoop loop(
      settings, *maker.device,
      [&](const ServoTick& tick, const DeviceState&) {
        if (tick.index == 0) return DeviceWrench{};
        if (tick.index != fault_tick) return contact;
        fault_at = world.half_milliseconds();
        return fault(maker, *self, world);
      },
      &world);
  self = &loop;
  loop.start();
  Outcome outcome;
  outcome.report = loop.wait();
  world.spend(5);
  BOOST_TEST(world.is_silent());  // whatever happened, nothing is left on
  const auto& silent = world.was_silent;
  outcome.pushed_before = !silent[std::size_t(fault_at) - 1];
  std::size_t first = std::size_t(fault_at);
  while (first < silent.size() && !silent[first]) ++first;
  outcome.silent_at = int(first);
  outcome.half_milliseconds_to_silence = int(first) - fault_at;
  outcome.stayed_silent = true;
  for (std::size_t i = first; i < silent.size(); ++i) outcome.stayed_silent = outcome.stayed_silent && silent[i];
  maker.device->close();
  return outcome;
}

void check_silenced(const Outcome& outcome, ForceFault fault) {
  BOOST_TEST(outcome.pushed_before);
  // The sample at fault_at is half a millisecond after the fault: index n lies (n + 1)/2 ms after it.
  BOOST_TEST(outcome.half_milliseconds_to_silence <= 3);
  BOOST_TEST(outcome.stayed_silent);
  BOOST_TEST((outcome.report.force.first_fault == fault), feeler::to_string(outcome.report.force.first_fault));
}

const std::vector<std::pair<const char*, Maker (*)(World&)>> makers = {
    {"OpenHaptics", &feeler_test::open_haptics}, {"Force Dimension", &feeler_test::force_dimension}, {"Virtuose", &feeler_test::virtuose}};

}  // namespace

BOOST_AUTO_TEST_CASE(without_a_fault_the_force_stays_on_to_the_end) {
  for (const auto& [name, make] : makers) {
    BOOST_TEST_CONTEXT(name) {
      int pushed = 0;
      const auto outcome = run(make, [&pushed](Maker&, ServoLoop&, World&) { return ++pushed, contact; });
      BOOST_TEST(pushed == 1);
      BOOST_TEST(outcome.pushed_before);
      BOOST_TEST(outcome.half_milliseconds_to_silence >= 2 * (last_tick - fault_tick) - 2);
      BOOST_TEST((outcome.report.force.first_fault == ForceFault::none));
      BOOST_TEST(outcome.report.problem == "");
      BOOST_TEST(outcome.report.ticks == last_tick);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_wrench_that_is_not_finite_ends_in_silence_on_every_device) {
  for (const auto& [name, make] : makers) {
    BOOST_TEST_CONTEXT(name) {
      check_silenced(run(make, [](Maker&, ServoLoop&, World&) { return DeviceWrench{{0, std::numeric_limits<double>::quiet_NaN(), 0}, {0, 0, 0}}; }),
                     ForceFault::not_finite);
    }
  }
}

BOOST_AUTO_TEST_CASE(an_emergency_stop_ends_in_silence_on_every_device) {
  for (const auto& [name, make] : makers) {
    BOOST_TEST_CONTEXT(name) {
      check_silenced(run(make,
                         [](Maker&, ServoLoop& loop, World&) {
                           loop.stop_force();
                           loop.restart_force();  // does not overtake the stop
                           return contact;
                         }),
                     ForceFault::emergency_stop);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_renderer_that_throws_ends_in_silence_on_every_device) {
  for (const auto& [name, make] : makers) {
    BOOST_TEST_CONTEXT(name) {
      const auto outcome = run(make, [](Maker&, ServoLoop&, World&) -> DeviceWrench { throw std::runtime_error("out of ideas"); });
      check_silenced(outcome, ForceFault::none);
      BOOST_TEST(outcome.report.problem == "The callback threw, so the loop ended: out of ideas");
      BOOST_TEST(outcome.report.ticks == fault_tick);
    }
  }
}

BOOST_AUTO_TEST_CASE(errors_that_open_haptics_recovers_from_end_in_silence) {
  for (const unsigned int error : {0x200u, 0x201u, 0x202u, 0x203u, 0x204u, 0x300u, 0x402u}) {
    for (const bool after_push : {false, true}) {
      BOOST_TEST_CONTEXT("error " << error << (after_push ? " after" : " before") << " the push") {
        const auto outcome = run(&feeler_test::open_haptics, [=](Maker& maker, ServoLoop&, World&) {
          (after_push ? maker.hd->error_after_push : maker.hd->error_in_next_frame) = error;
          return contact;
        });
        check_silenced(outcome, ForceFault::device_warning);
        BOOST_TEST(outcome.report.ticks == last_tick);  // it goes on, without force: the pose is not free
        BOOST_TEST(to_string(outcome.report).find("the device complains") != std::string::npos);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(switches_that_keep_the_motors_of_open_haptics_off_end_in_silence) {
  for (const auto is_on : {&feeler_test::OpenHapticsStandIn::is_in_inkwell, &feeler_test::OpenHapticsStandIn::is_safety_switch_on}) {
    const auto outcome = run(
        [](World& world) {
          Maker maker = feeler_test::open_haptics(world);
          maker.hd->calibration_styles = 6;
          world.is_silent = [&hd = *maker.hd] {
            return hd.is_in_inkwell || hd.is_safety_switch_on || (feeler_test::is_zero(hd.force) && feeler_test::is_zero(hd.torque));
          };
          return maker;
        },
        [is_on](Maker& maker, ServoLoop&, World& world) {
          maker.hd->*is_on = true;
          world.frame = [&hd = *maker.hd, is_on, frames = 0]() mutable {
            if (++frames == 20) hd.*is_on = false;  // the stylus is taken out, in contact
            hd.tick();
          };
          return contact;
        });
    check_silenced(outcome, ForceFault::device_warning);
    BOOST_TEST(outcome.report.ticks == last_tick);
  }
}

BOOST_AUTO_TEST_CASE(warm_motors_of_open_haptics_end_in_silence) {
  check_silenced(run(&feeler_test::open_haptics,
                     [](Maker& maker, ServoLoop&, World&) {
                       maker.hd->temperatures[2] = 1;
                       return contact;
                     }),
                 ForceFault::hot_motors);
}

BOOST_AUTO_TEST_CASE(a_lost_open_haptics_device_ends_in_silence_and_a_sentence) {
  for (const bool is_error : {true, false}) {
    const auto outcome = run(&feeler_test::open_haptics, [=](Maker& maker, ServoLoop&, World&) {
      if (is_error) {
        maker.hd->error_in_next_frame = 0x302;
      } else {
        maker.hd->transform[12] = std::numeric_limits<double>::infinity();
      }
      return contact;
    });
    check_silenced(outcome, ForceFault::device_lost);
    BOOST_TEST(outcome.report.ticks < last_tick);
    BOOST_TEST(outcome.report.problem.find("The device was lost, so the force is off") == 0u);
    BOOST_TEST(outcome.report.problem.find(is_error ? "check its power and cable" : "a pose that is none") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_renderer_that_hangs_is_silenced_by_the_servo_thread_of_open_haptics) {
  const auto outcome = run(&feeler_test::open_haptics, [](Maker&, ServoLoop&, World& world) {
    world.spend(20);
    return contact;
  });
  BOOST_TEST(outcome.pushed_before);
  // The frames go on: the third without a wrench is silent, 2 ms after the tick was due. Then the loop is
  // back and finds that it was late.
  BOOST_TEST(outcome.half_milliseconds_to_silence <= 6);
  BOOST_TEST((outcome.report.force.first_fault == ForceFault::late_tick));
  BOOST_TEST(outcome.report.missed >= 19);
}

BOOST_AUTO_TEST_CASE(a_renderer_that_hung_does_not_push_for_the_pose_that_it_began_with) {
  for (const auto& [name, make] : makers) {
    BOOST_TEST_CONTEXT(name) {
      bool is_back = false;
      double most = 0;
      const auto outcome = run(make, [&](Maker& maker, ServoLoop&, World& world) {
        world.spend(20);
        // From here on, what the motors of a device that is called directly are told.
        world.is_silent = [&, silent = world.is_silent, &m = maker]() {
          is_back = true;
          if (m.dhd != nullptr) most = std::max(most, m.dhd->force[1]);
          if (m.virtuose != nullptr) most = std::max(most, double(m.virtuose->wrench[1]));
          return silent();
        };
        return DeviceWrench{{8, 0, 0}, {0, 0, 0}};  // it wants more than ever
      });
      BOOST_TEST(is_back);
      BOOST_TEST((outcome.report.force.first_fault == ForceFault::late_tick));
      BOOST_TEST(most <= 1);  // 1 N was on: it fades from there
    }
  }
}

BOOST_AUTO_TEST_CASE(a_servo_thread_that_stops_is_found_out_and_finds_no_force_when_it_goes_on) {
  int return_at = 0;
  bool was_silent_then = false;
  const auto outcome = run(&feeler_test::open_haptics, [&](Maker&, ServoLoop&, World& world) {
    // Meanwhile nobody can push anew, or stop pushing: the amplifiers have a watchdog of their own.
    world.frame = [&world, &return_at, &was_silent_then, frame = world.frame, missing = 20]() mutable {
      if (missing-- > 0) return;
      frame();
      if (missing == -1) was_silent_then = world.is_silent();
      return_at = world.half_milliseconds();
    };
    return contact;
  });
  BOOST_TEST(return_at > 0);
  BOOST_TEST(was_silent_then);
  BOOST_TEST((outcome.report.force.first_fault == ForceFault::stale_pose));
}

BOOST_AUTO_TEST_CASE(a_lost_force_dimension_device_ends_in_silence_and_a_sentence) {
  const auto outcome = run(&feeler_test::force_dimension, [](Maker& maker, ServoLoop&, World&) {
    maker.dhd->frame[1][1] = std::numeric_limits<double>::quiet_NaN();
    return contact;
  });
  check_silenced(outcome, ForceFault::device_lost);
  BOOST_TEST(outcome.report.problem.find("a pose that is none") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_cable_that_comes_off_is_told_and_a_device_that_comes_back_lets_go) {
  struct Cable {
    Maker (*make)(World&);
    void (*plug)(Maker&, bool);
    const char* words;
  };
  const Cable cables[] = {{&feeler_test::force_dimension, [](Maker& maker, bool is_in) { maker.dhd->is_unplugged = !is_in; }, "communication error"},
                          {&feeler_test::virtuose, [](Maker& maker, bool is_in) { maker.virtuose->is_unplugged = !is_in; }, "network cable"}};
  for (const Cable& cable : cables) {
    int back_at = 0;
    const auto outcome = run(cable.make, [&](Maker& maker, ServoLoop&, World& world) {
      cable.plug(maker, false);
      world.frame = [&, missing = 20]() mutable {
        if (missing-- != 0) return;
        cable.plug(maker, true);
        back_at = world.half_milliseconds();
      };
      return contact;
    });
    // Without its cable, the stand-in holds the last force: nobody can reach it. It is silent 2 ms after it
    // is back.
    BOOST_TEST(back_at > 0);
    BOOST_TEST(outcome.silent_at - back_at <= 3);
    BOOST_TEST(outcome.stayed_silent);
    BOOST_TEST((outcome.report.force.first_fault == ForceFault::device_lost));
    BOOST_TEST(outcome.report.problem.find("The device was lost, so the force is off") == 0u);
    BOOST_TEST(outcome.report.problem.find(cable.words) != std::string::npos, outcome.report.problem);
  }
}

BOOST_AUTO_TEST_CASE(a_force_dimension_device_that_only_answers_with_its_time_guard_ends_in_silence) {
  const auto outcome = run(&feeler_test::force_dimension, [](Maker& maker, ServoLoop&, World&) {
    maker.dhd->has_nothing_new = true;
    return contact;
  });
  // From the moment at which the pose is too old: 3 ms.
  BOOST_TEST(outcome.half_milliseconds_to_silence <= 6 + 4);
  BOOST_TEST(outcome.stayed_silent);
  BOOST_TEST((outcome.report.force.first_fault == ForceFault::stale_pose));
  BOOST_TEST(outcome.report.ticks == last_tick);
}

BOOST_AUTO_TEST_CASE(what_hinders_a_force_dimension_device_ends_in_silence) {
  const std::vector<void (*)(feeler_test::ForceDimensionStandIn&)> hindrances = {
      [](auto& dhd) { dhd.force_off_cause = 1; }, [](auto& dhd) { dhd.has_power = false; }, [](auto& dhd) { dhd.has_error = true; }};
  for (const auto hinder : hindrances) {
    const auto outcome = run(&feeler_test::force_dimension, [=](Maker& maker, ServoLoop&, World&) {
      hinder(*maker.dhd);
      return contact;
    });
    check_silenced(outcome, ForceFault::device_warning);
    BOOST_TEST(outcome.report.ticks == last_tick);
  }
}

BOOST_AUTO_TEST_CASE(what_hinders_a_virtuose_ends_in_silence) {
  const std::vector<void (*)(feeler_test::VirtuoseStandIn&)> hindrances = {[](auto& controller) { controller.is_emergency_stopped = true; },
                                                                           [](auto& controller) { controller.is_powered = false; },
                                                                           [](auto& controller) { controller.is_held = false; }};
  for (const auto hinder : hindrances) {
    const auto outcome = run(&feeler_test::virtuose, [=](Maker& maker, ServoLoop&, World&) {
      hinder(*maker.virtuose);
      return contact;
    });
    check_silenced(outcome, ForceFault::device_warning);
    BOOST_TEST(outcome.report.ticks == last_tick);
  }
}

BOOST_AUTO_TEST_CASE(an_overheated_virtuose_ends_in_silence) {
  check_silenced(run(&feeler_test::virtuose,
                     [](Maker& maker, ServoLoop&, World&) {
                       maker.virtuose->alarm = 0x4000;
                       return contact;
                     }),
                 ForceFault::hot_motors);
}

BOOST_AUTO_TEST_CASE(a_virtuose_whose_state_is_not_renewed_ends_in_silence) {
  const auto outcome = run(&feeler_test::virtuose, [](Maker& maker, ServoLoop&, World&) {
    maker.virtuose->seconds_late = 0.1;
    return contact;
  });
  // From the moment at which the pose is too old: 3 ms.
  BOOST_TEST(outcome.half_milliseconds_to_silence <= 6 + 4);
  BOOST_TEST(outcome.stayed_silent);
  BOOST_TEST((outcome.report.force.first_fault == ForceFault::stale_pose));
}

BOOST_AUTO_TEST_CASE(a_virtuose_with_a_broken_pose_ends_in_silence_and_a_sentence) {
  const auto outcome = run(&feeler_test::virtuose, [](Maker& maker, ServoLoop&, World&) {
    maker.virtuose->pose[3] = 3;
    return contact;
  });
  check_silenced(outcome, ForceFault::device_lost);
  BOOST_TEST(outcome.report.problem.find("a pose that is none") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
