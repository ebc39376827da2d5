// A scene: an object, a tool and the motion of a hand, as tests, benchmarks and the demo share it.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/tool/box.hpp"
#include "feeler/tool/convex_polytope.hpp"
#include "feeler/tool/segment.hpp"

/// Scenes with their formulas, in SI units and world axes; nothing here reads a clock, a file or a global.
namespace feeler::scenes {

using Tool = std::variant<Segment<double>, Box<double>, ConvexPolytope<double>>;

/// Pose of the device at a time [s]; a pure function, so the same path can be sampled at any rate.
using Motion = std::function<Pose<double>(double)>;

/// An object and the motion of a hand; what the tool is, the types below add.
struct Setting {
  std::string name;                               ///< one word, usable as a folder
  std::string description;                        ///< one sentence for a report
  Points<double> vertices;                        ///< of the object [m]
  Triangles triangles;                            ///< rows of `vertices`
  Pose<double> start;                             ///< free of collision; where the renderer is reset
  Motion motion;                                  ///< of the device; motion(0) is `start`
  Vector3<double> tip = Vector3<double>::Zero();  ///< point of the tool to look at, in the tool frame [m]
  double length = 0.01;                           ///< L of the metric diag(1, 1, 1, L², L², L²) [m]
  double duration = 10.0;                         ///< of a full run [s]
  bool closed_means_solid = true;                 ///< false where the tool starts in a room whose normals point outwards
  double hardness = 1000.0;                       ///< K as a multiple of M [N/m]; figures are compared at 1000

  /// K = hardness × M.
  Stiffness<double> stiffness() const { return Stiffness<double>::uniform(hardness, hardness * length * length); }

  /// The library's defaults with the stiffness of the scene; the reference point is the origin of the tool
  /// frame.
  Settings<double> settings() const {
    Settings<double> settings;
    settings.stiffness = stiffness();
    settings.closed_means_solid = closed_means_solid;
    return settings;
  }
};

/// A scene whose tool is one convex piece.
struct Scene : Setting {
  Tool tool = Box<double>(Vector3<double>::Constant(0.01));
};

/// A scene whose tool is a union of convex pieces, each given by the points of its hull [m].
struct CompoundScene : Setting {
  std::vector<Points<double>> pieces;
};

/// Points given as a list, in the form the library takes.
inline Points<double> points_from(const std::vector<Vector3<double>>& list) {
  Points<double> points(Eigen::Index(list.size()), 3);
  for (std::size_t i = 0; i < list.size(); ++i) points.row(Eigen::Index(i)) = list[i].transpose();
  return points;
}

/// Triangles given as a list, in the form the library takes.
inline Triangles triangles_from(const std::vector<Eigen::Vector3i>& list) {
  Triangles triangles(Eigen::Index(list.size()), 3);
  for (std::size_t i = 0; i < list.size(); ++i) triangles.row(Eigen::Index(i)) = list[i].transpose();
  return triangles;
}

}  // namespace feeler::scenes
