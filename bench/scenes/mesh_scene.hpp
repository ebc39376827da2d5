// Any mesh and any convex tool: a hand that comes near, presses and slides around the object.
#pragma once

#include <limits>
#include <utility>

#include "scenes/rotation_between.hpp"
#include "scenes/surface_path.hpp"

namespace feeler::scenes {

/// Axis-aligned bounds of the vertices that triangles use [m].
inline Eigen::AlignedBox3d bounds(const Points<double>& vertices, const Triangles& triangles) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
    for (int k = 0; k < 3; ++k) box.extend(Vector(vertices.row(triangles(i, k)).transpose()));
  }
  return box;
}

/// How far a tool reaches along a world direction from the origin of its frame, when turned [m].
inline double reach(const Tool& tool, const Quaternion<double>& rotation, const Vector& direction) {
  const Vector direction_tool = rotation.conjugate() * direction;
  return std::visit([&](const auto& shape) { return direction_tool.dot(Vector(shape.vertex(shape.support(direction_tool)))); }, tool);
}

/// The vertex of a tool with the least z, in the tool frame [m]: with what it presses.
inline Vector lowest_vertex(const Tool& tool) {
  return std::visit([](const auto& shape) { return Vector(shape.vertex(shape.support(-Vector::UnitZ()))); }, tool);
}

/// Radius of the ball about the origin of the tool frame that holds the tool [m].
inline double radius(const Tool& tool) {
  return std::visit(
      [](const auto& shape) {
        double squared = 0.0;
        for (int i = 0; i < shape.vertex_count(); ++i) squared = std::max(squared, Vector(shape.vertex(i)).squaredNorm());
        return std::sqrt(squared);
      },
      tool);
}

/// The hand circles the centre of the object, its tool's −z axis towards it, and presses 1 to 5 mm into the
/// outermost surface.
///
/// Both are scaled to the object: a press is at most a tenth of its size, and the sweep never faster than
/// about 0.15 m/s.
/// @param vertices, triangles  the object, already in metres
/// @param tool                 with its origin inside or near it
inline Scene mesh_scene(std::string name, Points<double> vertices, Triangles triangles, Tool tool) {
  Scene scene;
  scene.name = std::move(name);
  scene.description = "The hand presses the tool on a mesh and slides around it.";
  scene.vertices = std::move(vertices);
  scene.triangles = std::move(triangles);
  scene.tool = std::move(tool);
  scene.tip = lowest_vertex(scene.tool);

  const Eigen::AlignedBox3d box = bounds(scene.vertices, scene.triangles);
  const Vector centre = box.center();
  const double size = box.sizes().maxCoeff();
  const double outside = box.sizes().norm() / 2.0;
  const double press = std::min(1.0, size / 0.05);
  const double pace = std::min(1.0, 0.12 / (size + radius(scene.tool)));

  const auto outward = [pace](double t) {
    const double theta = 1.1 * std::sin(1.9 * pace * t);
    const double phi = 1.3 * std::sin(1.3 * pace * t);
    return Vector(std::sin(theta) * std::cos(phi), std::sin(phi), std::cos(theta) * std::cos(phi));
  };
  const SurfacePath surface(scene.vertices, scene.triangles, [=](double t) { return Ray{centre, outward(t)}; }, outside, 10.0);

  scene.motion = [=, tool_copy = scene.tool](double t) {
    const double s = surface.folded(t);
    const Vector direction = outward(s);
    const Vector wobble(0.3 * std::sin(3.0 * t), 0.3 * std::sin(4.0 * t), 0.8 * std::sin(2.0 * t));
    const Quaternion<double> rotation = exp_rotation(wobble) * rotation_between(Vector::UnitZ(), direction);
    const double depth = press * (0.003 + 0.002 * std::sin(7.0 * t));
    const double pressed = surface(s) - depth;
    const double away = outside + 0.005;
    const double a = approach(t);
    const double share = a * a * (3.0 - 2.0 * a);
    const double distance = away + share * (pressed - away) + reach(tool_copy, rotation, -direction);
    return Pose<double>{centre + distance * direction, rotation};
  };
  scene.start = scene.motion(0.0);
  scene.length = std::max(radius(scene.tool) / 2.0, 1e-4);
  return scene;
}

}  // namespace feeler::scenes
