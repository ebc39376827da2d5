// A device that is held still: tool and wrench come to rest, to the last bit.
#pragma once

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>

#include "support/rendering.hpp"

namespace feeler::test {

/// How long a scene's hand goes on, and for how long a copy of it is held at every fiftieth tick.
struct Holding {
  int ticks, held_ticks;
  int latest = 20;  // tick after which nothing changes any more
};

/// Holds the device at every fiftieth tick of the scene's hand: twenty ticks later neither tool nor wrench changes any more.
template <RigidTool Tool>
void check_rest(const scenes::Setting& scene, const Tool& tool, const std::string& name, const Holding& holding) {
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  HapticRenderer renderer(object, tool, scene.settings());
  BOOST_TEST_REQUIRE((renderer.reset(scene.start) == Status::converged));
  int latest = 0, moving = 0, held_times = 0;
  for (int i = 0; i <= ticks_to_run(holding.ticks, 4); ++i) {
    renderer.update(scene.motion(i * 1e-3));
    if (i % 50 != 49) continue;
    // A copy is held, the hand goes on.
    auto held = renderer;
    Tick<double> last = held.tick();
    int rest = 0;
    for (int k = 1; k <= holding.held_ticks; ++k) {
      const auto& tick = held.update(scene.motion(i * 1e-3));
      if (!is_same(tick.graphic_pose, last.graphic_pose) || tick.wrench.force != last.wrench.force || tick.wrench.torque != last.wrench.torque)
        rest = k;
      last = tick;
    }
    ++held_times;
    moving += rest > holding.latest;
    latest = std::max(latest, rest);
  }
  BOOST_TEST_MESSAGE(name << ": held " << held_times << " times, at rest after at most " << latest << " ticks, not at rest after " << holding.latest
                          << ": " << moving);
  BOOST_TEST_CONTEXT(name) BOOST_TEST(moving == 0);
}

}  // namespace feeler::test
