// Nothing thin is ever crossed: plates of zero thickness and tunnels at any speed, with jumps and spins.
#include <boost/test/unit_test.hpp>

#include <array>
#include <numbers>

#include "scenes/plate.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(pop_through)

using namespace feeler;
using namespace feeler::test;

namespace {

constexpr std::array<double, 5> speeds{0.1, 0.3, 1, 3, 10};

/// Plates with free space of `gap` between each pair, wide enough that the device never goes round them: floor, ceiling, then the sides.
scenes::Scene walls(int count, double gap) {
  const Vector3<double> x(0.1, 0, 0), y(0, 0.1, 0), z(0, 0, 0.1);
  const std::array<scenes::Plate, 4> all{{{{0, 0, -gap / 2}, x, y}, {{0, 0, gap / 2}, x, y}, {{0, -gap / 2, 0}, x, z}, {{0, gap / 2, 0}, x, z}}};
  scenes::Scene scene;
  scenes::add_plates(scene, {all.begin(), all.begin() + count});
  scene.length = 0.008;
  return scene;
}

/// Whether all of the tool is on the side of the walls where it began.
template <class Tool>
bool is_inside(const Tool& tool, const Pose<double>& pose, int walls_count, double gap) {
  for (int i = 0; i < tool.vertex_count(); ++i) {
    const Vector3<double> v = pose * Vector3<double>(tool.vertex(i));
    if (v.z() < -gap / 2) return false;
    if (walls_count > 1 && v.z() > gap / 2) return false;
    if (walls_count > 2 && v.y() < -gap / 2) return false;
    if (walls_count > 3 && v.y() > gap / 2) return false;
  }
  return true;
}

struct Count {
  int ticks = 0, crossed = 0, penetrating = 0, invalid = 0;
  double deepest = 0;
};

/// Runs a motion between walls and counts what must not happen.
template <class Tool, class Motion>
void run(const Tool& tool, int walls_count, double gap, int ticks, const Motion& haptic_at, Count& count) {
  const scenes::Scene scene = walls(walls_count, gap);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const Witness witness(scene.vertices, scene.triangles, tool);
  HapticRenderer renderer(object, tool, scene.settings());
  BOOST_TEST_REQUIRE((renderer.reset(Pose<double>{}) == Status::converged));
  for (int i = 0; i < ticks; ++i) {
    const Pose<double> from = renderer.tick().graphic_pose;
    const auto& tick = renderer.update(haptic_at(i));
    const double depth = witness.depth_on_way(from, tick, 9);
    count.deepest = std::max(count.deepest, depth);
    ++count.ticks;
    count.penetrating += depth > touching_depth;
    count.crossed += !is_inside(tool, tick.graphic_pose, walls_count, gap);
    count.invalid += !is_valid(tick, object.triangle_count());
  }
}

/// Hands that break out to and fro at a speed, and jump from side to side with a spin.
template <class Tool>
void try_to_break_out(const Tool& tool, double gap, std::uint32_t seed) {
  BOOST_TEST_MESSAGE("seed " << seed);
  Count count;
  for (int walls_count = 1; walls_count <= 4; ++walls_count) {
    for (const double speed : speeds) {
      constexpr double reach = 0.03;
      run(
          tool, walls_count, gap, ticks_to_run(600),
          [speed](int i) {
            const double t = i * 1e-3, phase = speed / reach * t;
            return scenes::pose_of(
                {1.4 * std::sin(3.3 * t), 1.3 * std::sin(2.7 * t), 1.9 * std::sin(4.1 * t)},
                {0.03 * std::sin(2.1 * t), reach * std::sin(phase) * std::sin(1.3 * t), reach * std::sin(phase) * std::cos(1.3 * t)});
          },
          count);
    }
    scenes::RandomBits random(seed + std::uint32_t(walls_count));
    run(
        tool, walls_count, gap, ticks_to_run(600),
        [&](int i) {
          const Vector3<double> jitter = 0.01 * random.direction();
          const double side = i % 2 == 0 ? 0.03 : -0.03;
          const bool along_y = walls_count > 2 && random.unit() < 0.5;
          return Pose<double>{jitter + Vector3<double>(0, along_y ? side : 0, along_y ? 0 : side),
                              exp_rotation<double>(std::numbers::pi * random.unit() * random.direction())};
        },
        count);
  }
  BOOST_TEST_MESSAGE(count.ticks << " ticks, deepest penetration on a path " << count.deepest << " m");
  BOOST_TEST(count.crossed == 0);
  BOOST_TEST(count.penetrating == 0);
  BOOST_TEST(count.invalid == 0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_never_crosses_a_thin_wall) {
  try_to_break_out(Segment<double>({0, 0, -0.015}, {0.004, 0.001, 0.015}), 0.040, 21);
  try_to_break_out(Segment<double>({-0.009, -0.002, -0.002}, {0.009, 0.002, 0.002}), 0.006, 22);
}

BOOST_AUTO_TEST_CASE(a_box_never_crosses_a_thin_wall) {
  try_to_break_out(Box<double>({0.010, 0.006, 0.003}), 0.030, 23);
  try_to_break_out(Box<double>({0.010, 0.005, 0.005}), 0.011, 24);
  try_to_break_out(Box<double>({0.010, 0.005, 0.005}), 0.01001, 25);
  try_to_break_out(Box<double>({0.010, 0.010, 0.0001}), 0.025, 26);
}

BOOST_AUTO_TEST_CASE(a_hull_never_crosses_a_thin_wall) { try_to_break_out(scenes::pebble(5), 0.032, 27); }

BOOST_AUTO_TEST_SUITE_END()
