// One motion rendered by one contact method, tick by tick, with everything that the experiments ask about a tick.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "feeler/core/status.hpp"
#include "scenes/scene.hpp"

namespace feeler::experiments {

/// The contact methods compared: the paper as written, each correction of it alone, all of them, and the library's default.
enum class Method { paper, hard_box, no_box, linearisations, rotation_vectors, certificate, shared_metric, all_corrections, standard };

inline constexpr std::array all_methods{Method::paper,          Method::hard_box,         Method::no_box,
                                        Method::linearisations, Method::rotation_vectors, Method::certificate,
                                        Method::shared_metric,  Method::all_corrections,  Method::standard};

/// The name of a method in tables and file names.
constexpr const char* name_of(Method method) {
  switch (method) {
    case Method::paper: return "paper as written";
    case Method::hard_box: return "eq. 5 as hard box";
    case Method::no_box: return "eq. 5 off";
    case Method::linearisations: return "four linearisations";
    case Method::rotation_vectors: return "rotation vectors";
    case Method::certificate: return "certificate";
    case Method::shared_metric: return "M = K";
    case Method::all_corrections: return "all corrections";
    case Method::standard: return "default";
  }
  return "";
}

/// What one tick did.
struct Record {
  double t = 0;  ///< [s]
  Pose<double> haptic, graphic;
  Wrench<double> wrench;
  Status status = Status::not_reset;
  double microseconds = 0;               ///< of the tick, processor time
  double optimisation_microseconds = 0;  ///< of the QP solver in it
  double depth = 0;                      ///< deepest penetration on the way and at the pose, by the independent checker [m]
  double truncation = 0;        ///< largest |separation − its linear prediction| over the step, of an active contact [m]
  double truncation_bound = 0;  ///< the largest rφ²/2 of these contacts [m]
  int contacts = 0;             ///< principal contacts recognised
  int regions = 0;
  int vertex_face = 0, edge_edge = 0;
  bool is_switch = false;  ///< the formation has other features than a tick before
};

struct Run {
  Status start = Status::not_reset;
  std::vector<Record> ticks;
};

/// Renders the motion of a scene at 1 kHz; with `is_checked` the independent checker looks at each pose and at the way to it.
Run run(const scenes::Scene& scene, const Settings<double>& settings, Method method, double seconds, bool is_checked);
/// The same for a tool of several pieces, which the paper's method does not know; its contacts are counted as rows that hold it.
Run run(const scenes::CompoundScene& scene, const Settings<double>& settings, double seconds, bool is_checked);

}  // namespace feeler::experiments
