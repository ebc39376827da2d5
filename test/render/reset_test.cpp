// Nothing of what a renderer did before a reset is left after it.
#include <boost/test/unit_test.hpp>

#include "scenes/cavity.hpp"
#include "scenes/spline.hpp"
#include "scenes/steps.hpp"
#include "scenes/terrain.hpp"
#include "support/rendering.hpp"

BOOST_AUTO_TEST_SUITE(reset)

using namespace feeler;
using namespace feeler::test;

namespace {

/// Ticks in which a renderer that was used and reset differs from a new one, in any bit of the pose or in its work.
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

}  // namespace

BOOST_AUTO_TEST_CASE(a_renderer_that_is_reset_does_what_a_new_one_does) {
  for (const auto& scene : {scenes::cavity(1e-5), scenes::steps(), scenes::steps_with_prism(), scenes::terrain(71)}) {
    with_tool_of(scene, [&](const auto& tool) { BOOST_TEST(ticks_that_differ(scene, tool) == 0, scene.name); });
  }
  const auto scene = scenes::spline(2e-5);
  BOOST_TEST(ticks_that_differ(scene, CompoundTool<ConvexPolytope<double>>::hulls_of(scene.pieces)) == 0, scene.name);
}

BOOST_AUTO_TEST_SUITE_END()
