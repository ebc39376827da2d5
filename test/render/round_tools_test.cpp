// Spheres, capsules and rounded boxes at rest, in closed form; what cannot matter follows the device; nothing penetrates.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/motions.hpp"
#include "support/rendering.hpp"
#include "support/valleys.hpp"

BOOST_AUTO_TEST_SUITE(round_tools)

using namespace feeler;
using namespace feeler::test;
using namespace feeler::test::valleys;

namespace {

constexpr double radius = 0.005;

TriangleMesh<double> mesh_of(const std::vector<Vector3<double>>& vertices, const Triangles& triangles) {
  return {scenes::points_from(vertices), triangles};
}

/// A cube of ±h, solid inside or, turned out, a room.
TriangleMesh<double> cube(double h, bool is_room) {
  std::vector<Vector3<double>> vertices;
  for (int i = 0; i < 8; ++i) vertices.emplace_back((i & 1) != 0 ? h : -h, (i & 2) != 0 ? h : -h, (i & 4) != 0 ? h : -h);
  Triangles triangles(12, 3);
  triangles << 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6;
  if (is_room) triangles.col(1).swap(triangles.col(2));
  return mesh_of(vertices, triangles);
}

const Quaternion<double> askew = exp_rotation<double>({0.3, -0.7, 0.2});

}  // namespace

BOOST_AUTO_TEST_CASE(a_sphere_in_a_groove_feels_each_wall_with_its_share) {
  for (const double slope : {0.2, 0.7, 1.3}) {
    BOOST_TEST_CONTEXT("slope " << slope) {
      const auto mesh = valley(slope);
      HapticRenderer renderer(mesh, Sphere<double>(radius), settings_about({0, 0, 0}));
      const Vector3<double> device(0.0002, 0.01, radius / std::cos(slope) - 0.003);
      const auto& tick = come_down(renderer, {device, askew}, {0, 0, 0.03});
      const Vector3<double> expected(0, 0.01, (radius + margin) / std::cos(slope));
      BOOST_TEST((tick.graphic_pose.translation - expected).norm() <= 1e-9);
      BOOST_TEST((tick.graphic_pose.rotation.coeffs() == askew.normalized().coeffs()));
      BOOST_TEST(tick.wrench.torque.isZero(0));
      const Vector3<double> force = 1000 * (expected - device);
      const double sum = force.z() / (2 * std::cos(slope)), difference = force.x() / (2 * std::sin(slope));
      BOOST_TEST(std::abs(force_along(tick, {-std::sin(slope), 0, std::cos(slope)}) - (sum - difference)) <= 1e-5);
      BOOST_TEST(std::abs(force_along(tick, {std::sin(slope), 0, std::cos(slope)}) - (sum + difference)) <= 1e-5);
      BOOST_TEST(tick.converged());
      for (const auto& contact : tick.contacts) {
        BOOST_TEST(std::abs((contact.point_world - tick.graphic_pose.translation).norm() - radius) <= 1e-12);
        BOOST_TEST(std::abs(std::abs(contact.point_world.x()) * std::tan(slope) - contact.point_world.z()) <= 3 * margin / std::cos(slope));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_sphere_in_a_corner_feels_three_walls) {
  const auto mesh = corner();
  HapticRenderer renderer(mesh, Sphere<double>(radius), settings_about({0, 0, 0}));
  const Vector3<double> device = Vector3<double>::Constant(radius) - Vector3<double>(0.001, 0.002, 0.0005);
  const auto& tick = come_down(renderer, {device, askew}, {0.02, 0.02, 0.02});
  const Vector3<double> expected = Vector3<double>::Constant(radius + margin);
  BOOST_TEST((tick.graphic_pose.translation - expected).norm() <= 1e-9);
  for (int k = 0; k < 3; ++k) BOOST_TEST(std::abs(force_along(tick, Vector3<double>::Unit(k)) - 1000 * (expected - device)[k]) <= 1e-6);
}

BOOST_AUTO_TEST_CASE(a_sphere_on_a_cube_is_as_near_to_the_device_as_the_round_of_its_faces_edges_and_corners_allows) {
  // The nearest point of the surface at distance r + margin from the cube, from a device inside it.
  constexpr double half = 0.02;
  const auto mesh = cube(half, false);
  scenes::RandomBits random(61);
  int faces = 0, edges = 0, corners = 0, converged = 0, count = 0;
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    // A device that has left the cube proper but not the sphere's room, so that there is one nearest point.
    const Vector3<double> start = 0.06 * random.direction();
    Vector3<double> on_cube = start.cwiseMax(-half).cwiseMin(half);
    Vector3<double> out = start - on_cube;
    const double depth = radius * (0.1 + 0.8 * random.unit());
    const Vector3<double> expected = on_cube + out.normalized() * (radius + margin);
    const Vector3<double> device = on_cube + out.normalized() * (radius - depth);
    const int beyond = int(out.x() != 0) + int(out.y() != 0) + int(out.z() != 0);
    (beyond == 1 ? faces : beyond == 2 ? edges : corners)++;
    // From another place, round the cube: over edges and corners.
    const Vector3<double> aside = out.unitOrthogonal() * 0.004;
    HapticRenderer renderer(mesh, Sphere<double>(radius), settings_about({0, 0, 0}));
    BOOST_TEST_REQUIRE((renderer.reset({start + aside, askew}) == Status::converged));
    for (int k = 1; k <= 60; ++k) {
      const double s = k / 60.0;
      renderer.update({start + (device - start) * s + aside * (1 - s), askew});
    }
    ++count;
    converged += renderer.tick().converged();
    for (int k = 0; k < 10; ++k) renderer.update({device, askew});
    worst = std::max(worst, (renderer.tick().graphic_pose.translation - expected).norm());
  }
  BOOST_TEST_MESSAGE(faces << " on faces, " << edges << " on edges, " << corners << " on corners; farthest from the nearest place " << worst
                           << " m; converged in the last moving tick " << converged << " of " << count);
  BOOST_TEST(faces > 20);
  BOOST_TEST(edges > 20);
  BOOST_TEST(corners > 20);
  BOOST_TEST(worst <= 1e-8);
  BOOST_TEST(converged == count);
}

BOOST_AUTO_TEST_CASE(a_sphere_in_a_room_goes_where_the_device_goes_less_the_walls) {
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    const auto room = cube(radius + clearance / 2, true);
    HapticRenderer renderer(room, Sphere<double>(radius), settings_about({0, 0, 0}));
    BOOST_TEST_REQUIRE((renderer.reset(Pose<double>{}) == Status::converged));
    const double reach = std::max(0.0, clearance / 2 - margin);
    double worst = 0;
    for (int i = 0; i <= 400; ++i) {
      const double t = i * 1e-3;
      const Vector3<double> device(0.004 * std::sin(9 * t), 0.003 * std::sin(17 * t), 0.6 * clearance * std::sin(31 * t));
      const auto& tick = renderer.update({device, exp_rotation<double>({10 * t, -20 * t, 0})});
      const Vector3<double> expected = device.cwiseMax(-reach).cwiseMin(reach);
      worst = std::max(worst, (tick.graphic_pose.translation - expected).lpNorm<Eigen::Infinity>());
    }
    BOOST_TEST_MESSAGE("clearance " << clearance << ": off by at most " << worst << " m");
    // A wall that is approached slowly is seen when it is nearer than the margin.
    BOOST_TEST(worst <= (clearance > 0 ? margin : no_clearance_depth));
  }
}

BOOST_AUTO_TEST_CASE(a_sphere_between_two_plates_without_clearance_slides_freely_and_stays_put_across) {
  std::vector<Vector3<double>> vertices;
  for (const double z : {-radius, radius})
    for (const auto& [x, y] : {std::pair{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}) vertices.emplace_back(x, y, z);
  const auto plates = mesh_of(vertices, Triangles{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}});
  const Sphere<double> ball(radius);
  const Witness witness(scenes::points_from(vertices), Triangles{{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}}, ball);
  HapticRenderer renderer(plates, ball, settings_about({0, 0, 0}));
  BOOST_TEST_REQUIRE((renderer.reset(Pose<double>{}) == Status::converged));
  double worst_free = 0, worst_across = 0, deepest = 0;
  int unconverged = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i * 1e-3;
    const Vector3<double> device(0.03 * std::sin(7 * t), 0.02 * std::sin(11 * t), 0.004 * std::sin(5 * t));
    const Pose<double> from = renderer.tick().graphic_pose;
    const auto& tick = renderer.update({device, exp_rotation<double>({9 * t, 30 * t, -3 * t})});
    worst_free = std::max(worst_free, (tick.graphic_pose.translation - device).head<2>().norm());
    worst_across = std::max(worst_across, std::abs(tick.graphic_pose.translation.z()));
    deepest = std::max(deepest, witness.depth_on_way(from, tick, 5));
    unconverged += !tick.converged();
  }
  // It starts as well beside the diagonal of the plates by a hair.
  for (const double aside : {1e-11, 1e-10, 1e-9, 1e-8}) {
    HapticRenderer beside(plates, ball, settings_about({0, 0, 0}));
    BOOST_TEST((beside.reset({{aside, 0, 0}, Quaternion<double>::Identity()}) == Status::converged));
    const auto& tick = beside.update({{0.001, -0.001, 0.001}, Quaternion<double>::Identity()});
    BOOST_TEST((tick.graphic_pose.translation - Vector3<double>(0.001, -0.001, 0)).norm() <= no_clearance_depth);
  }
  BOOST_TEST_MESSAGE("free directions off by " << worst_free << " m, across by " << worst_across << " m, deepest " << deepest << " m, unconverged "
                                               << unconverged);
  BOOST_TEST(worst_free <= 1e-9 * 0.03);
  BOOST_TEST(worst_across <= no_clearance_depth);
  BOOST_TEST(deepest <= no_clearance_depth);
  BOOST_TEST(unconverged == 0);
}

BOOST_AUTO_TEST_CASE(a_capsule_on_a_slope_lies_where_forces_and_torques_balance) {
  // In the plane of the slope's normal and the axis: both ends down, or the lower one alone.
  for (const double slope : {0.0, 0.5, 1.2}) {
    for (const double tilt : {0.0, 0.05, 0.6}) {
      BOOST_TEST_CONTEXT("slope " << slope << ", tilt " << tilt) {
        const double x = 0.1 * std::cos(slope), z = 0.1 * std::sin(slope);
        const auto mesh = mesh_of({{-x, -0.1, -z}, {x, -0.1, z}, {x, 0.1, z}, {-x, 0.1, -z}}, Triangles{{0, 1, 2}, {0, 2, 3}});
        const Vector3<double> normal(-std::sin(slope), 0, std::cos(slope));
        constexpr double half = 0.02, depth = 0.003;
        const Capsule<double> tool({{-half, 0, 0}, {half, 0, 0}}, radius);
        // The hand: tilted by `tilt` from the plane, the lower end at a depth below contact.
        const Quaternion<double> rotation = exp_rotation<double>({0, tilt - slope, 0});
        const Vector3<double> device = normal * (radius - depth + half * std::sin(tilt)) + Vector3<double>(0.003, 0.002, 0.003 * std::tan(slope));
        HapticRenderer renderer(mesh, tool, settings_about({0, 0, 0}));
        const auto& tick = come_down(renderer, {device, rotation}, 0.03 * normal, 200);
        for (int k = 0; k < 30; ++k) renderer.update({device, rotation});
        // With the tilt φ and the rise d above the slope: both ends where that has less energy, else one, at its stationary point.
        const double height = normal.dot(device);
        const auto rise_of = [&](double phi) { return std::max(0.0, radius + margin + half * std::abs(std::sin(phi)) - height); };
        double low = 0, high = tilt;  // energy ½ rise² + ½ L² (φ − tilt)² has one valley
        const auto energy_at = [&](double phi) { return rise_of(phi) * rise_of(phi) / 2 + length * length * (phi - tilt) * (phi - tilt) / 2; };
        for (int k = 0; k < 200; ++k) {
          const double a = low + (high - low) / 3, b = high - (high - low) / 3;
          (energy_at(a) < energy_at(b) ? high : low) = energy_at(a) < energy_at(b) ? b : a;
        }
        const double phi = (low + high) / 2;
        const Pose<double> expected{device + rise_of(phi) * normal, exp_rotation<double>({0, phi - slope, 0})};
        BOOST_TEST(pose_error(expected, tick.graphic_pose).at(half) <= 2e-8);
        BOOST_TEST((tick.wrench.force - normal * normal.dot(tick.wrench.force)).norm() <= 2e-5);
        BOOST_TEST(tick.converged());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_capsule_across_an_edge_turns_about_its_round) {
  // Over a ridge along y, pressed with a turn: the axis stays r + margin from the ridge.
  const auto mesh = valley(-0.9);
  const Capsule<double> tool({{-0.02, 0, 0}, {0.02, 0, 0}}, radius);
  for (const double shift : {0.0, 0.004}) {
    for (const double turn : {0.0, 0.2}) {
      BOOST_TEST_CONTEXT("shift " << shift << ", turn " << turn) {
        HapticRenderer renderer(mesh, tool, settings_about({0, 0, 0}));
        const Pose<double> haptic{{shift, 0.01, radius - 0.002}, exp_rotation<double>({0, turn, 0})};
        const auto& tick = come_down(renderer, haptic, {0, 0, 0.03}, 200);
        for (int k = 0; k < 30; ++k) renderer.update(haptic);
        // In the plane: centre (x, z), axis at an angle b below x; the least of ½|p − p_h|² + ½ L² (b − turn)² with the origin at r + margin
        // from the axis: p = s (cos b, −sin b) + (r + margin) (sin b, cos b).
        const auto place = [&](double s, double b) {
          return Vector3<double>(s * std::cos(b) + (radius + margin) * std::sin(b), 0.01, -s * std::sin(b) + (radius + margin) * std::cos(b));
        };
        const auto energy_of_angle = [&](double b) {
          const Vector3<double> along(std::cos(b), 0, -std::sin(b));
          const double s = along.dot(haptic.translation - place(0, b));
          return (place(s, b) - haptic.translation).squaredNorm() / 2 + length * length * (b - turn) * (b - turn) / 2;
        };
        double low = -0.8, high = 0.8;
        for (int k = 0; k < 300; ++k) {
          const double a = low + (high - low) / 3, b = high - (high - low) / 3;
          (energy_of_angle(a) < energy_of_angle(b) ? high : low) = energy_of_angle(a) < energy_of_angle(b) ? b : a;
        }
        const double angle = (low + high) / 2;
        const Vector3<double> along(std::cos(angle), 0, -std::sin(angle));
        const Pose<double> expected{place(along.dot(haptic.translation - place(0, angle)), angle), exp_rotation<double>({0, angle, 0})};
        BOOST_TEST(pose_error(expected, tick.graphic_pose).at(0.02) <= 5e-8);  // a valley by its values is known to 1e-8
        BOOST_TEST(tick.converged());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rounded_box_lies_on_a_slope_as_its_core_does_on_a_higher_one) {
  const Box<double> core(Vector3<double>(0.010, 0.006, 0.003));
  const RoundedBox<double> tool(core, 0.002);
  for (const double slope : {0.0, 0.6, 1.3}) {
    for (const double tilt : {0.0, 0.1, -0.6}) {
      BOOST_TEST_CONTEXT("slope " << slope << ", tilt " << tilt) {
        const double x = 0.1 * std::cos(slope), z = 0.1 * std::sin(slope);
        const Vector3<double> normal(-std::sin(slope), 0, std::cos(slope));
        const Triangles triangles{{0, 1, 2}, {0, 2, 3}};
        const std::vector<Vector3<double>> low{{-x, -0.1, -z}, {x, -0.1, z}, {x, 0.1, z}, {-x, 0.1, -z}};
        auto high = low;
        for (auto& v : high) v += 0.002 * normal;
        const auto mesh = mesh_of(low, triangles), higher = mesh_of(high, triangles);
        HapticRenderer round(mesh, tool, settings_about({0, 0, 0}));
        HapticRenderer sharp(higher, core, settings_about({0, 0, 0}));
        const Pose<double> haptic{normal * 0.003 + Vector3<double>(0, 0.004, 0), exp_rotation<double>({0.1, tilt - slope, 0.2})};
        come_down(round, haptic, 0.03 * normal, 200);
        come_down(sharp, haptic, 0.03 * normal, 200);
        for (int k = 0; k < 40; ++k) round.update(haptic), sharp.update(haptic);
        BOOST_TEST(pose_error(sharp.tick().graphic_pose, round.tick().graphic_pose).at(0.012) <= 4e-8);
        BOOST_TEST(round.tick().converged());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rounded_box_hangs_over_an_edge_at_the_pose_of_least_energy) {
  // No closed form for the pose, but none nearby that the checker finds free is better.
  const auto mesh = valley(-0.9);
  const Points<double> vertices{
      {-0.1 * std::cos(0.9), -0.1, -0.1 * std::sin(0.9)}, {-0.1 * std::cos(0.9), 0.1, -0.1 * std::sin(0.9)}, {0, -0.1, 0}, {0, 0.1, 0},
      {0.1 * std::cos(0.9), -0.1, -0.1 * std::sin(0.9)},  {0.1 * std::cos(0.9), 0.1, -0.1 * std::sin(0.9)}};
  const RoundedBox<double> tool(Box<double>({0.010, 0.006, 0.003}), 0.002);
  const Witness witness(vertices, Triangles{{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}}, tool);
  scenes::RandomBits random(62);
  int better = 0, tried = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose<double> haptic{{0.003 * (2 * random.unit() - 1), 0.01 * random.unit(), 0.002 + 0.002 * random.unit()},
                              exp_rotation<double>(0.8 * random.unit() * random.direction())};
    HapticRenderer renderer(mesh, tool, settings_about({0, 0, 0}));
    const auto& tick = come_down(renderer, haptic, {0, 0, 0.03}, 100);
    for (int k = 0; k < 30; ++k) renderer.update(haptic);
    BOOST_TEST(tick.converged());
    BOOST_TEST(witness.depth_at(tick.graphic_pose) <= touching_depth);
    double forces = 0;
    for (const auto& contact : tick.contacts) forces += contact.force / 1000;
    for (int k = 0; k < 60; ++k) {
      const double size = std::pow(10.0, -4 - 2 * random.unit());
      Pose<double> other = tick.graphic_pose;
      other.translation += size * random.unit() * random.direction();
      other.rotation = exp_rotation<double>(size / 0.01 * random.unit() * random.direction()) * other.rotation;
      if (witness.depth_at(other) > 0) continue;
      ++tried;
      better += static_cast<double>(energy_of(tick.graphic_pose, haptic, length) - energy_of(other, haptic, length)) > forces * margin + 1e-12;
    }
  }
  BOOST_TEST_MESSAGE(tried << " free perturbations, better " << better);
  BOOST_TEST(tried > 200);
  BOOST_TEST(better == 0);
}

BOOST_AUTO_TEST_CASE(the_turns_of_a_sphere_are_those_of_the_device_bit_for_bit_and_make_no_torque) {
  const auto mesh = valley(-0.7);
  const Vector3<double> centre(0.01, -0.02, 0.03);  // of the sphere, in the tool frame
  HapticRenderer renderer(mesh, Sphere<double>(centre, radius), settings_about(centre));
  BOOST_TEST_REQUIRE((renderer.reset({Vector3<double>(0, 0, 0.02) - centre, Quaternion<double>::Identity()}) == Status::converged));
  int contact_ticks = 0;
  for (int i = 0; i < 500; ++i) {
    const double t = i * 1e-3;
    const Quaternion<double> rotation = exp_rotation<double>({9 * std::sin(5 * t), -40 * t, 3 * t});
    Quaternion<double> unnormalised = rotation;
    unnormalised.coeffs() *= 1 + std::sin(13 * t) / 2;
    const Vector3<double> device(0.01 * std::sin(9 * t), 0.01 * t, 0.004 - 0.004 * std::sin(7 * t));
    const Vector3<double> last = renderer.tick().graphic_pose * centre;
    const auto& tick = renderer.update({device - unnormalised.normalized() * centre, unnormalised});
    BOOST_TEST((tick.graphic_pose.rotation.coeffs() == unnormalised.normalized().coeffs()));
    BOOST_TEST(tick.wrench.torque.isZero(0));
    BOOST_TEST(is_valid(tick, mesh.triangle_count()));
    contact_ticks += !tick.contacts.empty();
    if (i > 20) BOOST_TEST((tick.graphic_pose * centre - last).norm() < 1e-3);
  }
  BOOST_TEST(contact_ticks > 100);
}

BOOST_AUTO_TEST_CASE(half_a_turn_that_does_not_matter_has_two_legs_that_tell_which_way_round_it_goes) {
  const auto mesh = cube(0.02, false);
  const auto check = [&](const auto& tool, const Vector3<double>& reference, bool is_about_axis) {
    scenes::RandomBits random(63);
    double longest = 0, moved = 0;
    int long_turns = 0, wrong_ends = 0;
    for (int i = 0; i < 300; ++i) {
      HapticRenderer renderer(mesh, tool, settings_about(reference));
      const Vector3<double> height(0, 0, i % 2 == 0 ? 0.1 : 0.02 + radius - 0.001);  // free, or pressed on the cube
      const Vector3<double> across = random.direction();
      const Quaternion<double> lying = is_about_axis ? exp_rotation<double>({0, 0, across.x()}) : exp_rotation<double>(across);
      const auto hand = [&](const Quaternion<double>& rotation) { return Pose<double>{height - rotation * reference, rotation}; };
      come_down(renderer, hand(lying), {0, 0, 0.05}, 40);
      const Pose<double> start = renderer.tick().graphic_pose;
      const Vector3<double> axis = is_about_axis ? Vector3<double>(lying * Vector3<double>::UnitX()) : random.direction();
      Quaternion<double> rotation = exp_rotation<double>((std::numbers::pi + 0.3 * (random.unit() - 0.5)) * axis) * lying;
      if (i % 3 == 0) rotation.coeffs() = -rotation.coeffs();
      const auto& tick = renderer.update(hand(rotation));
      const Pose<double>* from = &start;
      for (const auto& to : tick.path) {
        const WideVector turn = twist_between(*from, to).angular;
        longest = std::max(longest, static_cast<double>(turn.norm()));
        // All along the leg the core stays where it is.
        for (const double time : {0.25, 0.5, 0.75, 1.0}) {
          const Eigen::Quaternion<WideReal> on_way = rotation_by(turn * time) * checked_pose(*from).rotation;
          for (int k = 0; k < tool.vertex_count(); ++k) {
            const WideVector core = on_way * (tool.vertex(k) - reference).template cast<WideReal>();
            moved = std::max(moved, static_cast<double>((core - (start.rotation * (tool.vertex(k) - reference)).template cast<WideReal>()).norm()));
          }
        }
        from = &to;
      }
      long_turns += tick.path.size() == 2;
      wrong_ends += tick.path.empty() || !is_same(tick.path.back(), tick.graphic_pose) || pose_error(hand(rotation), tick.graphic_pose).angle > 1e-6;
    }
    BOOST_TEST_MESSAGE(long_turns << " turns of two legs, the longest leg by " << longest << " rad; the core moved by " << moved << " m");
    BOOST_TEST(longest <= 3.0001);
    BOOST_TEST(moved <= 1e-9);
    BOOST_TEST(long_turns > 250);
    BOOST_TEST(wrong_ends == 0);
  };
  check(Sphere<double>({0.01, -0.02, 0.03}, radius), {0.01, -0.02, 0.03}, false);
  check(Capsule<double>({{-0.02, 0, 0}, {0.02, 0, 0}}, radius), {0.004, 0, 0}, true);
}

BOOST_AUTO_TEST_CASE(no_leg_of_a_round_tool_turns_by_more_than_three_radians_whatever_the_hand_does) {
  const auto mesh = cube(0.02, false);
  const auto check = [&](const auto& tool, auto settings) {
    settings.maximum_iterations = 32;  // and the way has room for all legs
    HapticRenderer renderer(mesh, tool, settings);
    BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.1}, Quaternion<double>::Identity()}) == Status::converged));
    scenes::RandomBits random(64);
    Pose<double> hand{{0, 0, 0.1}, Quaternion<double>::Identity()};
    double longest = 0;
    int contact_ticks = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3<double> axis = random.direction();
      hand.rotation = exp_rotation<double>((std::numbers::pi - 0.1 * random.unit()) * axis) * hand.rotation;
      hand.translation = 0.03 * random.unit() * random.direction() + Vector3<double>(0, 0, 0.02);
      Pose<double> from = renderer.tick().graphic_pose;
      const auto& tick = renderer.update(hand);
      BOOST_TEST(is_valid(tick, mesh.triangle_count()));
      for (const auto& to : tick.path) {
        longest = std::max(longest, pose_error(from, to).angle);
        from = to;
      }
      contact_ticks += !tick.contacts.empty();
    }
    BOOST_TEST_MESSAGE("the longest leg turns by " << longest << " rad; " << contact_ticks << " contact ticks");
    BOOST_TEST(longest <= 3.0001);
    BOOST_TEST(contact_ticks > 200);
  };
  check(Sphere<double>(radius), settings_about({0, 0, 0}));
  check(Capsule<double>({{-0.02, 0, 0}, {0.02, 0, 0}}, radius), settings_about({0, 0, 0}));
  check(Segment<double>({-0.02, 0, 0}, {0.02, 0, 0}), settings_about({0.004, 0, 0}));
}

BOOST_AUTO_TEST_CASE(a_sphere_that_is_held_by_a_lever_is_refused_as_a_sphere_and_turns_as_a_compound_tool) {
  const auto mesh = cube(0.02, false);
  const Sphere<double> ball({0, 0, -0.05}, radius);
  BOOST_CHECK_EXCEPTION(HapticRenderer(mesh, ball, settings_about({0, 0, 0})), std::invalid_argument,
                        [](const auto& e) { return std::string(e.what()).find("CompoundTool") != std::string::npos; });
  // The hand is 50 mm above the ball; pressed sidewards against the cube it turns, and feels the torque of the force at the ball.
  HapticRenderer renderer(mesh, CompoundTool<Sphere<double>>({ball}), settings_about({0, 0, 0}));
  const Pose<double> haptic{{0.02 + radius - 0.002, 0, 0.05}, Quaternion<double>::Identity()};
  const auto& tick = come_down(renderer, haptic, {0.02, 0, 0});
  for (int k = 0; k < 30; ++k) renderer.update(haptic);
  BOOST_TEST(tick.converged());
  BOOST_TEST_REQUIRE(tick.contacts.size() == 1);
  const Vector3<double> centre = tick.graphic_pose * Vector3<double>(0, 0, -0.05);
  BOOST_TEST(std::abs(centre.x() - (0.02 + radius + margin)) <= 1e-9);
  const Vector3<double> torque = (centre - tick.graphic_pose.translation).cross(tick.wrench.force);
  BOOST_TEST(tick.wrench.torque.norm() > 1e-4);
  BOOST_TEST((tick.wrench.torque - torque).norm() <= 1e-6 * torque.norm());
}

BOOST_AUTO_TEST_CASE(a_line_and_a_capsule_feel_no_torque_about_their_axis_and_roll_with_the_device) {
  const auto mesh = valley(-0.7);
  const auto check = [&](const auto& tool, double least_height) {
    HapticRenderer renderer(mesh, tool, settings_about({0.004, 0, 0}));  // on the axis
    BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.03}, Quaternion<double>::Identity()}) == Status::converged));
    int contact_ticks = 0, iterations = 0;
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const double t = i * 1e-3;
      const Quaternion<double> rotation =
          exp_rotation<double>({0, 0.3 * std::sin(7 * t), 0.4 * std::sin(5 * t)}) * exp_rotation<double>({30 * std::sin(4 * t), 0, 0});
      const auto& tick = renderer.update({{0.003 * std::sin(9 * t), 0.01 * t, std::max(least_height - 0.002, 0.03 - 0.1 * t)}, rotation});
      if (tick.contacts.empty()) continue;
      ++contact_ticks;
      iterations += tick.iterations;
      const Vector3<double> axis = tick.graphic_pose.rotation * Vector3<double>::UnitX();
      // Of all turns from the device to this axis it is the shortest: about a normal of both axes.
      const WideVector turn = twist_between(Pose<double>{{}, rotation}, Pose<double>{{}, tick.graphic_pose.rotation}).angular;
      worst = std::max(worst, std::abs(static_cast<double>(turn.dot(axis.cast<WideReal>()))));
      BOOST_TEST(std::abs(tick.wrench.torque.dot(axis)) <= 1e-14);
      BOOST_TEST(is_valid(tick, mesh.triangle_count()));
    }
    BOOST_TEST_MESSAGE(contact_ticks << " contact ticks with " << double(iterations) / contact_ticks << " iterations each; roll off by at most "
                                     << worst << " rad");
    BOOST_TEST(contact_ticks > 500);
    BOOST_TEST(worst <= 1e-14);
    BOOST_TEST(iterations <= 3 * contact_ticks);
  };
  check(Segment<double>({-0.02, 0, 0}, {0.02, 0, 0}), 0);
  check(Capsule<double>({{-0.02, 0, 0}, {0.02, 0, 0}}, radius), radius);
}

BOOST_AUTO_TEST_CASE(a_line_that_is_held_beside_its_axis_turns_about_it_like_any_tool) {
  const auto mesh = cube(0.05, false);
  const Segment<double> tool({-0.02, 0.01, 0}, {0.02, 0.01, 0});
  HapticRenderer renderer(mesh, tool, settings_about({0, 0, 0}));
  const Pose<double> haptic{{0, 0, 0.049}, Quaternion<double>::Identity()};
  const auto& tick = come_down(renderer, haptic, {0, 0, 0.02});
  BOOST_TEST(tick.wrench.torque.x() > 1e-4);
  const Vector3<double> arm = tick.graphic_pose.rotation * Vector3<double>(0, 0.01, 0);
  BOOST_TEST((tick.wrench.torque - arm.cross(tick.wrench.force)).norm() <= 1e-6 * tick.wrench.torque.norm());
}

BOOST_AUTO_TEST_SUITE_END()
