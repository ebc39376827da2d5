// The renderer in float and in long double.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/steps.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(scalar)

using namespace feeler;
using namespace feeler::test;

namespace {

/// The settings of a scene as a float holds them.
Settings<float> float_settings(const scenes::Scene& scene) {
  Settings<float> settings;
  settings.stiffness = {scene.stiffness().translational.cast<float>(), scene.stiffness().rotational.cast<float>()};
  settings.closed_means_solid = scene.closed_means_solid;
  return settings;
}

/// The same numbers in double.
Settings<double> widened(const Settings<float>& from) {
  Settings<double> settings;
  settings.stiffness = {from.stiffness.translational.cast<double>(), from.stiffness.rotational.cast<double>()};
  settings.closed_means_solid = from.closed_means_solid;
  settings.margin = double(from.margin);
  settings.trust_radius = double(from.trust_radius);
  settings.step_tolerance = double(from.step_tolerance);
  return settings;
}

/// @param far_allowed  share of converged ticks that may differ: where a local minimum vanishes, rounding decides when the tool leaves it
void check_float(const scenes::Scene& scene, const std::string& name, int ticks, double far_allowed) {
  const Points<float> vertices = scene.vertices.cast<float>();
  const Points<double> same_vertices = vertices.cast<double>();
  const TriangleMesh<float> object(vertices, scene.triangles);
  const TriangleMesh<double> same_object(same_vertices, scene.triangles);
  with_tool_of(scene, [&](const auto& shape) {
    const auto tool = shape.template cast<float>();
    const auto same_tool = tool.template cast<double>();
    const Witness witness(same_vertices, scene.triangles, same_tool);
    HapticRenderer narrow(object, tool, float_settings(scene));
    HapticRenderer wide(same_object, same_tool, widened(float_settings(scene)));
    const Pose<float> start = scene.start.template cast<float>();
    BOOST_TEST_REQUIRE((narrow.reset(start) == Status::converged));
    BOOST_TEST_REQUIRE((wide.reset(start.template cast<double>()) == Status::converged));
    double deepest_excess = -1, worst = 0;
    int invalid = 0, far = 0, compared = 0;
    double radius = 0;
    for (int i = 0; i < tool.vertex_count(); ++i) radius = std::max(radius, Vector3<double>(same_tool.vertex(i)).norm());
    for (int i = 0; i < ticks; ++i) {
      const Pose<float> haptic = scene.motion(i * 1e-3).template cast<float>();
      const Pose<float> from = narrow.tick().graphic_pose;
      const auto& tick = narrow.update(haptic);
      const auto& same = wide.update(haptic.template cast<double>());
      invalid += !is_valid(tick, object.triangle_count());
      // Rounding moves each coordinate by ε/2 of itself and turns the axes by at most 2ε: √3 |p| ε/2 + 2 ε r.
      double reach = from.translation.template cast<double>().norm();
      for (const auto& pose : tick.path) reach = std::max(reach, pose.translation.template cast<double>().norm());
      const double bound = double(std::numeric_limits<float>::epsilon()) * (reach + 2 * radius);
      deepest_excess = std::max(deepest_excess, witness.depth_on_way(from, tick, 5) / bound);
      if (!same.converged() || !tick.converged()) continue;
      ++compared;
      const double error = pose_error(same.graphic_pose, tick.graphic_pose).at(radius);
      far += error > 1e-6;
      worst = std::max(worst, error);
    }
    BOOST_TEST_MESSAGE(name << ": float and double differ by at most " << worst << " m on " << compared << " converged ticks, more than 1 um on "
                            << far << "; deepest penetration " << deepest_excess << " of the rounding of the pose");
    BOOST_TEST_CONTEXT(name) {
      BOOST_TEST(invalid == 0);
      BOOST_TEST(deepest_excess <= 1);
      BOOST_TEST(far <= far_allowed * compared);
      BOOST_TEST(compared > ticks / 2);
    }
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_float_renderer_gives_the_poses_of_a_double_one_to_a_micrometre) {
  check_float(scenes::cavity(1e-3), "cavity 1 mm", ticks_to_run(3000), 0);
  check_float(scenes::cavity(1e-5), "cavity 10 um", ticks_to_run(3000), 0);
  check_float(scenes::steps(), "steps", ticks_to_run(3000), 0.005);
  check_float(scenes::terrain(71), "terrain", ticks_to_run(2000), 0.005);
}

BOOST_AUTO_TEST_CASE(a_long_double_renderer_gives_the_poses_of_a_double_one) {
  const scenes::Scene scene = scenes::cavity(1e-3);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  const TriangleMesh<long double> wide_object(scene.vertices.cast<long double>(), scene.triangles);
  const Box<double> tool = std::get<Box<double>>(scene.tool);
  Settings<long double> settings;
  settings.closed_means_solid = scene.closed_means_solid;
  settings.stiffness = {scene.stiffness().translational.cast<long double>(), scene.stiffness().rotational.cast<long double>()};
  HapticRenderer renderer(object, tool, scene.settings());
  HapticRenderer wide(wide_object, tool.cast<long double>(), settings);
  const Witness witness(scene.vertices, scene.triangles, tool);
  BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
  BOOST_TEST_REQUIRE((wide.reset(scene.start.cast<long double>()) == Status::converged));
  double worst = 0;
  for (int i = 0; i < ticks_to_run(1000); ++i) {
    const Pose<double> haptic = scene.motion(i * 1e-3);
    const auto& tick = renderer.update(haptic);
    const Pose<long double> from = wide.tick().graphic_pose;
    const auto& wide_tick = wide.update(haptic.cast<long double>());
    BOOST_TEST(is_valid(wide_tick, 12));
    BOOST_TEST(witness.depth_on_way(from, wide_tick, 5) <= touching_depth);
    worst = std::max(worst, pose_error(tick.graphic_pose, wide_tick.graphic_pose).at(0.017));
  }
  BOOST_TEST_MESSAGE("long double and double differ by at most " << worst << " m");
  BOOST_TEST(worst <= 1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
