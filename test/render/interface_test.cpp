// The forms that users type, the statuses, and what is left behind after each of them.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "scenes/cavity.hpp"
#include "scenes/motions.hpp"
#include "scenes/plate.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(interface)

using namespace feeler;
using namespace feeler::test;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();
const Pose<double> identity;

/// A floor at z = 0 of ±1 m.
TriangleMesh<double> floor_mesh() {
  Points<double> vertices(4, 3);
  vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  return {vertices, triangles};
}

const Box<double> cube(Vector3<double>::Constant(0.01));

}  // namespace

BOOST_AUTO_TEST_CASE(the_renderer_deduces_its_type_from_object_tool_and_settings) {
  const TriangleMesh<double> object = floor_mesh();
  const Settings<double> settings;
  HapticRenderer with_settings(object, cube, settings);
  HapticRenderer without_settings(object, cube);
  const Segment<double> line({0, 0, 0}, {0, 0, 0.01});
  HapticRenderer with_line(object, line, Settings<double>{});
  auto hull = ConvexPolytope<double>::hull_of(Points<double>{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}});
  HapticRenderer with_hull(object, hull, settings);
  static_assert(std::is_same_v<decltype(with_settings), HapticRenderer<Box<double>>>);
  static_assert(std::is_same_v<decltype(without_settings), HapticRenderer<Box<double>>>);
  static_assert(std::is_same_v<decltype(with_line), HapticRenderer<Segment<double>>>);
  static_assert(std::is_same_v<decltype(with_hull), HapticRenderer<ConvexPolytope<double>>>);
  static_assert(std::is_same_v<decltype(with_hull)::Scalar, double>);
  static_assert(noexcept(with_settings.reset(identity)) && noexcept(with_settings.update(identity)));
  static_assert(!std::is_constructible_v<HapticRenderer<Box<double>>, TriangleMesh<double>&&, const Box<double>&>);
  HapticRenderer<Box<double>, DualActiveSet<double>> explicit_form(object, cube);
  BOOST_TEST((explicit_form.reset({{0, 0, 1}, Quaternion<double>::Identity()}) == Status::converged));
  BOOST_TEST((without_settings.settings().margin == Settings<double>{}.margin));
}

BOOST_AUTO_TEST_CASE(a_renderer_is_small_on_the_stack_and_copied_with_all_that_it_knows) {
  using Compound = CompoundTool<ConvexPolytope<double>>;
  static_assert(sizeof(HapticRenderer<Box<double>>) < 4096 && sizeof(HapticRenderer<Compound>) < 4096);
  const TriangleMesh<double> object = floor_mesh();
  HapticRenderer renderer(object, cube);
  BOOST_TEST((renderer.reset({.translation = {0, 0, 0.02}}) == Status::converged));
  renderer.update({.translation = {0, 0, 0.009}});
  HapticRenderer copy = renderer;
  const Pose<double> up{.translation = {0.1, 0, 0.05}}, down{.translation = {0.01, 0, 0.005}};
  renderer.update_until_converged(up, 100000);
  HapticRenderer again = copy;
  BOOST_TEST(is_same(copy.update(down).graphic_pose, again.update(down).graphic_pose));  // untouched by what the first did
  BOOST_TEST(is_same(renderer.tick().graphic_pose, up));
  const HapticRenderer moved = std::move(copy);
  BOOST_TEST(is_same(moved.tick().graphic_pose, again.tick().graphic_pose));
}

BOOST_AUTO_TEST_CASE(an_update_before_a_reset_passes_the_haptic_pose_through_with_no_wrench) {
  const TriangleMesh<double> object = floor_mesh();
  HapticRenderer renderer(object, cube);
  BOOST_TEST((renderer.tick().status == Status::not_reset));
  BOOST_TEST(is_valid(renderer.tick(), 2));
  const Pose<double> haptic{{0.1, 0.2, -0.3}, Quaternion<double>(2, 0, 2, 0)};
  const auto& tick = renderer.update(haptic);
  BOOST_TEST((tick.status == Status::not_reset));
  BOOST_TEST(is_valid(tick, 2));
  BOOST_TEST(pose_error(haptic, tick.graphic_pose).at(1) <= 1e-15);
  BOOST_TEST(tick.wrench.force.isZero(0));
  BOOST_TEST(tick.wrench.torque.isZero(0));
  BOOST_TEST(is_valid(renderer.update({Vector3<double>(not_a_number, 0, 0), Quaternion<double>::Identity()}), 2));
}

BOOST_AUTO_TEST_CASE(a_pose_that_is_not_finite_keeps_the_last_pose_and_wrench) {
  const TriangleMesh<double> object = floor_mesh();
  HapticRenderer renderer(object, cube);
  BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.02}, Quaternion<double>::Identity()}) == Status::converged));
  const Pose<double> pressed{{0.001, 0, 0.009}, Quaternion<double>::Identity()};
  for (int i = 0; i < 10; ++i) renderer.update(pressed);
  const Tick<double> before = renderer.tick();
  for (const double bad : {not_a_number, infinity, -infinity}) {
    for (int k = 0; k < 7; ++k) {
      Pose<double> pose = pressed;
      (k < 3 ? pose.translation[k] : pose.rotation.coeffs()[k - 3]) = bad;
      const auto& tick = renderer.update(pose);
      BOOST_TEST((tick.status == Status::not_finite));
      BOOST_TEST(is_valid(tick, 2));
      BOOST_TEST(is_same(tick.graphic_pose, before.graphic_pose));
      BOOST_TEST(tick.wrench.force == before.wrench.force);
      BOOST_TEST(tick.wrench.torque == before.wrench.torque);
    }
  }
  Pose<double> no_rotation = pressed;
  no_rotation.rotation.coeffs().setZero();
  BOOST_TEST((renderer.update(no_rotation).status == Status::not_finite));
  BOOST_TEST(is_same(renderer.tick().graphic_pose, before.graphic_pose));
  BOOST_TEST((renderer.update(pressed).status == Status::converged));
  // 20 mm is beyond every corner of the cube.
  BOOST_TEST(pose_error(before.graphic_pose, renderer.tick().graphic_pose).at(0.02) <= 1e-7);
}

BOOST_AUTO_TEST_CASE(a_tick_that_has_no_pose_to_go_to_has_no_path) {
  const TriangleMesh<double> object = floor_mesh();
  HapticRenderer renderer(object, cube);
  renderer.reset({{0, 0, 0.02}, Quaternion<double>::Identity()});
  for (int i = 1; i < 5; ++i) {
    const Pose<double> hand{{0.001 * i, 0, 0.02}, Quaternion<double>::Identity()};
    BOOST_TEST_REQUIRE(!renderer.update(hand).path.empty());
    BOOST_TEST(renderer.update({{not_a_number, 0, 0.02}, Quaternion<double>::Identity()}).path.empty());
    BOOST_TEST(is_same(renderer.tick().graphic_pose, hand));
  }
}

BOOST_AUTO_TEST_CASE(numbers_near_the_ends_of_the_scalar_leave_every_output_valid) {
  const TriangleMesh<double> object = floor_mesh();
  const Witness witness(Points<double>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, Triangles{{0, 1, 2}, {0, 2, 3}}, cube);
  HapticRenderer renderer(object, cube);
  BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.02}, Quaternion<double>::Identity()}) == Status::converged));
  for (const double size : {1e3, 1e9, 1e30, 1e100, 1e150, 1e160, 1e300, 1.7e308, 1e-300, 5e-324}) {
    for (const Vector3<double>& direction : {Vector3<double>(0, 0, -1), Vector3<double>(1, 1, -1), Vector3<double>(0, 0, 1)}) {
      BOOST_TEST_CONTEXT("size " << size << ", direction " << direction.transpose()) {
        BOOST_TEST(is_valid(renderer.update({size * direction, Quaternion<double>::Identity()}), 2));
        BOOST_TEST(is_valid(renderer.update({{0, 0, 0.005}, Quaternion<double>(size, size, 0, 0)}), 2));
        BOOST_TEST(witness.depth_at(renderer.tick().graphic_pose) <= touching_depth);
        BOOST_TEST(is_valid(renderer.update({{0, 0, 0.03}, Quaternion<double>::Identity()}), 2));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_device_that_comes_back_from_far_away_does_not_bring_its_rounding_into_the_object) {
  const TriangleMesh<double> object = floor_mesh();
  const Witness witness(Points<double>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, Triangles{{0, 1, 2}, {0, 2, 3}}, cube);
  Settings<double> settings;
  settings.maximum_iterations = 32;  // time to get far, and to touch the floor on the way back
  HapticRenderer renderer(object, cube, settings);
  BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.02}, Quaternion<double>::Identity()}) == Status::converged));
  scenes::RandomBits random(17);
  for (int i = 0; i < ticks_to_run(2000); ++i) {
    const double size = std::pow(10.0, 12.0 * random.unit());
    renderer.update({size * random.direction(), Quaternion<double>::Identity()});
    renderer.update({{0, 0, 0.005}, Quaternion<double>(1, 1, 0, 0)});
    BOOST_TEST(witness.depth_at(renderer.tick().graphic_pose) <= no_clearance_depth);
    renderer.update({{0, 0, 0.03}, Quaternion<double>::Identity()});
  }
}

BOOST_AUTO_TEST_CASE(a_quaternion_of_any_length_gives_the_result_of_its_unit_one) {
  const TriangleMesh<double> object = floor_mesh();
  for (const double size : {1.0 / 1024, 0.25, 2.0, 4096.0, -1.0, 3.0, 1e-3}) {
    HapticRenderer renderer(object, cube), other(object, cube);
    const Pose<double> start{{0, 0, 0.03}, Quaternion<double>::Identity()};
    renderer.reset(start);
    other.reset({start.translation, Quaternion<double>(size, 0, 0, 0)});
    for (int i = 0; i < 100; ++i) {
      Pose<double> haptic = scenes::pose_of({0.005 * i, 0.2, 0.002 * i}, {0, 0, 0.03 - 0.0003 * i});
      renderer.update(haptic);
      haptic.rotation.coeffs() *= size;
      other.update(haptic);
      BOOST_TEST(pose_error(renderer.tick().graphic_pose, other.tick().graphic_pose).at(0.02) <= 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_reset_in_penetration_is_refused_and_then_the_renderer_holds_no_pose) {
  const auto check = [](const scenes::Scene& scene, const Pose<double>& bad, const Pose<double>& good) {
    const TriangleMesh<double> object(scene.vertices, scene.triangles);
    with_tool_of(scene, [&](const auto& tool) {
      HapticRenderer renderer(object, tool, scene.settings());
      BOOST_TEST((renderer.reset(good) == Status::converged));
      BOOST_TEST((renderer.reset(bad) == Status::penetrating));
      BOOST_TEST(is_valid(renderer.tick(), object.triangle_count()));
      BOOST_TEST((renderer.tick().status == Status::penetrating));
      BOOST_TEST((renderer.update(good).status == Status::not_reset));
      BOOST_TEST(renderer.tick().wrench.force.isZero(0));
      BOOST_TEST((renderer.reset(good) == Status::converged));
      BOOST_TEST((renderer.update(good).status == Status::converged));
    });
  };
  scenes::Scene plate = scenes::plate();
  check(plate, identity, plate.start);  // through the plate
  for (const double depth : {1e-9, 1e-7, 1e-4, 0.003}) check(plate, {{0, 0, 0.003 - depth}, Quaternion<double>::Identity()}, plate.start);
  check(plate, {{0.05, 0.05, 0}, Quaternion<double>::Identity()}, plate.start);  // a corner of the plate in the tool
  plate.tool = Segment<double>({0, 0, -0.01}, {0, 0, 0.01});
  check(plate, {{0.01, 0.004, 0}, Quaternion<double>::Identity()}, plate.start);  // a line that pierces the plate
  check(scenes::cavity(), {{0, 0.0006, 0}, Quaternion<double>::Identity()}, identity);
  check(scenes::cavity(), scenes::pose_of({0.2, 0, 0}, {0, 0, 0}), identity);
  check(scenes::cavity(0), {{0, 1e-9, 0}, Quaternion<double>::Identity()}, identity);
  for (const double overlap : {1e-9, 1e-6, 1e-3}) check(scenes::cavity(-overlap), identity, {{1, 0, 0}, Quaternion<double>::Identity()});
}

BOOST_AUTO_TEST_CASE(a_reset_to_a_pose_that_is_not_finite_is_refused) {
  const TriangleMesh<double> object = floor_mesh();
  HapticRenderer renderer(object, cube);
  for (const double bad : {not_a_number, infinity}) {
    BOOST_TEST((renderer.reset({{0, 0, 1}, Quaternion<double>::Identity()}) == Status::converged));
    BOOST_TEST((renderer.reset({{0, bad, 1}, Quaternion<double>::Identity()}) == Status::not_finite));
    BOOST_TEST(is_valid(renderer.tick(), 2));
    BOOST_TEST((renderer.update({{0, 0, 1}, Quaternion<double>::Identity()}).status == Status::not_reset));
    BOOST_TEST((renderer.reset({{0, 0, 1}, Quaternion<double>(0, 0, 0, 0)}) == Status::not_finite));
    BOOST_TEST((renderer.reset({{0, 0, 1}, Quaternion<double>(1, bad, 0, 0)}) == Status::not_finite));
    BOOST_TEST(is_valid(renderer.tick(), 2));
  }
}

BOOST_AUTO_TEST_CASE(in_free_space_the_wrench_is_exactly_zero_and_the_pose_is_the_haptic_pose) {
  const TriangleMesh<double> object = floor_mesh();
  auto settings = Settings<double>{};
  for (const bool off_origin : {false, true}) {
    if (off_origin) settings.reference_point = {0.01, 0.02, -0.03};
    HapticRenderer renderer(object, cube, settings);
    BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.5}, Quaternion<double>::Identity()}) == Status::converged));
    for (int i = 0; i < 500; ++i) {
      const double t = i * 1e-3;
      const Pose<double> haptic = scenes::pose_of({std::sin(7 * t), std::sin(9 * t), 2 * std::sin(5 * t)},
                                                  {0.3 * std::sin(3 * t), 0.2 * std::sin(4 * t), 0.5 + 0.4 * std::sin(2 * t)});
      const auto& tick = renderer.update(haptic);
      BOOST_TEST((tick.status == Status::converged));
      BOOST_TEST(tick.wrench.force.isZero(0));
      BOOST_TEST(tick.wrench.torque.isZero(0));
      BOOST_TEST(tick.contacts.empty());
      BOOST_TEST(pose_error(haptic, tick.graphic_pose).at(1) <= 4e-16);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
