// The choices of the paper's way of modelling contact.
#pragma once

#include "feeler/paper/step_coordinates.hpp"

namespace feeler {

/// What becomes of eq. 5, by which each coordinate of the new pose lies between its last value and the haptic pose's.
enum class LocalSolution {
  inside_box,       ///< twelve more rows in every optimisation
  selected_by_box,  ///< solutions outside the box are not chosen
  free,             ///< not used
};

/// How first contacts are found, and what is known of the motion.
enum class CollisionDetection {
  tool_vertices,  ///< the paper's: vertices are tracked from free space, overlaps at the haptic pose are looked for in contact
  certificate,    ///< the motion to the solution is certified, and what blocks it is the next first contact
};

/// Choices of `CandidateContacts`; the defaults are the paper as written. They are fixed when compiling, and what is not chosen is not in
/// the program.
struct CandidateOptions {
  LocalSolution local_solution = LocalSolution::selected_by_box;
  CollisionDetection collision_detection = CollisionDetection::tool_vertices;
  Increments increments = Increments::euler_angles;
  int linearisations = 1;            ///< of the rows of one combination
  int maximum_combinations = 64;     ///< optimisations a round; the rest is dropped, and counted
  int maximum_regions = 4;           ///< contact regions followed at once

  constexpr bool is_certified() const noexcept { return collision_detection == CollisionDetection::certificate; }
};

}  // namespace feeler
