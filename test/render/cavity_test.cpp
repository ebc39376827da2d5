// A cube in a narrow cavity: how far it tilts, what stays free, what it feels, and that sampling faster changes nothing.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/cavity.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(cavity)

using namespace feeler;
using namespace feeler::test;

namespace {

constexpr double half = 0.010;
constexpr double margin = 1e-6;
const Box<double> cube(Vector3<double>::Constant(half));

using CubeRenderer = HapticRenderer<Box<double>>;

struct Cavity {
  explicit Cavity(double clearance)
      : scene(scenes::cavity(clearance)), object(scene.vertices, scene.triangles), renderer(object, cube, scene.settings()) {
    BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
  }

  const Tick<double>& approach(const Pose<double>& haptic, int ticks = 60) {
    for (int i = 1; i <= ticks; ++i) {
      const double s = double(i) / ticks;
      renderer.update({s * haptic.translation, Quaternion<double>::Identity().slerp(s, haptic.rotation)});
    }
    return hold(haptic);
  }
  const Tick<double>& hold(const Pose<double>& haptic, int ticks = 20) {
    for (int i = 0; i < ticks; ++i) renderer.update(haptic);
    return renderer.tick();
  }

  scenes::Scene scene;
  TriangleMesh<double> object;
  CubeRenderer renderer;
};

/// The tilt at which a cube of half side h just fits a height of 2h + room: h (cos φ + sin φ) = h + room/2.
double tilt_that_fits(double room) {
  // sin(φ + π/4) = (1 + room/2h)/√2, as tan to lose no digits: with s = 1 + δ, φ = atan((s √(2−s²)... )) suffers, so by Newton.
  const WideReal delta = WideReal(room) / (2 * half);
  WideReal phi = delta;
  for (int i = 0; i < 60; ++i) {
    // cos φ − 1 = −2 sin²(φ/2)
    const WideReal value = std::sin(phi) - 2 * std::pow(std::sin(phi / 2), 2) - delta;
    phi -= value / (std::cos(phi) - std::sin(phi));
  }
  return static_cast<double>(phi);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_cube_tilts_in_its_cavity_as_far_as_the_clearance_lets_it) {
  for (const double clearance : {1e-3, 1e-4, 1e-5, 2e-6, 1e-6, 1e-7, 0.0}) {
    for (const int axis : {0, 2}) {
      for (const double command : {0.35, -0.35, 0.15}) {
        BOOST_TEST_CONTEXT("clearance " << clearance << ", axis " << axis << ", command " << command) {
          Cavity cavity(clearance);
          const auto& tick = cavity.approach({Vector3<double>::Zero(), exp_rotation<double>(command * Vector3<double>::Unit(axis))});
          const Vector3<double> turn = log_rotation(tick.graphic_pose.rotation);
          const double tilt = turn[axis] * (command > 0 ? 1 : -1);
          const double largest = tilt_that_fits(clearance);
          // On each side the margin is kept where there is room for it.
          const double least = clearance > 2 * margin ? tilt_that_fits(clearance - 2 * margin) : 0.0;
          BOOST_TEST(tilt <= largest + no_clearance_depth / half);
          BOOST_TEST(tilt >= least - 1e-8);
          BOOST_TEST(std::abs(turn[(axis + 1) % 3]) <= 1e-9);
          BOOST_TEST(std::abs(turn[(axis + 2) % 3]) <= 1e-9);
          BOOST_TEST(tick.graphic_pose.translation.norm() <= 1e-6);
          BOOST_TEST(tick.converged());
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(free_directions_follow_the_device_and_blocked_ones_hold) {
  for (const double clearance : {1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
    Cavity cavity(clearance);
    double worst_free = 0, worst_turn = 0, worst_blocked = 0;
    for (int i = 0; i <= 300; ++i) {
      const double t = i * 1e-3;
      // Free: x, z and the turn about y. Against a wall: y.
      const Pose<double> haptic = scenes::pose_of({0, 0.15 * std::sin(9 * t), 0}, {0.006 * std::sin(7 * t), 0.003, 0.0015 * std::sin(11 * t)});
      const auto& tick = i == 0 ? cavity.approach(haptic) : cavity.renderer.update(haptic);
      const Vector3<double>& p = tick.graphic_pose.translation;
      const Vector3<double> turn = log_rotation(tick.graphic_pose.rotation), device_turn = log_rotation(haptic.rotation);
      worst_free = std::max({worst_free, std::abs(p.x() - haptic.translation.x()), std::abs(p.z() - haptic.translation.z())});
      worst_turn = std::max(worst_turn, std::abs(turn.y() - device_turn.y()));
      worst_blocked = std::max({worst_blocked, std::abs(turn.x()) * half, std::abs(turn.z()) * half});
      BOOST_TEST(p.y() <= clearance / 2 + no_clearance_depth);
      BOOST_TEST(p.y() >= std::max(0.0, clearance / 2 - margin) - 1e-9);
      BOOST_TEST(tick.converged());
    }
    BOOST_TEST_MESSAGE("clearance " << clearance << ": free directions are off by " << worst_free << " m, " << worst_turn << " rad; blocked ones by "
                                    << worst_blocked << " m");
    BOOST_TEST(worst_free <= 1e-9 * 0.006);
    BOOST_TEST(worst_turn <= 1e-9 * 0.15);
    BOOST_TEST(worst_blocked <= 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(in_a_perfect_fit_a_tilted_device_leaves_the_turn_that_is_nearest_to_it) {
  Cavity cavity(0);
  double worst = 0;
  for (int i = 0; i <= 300; ++i) {
    const double t = i * 1e-3;
    const Pose<double> haptic = scenes::pose_of({0.3 * std::sin(4 * t), 0.25 * std::sin(9 * t), 0.35 * std::sin(3.7 * t)},
                                                {0.006 * std::sin(7 * t), 0.004 * std::sin(9 * t), 0.0015 * std::sin(11 * t)});
    const auto& tick = cavity.renderer.update(haptic);
    // The rotation about y nearest to R_h has half its angle at atan2(y, w) of the quaternion.
    const double turn = 2 * std::atan2(haptic.rotation.y(), haptic.rotation.w());
    const Pose<double> expected = scenes::pose_of({0, turn, 0}, {haptic.translation.x(), 0, haptic.translation.z()});
    worst = std::max(worst, pose_error(expected, tick.graphic_pose).at(half));
  }
  BOOST_TEST_MESSAGE("farthest from the nearest pose " << worst << " m");
  BOOST_TEST(worst <= 1e-8);
}

BOOST_AUTO_TEST_CASE(the_wrench_is_the_stiffness_times_the_pose_difference_and_the_sum_of_the_contact_forces) {
  double worst_force = 0, worst_torque = 0, worst_sum = 0, worst_torque_sum = 0;
  int contact_ticks = 0;
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    Cavity cavity(clearance);
    const auto stiffness = cavity.scene.stiffness();
    for (int i = 0; i < ticks_to_run(3000, 4); ++i) {
      const Pose<double> haptic = cavity.scene.motion(i * 1e-3);
      cavity.renderer.update(haptic);
      const auto& tick = i % 10 == 0 ? cavity.hold(haptic, 15) : cavity.renderer.tick();
      const WideTwist e = twist_between(haptic, tick.graphic_pose);
      worst_force = std::max(worst_force, (tick.wrench.force - (stiffness.translational.x() * e.linear).cast<double>()).norm());
      worst_torque = std::max(worst_torque, (tick.wrench.torque - (stiffness.rotational.x() * e.angular).cast<double>()).norm());
      // Where rounding decides which walls hold, a tick may end unconverged, a hair from where its multipliers balance.
      if (i % 10 != 0 || !tick.converged() || tick.wrench.force.norm() + tick.wrench.torque.norm() / half < 1e-6) continue;
      ++contact_ticks;
      Vector3<double> force = Vector3<double>::Zero(), torque = Vector3<double>::Zero();
      for (const auto& contact : tick.contacts) {
        force += contact.force * contact.normal_world;
        torque += contact.force * (contact.point_world - tick.graphic_pose.translation).cross(contact.normal_world);
        BOOST_TEST(contact.force >= 0);
        BOOST_TEST(std::abs(contact.normal_world.norm() - 1) <= 1e-14);
        // The point lies on the tool, and no farther from the triangle than the margin.
        const Vector3<double> local = tick.graphic_pose.rotation.conjugate() * (contact.point_world - tick.graphic_pose.translation);
        BOOST_TEST(std::abs(local.cwiseAbs().maxCoeff() - half) <= 3 * margin);
        const Vector3<double> corner = cavity.object.corners(contact.triangle).col(0);
        const Vector3<double> n = cavity.object.normal(contact.triangle);
        BOOST_TEST(std::abs(n.dot(contact.point_world - corner)) <= 3 * margin);
      }
      worst_sum = std::max(worst_sum, (force - tick.wrench.force).norm());
      worst_torque_sum = std::max(worst_torque_sum, (torque - tick.wrench.torque).norm());
    }
  }
  BOOST_TEST_MESSAGE(contact_ticks << " held contact ticks; wrench off its formula by " << worst_force << " N, " << worst_torque
                                   << " N m; off the sum of contacts by " << worst_sum << " N, " << worst_torque_sum << " N m");
  BOOST_TEST(contact_ticks > 50);
  BOOST_TEST(worst_force <= 1e-11);
  BOOST_TEST(worst_torque <= 1e-13);
  BOOST_TEST(worst_sum <= 1e-5);
  BOOST_TEST(worst_torque_sum <= 1e-7);
}

BOOST_AUTO_TEST_CASE(an_anisotropic_torque_is_the_gradient_of_the_stiffness_energy) {
  Cavity cavity(1e-3);
  auto settings = cavity.scene.settings();
  settings.stiffness = {{800, 1000, 1200}, {0.05, 0.1, 0.2}};
  CubeRenderer renderer(cavity.object, cube, settings);
  BOOST_TEST_REQUIRE((renderer.reset(cavity.scene.start) == Status::converged));
  for (int i = 0; i < 600; ++i) {
    const Pose<double> haptic = cavity.scene.motion(i * 1e-3);
    const auto& tick = renderer.update(haptic);
    if (i % 20 != 0) continue;
    const CheckedPose graphic = checked_pose(tick.graphic_pose), device = checked_pose(haptic);
    const auto energy = [&](const WideVector& moved_by, const WideVector& turned_by) {
      const WideTwist e = twist_between(CheckedPose(WideVector(device.translation + moved_by), rotation_by(turned_by) * device.rotation), graphic);
      return (e.linear.dot(settings.stiffness.translational.cast<WideReal>().cwiseProduct(e.linear)) +
              e.angular.dot(settings.stiffness.rotational.cast<WideReal>().cwiseProduct(e.angular))) /
             2;
    };
    constexpr WideReal step = 1e-6L;
    for (int k = 0; k < 3; ++k) {
      const WideVector d = step * WideVector::Unit(k), none = WideVector::Zero();
      BOOST_TEST(std::abs(tick.wrench.force[k] - static_cast<double>((energy(-d, none) - energy(d, none)) / (2 * step))) <= 1e-9);
      BOOST_TEST(std::abs(tick.wrench.torque[k] - static_cast<double>((energy(none, -d) - energy(none, d)) / (2 * step))) <= 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(sampling_ten_times_faster_gives_the_same_poses) {
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    Cavity slow(clearance), fast(clearance);
    double worst = 0;
    for (int i = 1; i < ticks_to_run(2000, 4); ++i) {
      slow.renderer.update(slow.scene.motion(i * 1e-3));
      for (int k = 9; k >= 0; --k) fast.renderer.update(slow.scene.motion(i * 1e-3 - k * 1e-4));
      worst = std::max(worst, pose_error(slow.renderer.tick().graphic_pose, fast.renderer.tick().graphic_pose).at(half));
    }
    BOOST_TEST_MESSAGE("clearance " << clearance << ": 1 kHz and 10 kHz differ by at most " << worst << " m");
    // In fits of a few margins and less, which walls have their margin depends on the way.
    BOOST_TEST(worst <= (clearance > 1e-5 ? 1e-8 : 2e-6));
  }
}

BOOST_AUTO_TEST_CASE(the_tool_never_jumps_where_the_device_does_not) {
  // A projection on a convex set never lengthens a step. Two corners of the tilted cube that push with forces λ add a curvature of −λh to
  // the metric's L², which lengthens steps of the tilt by 1/(1 − 2λh/L²): 3 in the cavity of 1 mm. At ten times the rate a jump would be
  // ten times that. Steps are from one converged tick to the next: after one that is late the tool catches up.
  for (const double clearance : {1e-3, 1e-5, 0.0}) {
    for (const double rate : {1e3, 1e4}) {
      Cavity cavity(clearance);
      const double length = cavity.scene.length;
      double worst = 0, worst_wrench = 0;
      int late = 0;
      Pose<double> last = cavity.scene.start, last_haptic = last;
      Wrench<double> last_wrench;
      for (int i = 1; i < ticks_to_run(int(2 * rate), 8); ++i) {
        const Pose<double> haptic = cavity.scene.motion(i / rate);
        const auto& tick = cavity.renderer.update(haptic);
        late += !tick.converged();
        if (!tick.converged()) continue;
        const auto size = [&](const WideTwist& e) {
          return static_cast<double>(std::sqrt(e.linear.squaredNorm() + length * length * e.angular.squaredNorm()));
        };
        const double device = size(twist_between(last_haptic, haptic));
        worst = std::max(worst, size(twist_between(last, tick.graphic_pose)) / device);
        worst_wrench = std::max(worst_wrench, (tick.wrench.force - last_wrench.force).norm() / (1000 * device));
        last = tick.graphic_pose, last_haptic = haptic, last_wrench = tick.wrench;
      }
      BOOST_TEST_MESSAGE("clearance " << clearance << ", " << rate << " Hz: largest step of the tool per step of the device " << worst
                                      << ", of the force " << worst_wrench << "; late ticks " << late);
      BOOST_TEST(worst <= (clearance > 1e-4 ? 4.0 : 1.1));
      BOOST_TEST(worst_wrench <= (clearance > 1e-4 ? 3.0 : 1.1));
      BOOST_TEST(late <= 2e-3 * rate);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
