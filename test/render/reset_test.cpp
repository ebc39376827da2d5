// Where a renderer takes a tool, and that nothing of what it did before a reset is left after it.
#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/spline.hpp"
#include "scenes/steps.hpp"
#include "scenes/terrain.hpp"
#include "support/closed_meshes.hpp"
#include "support/random_geometry.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(reset)

using namespace feeler;
using namespace feeler::test;

namespace {

/// Ticks in which a renderer that was used and reset differs from a new one, in any bit of the pose or in its
/// work.
template <class Tool>
int ticks_that_differ(const scenes::Setting& scene, const Tool& tool) {
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const auto make = [&] { return HapticRenderer(object, tool, scene.settings()); };
  auto used = make(), fresh = make();
  used.reset(scene.start);
  for (int i = 1; i <= ticks_to_run(701); ++i) used.update(scene.motion(i * 1e-3));
  used.reset(scene.start);
  fresh.reset(scene.start);
  int count = 0;
  for (int i = 1; i <= ticks_to_run(3000); ++i) {
    const auto& a = used.update(scene.motion(i * 1e-3));
    const auto& b = fresh.update(scene.motion(i * 1e-3));
    count += a.work != b.work || a.path.size() != b.path.size() || !is_same(a.graphic_pose, b.graphic_pose);
  }
  return count;
}

using feeler_test::ball;
using feeler_test::block;
using feeler_test::ClosedMesh;

ClosedMesh cube(double half) { return block(Vector3<double>::Constant(-half), Vector3<double>::Constant(half)); }

/// What a reset says of a box in a mesh.
Status status_of(const ClosedMesh& mesh, const Pose<double>& pose, double half = 0.005, const Settings<double>& settings = {}) {
  const TriangleMesh<double> object(mesh.vertices, mesh.triangles);
  HapticRenderer renderer(object, Box<double>(Vector3<double>::Constant(half)), settings);
  return renderer.reset(pose);
}

const Pose<double> origin;

}  // namespace

BOOST_AUTO_TEST_CASE(a_renderer_that_is_reset_does_what_a_new_one_does) {
  for (const auto& scene : {scenes::cavity(1e-5), scenes::steps(), scenes::steps_with_prism(), scenes::terrain(71)}) {
    with_tool_of(scene, [&](const auto& tool) { BOOST_TEST(ticks_that_differ(scene, tool) == 0, scene.name); });
  }
  const auto scene = scenes::spline(2e-5);
  BOOST_TEST(ticks_that_differ(scene, CompoundTool<ConvexPolytope<double>>::hulls_of(scene.pieces)) == 0, scene.name);
}

BOOST_AUTO_TEST_CASE(a_hand_at_which_the_tool_was_at_rest_before_a_reset_is_followed_after_it) {
  const ClosedMesh mesh = cube(0.01);
  const TriangleMesh<double> object(mesh.vertices, mesh.triangles);
  const Pose<double> start{{0, 0, 0.05}, Quaternion<double>::Identity()};
  for (const double height : {0.03, 0.012}) {  // in the air, and pressed onto the cube
    const Pose<double> hand{{0, 0, height}, Quaternion<double>::Identity()};
    HapticRenderer used(object, Box<double>(Vector3<double>::Constant(0.005))), fresh(used);
    used.reset(start);
    for (int i = 0; i < 50; ++i) used.update(hand);
    BOOST_TEST_REQUIRE((used.tick().converged() && used.tick().path.empty()));
    used.reset(start);
    fresh.reset(start);
    for (int i = 0; i < 5; ++i) {
      BOOST_TEST(used.update(hand).path.size() == fresh.update(hand).path.size());
      BOOST_TEST(is_same(used.tick().graphic_pose, fresh.tick().graphic_pose));
    }
    BOOST_TEST(used.tick().graphic_pose.translation.z() < 0.04);
  }
}

BOOST_AUTO_TEST_CASE(a_tool_is_inside_where_it_is_and_not_where_it_is_held) {
  for (const double held : {-0.17, 0.0, 0.17}) {
    Settings<double> settings;
    settings.reference_point.x() = held;
    for (const double place : {-0.2, -0.03, 0.0, 0.03, 0.2}) {
      const Status expected = std::abs(place) < 0.04 ? Status::inside : Status::converged;
      BOOST_TEST((status_of(ball(0.05, 8), {{place, 0, 0}, Quaternion<double>::Identity()}, 0.005, settings) == expected));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_start_in_a_closed_solid_is_inside_and_no_force_follows) {
  const ClosedMesh mesh = ball(0.05, 8);
  const TriangleMesh<double> object(mesh.vertices, mesh.triangles);
  HapticRenderer renderer(object, Box<double>(Vector3<double>::Constant(0.005)));
  BOOST_TEST((renderer.reset({{0.1, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
  const Pose<double> deep{{0.03, 0, 0}, Quaternion<double>(2, 0, 1, 0)};
  BOOST_TEST((renderer.reset(deep) == Status::inside));
  BOOST_TEST((renderer.tick().status == Status::inside));
  BOOST_TEST(is_valid(renderer.tick(), object.triangle_count()));
  const auto& tick = renderer.update({{2, 0, 0}, Quaternion<double>::Identity()});
  BOOST_TEST((tick.status == Status::not_reset));
  BOOST_TEST(is_valid(tick, object.triangle_count()));
  BOOST_TEST(tick.wrench.force.isZero(0));
  BOOST_TEST((renderer.reset({{0.1, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
}

BOOST_AUTO_TEST_CASE(a_reset_in_a_random_pose_says_free_penetrating_or_inside_as_the_formulas_do) {
  std::mt19937 bits(11);
  const double reach = 0.005 * std::sqrt(3.0);
  std::array<int, 3> count{};
  for (int i = 0; i < 400; ++i) {
    const auto rotation = feeler_test::random_rotation(bits);
    const Vector3<double> place = feeler_test::random_vector(bits);
    const Vector3<double> off = 0.08 * feeler_test::random_vector(bits);
    const Pose<double> pose{place + rotation * off, feeler_test::random_rotation(bits)};
    // A ball of 50 mm whose facets lie beyond 49 mm, and a block.
    const double from_ball = off.norm() - 0.05, from_block = (off.cwiseAbs() - Vector3<double>(0.06, 0.05, 0.03)).maxCoeff();
    const auto check = [&](const ClosedMesh& mesh, double height, double facet) {
      const Status status = status_of(mesh.moved(rotation, place), pose);
      if (height > reach && ++count[0] > 0) BOOST_TEST((status == Status::converged));
      if (height < -reach - facet && ++count[1] > 0) BOOST_TEST((status == Status::inside));
      if (std::abs(height) < 0.005 - facet && ++count[2] > 0) BOOST_TEST((status == Status::penetrating));
    };
    check(ball(0.05, 10), from_ball, 0.001);
    if (from_block < 0) check(block({-0.06, -0.05, -0.03}, {0.06, 0.05, 0.03}), from_block, 0);
  }
  for (const int cases : count) BOOST_TEST(cases > 20);
}

BOOST_AUTO_TEST_CASE(cavities_rooms_and_open_meshes_are_free_inside) {
  BOOST_TEST((status_of(cube(0.05), origin) == Status::inside));
  BOOST_TEST((status_of(cube(0.05).with(cube(0.02).inverted()), origin) == Status::converged));  // a cavity
  BOOST_TEST((status_of(cube(0.05).with(cube(0.02).inverted()), {{0.035, 0, 0}, origin.rotation}) == Status::inside));  // its wall
  BOOST_TEST((status_of(cube(0.05).inverted(), origin) == Status::converged));  // a room
  BOOST_TEST((status_of(cube(0.05).opened(1), origin) == Status::converged));
  BOOST_TEST((status_of(ball(0.05, 6).opened(3), origin) == Status::converged));
  Settings<double> walls;
  walls.closed_means_solid = false;
  BOOST_TEST((status_of(cube(0.05), origin, 0.005, walls) == Status::converged));
  // The tool is solid too: what it surrounds it overlaps.
  BOOST_TEST((status_of(cube(0.05), origin, 0.06) == Status::penetrating));
}

BOOST_AUTO_TEST_CASE(of_several_meshes_each_is_asked_by_itself) {
  MeshAssembly<double> parts;
  const auto add = [&](const ClosedMesh& mesh, const Vector3<double>& place) { parts.add(mesh.vertices, mesh.triangles, {.translation = place}); };
  add(cube(0.02), {0, 0, 0});
  add(cube(0.02), {0.04, 0, 0});  // shares a face with the first
  add(cube(0.02).opened(2), {0.2, 0, 0});
  add(cube(0.1).opened(2), {0, 0, 0.01});  // around the first two
  const TriangleMesh<double> object = parts.mesh();
  HapticRenderer renderer(object, Box<double>(Vector3<double>::Constant(0.005)));
  const auto at = [&](double x, double z) { return renderer.reset({.translation = {x, 0, z}}); };
  BOOST_TEST((at(0, 0) == Status::inside));
  BOOST_TEST((at(0.04, 0) == Status::inside));
  BOOST_TEST((at(0.2, 0) == Status::converged));
  BOOST_TEST((at(0, 0.05) == Status::converged));
  BOOST_TEST((at(0.02, 0) == Status::penetrating));
}

BOOST_AUTO_TEST_CASE(a_compound_tool_is_inside_where_one_piece_is) {
  const ClosedMesh mesh = cube(0.05);
  const TriangleMesh<double> object(mesh.vertices, mesh.triangles);
  const std::array pieces{cube(0.005).vertices, cube(0.005).moved(origin.rotation, {0.2, 0, 0}).vertices};  // far apart
  HapticRenderer renderer(object, CompoundTool<ConvexPolytope<double>>::hulls_of(pieces));
  BOOST_TEST((renderer.reset({.translation = {0, 0, 0}}) == Status::inside));
  BOOST_TEST((renderer.reset({.translation = {-0.2, 0, 0}}) == Status::inside));
  BOOST_TEST((renderer.reset({.translation = {-0.1, 0, 0}}) == Status::converged));
  BOOST_TEST((renderer.reset({.translation = {-0.05, 0, 0}}) == Status::penetrating));
}

BOOST_AUTO_TEST_CASE(a_thin_tool_on_the_surface_is_free_and_below_it_inside) {
  const ClosedMesh mesh = cube(0.05);
  const TriangleMesh<double> object(mesh.vertices, mesh.triangles);
  HapticRenderer point(object, Point<double>(Vector3<double>::Zero()));
  for (const double depth : {-1e-3, 0.0, 1e-17, 1e-12}) BOOST_TEST((point.reset({.translation = {0.01, 0.02, 0.05 - depth}}) == Status::converged));
  for (const double depth : {1e-9, 1e-3}) BOOST_TEST((point.reset({.translation = {0.01, 0.02, 0.05 - depth}}) == Status::inside));
}

BOOST_AUTO_TEST_CASE(a_reset_at_a_graphic_pose_is_taken) {
  std::mt19937 bits(12);
  const ClosedMesh mesh = ball(0.05, 8).with(cube(0.03).moved(feeler_test::random_rotation(bits), {0.07, 0, 0}));
  const TriangleMesh<double> object(mesh.vertices, mesh.triangles);
  const auto check = [&](const auto& tool) {
    HapticRenderer renderer(object, tool), other = renderer;
    BOOST_TEST((renderer.reset({.translation = {0, 0, 0.1}}) == Status::converged));
    for (int i = 0; i < ticks_to_run(300); ++i) {
      const auto& tick = renderer.update({0.05 * feeler_test::random_vector(bits), feeler_test::random_rotation(bits)});
      BOOST_TEST((other.reset(tick.graphic_pose) == Status::converged));
    }
  };
  check(Box<double>({0.01, 0.004, 0.02}));
  check(Point<double>(Vector3<double>::Zero()));
  check(Segment<double>({0, 0, -0.02}, {0, 0, 0.02}));
}

BOOST_AUTO_TEST_SUITE_END()
