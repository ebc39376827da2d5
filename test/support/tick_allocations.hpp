// What the ticks of a renderer take from the heap.
#pragma once

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>

#include "scenes/cavity.hpp"
#include "scenes/motions.hpp"
#include "scenes/scene.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"
#include "support/allocation_count.hpp"
#include "support/rendering.hpp"

#if FEELER_TEST_COUNTS_ALLOCATIONS
namespace feeler::test {

/// Requires of ticks along a scene's motion, with and without jumps, and of a reset and a pose that is none, that they allocate nothing.
/// @return how many of them are in contact
template <class Renderer>
int contact_ticks_without_allocation(Renderer renderer, const scenes::Scene& scene, int ticks) {
  int contact_ticks = 0;
  std::int64_t allocations = 0;
  for (const auto& motion : {scene.motion, scenes::hostile(scene.motion, 5)}) {
    BOOST_TEST((renderer.reset(scene.start) == Status::converged));
    for (int i = 0; i < ticks; ++i) {
      const Pose<double> haptic = motion(i * 1e-3);
      allocations += feeler_test::allocations_during([&] { renderer.update(haptic); });
      contact_ticks += !renderer.tick().contacts.empty();
    }
    allocations += feeler_test::allocations_during([&] {
      renderer.reset(scene.start);
      renderer.update({Vector3<double>::Constant(std::nan("")), Quaternion<double>::Identity()});
    });
  }
  BOOST_TEST(allocations == 0);
  return contact_ticks;
}

/// Calls `check(object, tool, scene)` for scenes with and without clearance, and with tools of each kind.
template <class Check>
void in_scenes_whose_ticks_allocate_nothing(const Check& check) {
  BOOST_TEST(feeler_test::count_works());
  for (const auto& scene :
       {scenes::cavity(1e-3), scenes::cavity(0), scenes::steps(), scenes::steps_with_prism(), scenes::terrain(71), scenes::sulcus()}) {
    BOOST_TEST_CONTEXT(scene.name) {
      const TriangleMesh<double> object(scene.vertices, scene.triangles);
      with_tool_of(scene, [&](const auto& tool) { check(object, tool, scene); });
    }
  }
}

}  // namespace feeler::test
#endif
