// A cell of the study: one scene rendered with one choice of everything.
#pragma once

#include <cstdio>
#include <string>

namespace feeler::study {

/// What is chosen; the defaults are the library's.
struct Cell {
  std::string scene;
  std::string motion = "usual";  ///< how the hand goes along the scene's motion: one of `motions`
  std::string rendering = "double";  ///< scalar, QP solver and contact method, as one name
  double margin = 1e-6;              ///< [m]
  int budget = 128;                  ///< of work a tick
  int iterations = 12;               ///< a tick, at most
  int rate = 1000;                   ///< ticks a second
  double scale = 1;                  ///< of all lengths of object, tool and motion
  double offset = 0;                 ///< of the scene from the origin, along the diagonal [m]

  /// Names the cell in the files and in filters.
  std::string key() const {
    char text[256];
    std::snprintf(text, sizeof text, "%s/%s/%s/margin=%g/budget=%d/iterations=%d/rate=%d/scale=%g/offset=%g", scene.c_str(), motion.c_str(),
                  rendering.c_str(), margin, budget, iterations, rate, scale, offset);
    return text;
  }
};

}  // namespace feeler::study
