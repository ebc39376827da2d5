// The scenes of the study: those of the catalogue whose tools are polytopes, and generated fits, wedges and plates.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace feeler::study {

/// An object, a tool of convex pieces and the motion of a hand.
struct StudyScene : scenes::Setting {
  std::vector<Points<double>> pieces;  ///< points of the hull of each [m], in the tool frame
};

/// Names in the order of tables.
std::vector<std::string> scene_names();
/// The splines alone are of several pieces: for them no other rendering than the default is compiled.
bool has_several_pieces(const std::string& scene);

/// @param scale   of all lengths
/// @param offset  by which object and motion are moved, along each axis alike [m]; coordinates are rounded to double there
/// @param seed    of how generated surfaces are cut
/// @throws std::invalid_argument  for a name that is none of `scene_names`
StudyScene make_scene(const std::string& name, double scale, double offset, unsigned seed);

}  // namespace feeler::study
