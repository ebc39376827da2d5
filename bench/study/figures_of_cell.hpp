// What one cell of the study gave.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "study/truth.hpp"

namespace feeler::study {

/// Poses that a renderer without limits comes to with the same hand, each carried on in 50 digits to the minimum at some distance from the object.
struct TruthPath {
  struct Sample {
    double time = 0;  ///< [s]
    Pose<Wide> pose;
    Vector3<Wide> force, torque;
    bool is_in_contact = false;
  };
  static constexpr int samples_a_second = 50;

  std::vector<Sample> samples;
  int missing = 0;  ///< samples for which there is no proved minimum; they are left out
};

/// Makes each path once.
class TruthPaths {
 public:
  explicit TruthPaths(double seconds) : seconds_(seconds) {}
  /// @param margin  of that renderer [m]
  /// @param kept    distance from the object [m]; next to nothing for the rigid problem
  const TruthPath& of(const StudyScene& scene, const Cell& cell, const Truth& truth, double margin, double kept);

 private:
  double seconds_;
  std::map<std::tuple<std::string, std::string, double, double, double, double>, TruthPath>
      made_;  // by scene, motion, scale, offset, margin, distance
};

/// Errors are those of the samples, from the rigid problem, and so the margin is one of them; shares are of one. NaN is what was not measured.
struct CellFigures {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::string refusal;  ///< the sentence, where the renderer refuses the cell; then nothing else counts
  int samples = 0, samples_without_truth = 0;
  double converged = none;                                         ///< share of all ticks
  double error_median = none, error_99 = none, error_most = none;  ///< a point of the tool is off by at most [m]
  int solver_samples = 0;                                          ///< for which there is a proved minimum at the cell's own margin
  double solver_error_median = none, solver_error_99 = none;       ///< the distance from that [m]
  double within_tenth_micrometre = none, within_micrometre = none;
  double deepest = none;                                   ///< penetration of the samples, by the checker that shares no code with the library [m]
  double separation = none;                                ///< median of the contacts [m]
  double force_error_median = none, force_error_99 = none; ///< [N]
  double force_jnd_99 = none, torque_jnd_99 = none;        ///< in just-noticeable differences
  double jitter_99 = none;                                 ///< second difference of the force from tick to tick [N]
  double lag = none;                                       ///< longest time without a converged tick [s]
  double work_median = none, work_99 = none, work_most = none;   ///< of ticks in contact
  double operations_median = none, operations_99 = none;         ///< on numbers, of ticks in contact, where the scalar counts them
  double time_median = none, time_99 = none, time_999 = none, time_most = none;  ///< of ticks in contact, processor time [µs]
};

/// @param seconds  of the motion
CellFigures figures_of(const Cell& cell, double seconds, unsigned seed, TruthPaths& paths);

}  // namespace feeler::study
