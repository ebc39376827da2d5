// A splined shaft in its hole, from a loose fit to a perfect one: it slides as freely as the device, and gives way to nothing else.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "scenes/spline.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(tight_fits)

using namespace feeler;
using namespace feeler::test;

namespace {

/// A shaft through its hole, longer than it, pushed sideways by millimetres while the device slides it along.
struct PressedShaft {
  static constexpr double middle = -0.01;  // of the hole, along its axis [m]
  using Shaft = CompoundTool<ConvexPolytope<double>>;

  explicit PressedShaft(double clearance, int budget = Settings<double>{}.work_budget)
      : scene(scenes::spline(clearance)), object(scene.vertices, scene.triangles), renderer(object, Shaft::hulls_of(scene.pieces), settings(budget)) {
    BOOST_TEST((renderer.reset(scenes::pose_of({0, 0, 0}, {0, 0, middle})) == Status::converged));
  }

  /// The device at a millisecond of its motion; hands are a nanometre apart.
  static Pose<double> device(int tick, int hand = 0) {
    return scenes::pose_of({0, 0, 0}, {0.003 + hand * 1e-9, 0.002, middle + 0.004 * std::sin(0.008 * tick)});
  }
  static constexpr double fastest = 0.004 * 0.008;  // way of the device in a tick [m]

  Settings<double> settings(int budget) const {
    Settings<double> settings = scene.settings();
    settings.work_budget = budget;
    return settings;
  }

  scenes::CompoundScene scene;
  TriangleMesh<double> object;
  HapticRenderer<Shaft> renderer;
};

constexpr double margin = 1e-6;
constexpr int first_ticks = 10;

}  // namespace

BOOST_AUTO_TEST_CASE(a_shaft_slides_like_the_device_and_stays_in_the_corner_it_is_pushed_into) {
  for (const double clearance : {1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      PressedShaft shaft(clearance);
      double worst_slide = 0, worst_lag = 0, low = 1, high = -1, worst_corner = 0, worst_turn = 0;
      int unconverged = 0;
      const int ticks = ticks_to_run(800);
      for (int i = 1; i <= ticks; ++i) {
        const Pose<double> device = PressedShaft::device(i);
        const auto& tick = shaft.renderer.update(device);
        if (i <= first_ticks) continue;
        const Vector3<double>& p = tick.graphic_pose.translation;
        double& worst = tick.converged() ? worst_slide : worst_lag;
        worst = std::max(worst, std::abs(p.z() - device.translation.z()));
        worst_turn = std::max(worst_turn, log_rotation(tick.graphic_pose.rotation).norm());
        low = std::min(low, p.x());
        high = std::max(high, p.x());
        // Side walls of the teeth face in 8 directions, so the shaft has an octagon to move in, and ends in the corner at 22.5 degrees.
        const double play = std::max(clearance - margin, 0.0);
        worst_corner = std::max({worst_corner, std::abs(p.x() - play), std::abs(p.y() - play * std::tan(std::numbers::pi / 8))});
        unconverged += tick.converged() ? 0 : 1;
      }
      BOOST_TEST_MESSAGE("clearance " << clearance << ": slides " << worst_slide << " m behind the device, " << worst_lag
                                      << " m where work lacks, held to " << high - low << " m, " << worst_corner << " m from the corner, turned by "
                                      << worst_turn << "; " << unconverged << " unconverged");
      // Without clearance rounding says which teeth hold, about once in 1500 to 4000 ticks others than before. Those are more to look at than a tick
      // may, which says so; the next one makes up for it.
      BOOST_TEST(unconverged <= (clearance > 0 ? 0 : 1 + ticks / 800));
      BOOST_TEST(worst_lag <= PressedShaft::fastest);
      BOOST_TEST(worst_slide <= 1e-9 * 0.008);
      BOOST_TEST(high - low <= 1e-11);
      BOOST_TEST(worst_corner <= (clearance > 2 * margin ? 1e-10 : clearance + no_clearance_depth));
      BOOST_TEST(worst_turn <= 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(it_slides_so_whatever_the_hand) {
  // Which of hundreds of pairs a tick has time for hangs on the last bits of the hand. While a wall, or an end of one, was known only once it blocked,
  // 1 of 3000 ticks was late, and of the others 1 of 10,000 was off by up to 85 nm as the shaft had tilted; 39 of 200 shafts rested turned.
  for (const double clearance : {1e-3, 1e-4, 1e-5, 3e-6, 2e-6, 1.5e-6, 1e-6}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      double worst_slide = 0, worst_turn = 0;
      int late = 0;
      for (int hand = 1; hand <= 8; ++hand) {
        PressedShaft shaft(clearance);
        for (int i = 1; i <= ticks_to_run(600); ++i) {
          const Pose<double> device = PressedShaft::device(i, hand);
          const auto& tick = shaft.renderer.update(device);
          if (i <= 4 * first_ticks) continue;
          late += tick.converged() ? 0 : 1;
          if (tick.converged()) worst_slide = std::max(worst_slide, std::abs(tick.graphic_pose.translation.z() - device.translation.z()));
          worst_turn = std::max(worst_turn, log_rotation(tick.graphic_pose.rotation).norm());
        }
      }
      BOOST_TEST_MESSAGE("clearance " << clearance << ": slides " << worst_slide << " m behind the device, turned by " << worst_turn << "; " << late
                                      << " late");
      BOOST_TEST(late <= 1);
      BOOST_TEST(worst_slide <= 1e-9 * 0.008);
      BOOST_TEST(worst_turn <= 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_pressed_shaft_comes_to_rest_whatever_a_tick_may_take) {
  // About where there is no room for the margin, hundreds of pairs touch, and what the first ticks have time for decides which are looked at.
  // With the first seven budgets one at the rim was missing at 1 µm, and the shaft hopped to and fro by 0.1 µm for ever. A hand that goes on asks for
  // 60 to 100 units a tick: with less the shaft is a tick or two behind it.
  for (const double clearance : {1e-6, 1.5e-6, 2e-6, 3e-6}) {
    for (const int budget : {53, 65, 68, 107, 120, 121, 290, 160, 208, 232, 240, 328, 352}) {
      BOOST_TEST_CONTEXT("clearance " << clearance << ", work budget " << budget) {
        PressedShaft shaft(clearance, budget);
        int unconverged = 0;
        for (int i = 1; i <= ticks_to_run(200, 5); ++i) {
          const bool is_at_rest = shaft.renderer.update(PressedShaft::device(std::min(i, first_ticks))).converged();
          unconverged += i > 3 * first_ticks && !is_at_rest ? 1 : 0;
        }
        BOOST_TEST(unconverged <= 2);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_shaft_that_is_held_does_not_creep) {
  for (const double clearance : {1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      PressedShaft shaft(clearance);
      const Pose<double> twisted = scenes::pose_of({0.1, -0.05, 0.2}, {0.003, 0.002, PressedShaft::middle});
      for (int i = 0; i < ticks_to_run(200, 4); ++i) shaft.renderer.update(twisted);
      const Pose<double> rest = shaft.renderer.tick().graphic_pose;
      BOOST_TEST(shaft.renderer.tick().converged());
      for (int i = 0; i < ticks_to_run(1000); ++i) shaft.renderer.update(twisted);
      BOOST_TEST(pose_error(rest, shaft.renderer.tick().graphic_pose).at(0.018) <= 1e-10);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_shaft_that_is_stopped_anywhere_comes_to_rest) {
  // It may be about to fall through its whole hole, by 22 mm, a trust radius or more in a tick.
  constexpr int most_beyond_its_way = 5;
  for (const auto& [clearance, budget] : {std::pair{1e-4, 200}, std::pair{1e-5, 400}, std::pair{1e-5, 100}}) {
    BOOST_TEST_CONTEXT("clearance " << clearance << ", work budget " << budget) {
      PressedShaft shaft(clearance, budget);
      auto& moving = shaft.renderer;
      BOOST_TEST((moving.reset(shaft.scene.start) == Status::converged));
      int longest = 0, beyond_its_way = 0;
      for (int i = 1; i <= ticks_to_run(3200); ++i) {
        const Pose<double> device = shaft.scene.motion(i * 1e-3);
        moving.update(device);
        if (i % 50 != 0) continue;
        for (const double twist : {0.0, 0.02, -0.02, 0.1}) {
          auto held = moving;
          const Pose<double> start = held.tick().graphic_pose;
          const Pose<double> twisted{device.translation, exp_rotation(Vector3<double>(0, 0, twist)) * device.rotation};
          int ticks = 1;
          while (!held.update(twisted).converged() && ticks < 300) ++ticks;
          longest = std::max(longest, ticks);
          const double way = pose_error(start, held.tick().graphic_pose).at(0.018);
          beyond_its_way = std::max(beyond_its_way, ticks - int(std::ceil(way / moving.settings().trust_radius)));
        }
      }
      BOOST_TEST_MESSAGE("clearance " << clearance << ", budget " << budget << ": at rest after " << longest << " ticks at most, " << beyond_its_way
                                      << " more than its way has trust radii");
      BOOST_TEST(beyond_its_way <= most_beyond_its_way);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_shaft_whose_hand_goes_on_is_not_late_for_want_of_a_triangle) {
  // A tooth comes to a wall that blocks no motion as they are cut short by what else is met. Whether a tick finds it in its work hangs on a
  // nanometre of the hand: with the default budget 3 of 4 shafts were late for 40 to 170 ticks, with 190 every other for 40 to 75.
  constexpr int most_beyond_its_way = 5;
  for (const int budget : {Settings<double>{}.work_budget, 190, 250}) {
    PressedShaft shaft(2e-4, budget);
    int longest = 0;
    for (int shift = 0; shift < ticks_to_run(8, 8); ++shift) {
      BOOST_TEST((shaft.renderer.reset(shaft.scene.start) == Status::converged));
      int late = 0;  // ticks in a row
      double way = 0;
      for (int i = 1; i <= ticks_to_run(3500); ++i) {
        Pose<double> device = shaft.scene.motion(i * 1e-3);
        device.translation += 1e-9 * Vector3<double>(shift, 2 * (7 * shift % 13), -5 * shift % 11);
        const Pose<double> from = shaft.renderer.tick().graphic_pose;
        const auto& tick = shaft.renderer.update(device);
        if (tick.converged()) late = 0, way = 0;
        else ++late, way += pose_error(from, tick.graphic_pose).at(0.018);
        longest = std::max(longest, late - int(std::ceil(way / shaft.renderer.settings().trust_radius)));
      }
    }
    BOOST_TEST_MESSAGE("budget " << budget << ": late for at most " << longest << " ticks more than its way has trust radii");
    BOOST_TEST(longest <= most_beyond_its_way, "budget " << budget << ": late for " << longest << " ticks");
  }
}

BOOST_AUTO_TEST_CASE(the_first_touch_takes_no_longer_than_a_few_ticks) {
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    BOOST_TEST_CONTEXT("clearance " << clearance) {
      PressedShaft shaft(clearance);
      int ticks = 0, most_work = 0;
      do {
        most_work = std::max(most_work, shaft.renderer.update(PressedShaft::device(1)).work);
      } while (++ticks < 50 && !shaft.renderer.tick().converged());
      BOOST_TEST_MESSAGE("clearance " << clearance << ": at rest after " << ticks << " ticks of at most " << most_work << " work");
      BOOST_TEST(ticks <= first_ticks);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
