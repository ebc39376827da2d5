// Where the hand holds the tool against an object, and where it slides over an edge.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "feeler/spatial/twist.hpp"
#include "scenes/cavity.hpp"
#include "scenes/plate.hpp"
#include "scenes/steps.hpp"
#include "scenes/terrain.hpp"
#include "stability/rendering.hpp"

namespace feeler::stability {

/// A contact and how the hand comes to it.
struct Situation {
  std::string scene;  ///< by name
  std::string name;
  Pose<double> near;  ///< free of collision, within millimetres of the contact
  /// Where the hand presses: a unit direction, or a unit axis where it turns.
  Twist<double> press;
  /// How far it slides along the object while it presses [m]; nothing where it holds.
  Vector3<double> slide = Vector3<double>::Zero();

  bool turns() const noexcept { return press.angular.squaredNorm() > 0; }
  bool slides() const noexcept { return slide.squaredNorm() > 0; }
};

/// A scene by the name that its situations give.
inline scenes::Scene scene_named(const std::string& name) {
  if (name == "cavity") return scenes::cavity(1e-3);
  if (name == "steps") return scenes::steps();
  if (name == "plate") return scenes::plate();
  if (name == "terrain") return scenes::terrain(22);
  throw std::invalid_argument("there is no scene named " + name);
}

inline Twist<double> along(const Vector3<double>& direction) { return {direction.normalized(), Vector3<double>::Zero()}; }
inline Twist<double> about(const Vector3<double>& axis) { return {Vector3<double>::Zero(), axis.normalized()}; }

/// Faces, edges, corners and fits of every scene, held.
inline std::vector<Situation> holds() {
  using scenes::pose_of;
  return {
      {"cavity", "face on wall", pose_of({0, 0, 0}, {0, 0, 0}), along({0, -1, 0})},
      {"cavity", "corner", pose_of({0.005, 0.01, 0.008}, {0.0093, 0.0001, 0.0042}), along({1, 1, 1})},
      {"cavity", "turned between walls", pose_of({0, 0, 0}, {0, 0, 0}), about({0, 0, 1})},
      {"steps", "tip on face", pose_of({0, 0.1, 0}, {-0.045, 0, 0.0160}), along({0, 0, -1})},
      {"steps", "line over edge", pose_of({0, 0.9, 0}, {-0.0304, 0, 0.0130}), along({0.51, 0, -0.86})},
      {"steps", "tip in valley", pose_of({0, 0, 0}, {0.018, 0, 0.0278}), along({0, 0, -1})},
      {"steps", "turned against wall", pose_of({0, 0, 0}, {-0.0325, 0, 0.0160}), about({0, -1, 0})},
      {"plate", "face on plate", pose_of({0, 0, 0}, {0, 0, 0.0036}), along({0, 0, -1})},
      {"plate", "face on rim", pose_of({0, 0.3, 0}, {0.052, 0, 0.0050}), along({0, 0, -1})},
      {"plate", "turned on plate", pose_of({0, 0, 0}, {0, 0, 0.0034}), about({0, 1, 0})},
      {"terrain", "pebble in hollow", pose_of({0.1, 0.2, 0.3}, {0.013, 0.004, 0.0200}), along({0, 0, -1})},
  };
}

/// The hand slides over edges while it presses.
inline std::vector<Situation> slides() {
  using scenes::pose_of;
  return {
      {"cavity", "face along wall into corner", pose_of({0, 0, 0}, {0, 0, 0}), along({0, -1, 0}), {0.015, 0, 0}},
      {"steps", "tip over ridge into valley", pose_of({0, 0.1, 0}, {0.006, 0, 0.0357}), along({0, 0, -1}), {0.016, 0, 0}},
      {"plate", "face over rim", pose_of({0, 0.1, 0}, {0.035, 0, 0.0050}), along({0, 0, -1}), {0.020, 0, 0}},
      {"terrain", "pebble over bumps", pose_of({0.1, 0.2, 0.3}, {0.0, 0.0, 0.0200}), along({0, 0, -1}), {0.020, 0, 0}},
  };
}

/// The haptic pose in which the renderer first wants a wrench, from `near` along the press, to 1 µm or 1e-4
/// rad.
inline Pose<double> contact_of(const Situation& situation, const scenes::Scene& scene) {
  const auto rendering = make_rendering(Engine::feeler, scene, 1e-3);
  const double step = situation.turns() ? 1e-4 : 1e-6;
  const double reach = situation.turns() ? 0.3 : 0.012;
  rendering->reset(situation.near);
  for (int i = 1; i * step <= reach; ++i) {
    const Pose<double> pose = moved(situation.near, situation.press * (i * step));
    const Wrench<double> wrench = rendering->update(pose);
    if (wrench.force.norm() > 1e-6 || wrench.torque.norm() > 1e-8) return pose;
  }
  throw std::runtime_error("the situation \"" + situation.name + "\" meets nothing");
}

}  // namespace feeler::stability
