// Whether a motion is worth making: the merit function of the step control.
#pragma once

#include <cmath>

#include "feeler/spatial/turned_metric.hpp"
#include "feeler/spatial/twist.hpp"

namespace feeler {

/// Whether a pose is nearer to the target than another, but for what the margin is worth that is won on the way or has to be won yet.
/// @param before, after  of the two poses, from the target
/// @param margin         that is kept [m]
/// @param restoration    energy that it may cost to win the margin back [m²]
template <class Scalar>
bool descends(const TurnedMetric<Scalar>& metric, const Twist<Scalar>& before, const Twist<Scalar>& after, Scalar margin,
              Scalar restoration) noexcept {
  using std::sqrt;
  const Scalar energy_before = metric.energy(before), energy_after = metric.energy(after);
  return energy_after <= energy_before + restoration + margin * (sqrt(2 * energy_before) + margin);
}

/// Whether it is nearer by more than a tenth of the margin is worth.
template <class Scalar>
bool descends_clearly(const TurnedMetric<Scalar>& metric, const Twist<Scalar>& before, const Twist<Scalar>& after, Scalar margin) noexcept {
  using std::sqrt;
  const Scalar energy_before = metric.energy(before);
  const Scalar energy_after = metric.energy(after);
  return energy_after < energy_before - margin / 10 * sqrt(2 * energy_before);
}

}  // namespace feeler
