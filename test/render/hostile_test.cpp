// Whatever the device does, every output is valid and nothing penetrates, at the ends of ticks and on the way.
#include <boost/test/unit_test.hpp>

#include <limits>
#include <numbers>
#include <string>

#include "scenes/cavity.hpp"
#include "scenes/plate.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(hostile)

using namespace feeler;
using namespace feeler::test;

namespace {

/// Worst results of a run.
struct Account {
  int ticks = 0, invalid = 0, not_free = 0, unconverged = 0;
  double deepest = 0, deepest_on_way = 0;
};

/// Runs a motion of poses that need not be finite, with the checker on every tick and on the way of every `way_every`th.
template <class HapticAt>
Account account_of(const scenes::Scene& scene, const Settings<double>& settings, int ticks, int way_every, double depth_allowed,
                   const HapticAt& haptic_at) {
  Account account;
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  with_tool_of(scene, [&](const auto& tool) {
    const Witness witness(scene.vertices, scene.triangles, tool);
    HapticRenderer renderer(object, tool, settings);
    BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
    for (int i = 0; i < ticks; ++i) {
      const Pose<double> from = renderer.tick().graphic_pose;
      const Pose<double> haptic = haptic_at(i);
      const auto& tick = renderer.update(haptic);
      ++account.ticks;
      account.invalid += !is_valid(tick, object.triangle_count()) || (tick.status == Status::not_finite) == haptic.is_finite() ||
                         (tick.path.empty() && !is_same(from, tick.graphic_pose));
      account.unconverged += tick.status == Status::unconverged;
      const double depth = witness.depth_at(tick.graphic_pose);
      const double on_way = i % way_every == 0 ? witness.depth_on_way(from, tick, 7) : 0;
      account.deepest = std::max(account.deepest, depth);
      account.deepest_on_way = std::max(account.deepest_on_way, on_way);
      account.not_free += std::max(depth, on_way) > depth_allowed;
    }
  });
  return account;
}

void check(const std::string& name, const Account& account) {
  BOOST_TEST_MESSAGE(name << ": " << account.ticks << " ticks, unconverged " << account.unconverged << ", deepest " << account.deepest
                          << " m, on the way " << account.deepest_on_way << " m");
  BOOST_TEST_CONTEXT(name) {
    BOOST_TEST(account.invalid == 0);
    BOOST_TEST(account.not_free == 0);
  }
}

/// Jumps of every kind on top of a motion: the scene's hostile one, spins of π, encoder noise, and poses that are no poses.
auto hostile_hand(const scenes::Scene& scene, std::uint32_t seed) {
  return [motion = scenes::hostile(scene.motion, seed), seed](int i) {
    scenes::RandomBits random(seed * 7919u + std::uint32_t(i));
    Pose<double> pose = motion(i * 1e-3);
    const auto count = [&] { return 2e-5 * (int(3 * random.unit()) - 1); };  // -1, 0 or 1 encoder counts
    pose.translation += Vector3<double>(count(), count(), count());
    pose.rotation = (exp_rotation<double>({10 * count(), 10 * count(), 10 * count()}) * pose.rotation).normalized();
    switch (i % 97) {
      case 13: pose.rotation = exp_rotation<double>(std::numbers::pi * random.direction()) * pose.rotation; break;
      case 29: pose.translation[int(3 * random.unit())] = std::numeric_limits<double>::quiet_NaN(); break;
      case 43: pose.rotation.coeffs()[int(4 * random.unit())] = std::numeric_limits<double>::infinity(); break;
      case 59: pose.rotation.coeffs().setZero(); break;
      case 71: pose.rotation.coeffs() *= std::pow(10.0, 6 * random.unit() - 3); break;
      case 83: pose.translation *= 1e9; break;
      default: break;
    }
    return pose;
  };
}

void check_hostile(const scenes::Scene& scene, const std::string& name, int ticks, int way_every, double depth_allowed, std::uint32_t seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  check(name, account_of(scene, scene.settings(), ticks_to_run(ticks), way_every, depth_allowed, hostile_hand(scene, seed)));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_the_cube_penetrate_the_cavity) {
  check_hostile(scenes::cavity(1e-3), "cavity 1 mm", 4000, 1, touching_depth, 31);
  check_hostile(scenes::cavity(1e-5), "cavity 10 um", 4000, 1, touching_depth, 32);
  check_hostile(scenes::cavity(0), "cavity 0", 4000, 1, no_clearance_depth, 33);
}

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_a_tool_penetrate_the_steps) {
  check_hostile(scenes::steps(), "steps", 4000, 1, no_clearance_depth, 34);
  check_hostile(scenes::steps_with_prism(), "steps-prism", 4000, 1, touching_depth, 35);
}

BOOST_AUTO_TEST_CASE(a_hostile_device_never_wears_the_clearance_of_a_line_on_the_steps_down_to_nothing) {
  check_hostile(scenes::steps(), "steps", 4000, 1, touching_depth, 34);
}

BOOST_AUTO_TEST_CASE(a_leaping_device_never_wears_the_clearance_of_a_line_in_a_corner_down_to_nothing) {
  scenes::Scene scene = scenes::cavity(0.01);
  Settings<double> settings = scene.settings();
  settings.margin = 1e-8;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const double size = seed % 2 == 0 ? 1e-5 : 8e-3;  // a tiny one turns far within the trust region; a long one is caught between walls
    scenes::RandomBits random(seed);
    const Vector3<double> from = size * random.unit() * random.direction();
    scene.tool = Segment<double>(from, from + size * random.direction());
    Pose<double> hand = scene.start;
    const auto leaps = [&](int i) {
      const auto symmetric = [&] { return 2 * random.unit() - 1; };
      if (i % (size < 1e-3 ? 5 : 20) == 0)
        hand = {{symmetric(), symmetric(), symmetric()}, exp_rotation<double>(std::numbers::pi * random.unit() * random.direction())};
      return hand;
    };
    check("seed " + std::to_string(seed), account_of(scene, settings, ticks_to_run(300), 1, touching_depth, leaps));
  }
}

BOOST_AUTO_TEST_CASE(turns_that_weigh_differently_by_axis_make_no_tool_penetrate_a_plate) {
  // Then the step home is not the gradient's: a motion certified must be the one that is made.
  const scenes::Scene scene = scenes::plate(3);
  Settings<double> settings = scene.settings();
  settings.stiffness.rotational = {0.1, 0.3, 1};
  scenes::RandomBits random(41);
  Pose<double> hand = scene.start;
  const Vector3<double> middle = scene.motion(0).translation;
  const auto leaps = [&](int i) {
    if (i % 5 == 0)
      hand = {middle + 0.05 * random.unit() * random.direction(), exp_rotation<double>(std::numbers::pi * random.unit() * random.direction())};
    return hand;
  };
  check("plate", account_of(scene, settings, ticks_to_run(2000), 1, touching_depth, leaps));
}

BOOST_AUTO_TEST_CASE(half_a_turn_is_made_in_legs_that_tell_which_way_round_it_went) {
  scenes::Scene wall;
  scenes::add_plates(wall, {{{0, 0.02, 0}, {0.1, 0, 0}, {0, 0, 0.1}}});
  wall.tool = Segment<double>({0, 0, 0}, {0, 0, 0.05});
  const TriangleMesh<double> object(wall.vertices, wall.triangles);
  with_tool_of(wall, [&](const auto& tool) {
    const Witness witness(wall.vertices, wall.triangles, tool);
    HapticRenderer renderer(object, tool, wall.settings());
    scenes::RandomBits random(44);
    int stopped = 0;
    for (int i = 0; i < 200; ++i) {
      const Pose<double> start{{0, 0, 0}, exp_rotation<double>({0, 0, 6 * random.unit()})};
      BOOST_TEST_REQUIRE((renderer.reset(start) == Status::converged));
      const double azimuth = 6 * random.unit();
      const auto& tick = renderer.update(
          {start.translation, exp_rotation<double>(std::numbers::pi * Vector3<double>(std::cos(azimuth), std::sin(azimuth), 0)) * start.rotation});
      BOOST_TEST(witness.depth_on_way(start, tick, 40) == 0);
      stopped += !tick.contacts.empty();
      const Pose<double>* from = &start;
      for (const auto& to : tick.path) {
        BOOST_TEST(from->rotation.angularDistance(to.rotation) <= 3.0001);
        from = &to;
      }
    }
    BOOST_TEST(stopped > 20);
    BOOST_TEST(stopped < 180);
  });
}

BOOST_AUTO_TEST_CASE(in_free_space_turns_that_weigh_differently_by_axis_follow_the_device_at_once) {
  const scenes::Scene scene = scenes::plate(3);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  Settings<double> settings = scene.settings();
  settings.stiffness.rotational = {0.1, 0.3, 1};
  HapticRenderer renderer(object, Box<double>({0.01, 0.02, 0.03}), settings);
  Pose<double> hand{object.bounds().max() + Vector3<double>(1, 1, 1)};
  BOOST_TEST_REQUIRE((renderer.reset(hand) == Status::converged));
  scenes::RandomBits random(42);
  for (int i = 0; i < 200; ++i) {
    hand.translation += 0.01 * random.direction();
    hand.rotation = exp_rotation<double>(3 * random.unit() * random.direction()) * hand.rotation;
    const auto& tick = renderer.update(hand);
    BOOST_TEST(tick.converged());
    BOOST_TEST((tick.graphic_pose.translation - hand.translation).norm() <= 1e-14);
    BOOST_TEST(tick.graphic_pose.rotation.angularDistance(hand.rotation) <= 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_the_pebble_penetrate_the_terrain) {
  check_hostile(scenes::terrain(22), "terrain 1e3", 3000, 2, touching_depth, 36);
  check_hostile(scenes::terrain(71), "terrain 1e4", 3000, 4, touching_depth, 37);
}

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_the_probe_penetrate_the_sulcus) {
  check_hostile(scenes::sulcus(), "sulcus", 3000, 4, touching_depth, 38);
}

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_a_box_penetrate_plates) {
  check_hostile(scenes::plate(3), "plate", 4000, 1, touching_depth, 39);
  check_hostile(scenes::tunnel(4, 1e-3, 10), "tunnel", 4000, 1, touching_depth, 40);
}

BOOST_AUTO_TEST_CASE(the_hand_of_a_scene_never_makes_its_tool_penetrate) {
  const auto along = [](const scenes::Scene& scene, const std::string& name, int ticks, int way_every, double allowed) {
    check(name, account_of(scene, scene.settings(), ticks_to_run(ticks), way_every, allowed, [&](int i) { return scene.motion(i * 1e-3); }));
  };
  for (const double clearance : {1e-3, 1e-5, 0.0})
    along(scenes::cavity(clearance), "cavity " + std::to_string(clearance), 3000, 1, clearance > 0 ? touching_depth : no_clearance_depth);
  along(scenes::steps(), "steps", 3000, 1, touching_depth);
  along(scenes::steps_with_prism(), "steps-prism", 3000, 1, touching_depth);
  along(scenes::terrain(71), "terrain", 2000, 2, touching_depth);
  along(scenes::sulcus(), "sulcus", 2000, 2, touching_depth);
}

BOOST_AUTO_TEST_SUITE_END()
