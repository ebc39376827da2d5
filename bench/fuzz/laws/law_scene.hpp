// A scene of which laws are known: what the tool may do freely, or the room that it may be in.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "feeler/feeler.hpp"
#include "fuzz/laws/half_spaces.hpp"
#include "fuzz/laws/surface.hpp"

namespace feeler::laws {

/// A direction that no contact can push along, or turn about.
struct FreeAxis {
  Vector direction;
  bool is_of_tool = false;  ///< in the tool frame, and turns with the graphic tool; else in the axes of the scene
  bool is_turn = false;
};

/// An object, a tool about the origin of its frame, and hands. Everything in the axes of the scene, which `placed` puts into the world.
template <class ToolType>
struct LawScene {
  using Tool = ToolType;

  std::string family;
  Surface surface;
  Tool tool;
  Settings<double> settings = {};
  Pose<double> placed = {};
  Pose<double> start = {};
  std::function<Pose<double>(std::mt19937&)> random_hand = {};  ///< where a hand may go
  double play = std::numeric_limits<double>::infinity();        ///< of a fit, on each side [m]
  double lever = 1;  ///< how much farther its farthest point may go than the play, where it tilts in the fit
  std::vector<FreeAxis> free_axes = {};
  std::vector<HalfSpace> walls = {};  ///< of a convex room; empty where there is none
  /// Whether every hand is turned so that the nearest pose is not: then the centre's is the nearest point of the room, closed in by the tool.
  bool is_turned_as_hand = false;
};

/// Turns of a ball have no energy and no meaning.
template <class Tool>
inline constexpr bool has_turns = !std::is_same_v<Tool, Sphere<double>>;

/// Largest distance of a tool's points from the origin of its frame [m].
template <class Tool>
double radius_of(const Tool& tool) {
  if constexpr (std::is_same_v<Tool, Sphere<double>>) {
    return tool.swept_radius();
  } else if constexpr (requires { tool.piece(0); }) {
    double radius = 0;
    for (int i = 0; i < tool.piece_count(); ++i) radius = std::max(radius, radius_of(tool.piece(i)));
    return radius;
  } else {
    double radius = 0;
    for (int i = 0; i < tool.vertex_count(); ++i) radius = std::max(radius, tool.vertex(i).norm());
    return radius;
  }
}

/// How far a tool at a rotation reaches from its origin against a direction [m].
template <class Tool>
Wide reach(const Tool& tool, const Eigen::Quaterniond& rotation, const WideVector& normal) {
  if constexpr (std::is_same_v<Tool, Sphere<double>>) {
    return Wide(tool.swept_radius());
  } else if constexpr (requires { tool.piece(0); }) {
    Wide farthest = -std::numeric_limits<Wide>::infinity();
    for (int i = 0; i < tool.piece_count(); ++i) farthest = std::max(farthest, reach(tool.piece(i), rotation, normal));
    return farthest;
  } else {
    const Eigen::Matrix<Wide, 3, 3> turn = rotation.cast<Wide>().normalized().toRotationMatrix();
    Wide lowest = std::numeric_limits<Wide>::infinity();
    for (int i = 0; i < tool.vertex_count(); ++i) lowest = std::min(lowest, normal.dot(turn * tool.vertex(i).template cast<Wide>()));
    return -lowest;
  }
}

/// Where the centre of a tool that turns as the hand may be: the room closed in by tool and margin.
template <class Tool>
std::vector<HalfSpace> closed_in(const std::vector<HalfSpace>& walls, const Tool& tool, const Eigen::Quaterniond& rotation, double margin) {
  std::vector<HalfSpace> spaces = walls;
  for (HalfSpace& space : spaces) space.offset += reach(tool, rotation, space.normal) + Wide(margin);
  return spaces;
}

/// How far a tool at a pose in the scene is off the walls of a convex room, less where it is through one [m].
template <class Tool>
double clearance_in(const std::vector<HalfSpace>& walls, const Tool& tool, const Pose<double>& pose) {
  Wide lowest = std::numeric_limits<Wide>::infinity();
  for (const HalfSpace& wall : walls) lowest = std::min(lowest, wall.height(pose.translation.cast<Wide>()) - reach(tool, pose.rotation, wall.normal));
  return double(lowest);
}

/// Pose of a frame that is given in another one.
inline Pose<double> compose(const Pose<double>& outer, const Pose<double>& inner) {
  return {outer * inner.translation, (outer.rotation * inner.rotation).normalized()};
}
inline Pose<double> relative_to(const Pose<double>& outer, const Pose<double>& pose) {
  const Eigen::Quaterniond back = outer.rotation.conjugate();
  return {back * Vector(pose.translation - outer.translation), (back * pose.rotation).normalized()};
}

/// Margin and metric: a third of each other than the defaults.
inline Settings<double> random_law_settings(std::mt19937& bits) {
  Settings<double> settings;
  settings.closed_means_solid = false;  // rooms face either way
  if (below(bits, 3) == 0) settings.margin = magnitude(bits, -7, -5);
  if (below(bits, 3) == 0) settings.stiffness = Stiffness<double>::uniform(1000, 1000 * magnitude(bits, -5, -3));
  return settings;
}

/// No play at all in one of six; too little for the margin on both sides in a quarter; else up to 1000 margins, a millimetre at most.
inline double random_play(std::mt19937& bits, double margin) {
  const int kind = below(bits, 12);
  return kind < 2 ? 0 : kind < 5 ? 1.1 * margin * fraction(bits) : std::min(1e-3, margin * magnitude(bits, -1, 3));
}

/// Anywhere within some decimetres; of each three one is not turned, and one not moved.
inline Pose<double> random_placement(std::mt19937& bits) {
  Pose<double> placed;
  if (below(bits, 3) > 0) placed.rotation = random_rotation(bits);
  if (below(bits, 3) > 0) placed.translation = 0.2 * random_vector(bits);
  return placed;
}

}  // namespace feeler::laws
