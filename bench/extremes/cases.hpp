// The battery of extremes: scenes, hands and numbers at the ends of what a renderer may be given.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/player.hpp"

namespace feeler::extremes {

using study::StudyScene;

/// What is expected of a case.
enum class Outcome {
  rendered,  ///< accepted; no penetration, and at rest in the nearest pose where there is a proved one
  free,      ///< accepted; no penetration, whatever the pose
  refused,   ///< with a sentence, when the renderer is made or reset
  either,    ///< refused with a sentence, or rendered: it depends on the scalar
};

struct Case {
  std::string group, name;
  std::function<StudyScene()> make;
  Outcome outcome = Outcome::rendered;
  double margin = 1e-6;           ///< [m]
  double overlap_allowed = 0;     ///< [m]: 1e-11 where there is no clearance at all
  double distance_allowed = 1e-7; ///< from the nearest pose, at rest, in `double` [m]
  int ticks = 400;                ///< of the motion; then the hand is held
  std::string remark = {};        ///< why no more is expected
  /// How far a pose is from the nearest one, where a formula tells [m]; else the study's truth does.
  std::function<double(const Pose<double>& hand, const Pose<study::Wide>& pose)> off = {};
};

/// In the order of the table.
std::vector<Case> cases();

}  // namespace feeler::extremes
