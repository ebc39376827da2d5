// The trajectory of a scene as one number for each of three hands, for telling whether a change of the code
// changed what it does.
#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>

#include "feeler/object/triangle_mesh.hpp"
#include "golden/bits.hpp"
#include "scenes/motions.hpp"
#include "scenes/renderers.hpp"

namespace feeler::bench {

/// How the motion of a scene is sampled.
struct Hand {
  const char* name;
  double rate;  ///< [Hz]
  int ticks;
  unsigned hostile_seed = 0;  ///< 0: as the scene says
};

/// Long enough for every scene to have come down, pressed and slid for a while.
inline constexpr std::array<Hand, 3> golden_hands{{{"1 kHz", 1e3, 6000}, {"10 kHz", 1e4, 12000}, {"hostile", 1e3, 2000, 7}}};

/// A hash of a scene for each of `golden_hands`.
using GoldenHashes = std::array<std::uint64_t, golden_hands.size()>;

/// A hash over pose, wrench, status and work of every tick, with default settings.
template <class Tool>
std::uint64_t trajectory_hash(const TriangleMesh<double>& object, const scenes::Setting& scene, const Tool& tool, const Hand& hand) {
  HapticRenderer renderer(object, tool, scene.settings());
  if (renderer.reset(scene.start) != Status::converged) throw std::runtime_error("the scene " + scene.name + " starts in penetration");
  const auto motion = hand.hostile_seed != 0 ? scenes::hostile(scene.motion, hand.hostile_seed, hand.rate) : scene.motion;
  BitHash hash;
  for (int k = 1; k <= hand.ticks; ++k) {
    const auto& tick = renderer.update(motion(double(k) / hand.rate));
    hash.add(tick.graphic_pose.translation);
    hash.add(tick.graphic_pose.rotation.coeffs());
    hash.add(tick.wrench.force);
    hash.add(tick.wrench.torque);
    hash.add(int(tick.status));
    hash.add(tick.work);
  }
  return hash.value();
}

template <class Tool>
GoldenHashes golden_hashes(const scenes::Setting& scene, const Tool& tool) {
  const TriangleMesh<double> object(scene.vertices, scene.triangles);
  GoldenHashes hashes;
  for (std::size_t i = 0; i < hashes.size(); ++i) hashes[i] = trajectory_hash(object, scene, tool, golden_hands[i]);
  return hashes;
}

}  // namespace feeler::bench
