// Round tools whatever the device does: nothing penetrates, nothing thin is crossed, a held device makes no jitter, a tick allocates nothing.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/plate.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"
#include "support/allocation_count.hpp"
#include "support/rendering.hpp"
#include "support/rest.hpp"

BOOST_AUTO_TEST_SUITE(round_tools_safety)

using namespace feeler;
using namespace feeler::test;

namespace {

const Sphere<double> small_ball(0.004);
const Capsule<double> pin({{0.001, 0, -0.008}, {0, 0.001, 0.012}}, 0.002);
const RoundedBox<double> bar(Box<double>({0.009, 0.004, 0.002}), 0.0015);

RoundedPolytope<double> smooth_pebble() { return {scenes::pebble(5), 0.001}; }

/// A bent wire: a shaft and, at its end, a tip aside.
CompoundTool<Capsule<double>> hook() {
  return CompoundTool<Capsule<double>>({{{{0, 0, 0}, {0, 0, 0.015}}, 0.002}, {{{0, 0, 0}, {0.006, 0, -0.004}}, 0.0015}});
}

/// A scene with its hand 7 mm lower, for a tool that is so much smaller.
scenes::Scene lower(scenes::Scene scene) {
  scene.motion = [motion = scene.motion](double t) {
    Pose<double> pose = motion(t);
    pose.translation.z() -= 0.007;
    return pose;
  };
  scene.start = scene.motion(0);
  return scene;
}

/// What must not happen, counted while the device does what it likes.
template <RigidTool Tool>
class Watch {
 public:
  int ticks = 0, invalid = 0, not_free = 0, contact_ticks = 0, unconverged = 0;
  double deepest = 0;

  Watch(const scenes::Setting& scene, const Tool& tool, double depth_allowed)
      : triangle_count_(int(scene.triangles.rows())),
        object_(scene.vertices, scene.triangles),
        pieces_(checked_pieces(tool)),
        allowed_(depth_allowed) {}

  template <class Renderer>
  void update(Renderer& renderer, const Pose<double>& haptic, int samples) {
    const Pose<double> from = renderer.tick().graphic_pose;
    const auto& tick = renderer.update(haptic);
    ++ticks;
    contact_ticks += !tick.contacts.empty();
    unconverged += tick.status == Status::unconverged;
    invalid += !is_valid(tick, triangle_count_) || (tick.status == Status::not_finite) == haptic.is_finite() ||
               (tick.path.empty() && !is_same(from, tick.graphic_pose));
    double depth = static_cast<double>(deepest_penetration(object_, pieces_, checked_pose(tick.graphic_pose)).depth);
    CheckedPose last = checked_pose(from);
    for (const auto& pose : tick.path) {
      if (samples == 0) break;
      const CheckedPose next = checked_pose(pose);
      depth = std::max(depth, static_cast<double>(deepest_penetration_on_path(object_, pieces_, last, next, samples).depth));
      last = next;
    }
    deepest = std::max(deepest, depth);
    not_free += depth > allowed_;
  }

  void check(const std::string& name, bool must_touch = true) const {
    BOOST_TEST_MESSAGE(name << ": " << ticks << " ticks, " << contact_ticks << " in contact, unconverged " << unconverged << ", deepest " << deepest
                            << " m");
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(invalid == 0);
      BOOST_TEST(not_free == 0);
      if (must_touch && runs_all_ticks) BOOST_TEST(contact_ticks > ticks / 50);
    }
  }

 private:
  int triangle_count_;
  CheckedObject object_;
  std::vector<CheckedTool> pieces_;
  double allowed_;
};

/// Jumps of every kind on top of a motion: the scene's hostile one, spins of π, and poses that are no poses.
auto hostile_hand(const scenes::Setting& scene, std::uint32_t seed) {
  return [motion = scenes::hostile(scene.motion, seed), seed](int i) {
    scenes::RandomBits random(seed * 7919u + std::uint32_t(i));
    Pose<double> pose = motion(i * 1e-3);
    switch (i % 97) {
      case 13: pose.rotation = exp_rotation<double>(std::numbers::pi * random.direction()) * pose.rotation; break;
      case 29: pose.translation[int(3 * random.unit())] = std::numeric_limits<double>::quiet_NaN(); break;
      case 59: pose.rotation.coeffs().setZero(); break;
      case 71: pose.rotation.coeffs() *= std::pow(10.0, 6 * random.unit() - 3); break;
      case 83: pose.translation *= 1e9; break;
      default: break;
    }
    return pose;
  };
}

template <RigidTool Tool>
void check_hostile(const scenes::Setting& scene, const Tool& tool, const std::string& name, int ticks, double depth_allowed, std::uint32_t seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer renderer(object, tool, scene.settings());
  BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
  Watch<Tool> watch(scene, tool, depth_allowed);
  const auto hand = hostile_hand(scene, seed);
  for (int i = 0; i < ticks_to_run(ticks); ++i) watch.update(renderer, i % 600 < 300 ? hand(i) : scene.motion(i * 1e-3), 4);
  watch.check(name);
}

/// Plates with free space of `gap` between them: floor and ceiling, then the sides.
scenes::Scene walls(int count, double gap) {
  const Vector3<double> x(0.1, 0, 0), y(0, 0.1, 0), z(0, 0, 0.1);
  const std::vector<scenes::Plate> all{{{0, 0, -gap / 2}, x, y}, {{0, 0, gap / 2}, x, y}, {{0, -gap / 2, 0}, x, z}, {{0, gap / 2, 0}, x, z}};
  scenes::Scene scene;
  scenes::add_plates(scene, {all.begin(), all.begin() + count});
  scene.length = 0.008;
  return scene;
}

/// Triangles of no breadth, some of no area, all about the origin.
scenes::Setting slivers(std::uint32_t seed) {
  scenes::RandomBits random(seed);
  const auto symmetric = [&] { return 2 * random.unit() - 1; };
  std::vector<Vector3<double>> corners;
  for (int i = 0; i < 150; ++i) {
    const Vector3<double> from = 0.08 * Vector3<double>(symmetric(), symmetric(), symmetric()),
                          along = std::pow(10.0, -2 + random.unit()) * random.direction();
    corners.insert(corners.end(), {from, from + along, from + random.unit() * along + std::pow(10.0, -18 + 14 * random.unit()) * random.direction()});
  }
  scenes::Setting scene;
  scene.vertices = scenes::points_from(corners);
  scene.triangles.resize(150, 3);
  for (int i = 0; i < 150; ++i) scene.triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
  return scene;
}

/// Hands that break out to and fro at a speed, and jump from side to side with a spin.
template <ConvexTool Tool>
void try_to_break_out(const Tool& tool, double gap, const std::string& name, std::uint32_t seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  int crossed = 0;
  for (int count = 1; count <= 4; count += 3) {
    const scenes::Scene scene = walls(count, gap);
    const TriangleMesh<double> object(scene.vertices, scene.triangles);
    scenes::RandomBits random(seed + std::uint32_t(count));
    for (const double speed : {0.1, 1.0, 10.0, 0.0}) {  // the last: jumps
      HapticRenderer renderer(object, tool, scene.settings());
      BOOST_TEST_REQUIRE((renderer.reset(Pose<double>{}) == Status::converged));
      Watch<Tool> watch(scene, tool, touching_depth);
      for (int i = 0; i < ticks_to_run(400); ++i) {
        const double t = i * 1e-3, phase = speed / 0.03 * t, side = i % 2 == 0 ? 0.03 : -0.03;
        const Pose<double> haptic =
            speed > 0
                ? scenes::pose_of({1.4 * std::sin(3.3 * t), 1.3 * std::sin(2.7 * t), 1.9 * std::sin(4.1 * t)},
                                  {0.03 * std::sin(2.1 * t), 0.03 * std::sin(phase) * std::sin(1.3 * t), 0.03 * std::sin(phase) * std::cos(1.3 * t)})
                : Pose<double>{0.01 * random.direction() + Vector3<double>(0, count > 2 && random.unit() < 0.5 ? side : 0, side),
                               exp_rotation<double>(std::numbers::pi * random.unit() * random.direction())};
        watch.update(renderer, haptic, 5);
        for (int k = 0; k < tool.vertex_count(); ++k) {
          const Vector3<double> v = renderer.tick().graphic_pose * Vector3<double>(tool.vertex(k));
          const double room = gap / 2 - tool.swept_radius();
          crossed += v.z() < -room || (count > 1 && (v.z() > room || v.y() < -room || v.y() > room));
        }
      }
      watch.check(name + ", " + std::to_string(count) + " walls, speed " + std::to_string(speed), speed != 0.1);
    }
  }
  BOOST_TEST(crossed == 0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_a_round_tool_penetrate_a_cavity) {
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    const double allowed = clearance > 0 ? touching_depth : no_clearance_depth;
    const std::string name = "cavity " + std::to_string(clearance);
    check_hostile(scenes::cavity(clearance), Sphere<double>(0.01), name + ", sphere", 2400, allowed, 71);
    check_hostile(scenes::cavity(clearance), Capsule<double>({{-0.006, 0, 0}, {0.006, 0, 0}}, 0.004), name + ", capsule", 2400, allowed, 72);
    check_hostile(scenes::cavity(clearance), RoundedBox<double>(Box<double>(Vector3<double>::Constant(0.008)), 0.002), name + ", rounded cube", 1200,
                  allowed, 73);
  }
}

BOOST_AUTO_TEST_CASE(a_hostile_device_never_makes_a_round_tool_penetrate_the_terrain) {
  check_hostile(scenes::terrain(71), small_ball, "terrain, sphere", 2400, touching_depth, 74);
  check_hostile(scenes::terrain(71), pin, "terrain, capsule", 2400, touching_depth, 75);
  check_hostile(scenes::terrain(22), bar, "terrain, rounded box", 1200, touching_depth, 76);
  check_hostile(scenes::terrain(22), smooth_pebble(), "terrain, rounded pebble", 600, touching_depth, 77);
  check_hostile(scenes::terrain(22), hook(), "terrain, two capsules", 1200, touching_depth, 78);
  check_hostile(lower(scenes::terrain(71)), Point<double>(), "terrain, point", 2400, touching_depth, 79);
}

BOOST_AUTO_TEST_CASE(a_round_tool_never_crosses_a_thin_wall) {
  try_to_break_out(Sphere<double>(0.0005), 0.02, "small sphere", 81);
  try_to_break_out(Sphere<double>(0.01), 0.02 + 1e-5, "tight sphere", 82);
  try_to_break_out(Capsule<double>({{-0.009, -0.002, -0.002}, {0.009, 0.002, 0.002}}, 0.0002), 0.03, "thin capsule", 83);
  try_to_break_out(RoundedBox<double>(Box<double>({0.010, 0.005, 0.0001}), 0.0001), 0.03, "rounded sheet", 84);
}

BOOST_AUTO_TEST_CASE(a_leaping_device_never_wears_the_clearance_of_a_round_tool_among_slivers_down) {
  const Capsule<double> tool({{0, 0, -0.01}, {0, 0, 0.01}}, 0.01);
  for (std::uint32_t seed = 85; seed < 89; ++seed) {
    const scenes::Setting scene = slivers(seed);
    const TriangleMesh<double> object(scene.vertices, scene.triangles);
    HapticRenderer renderer(object, tool, scene.settings());
    BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.2}}) == Status::converged));
    Watch<Capsule<double>> watch(scene, tool, touching_depth);
    scenes::RandomBits random(seed);
    for (int i = 0; i < ticks_to_run(300); ++i) {
      const Vector3<double> to(random.unit(), random.unit(), random.unit());
      watch.update(renderer,
                   {0.12 * (to - Vector3<double>::Constant(0.5)), exp_rotation<double>(std::numbers::pi * random.unit() * random.direction())}, 3);
    }
    watch.check("slivers of seed " + std::to_string(seed));
  }
}

BOOST_AUTO_TEST_CASE(a_held_device_makes_no_jitter) {
  constexpr Holding holding{.ticks = 2000, .held_ticks = 100};
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    const std::string name = "cavity " + std::to_string(clearance);
    check_rest(scenes::cavity(clearance), Sphere<double>(0.01), name + ", sphere", holding);
    check_rest(scenes::cavity(clearance), Capsule<double>({{-0.006, 0, 0}, {0.006, 0, 0}}, 0.004), name + ", capsule", holding);
    check_rest(scenes::cavity(clearance), RoundedBox<double>(Box<double>(Vector3<double>::Constant(0.008)), 0.002), name + ", rounded cube", holding);
  }
  check_rest(scenes::terrain(71), small_ball, "terrain, sphere", holding);
  check_rest(scenes::terrain(71), pin, "terrain, capsule", holding);
  check_rest(scenes::terrain(22), bar, "terrain, rounded box", holding);
  check_rest(scenes::terrain(22), hook(), "terrain, two capsules", holding);
  check_rest(lower(scenes::terrain(71)), Point<double>(), "terrain, point", holding);
}

BOOST_AUTO_TEST_CASE(a_float_renderer_gives_the_poses_of_a_double_one_to_a_micrometre) {
  const auto check = []<class Tool>(const Tool& shape, const std::string& name) {
    const scenes::Scene scene = scenes::terrain(71);
    const Points<float> vertices = scene.vertices.template cast<float>();
    const TriangleMesh<float> object(vertices, scene.triangles);
    const TriangleMesh<double> same_object(vertices.template cast<double>(), scene.triangles);
    const ToolCast<Tool, float> tool = shape.template cast<float>();
    HapticRenderer narrow(object, tool);
    const Tool same_tool = tool.template cast<double>();
    HapticRenderer wide(same_object, same_tool);
    const Pose<float> start = scene.start.template cast<float>();
    BOOST_TEST_REQUIRE((narrow.reset(start) == Status::converged));
    BOOST_TEST_REQUIRE((wide.reset(start.template cast<double>()) == Status::converged));
    double worst = 0;
    int compared = 0, far = 0;
    for (int i = 0; i < ticks_to_run(1500); ++i) {
      const Pose<float> haptic = scene.motion(i * 1e-3).template cast<float>();
      const auto& tick = narrow.update(haptic);
      const auto& same = wide.update(haptic.template cast<double>());
      if (!tick.converged() || !same.converged()) continue;
      ++compared;
      const double error = pose_error(same.graphic_pose, tick.graphic_pose).at(0.015);
      far += error > 1e-6;
      worst = std::max(worst, error);
    }
    BOOST_TEST_MESSAGE(name << ": float and double differ by at most " << worst << " m on " << compared << " converged ticks, more than 1 um on "
                            << far);
    BOOST_TEST(compared > ticks_to_run(1500) / 2);
    BOOST_TEST(far <= compared / 200);
  };
  check(small_ball, "sphere");
  check(pin, "capsule");
  check(bar, "rounded box");
}

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_of_a_round_tool_allocates_nothing) {
  const auto check = [](const auto& tool, const std::string& name) {
    const scenes::Scene scene = scenes::terrain(71);
    const TriangleMesh<double> object(scene.vertices, scene.triangles);
    HapticRenderer renderer(object, tool, scene.settings());
    int contact_ticks = 0;
    std::int64_t allocations = 0;
    for (const auto& motion : {scene.motion, scenes::hostile(scene.motion, 5)}) {
      BOOST_TEST((renderer.reset(scene.start) == Status::converged));
      for (int i = 0; i < 1500; ++i) {
        const Pose<double> haptic = motion(i * 1e-3);
        allocations += feeler_test::allocations_during([&] { renderer.update(haptic); });
        contact_ticks += !renderer.tick().contacts.empty();
      }
    }
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(allocations == 0);
      BOOST_TEST(contact_ticks > 100);
    }
  };
  check(small_ball, "sphere");
  check(pin, "capsule");
  check(bar, "rounded box");
  check(hook(), "two capsules");
}
#endif

BOOST_AUTO_TEST_SUITE_END()
