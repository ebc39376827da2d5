// A peg and its hole from mesh files: the hand finds the hole, pushes the peg in and pulls it out.
#pragma once

#include <utility>

#include "scenes/motions.hpp"

namespace feeler::scenes {

/// @param vertices, triangles  the hole, its axis z and its mouth at the top [m]
/// @param peg                  points of the peg in the place where it sits in the hole [m]
inline Scene peg(Points<double> vertices, Triangles triangles, const Points<double>& peg) {
  Scene scene;
  scene.name = "peg";
  scene.description = "A peg slides into its hole and out again.";
  scene.vertices = std::move(vertices);
  scene.triangles = std::move(triangles);
  const Vector low = peg.colwise().minCoeff().transpose(), high = peg.colwise().maxCoeff().transpose();
  const Vector centre = (low + high) / 2.0;
  const double half_length = (high - low).z() / 2.0;
  scene.tool = ConvexPolytope<double>::hull_of(peg.rowwise() - centre.transpose());
  const double top = scene.vertices.col(2).maxCoeff();
  scene.motion = [=](double t) {
    const double down = 0.5 * (1.0 - std::cos(1.5 * t));
    const double z = top + half_length + 0.002 - 0.009 * down;
    return pose_of({0.05 * std::sin(4.1 * t), 0.05 * std::sin(3.3 * t), 0.05 * std::sin(5.0 * t)},
                   {centre.x() + 0.001 * std::sin(6.0 * t), centre.y() + 0.001 * std::sin(7.0 * t), z});
  };
  scene.start = scene.motion(0.0);
  scene.tip = Vector(0.0, 0.0, -half_length);
  scene.length = half_length / 2.0;
  return scene;
}

}  // namespace feeler::scenes
