// The paper's narrow cavity (Fig. 10 and 11): a cube in a room that leaves it a clearance in y.
#pragma once

#include "scenes/motions.hpp"

namespace feeler::scenes {

/// The inside of a box of 12 triangles and a cube of 20 mm that turns and slides in it.
/// @param clearance  free height of the room above the cube's [m]; 0 is a perfect fit, less penetrates from
/// the start
inline Scene cavity(double clearance = 1e-3) {
  constexpr double half = 0.010;
  const Vector room(0.02, half + clearance / 2.0, 0.015);

  Scene scene;
  scene.name = "cavity";
  scene.description = "A cube in a narrow cavity: free, turning both ways, sliding.";
  scene.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    const Vector sign((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    scene.vertices.row(i) = room.cwiseProduct(sign).transpose();
  }
  scene.triangles.resize(12, 3);
  // Counter-clockwise seen from outside: the tool is behind the surface.
  scene.triangles << 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,  // x
      0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3,                 // y
      0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6;                 // z
  scene.tool = Box<double>(Vector::Constant(half));
  scene.motion = [](double t) {
    return pose_of({0.3 * std::sin(4.0 * t), 0.25 * std::sin(5.0 * t), 0.35 * std::sin(3.7 * t)},
                   {0.013 * std::sin(6.0 * t), 0.004 * std::sin(9.0 * t), 0.007 * std::sin(7.0 * t)});
  };
  scene.start = scene.motion(0.0);
  scene.closed_means_solid = false;
  scene.length = 0.010;
  return scene;
}

}  // namespace feeler::scenes
