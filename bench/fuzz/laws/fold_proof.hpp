// Whether two poses of rest can both be local minima: a fold, which no law is about.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fuzz/laws/law_run.hpp"
#include "support/penetration_checker.hpp"

namespace feeler::laws {

/// Separation of a tool from every triangle of a scene, by the checker.
template <class Tool>
class Separation {
 public:
  /// @param reach  up to which it is told [m]
  Separation(const LawScene<Tool>& scene, double reach) : reach_(reach), object_(points_of(scene.surface), rows_of(scene.surface)) {
    for (const auto& piece : test::checked_pieces(scene.tool)) pieces_.push_back(piece.swept_by(test::WideReal(reach)));
  }
  double at(const Pose<double>& pose_in_scene) const {
    return reach_ - double(test::deepest_penetration(object_, pieces_, test::checked_pose(pose_in_scene)).depth);
  }

 private:
  double reach_;
  test::CheckedObject object_;
  std::vector<test::CheckedTool> pieces_;
};

/// True if the straight way from the worse of two poses to the better one goes down all the way, and is nowhere nearer to the object than the
/// nearer end, to a nanometre: then the worse is no minimum, whatever the margin is worth, and there is no fold between the two.
/// @param run  whose hand is held; poses in the axes of its scene
template <class Tool>
bool has_no_fold(const LawScene<Tool>& scene, const LawRun<Tool>& run, Pose<double> worse, Pose<double> better) {
  const auto energy_at = [&](const Pose<double>& pose) { return run.energy(compose(scene.placed, pose)); };
  if (energy_at(worse) < energy_at(better)) std::swap(worse, better);
  const Separation separation(scene, 2 * scene.settings.margin);
  const double least = std::min(separation.at(worse), separation.at(better)) - 1e-9;
  double last = energy_at(worse);
  constexpr int steps = 8;
  for (int i = 1; i <= steps; ++i) {
    const double share = double(i) / steps;
    const Pose<double> pose{worse.translation + share * (better.translation - worse.translation), worse.rotation.slerp(share, better.rotation)};
    const double energy = energy_at(pose);
    // At the foot of the way it may be level.
    if (separation.at(pose) < least || (i < steps / 2 && energy >= last)) return false;
    last = energy;
  }
  return true;
}

}  // namespace feeler::laws
