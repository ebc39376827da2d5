// The result does not depend on units, axes, place, the order of triangles or the frame of the tool.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "scenes/cavity.hpp"
#include "scenes/mesh_scene.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"
#include "support/closed_meshes.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(invariance)

using namespace feeler;
using namespace feeler::test;

namespace {

/// Two runs side by side, the second mapped back.
struct Difference {
  int ticks = 0, identical = 0, compared = 0;
  double largest = 0;  ///< on ticks where both converged [m]
  int apart = 0;       ///< of those, ticks more than 0.1 µm apart: at a fold, rounding decides the tick in which the tool lets go
};

/// A scene and what became of it: vertices, triangles, tool, settings and the map of poses.
struct Variant {
  Points<double> vertices;
  Triangles triangles;
  scenes::Tool tool;
  Settings<double> settings;
  std::function<Pose<double>(const Pose<double>&)> there = [](const Pose<double>& pose) { return pose; };
  std::function<Pose<double>(const Pose<double>&)> back = [](const Pose<double>& pose) { return pose; };

  explicit Variant(const scenes::Scene& scene) : vertices(scene.vertices), triangles(scene.triangles), tool(scene.tool), settings(scene.settings()) {}
};

ConvexPolytope<double> mapped_hull(const scenes::Tool& tool, const std::function<Vector3<double>(const Vector3<double>&)>& map) {
  return std::visit(
      [&](const auto& shape) {
        Points<double> points(shape.vertex_count(), 3);
        for (int i = 0; i < shape.vertex_count(); ++i) points.row(i) = map(shape.vertex(i)).transpose();
        return ConvexPolytope<double>::hull_of(points);
      },
      tool);
}

Difference difference_of(const scenes::Scene& scene, const Variant& variant, int ticks) {
  Difference difference;
  const TriangleMesh<double> object(scene.vertices, scene.triangles), other_object(variant.vertices, variant.triangles);
  std::visit(
      [&](const auto& tool) {
        using Tool = std::remove_cvref_t<decltype(tool)>;
        const double radius = scenes::radius(scene.tool);
        HapticRenderer renderer(object, tool, scene.settings());
        HapticRenderer other(other_object, std::get<Tool>(variant.tool), variant.settings);
        BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
        BOOST_TEST_REQUIRE((other.reset(variant.there(scene.start)) == Status::converged));
        for (int i = 0; i < ticks; ++i) {
          const Pose<double> haptic = scene.motion(i * 1e-3);
          renderer.update(haptic);
          other.update(variant.there(haptic));
          const Pose<double> pose = renderer.tick().graphic_pose, other_pose = variant.back(other.tick().graphic_pose);
          ++difference.ticks;
          difference.identical += is_same(pose, other_pose);
          if (!renderer.tick().converged() || !other.tick().converged()) continue;
          ++difference.compared;
          const double distance = pose_error(pose, other_pose).at(radius);
          difference.largest = std::max(difference.largest, distance);
          difference.apart += distance > 1e-7;
        }
      },
      scene.tool);
  return difference;
}

Difference report(const std::string& what, const scenes::Scene& scene, const Variant& variant, int ticks) {
  const Difference d = difference_of(scene, variant, ticks_to_run(ticks));
  BOOST_TEST_MESSAGE(scene.name << ", " << what << ": " << d.identical << " of " << d.ticks << " ticks bit-identical, largest difference "
                                << d.largest << " m on " << d.compared << " converged ticks");
  return d;
}

Variant with_scaled_lengths(const scenes::Scene& scene, const Settings<double>& settings, double s) {
  Variant variant(scene);
  variant.settings = settings;
  variant.vertices *= s;
  variant.tool = std::visit(
      [s](const auto& shape) -> scenes::Tool {
        using Tool = std::remove_cvref_t<decltype(shape)>;
        if constexpr (std::is_same_v<Tool, Box<double>>) return Box<double>(s * shape.half_extents());
        if constexpr (std::is_same_v<Tool, Segment<double>>) return Segment<double>(s * shape.vertex(0), s * shape.vertex(1));
        if constexpr (std::is_same_v<Tool, ConvexPolytope<double>>)
          return mapped_hull(shape, [s](const Vector3<double>& v) { return Vector3<double>(s * v); });
      },
      scene.tool);
  variant.settings.stiffness.rotational *= s * s;
  variant.settings.margin *= s;
  variant.settings.trust_radius *= s;
  variant.settings.step_tolerance *= s;
  variant.there = [s](const Pose<double>& pose) { return Pose<double>{s * pose.translation, pose.rotation}; };
  variant.back = [s](const Pose<double>& pose) { return Pose<double>{pose.translation / s, pose.rotation}; };
  return variant;
}

/// Whether a tick is that of a scene with all lengths scaled; a force is scaled by `s`, and a torque by its square.
bool is_scaled(const Tick<double>& tick, const Tick<double>& scaled, double s) {
  const auto is_same_pose = [s](const Pose<double>& a, const Pose<double>& b) {
    return s * a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
  };
  const auto is_same_contact = [s](const ActiveContact<double>& a, const ActiveContact<double>& b) {
    return a.triangle == b.triangle && s * a.point_world == b.point_world && a.normal_world == b.normal_world && s * a.gap == b.gap &&
           s * a.force == b.force;
  };
  return tick.status == scaled.status && tick.work == scaled.work && tick.iterations == scaled.iterations && tick.rows == scaled.rows &&
         is_same_pose(tick.graphic_pose, scaled.graphic_pose) && s * tick.wrench.force == scaled.wrench.force &&
         s * s * tick.wrench.torque == scaled.wrench.torque &&
         std::equal(tick.path.begin(), tick.path.end(), scaled.path.begin(), scaled.path.end(), is_same_pose) &&
         std::equal(tick.contacts.begin(), tick.contacts.end(), scaled.contacts.begin(), scaled.contacts.end(), is_same_contact);
}

Variant moved_rigidly(const scenes::Scene& scene, const Pose<double>& by) {
  Variant variant(scene);
  for (Eigen::Index i = 0; i < variant.vertices.rows(); ++i)
    variant.vertices.row(i) = (by * Vector3<double>(scene.vertices.row(i).transpose())).transpose();
  variant.there = [by](const Pose<double>& pose) { return Pose<double>{by * pose.translation, (by.rotation * pose.rotation).normalized()}; };
  variant.back = [by](const Pose<double>& pose) {
    return Pose<double>{by.rotation.conjugate() * (pose.translation - by.translation), (by.rotation.conjugate() * pose.rotation).normalized()};
  };
  return variant;
}

const scenes::Scene cavity_scene = scenes::cavity(1e-3);
const scenes::Scene steps_scene = scenes::steps();
const scenes::Scene terrain_scene = scenes::terrain(22);

}  // namespace

BOOST_AUTO_TEST_CASE(a_stiffness_scaled_by_a_power_of_two_scales_the_wrench_and_leaves_the_pose_alone) {
  for (const auto* scene : {&cavity_scene, &steps_scene, &terrain_scene}) {
    const TriangleMesh<double> object(scene->vertices, scene->triangles);
    with_tool_of(*scene, [&](const auto& tool) {
      auto settings = scene->settings();
      settings.stiffness.translational *= 0.25;
      settings.stiffness.rotational *= 0.25;
      HapticRenderer renderer(object, tool, scene->settings()), weak(object, tool, settings);
      BOOST_TEST_REQUIRE((renderer.reset(scene->start) == Status::converged));
      BOOST_TEST_REQUIRE((weak.reset(scene->start) == Status::converged));
      int different = 0;
      for (int i = 0; i < ticks_to_run(1500); ++i) {
        renderer.update(scene->motion(i * 1e-3));
        weak.update(scene->motion(i * 1e-3));
        different += !is_same(renderer.tick().graphic_pose, weak.tick().graphic_pose) ||
                     renderer.tick().wrench.force != 4 * weak.tick().wrench.force || renderer.tick().wrench.torque != 4 * weak.tick().wrench.torque;
      }
      BOOST_TEST(different == 0);
    });
  }
}

BOOST_AUTO_TEST_CASE(lengths_scaled_by_a_power_of_two_scale_every_tick_to_the_last_bit) {
  const feeler_test::ClosedMesh ball = feeler_test::ball(0.02, 12);
  const scenes::Scene mesh_scene = scenes::mesh_scene("ball", ball.vertices, ball.triangles, scenes::slender_probe());
  const scenes::Scene fit_scene = scenes::cavity(0);
  for (const auto* base : {&cavity_scene, &fit_scene, &steps_scene, &terrain_scene, &mesh_scene}) {
    for (const double s : {2.0, 1024.0, 1.0 / 1024}) {
      // Lengths that a renderer accepts in both sizes.
      Settings<double> settings = base->settings();
      settings.margin = std::min(settings.margin, 9e-4 / s);
      settings.step_tolerance = std::min(settings.step_tolerance, 9e-4 / s);
      settings.trust_radius = std::max(settings.trust_radius, 1.1e-6 / s);
      const Variant variant = with_scaled_lengths(*base, settings, s);
      const TriangleMesh<double> object(base->vertices, base->triangles), scaled_object(variant.vertices, variant.triangles);
      with_tool_of(*base, [&](const auto& tool) {
        using Tool = std::remove_cvref_t<decltype(tool)>;
        HapticRenderer renderer(object, tool, settings), scaled(scaled_object, std::get<Tool>(variant.tool), variant.settings);
        BOOST_TEST_REQUIRE((renderer.reset(base->start) == Status::converged));
        BOOST_TEST_REQUIRE((scaled.reset(variant.there(base->start)) == Status::converged));
        int different = 0, contacts = 0;
        for (int i = 0; i < ticks_to_run(1500); ++i) {
          renderer.update(base->motion(i * 1e-3));
          scaled.update(variant.there(base->motion(i * 1e-3)));
          different += !is_scaled(renderer.tick(), scaled.tick(), s);
          contacts += renderer.tick().contacts.size();
        }
        BOOST_TEST(different == 0, base->name << " times " << s << ": " << different << " ticks differ");
        BOOST_TEST((contacts > 0 || !runs_all_ticks));
      });
    }
  }
}

BOOST_AUTO_TEST_CASE(the_order_of_triangles_and_of_their_corners_does_not_matter) {
  for (const auto* scene : {&cavity_scene, &terrain_scene, &steps_scene}) {
    constexpr std::uint32_t seed = 61;
    BOOST_TEST_MESSAGE("seed " << seed);
    scenes::RandomBits random(seed);
    Variant variant(*scene);
    for (Eigen::Index i = variant.triangles.rows() - 1; i > 0; --i) {
      const auto k = Eigen::Index(random.unit() * double(i + 1));
      variant.triangles.row(i).swap(variant.triangles.row(k));
    }
    for (Eigen::Index i = 0; i < variant.triangles.rows(); ++i) {
      const Eigen::RowVector3i t = variant.triangles.row(i);
      const int turn = int(3 * random.unit());
      variant.triangles.row(i) << t[turn % 3], t[(turn + 1) % 3], t[(turn + 2) % 3];
    }
    const Difference d = report("triangles permuted", *scene, variant, 2000);
    if (scene == &cavity_scene) BOOST_TEST(d.largest <= 1e-8);
    BOOST_TEST(d.apart <= d.compared / 100);
  }
}

BOOST_AUTO_TEST_CASE(a_rigid_motion_of_scene_and_device_moves_the_result) {
  const Pose<double> by = scenes::pose_of({0.7, -1.9, 0.4}, {0.3, -0.2, 0.5});
  for (const auto* scene : {&cavity_scene, &terrain_scene, &steps_scene}) {
    const Difference d = report("moved rigidly", *scene, moved_rigidly(*scene, by), 2000);
    if (scene == &cavity_scene) BOOST_TEST(d.largest <= 1e-8);
    BOOST_TEST(d.apart <= d.compared / 100);
  }
}

BOOST_AUTO_TEST_CASE(a_scene_a_kilometre_away_gives_the_same_result) {
  const Pose<double> by{{1e3, -1e3, 1e3}, Quaternion<double>::Identity()};
  for (const auto* scene : {&cavity_scene, &terrain_scene}) {
    const Difference d = report("a kilometre away", *scene, moved_rigidly(*scene, by), 2000);
    if (scene == &cavity_scene) BOOST_TEST(d.largest <= 1e-8);
    BOOST_TEST(d.apart <= d.compared / 100);
  }
}

BOOST_AUTO_TEST_CASE(a_reference_point_is_the_origin_of_a_shifted_tool_frame) {
  const Vector3<double> reference(0.004, -0.003, 0.006);
  for (const auto* base : {&cavity_scene, &terrain_scene}) {
    // The scene itself with the tool as a hull about the reference point; the variant in the old frame names that point.
    scenes::Scene scene = *base;
    scene.tool = mapped_hull(base->tool, [&](const Vector3<double>& v) { return Vector3<double>(v - reference); });
    scene.motion = [motion = base->motion, reference](double t) {
      const Pose<double> pose = motion(t);
      return Pose<double>{pose * reference, pose.rotation};
    };
    scene.start = scene.motion(0);
    Variant variant(scene);
    variant.tool = mapped_hull(base->tool, [](const Vector3<double>& v) { return v; });
    variant.settings.reference_point = reference;
    variant.there = [reference](const Pose<double>& pose) { return Pose<double>{pose.translation - pose.rotation * reference, pose.rotation}; };
    variant.back = [reference](const Pose<double>& pose) { return Pose<double>{pose * reference, pose.rotation}; };
    const Difference d = report("reference point", scene, variant, 2000);
    if (base == &cavity_scene) BOOST_TEST(d.largest <= 1e-8);
    BOOST_TEST(d.apart <= d.compared / 100);
  }
}

BOOST_AUTO_TEST_SUITE_END()
