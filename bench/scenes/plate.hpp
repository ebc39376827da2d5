// Plates of zero thickness, alone or as the walls of a tunnel, and a hand that crosses them fast:
// pop-through.
#pragma once

#include <stdexcept>

#include "scenes/motions.hpp"

namespace feeler::scenes {

/// A rectangle as two triangles: the corners centre ± a ± b.
struct Plate {
  Vector centre, a, b;  ///< [m]
};

/// Appends the plates to the object of a scene; each has two triangles and no thickness.
inline void add_plates(Setting& scene, const std::vector<Plate>& plates) {
  Eigen::Index vertex = scene.vertices.rows();
  Eigen::Index triangle = scene.triangles.rows();
  scene.vertices.conservativeResize(vertex + 4 * Eigen::Index(plates.size()), 3);
  scene.triangles.conservativeResize(triangle + 2 * Eigen::Index(plates.size()), 3);
  for (const Plate& plate : plates) {
    const int first = int(vertex);
    scene.vertices.row(vertex++) = (plate.centre - plate.a - plate.b).transpose();
    scene.vertices.row(vertex++) = (plate.centre + plate.a - plate.b).transpose();
    scene.vertices.row(vertex++) = (plate.centre + plate.a + plate.b).transpose();
    scene.vertices.row(vertex++) = (plate.centre - plate.a + plate.b).transpose();
    scene.triangles.row(triangle++) << first, first + 1, first + 2;
    scene.triangles.row(triangle++) << first, first + 2, first + 3;
  }
}

/// One plate of 0.1 m at z = 0, crossed to and fro by the device while the tool must stay above.
/// @param speed  of the crossing [m/s], 0.1 to 10
inline Scene plate(double speed = 1.0) {
  constexpr double reach = 0.02;
  Scene scene;
  scene.name = "plate";
  scene.description = "The hand crosses a plate of zero thickness at speed; the tool must not.";
  add_plates(scene, {{Vector::Zero(), Vector(0.05, 0.0, 0.0), Vector(0.0, 0.05, 0.0)}});
  scene.tool = Box<double>(Vector(0.010, 0.006, 0.003));
  scene.motion = [speed](double t) {
    return pose_of({0.5 * std::sin(2.9 * t), 0.6 * std::sin(3.1 * t), 0.7 * std::sin(1.7 * t)},
                   {0.02 * std::sin(2.3 * t), 0.02 * std::sin(1.9 * t), reach * std::cos(speed / reach * t)});
  };
  scene.start = scene.motion(0.0);
  scene.length = 0.008;
  return scene;
}

/// A tunnel along x of 2, 3 or 4 plates (floor and ceiling, then the sides), from which the device breaks out
/// in all directions.
/// @param walls      2 to 4
/// @param clearance  free space across each pair of walls [m]
/// @param speed      of the device as it crosses a wall [m/s], 0.1 to 10
inline Scene tunnel(int walls = 4, double clearance = 1e-3, double speed = 1.0) {
  if (walls < 2 || walls > 4) throw std::invalid_argument("A tunnel has 2 to 4 walls.");
  constexpr double reach = 0.015;
  const Vector half(0.010, 0.005, 0.005);
  const double y = half.y() + clearance / 2.0;
  const double z = half.z() + clearance / 2.0;
  const Vector along(0.06, 0.0, 0.0);
  const std::vector<Plate> all{{{0.0, 0.0, -z}, along, {0.0, y, 0.0}},
                               {{0.0, 0.0, z}, along, {0.0, y, 0.0}},
                               {{0.0, -y, 0.0}, along, {0.0, 0.0, z}},
                               {{0.0, y, 0.0}, along, {0.0, 0.0, z}}};
  Scene scene;
  scene.name = "tunnel-" + std::to_string(walls);
  scene.description = "The hand breaks out of a tunnel of thin plates; the tool must not.";
  add_plates(scene, {all.begin(), all.begin() + walls});
  scene.tool = Box<double>(half);
  scene.motion = [speed](double t) {
    const double phase = speed / reach * t;
    return pose_of({0.4 * std::sin(3.3 * t), 0.3 * std::sin(2.7 * t), 0.3 * std::sin(4.1 * t)},
                   {0.03 * std::sin(2.1 * t), reach * std::sin(phase) * std::sin(1.3 * t), reach * std::sin(phase) * std::cos(1.3 * t)});
  };
  scene.start = scene.motion(0.0);
  scene.length = 0.008;
  return scene;
}

}  // namespace feeler::scenes
