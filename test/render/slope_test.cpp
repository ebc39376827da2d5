// A tool pressed on a plane: the graphic pose is the metric projection, whatever the slope and its triangulation.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <vector>

#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(slope)

using namespace feeler;
using namespace feeler::test;

namespace {

constexpr double half = 0.010;
constexpr double length = 0.008;  // of the metric
constexpr double degree = std::numbers::pi / 180;

struct Plane {
  Points<double> vertices;
  Triangles triangles;
};

/// A square of ±0.1 m through the origin, turned about y by a slope; `jitter` moves inner vertices by a part of a cell.
Plane grid_plane(double slope, int cells, double jitter, std::uint32_t seed) {
  scenes::RandomBits random(seed);
  Plane plane;
  const int columns = cells + 1;
  plane.vertices.resize(columns * columns, 3);
  plane.triangles.resize(2 * cells * cells, 3);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const bool inner = i > 0 && i < cells && j > 0 && j < cells;
      const double u = (i + (inner ? jitter * (2 * random.unit() - 1) : 0)) / cells, v = (j + (inner ? jitter * (2 * random.unit() - 1) : 0)) / cells;
      const double x = 0.2 * u - 0.1, y = 0.2 * v - 0.1;
      plane.vertices.row(j * columns + i) << x * std::cos(slope), y, x * std::sin(slope);
    }
  int row = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      if (random.unit() < 0.5) {
        plane.triangles.row(row++) << a, b, c;
        plane.triangles.row(row++) << a, c, d;
      } else {
        plane.triangles.row(row++) << a, b, d;
        plane.triangles.row(row++) << b, c, d;
      }
    }
  return plane;
}

/// The square as a fan of slivers: every triangle is 0.2 m long and from 1e-3 down to 1e-9 m wide at its short side, besides two large ones.
Plane sliver_plane(double slope) {
  Plane plane;
  std::vector<double> cuts{-0.1};
  for (double width : {1e-3, 1e-5, 1e-7, 1e-9, 1e-8, 1e-6, 1e-4}) cuts.push_back((cuts.size() == 1 ? -0.002 : cuts.back()) + width);
  cuts.push_back(0.1);
  const int count = int(cuts.size());
  plane.vertices.resize(2 * count, 3);
  plane.triangles.resize(2 * (count - 1), 3);
  for (int i = 0; i < count; ++i) {
    const double x = cuts[std::size_t(i)];
    plane.vertices.row(2 * i) << x * std::cos(slope), -0.1, x * std::sin(slope);
    plane.vertices.row(2 * i + 1) << x * std::cos(slope), 0.1, x * std::sin(slope);
    if (i == 0) continue;
    plane.triangles.row(2 * i - 2) << 2 * i - 2, 2 * i, 2 * i + 1;
    plane.triangles.row(2 * i - 1) << 2 * i - 2, 2 * i + 1, 2 * i - 1;
  }
  return plane;
}

std::vector<std::pair<const char*, Plane>> planes(double slope) {
  return {{"two triangles", grid_plane(slope, 1, 0, 1)},
          {"8 x 8", grid_plane(slope, 8, 0, 2)},
          {"random", grid_plane(slope, 13, 0.45, 3)},
          {"slivers", sliver_plane(slope)}};
}

/// Minimum of a function with one valley on [low, high], by golden section.
WideReal valley_of(const std::function<WideReal(WideReal)>& f, WideReal low, WideReal high) {
  const WideReal ratio = (std::sqrt(WideReal(5)) - 1) / 2;
  WideReal a = high - ratio * (high - low), b = low + ratio * (high - low), fa = f(a), fb = f(b);
  for (int i = 0; i < 200; ++i) {
    if (fa < fb) {
      high = b, b = a, fb = fa, a = high - ratio * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + ratio * (high - low), fb = f(b);
    }
  }
  return (low + high) / 2;
}

/// The pose nearest to a haptic pose, in the metric diag(1, L²), that keeps the margin to a plane through the origin and differs by a turn
/// about one axis: for problems that are symmetric about the plane of that axis and the normal.
template <class Tool>
CheckedPose projection_about(const Tool& tool, const Pose<double>& haptic, const WideVector& normal, const WideVector& axis, WideReal margin,
                             WideReal metric_length) {
  const CheckedPose pose = checked_pose(haptic);
  const CheckedTool checked = checked_tool(tool);
  const auto rise = [&](WideReal angle) {
    const auto rotation = rotation_by(WideVector(angle * axis)) * pose.rotation;
    WideReal lowest = std::numeric_limits<WideReal>::infinity();
    for (const WideVector& v : checked.vertices) lowest = std::min(lowest, normal.dot(pose.translation + rotation * v));
    return std::max(WideReal(0), margin - lowest);
  };
  const auto energy = [&](WideReal angle) {
    const WideReal d = rise(angle);
    return (d * d + metric_length * metric_length * angle * angle) / 2;
  };
  const WideReal angle = valley_of(energy, -1, 1);
  return {WideVector(pose.translation + rise(angle) * normal), rotation_by(WideVector(angle * axis)) * pose.rotation};
}

Settings<double> settings_of(double metric_length = length) {
  Settings<double> settings;
  settings.stiffness = Stiffness<double>::uniform(1000, 1000 * metric_length * metric_length);
  return settings;
}

template <class Renderer>
const Tick<double>& hold(Renderer& renderer, const Pose<double>& haptic, int ticks = 30) {
  for (int i = 0; i < ticks; ++i) renderer.update(haptic);
  return renderer.tick();
}

constexpr std::array<double, 8> slopes{0, 5, 10, 30, 45, 60, 80, 89};

}  // namespace

BOOST_AUTO_TEST_CASE(a_cube_dragged_over_a_slope_ends_at_the_metric_projection_and_feels_no_tangential_force) {
  double worst = 0, worst_tangential = 0;
  for (const double angle : slopes) {
    const double a = angle * degree;
    const WideVector normal(-std::sin(a), 0, std::cos(a)), axis = WideVector::UnitY();
    const Vector3<double> n = normal.cast<double>(), along(std::cos(a), 0, std::sin(a));
    for (const auto& [name, plane] : planes(a)) {
      const TriangleMesh<double> mesh(plane.vertices, plane.triangles);
      const Box<double> cube(Vector3<double>::Constant(half));
      const Witness witness(plane.vertices, plane.triangles, cube);
      for (const double tilt : {0.0, 0.1, -0.6}) {  // against the plane: face, then edge contacts
        BOOST_TEST_CONTEXT("slope " << angle << ", " << name << ", tilt " << tilt) {
          const Quaternion<double> rotation = exp_rotation<double>(Vector3<double>(0, tilt - a, 0));
          HapticRenderer renderer(mesh, cube, settings_of());
          BOOST_TEST_REQUIRE((renderer.reset({n * 0.03, rotation}) == Status::converged));
          double deepest = 0;
          Pose<double> haptic;
          for (int i = 0; i <= 130; ++i) {
            // 30 ticks down, then a drag of 10 mm along x and 5 mm along y, 3 mm deep
            const double down = std::min(1.0, i / 30.0), drag = std::max(0, i - 30) / 100.0;
            haptic = {n * (0.03 - down * (0.03 - half + 0.003)) + along * (0.010 * drag - 0.004) + Vector3<double>(0, 0.005 * drag, 0), rotation};
            const Pose<double> from = renderer.tick().graphic_pose;
            const auto& tick = renderer.update(haptic);
            deepest = std::max(deepest, witness.depth_on_way(from, tick, 5));
          }
          BOOST_TEST(deepest <= touching_depth);
          const auto& tick = hold(renderer, haptic);
          const CheckedPose expected = projection_about(cube, haptic, normal, axis, 1e-6L, length);
          const double error = pose_error(expected, tick.graphic_pose).at(half);
          const Vector3<double> tangential = tick.wrench.force - n * n.dot(tick.wrench.force);
          BOOST_TEST(error <= 2e-8);
          BOOST_TEST(tangential.norm() <= 2e-5);  // of about 3 N
          BOOST_TEST(n.dot(tick.wrench.force) > 1.0);
          BOOST_TEST(tick.converged());
          worst = std::max(worst, error);
          worst_tangential = std::max(worst_tangential, tangential.norm());
        }
      }
    }
  }
  BOOST_TEST_MESSAGE("largest distance from the projection " << worst << " m, largest tangential force " << worst_tangential << " N");
}

BOOST_AUTO_TEST_CASE(a_vertex_on_a_slope_ends_where_force_and_torque_balance) {
  constexpr std::uint32_t seed = 11;
  BOOST_TEST_MESSAGE("seed " << seed);
  scenes::RandomBits random(seed);
  double worst = 0;
  for (const double angle : slopes) {
    const double a = angle * degree;
    const WideVector normal(-std::sin(a), 0, std::cos(a));
    const Vector3<double> n = normal.cast<double>();
    for (const auto& [name, plane] : planes(a)) {
      const TriangleMesh<double> mesh(plane.vertices, plane.triangles);
      const auto tool = scenes::pebble(3);
      const CheckedTool checked = checked_tool(tool);
      for (int attempt = 0; attempt < 4; ++attempt) {
        const Pose<double> haptic{n * (0.007 + 0.002 * random.unit()) +
                                      Vector3<double>(0.01 * random.unit() * std::cos(a), 0.02 * random.unit(), 0.01 * random.unit() * std::sin(a)),
                                  exp_rotation<double>(3.0 * random.unit() * random.direction())};
        HapticRenderer renderer(mesh, tool, settings_of());
        BOOST_TEST_REQUIRE((renderer.reset({haptic.translation + n * 0.03, haptic.rotation}) == Status::converged));
        for (int i = 0; i <= 60; ++i) renderer.update({haptic.translation + n * (0.03 * (60 - i) / 60), haptic.rotation});
        const auto& tick = hold(renderer, haptic);
        // Statics of one vertex: e = λ(n, a × n/L²), by a damped fixed point from the vertex that is lowest.
        const CheckedPose from = checked_pose(haptic), found = checked_pose(tick.graphic_pose);
        const auto height = [&](const CheckedPose& p, const WideVector& v) { return normal.dot(p.translation + p.rotation * v); };
        const auto lowest = std::min_element(checked.vertices.begin(), checked.vertices.end(),
                                             [&](const auto& u, const auto& v) { return height(found, u) < height(found, v); });
        WideVector phi = WideVector::Zero();
        WideReal force = 0;
        for (int i = 0; i < 4000; ++i) {
          const WideVector arm = rotation_by(phi) * (from.rotation * *lowest);
          force = 1e-6L - normal.dot(from.translation + arm);
          phi += 0.05L * (force / (length * length) * arm.cross(normal) - phi);
        }
        const CheckedPose expected(WideVector(from.translation + force * normal), rotation_by(phi) * from.rotation);
        const bool one_vertex_holds =
            std::all_of(checked.vertices.begin(), checked.vertices.end(), [&](const auto& v) { return v == *lowest || height(expected, v) > 2e-6L; });
        if (!one_vertex_holds || !(force > 0)) continue;
        BOOST_TEST_CONTEXT("slope " << angle << ", " << name << ", attempt " << attempt) {
          const double error = pose_error(expected, tick.graphic_pose).at(0.015);
          BOOST_TEST(error <= 2e-8);
          worst = std::max(worst, error);
        }
      }
    }
  }
  BOOST_TEST_MESSAGE("largest distance from the balance " << worst << " m");
}

BOOST_AUTO_TEST_CASE(a_device_that_turns_in_place_against_a_wall_makes_the_tool_back_off) {
  const Plane plane = grid_plane(0, 4, 0, 1);
  const TriangleMesh<double> mesh(plane.vertices, plane.triangles);
  const Box<double> cube(Vector3<double>::Constant(half));
  HapticRenderer renderer(mesh, cube, settings_of());
  BOOST_TEST_REQUIRE((renderer.reset({{0, 0, half + 1e-6}, Quaternion<double>::Identity()}) == Status::converged));
  for (int i = 1; i <= 200; ++i) {
    const double angle = 0.6 * i / 200;
    const Pose<double> haptic{{0, 0, half + 1e-6}, exp_rotation<double>({angle, 0, 0})};
    renderer.update(haptic);
    if (i % 20 != 0) continue;
    const auto& tick = hold(renderer, haptic, 10);
    const CheckedPose expected = projection_about(cube, haptic, WideVector::UnitZ(), WideVector::UnitX(), 1e-6L, length);
    BOOST_TEST(pose_error(expected, tick.graphic_pose).at(half) <= 2e-8);
    BOOST_TEST(tick.graphic_pose.translation.z() > half + 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(a_metric_of_its_own_decides_the_pose_while_the_stiffness_makes_the_wrench) {
  const Plane plane = grid_plane(0, 1, 0, 1);
  const TriangleMesh<double> mesh(plane.vertices, plane.triangles);
  const Box<double> cube(Vector3<double>::Constant(half));
  auto settings = settings_of(0.02);
  settings.metric = Metric<double>::with_length(0.005);
  HapticRenderer renderer(mesh, cube, settings);
  const Pose<double> haptic{{0, 0, half - 0.001}, exp_rotation<double>({0.3, 0, 0})};
  BOOST_TEST_REQUIRE((renderer.reset({{0, 0, 0.03}, haptic.rotation}) == Status::converged));
  const auto& tick = hold(renderer, haptic);
  const CheckedPose expected = projection_about(cube, haptic, WideVector::UnitZ(), WideVector::UnitX(), 1e-6L, 0.005L);
  BOOST_TEST(pose_error(expected, tick.graphic_pose).at(half) <= 2e-8);
  const WideTwist e = twist_between(haptic, tick.graphic_pose);
  BOOST_TEST((tick.wrench.force - (1000 * e.linear).cast<double>()).norm() <= 1e-9);
  BOOST_TEST((tick.wrench.torque - (0.4 * e.angular).cast<double>()).norm() <= 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
