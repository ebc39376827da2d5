// What the ticks of a renderer take from the heap.
#pragma once

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>

#include "scenes/motions.hpp"
#include "scenes/scene.hpp"
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

}  // namespace feeler::test
#endif
