// How triangles that a certificate met join the working set.
#pragma once

#include "feeler/proximity/gjk.hpp"
#include "feeler/proximity/sweep_result.hpp"
#include "feeler/render/constraints/working_set.hpp"
#include "feeler/tool/compound_tool.hpp"

namespace feeler {

/// Adds a triangle to the working set, and returns its pair.
/// @param scene     `RenderedScene`
/// @param features  to start its first query from
template <class Pairs, class Scene>
typename Pairs::Pair& take_in(Pairs& pairs, const Scene& scene, int piece, int triangle, WitnessFeatures features) noexcept {
  auto& pair = pairs.add(piece, triangle, scene.object().corners(triangle).template cast<typename Scene::Scalar>());
  pair.features = features;
  return pair;
}

/// Takes in what is near where a motion ended; false if all of it was there.
template <class Pairs, class Scene>
bool take_in_noticed(Pairs& pairs, const Scene& scene, const NoticedTriangles& all) noexcept {
  bool is_new = false;
  for (const Noticed& noticed : all) {
    if (pairs.find(noticed.piece, noticed.triangle) >= 0) continue;
    take_in(pairs, scene, noticed.piece, noticed.triangle, noticed.features);
    is_new = true;
  }
  return is_new;
}

/// Without clearance, where what blocked a motion was there with its rows: what is at the rims of its walls is to join.
template <class Pairs, class Scene>
void want_rims(Pairs& pairs, const Scene& scene, const SweepResult<typename Scene::Scalar>& result) noexcept {
  if (!pairs.has_no_clearance(scene.clearance().none())) return;
  for (const auto& blocker : result.blockers) {
    auto& pair = pairs[pairs.find(blocker.piece, blocker.triangle)];
    if (pair.wants_rim || scene.object().walls().of_triangle(blocker.triangle) < 0) continue;
    pair.wants_rim = true;
    pair.state = PairState::left_out;  // to be measured again
  }
}

/// Takes in the triangles that blocked a motion. False if another linearisation would find no more than the last: all these triangles had rows
/// already, and it is the way to the end of the motion that meets them, not the end.
template <class Pairs, class Scene>
bool take_in_blockers(Pairs& pairs, const Scene& scene, const SweepResult<typename Scene::Scalar>& result) noexcept {
  constexpr bool is_convex = maximum_pieces<typename Scene::Tool> == 1;
  bool is_new = false, meets_left_out = false, meets_touching = false;
  for (const auto& blocker : result.blockers) {
    const int i = pairs.find(blocker.piece, blocker.triangle);
    if (i < 0) {
      take_in(pairs, scene, blocker.piece, blocker.triangle, blocker.features);
      is_new = true;
      continue;
    }
    auto& pair = pairs[i];
    pair.note_use();
    if (pair.state == PairState::ghost) {
      is_new = pair.keeps_ghost = true;
      pair.state = PairState::left_out;  // to be measured again, where all else is carried
    } else if (pair.slack < scene.contact_distance()) {
      meets_touching = true;
      if (is_convex && pair.state == PairState::repeats) pair.state = PairState::left_out;  // to be measured, whatever covers it
    } else if (pair.state == PairState::left_out) {
      meets_left_out = true;
    }
  }
  if (!is_new && meets_touching) want_rims(pairs, scene, result);
  // What touches stops the tool before what was left out comes near.
  return is_new || (meets_left_out && !meets_touching);
}

}  // namespace feeler
