// The scenes of the study: those of the catalogue whose tools are polytopes, and generated fits, wedges and plates.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.hpp"
#include "study/cell.hpp"

namespace feeler::study {

/// An object, a tool of convex pieces and the motion of a hand.
struct StudyScene : scenes::Setting {
  std::vector<Points<double>> pieces;  ///< points of the hull of each [m], in the tool frame
};

/// Names in the order of tables.
std::vector<std::string> scene_names();
/// The splines alone are of several pieces: for them no other rendering than the default is compiled.
bool has_several_pieces(const std::string& scene);

/// What a hand makes of a scene's motion, by name; the first is the motion as it is.
struct HandMotion {
  std::string name;
  double speed = 1;   ///< along the scene's motion
  double tremor = 0;  ///< of the hand about it: so far along each axis [m], and 50 rad/m times that about it
};
const std::vector<HandMotion>& motions();

/// The scene of a cell: object and motion are scaled, then moved by the offset along each axis alike; coordinates are rounded to double there.
/// @param seed  of how generated surfaces are cut
/// @throws std::invalid_argument  for a scene that is none of `scene_names`, or a motion that is none of `motions`
StudyScene make_scene(const Cell& cell, unsigned seed);

}  // namespace feeler::study
