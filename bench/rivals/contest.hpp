// One scene in which Feeler and its rivals compete: what is measured, and how.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rivals/coupled_tool.hpp"
#include "scenes/scene.hpp"
#include "support/penetration_checker.hpp"

namespace feeler::rivals {

/// How long and how carefully a contest is held.
struct ContestOptions {
  double rate = 1000.0;    ///< ticks a second
  double seconds = 10.0;   ///< of the motion
  int repeats = 3;         ///< identical runs; a tick's time is the least of them
  int check_every = 20;    ///< ticks between looks at a pose
  bool is_judged = true;   ///< else times are taken and nothing else
  double patience = 30.0;  ///< processor time after which a contender drops out of a run [s]
};

/// Who competes, and on what. The first tool is the one that says which ticks are in contact.
struct Contest {
  std::string scene;
  scenes::Motion motion;
  Pose<double> start;
  Vector3<double> tip;  ///< of the tool, in its frame [m]
  double length;        ///< L of the metric [m]
  std::vector<std::unique_ptr<CoupledTool>> tools;
  std::vector<std::unique_ptr<CoupledTool>> free_tools;  ///< the same, with the object out of reach
  std::function<double(const Pose<double>&)> distance;  ///< a query at the poses of the first tool [m]; may be empty
  test::CheckedObject object;
  std::vector<test::CheckedTool> pieces;
};

/// What one contender did in one scene.
struct Score {
  std::string name;
  int ticks = 0;                      ///< in contact, that it made before it dropped out
  double p50 = 0, p99 = 0, p999 = 0;  ///< processor time of ticks in contact [µs]
  bool is_query = false;              ///< a distance alone: nothing below is known
  int samples = 0;                    ///< ticks looked at, in contact or not
  double deepest = 0;                 ///< penetration by the independent checker over the samples [m]
  int crossed = 0;    ///< samples in which the middle or the tip of the tool was through the object
  double jitter = 0;  ///< with the device held: the farthest that a settled tool moves, in the metric [m];
                      ///< NaN where it dropped out before
  double lag = 0;     ///< behind the device in free space [m]
  bool is_repeatable = true;  ///< all runs gave the same poses to the last bit
  int touching = 0;           ///< of a query: ticks in contact for which it says that tool and object touch
};

/// Runs all contenders over the motion in turns of 200 ticks, so that what else the machine does hits all
/// alike, and then looks at what they did. Turns begin at other ticks in every run.
///
/// A tick is in contact when the first tool is held away from the device by an energy of more than 1e-14 m²,
/// for all contenders alike: a spring never rests on the device. For jitter the motion stops after each of
/// its seconds for half a second, of which the last 0.2 s count; for lag it runs for 3 s with the object out
/// of reach, and its first 0.7 s do not count, in which hands come down with a jolt.
std::vector<Score> hold(Contest& contest, const ContestOptions& options);

}  // namespace feeler::rivals
