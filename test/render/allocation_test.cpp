// A tick allocates nothing, and the count would show it.
#include <boost/test/unit_test.hpp>

#include <cstdint>

#include "feeler/render/wrench_derivative.hpp"
#include "scenes/cavity.hpp"
#include "scenes/spline.hpp"
#include "support/tick_allocations.hpp"

BOOST_AUTO_TEST_SUITE(allocation)

using namespace feeler;
using namespace feeler::test;

#if FEELER_TEST_COUNTS_ALLOCATIONS
BOOST_AUTO_TEST_CASE(a_tick_allocates_nothing_and_the_count_would_show_it) {
  in_scenes_whose_ticks_allocate_nothing([](const auto& object, const auto& tool, const auto& scene) {
    BOOST_TEST(contact_ticks_without_allocation(HapticRenderer(object, tool, scene.settings()), scene, 1500) > 20);
  });
}

BOOST_AUTO_TEST_CASE(a_tick_of_a_tool_of_several_pieces_allocates_nothing) {
  const auto scene = scenes::spline(2e-4);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer renderer(object, CompoundTool<ConvexPolytope<double>>::hulls_of(scene.pieces), scene.settings());
  renderer.reset(scene.start);
  int contact_ticks = 0;
  const auto allocations = feeler_test::allocations_during([&] {
    for (int i = 1; i <= 1000; ++i) contact_ticks += renderer.update(scene.motion(i * 1e-3)).contacts.empty() ? 0 : 1;
  });
  BOOST_TEST(allocations == 0);
  BOOST_TEST(contact_ticks > 100);
}

BOOST_AUTO_TEST_CASE(asking_for_the_derivative_of_the_wrench_allocates_nothing) {
  const auto scene = scenes::cavity(1e-3);
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer renderer(object, std::get<Box<double>>(scene.tool), scene.settings());
  renderer.reset(scene.start);
  double sum = 0;
  std::int64_t allocations = 0;
  for (int i = 0; i < 500; ++i) {
    renderer.update(scene.motion(i * 1e-3));
    allocations += feeler_test::allocations_during([&] { sum += wrench_derivative(renderer).matrix.sum(); });
  }
  BOOST_TEST(allocations == 0);
  BOOST_TEST(sum < 0);
}
#else
BOOST_AUTO_TEST_CASE(allocations_are_not_counted_with_a_sanitizer) { BOOST_TEST_MESSAGE("skipped: the sanitizer has a malloc of its own"); }
#endif

BOOST_AUTO_TEST_SUITE_END()
