// The settings that a renderer can work with; all others are refused when it is made, since the tick has nobody to tell.
#pragma once

#include "feeler/core/requirement.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/render/settings.hpp"

namespace feeler {

namespace detail {
/// Whether a vector of weights is finite and positive; a NaN is neither.
template <class Scalar>
bool is_positive(const Vector3<Scalar>& weights) {
  return weights.allFinite() && (weights.array() > Scalar(0)).all();
}
}  // namespace detail

/// The settings as they are, or a sentence about the first that is of no use.
/// @param turns_matter  whether a turn of the tool can matter; a sphere's cannot, and nothing weighs them
template <RealScalar Scalar>
const Settings<Scalar>& usable(const Settings<Scalar>& settings, bool turns_matter) {
  const auto is_positive_length = [](Scalar length) { return length > Scalar(0); };
  if (!settings.reference_point.allFinite())
    refuse("HapticRenderer: Settings::reference_point has a NaN or an infinity; give the point of the tool that the hand holds [m]");
  for (const Vector3<Scalar>& stiffness : {settings.stiffness.translational, settings.stiffness.rotational})
    if (!stiffness.allFinite() || (stiffness.array() < Scalar(0)).any())
      refuse("HapticRenderer: Settings::stiffness has a component that is negative, a NaN or an infinity; give newtons a metre and newton-metres a radian");
  const Metric<Scalar> metric = settings.metric_in_use();
  if (!detail::is_positive(metric.translational) || (turns_matter && !detail::is_positive(metric.rotational))) {
    if (settings.metric)
      refuse("HapticRenderer: Settings::metric has a weight that is not positive and finite; without it nothing draws the tool to the hand that way");
    refuse(
        "HapticRenderer: Settings::stiffness has a zero, and nothing draws the tool to the hand that way; to feel no force or torque there set "
        "Settings::metric too, which weighs in its place");
  }
  if (!is_positive_length(settings.trust_radius)) refuse("HapticRenderer: Settings::trust_radius is not a positive length; leave the default of 0.4 mm if in doubt");
  if (!is_positive_length(settings.step_tolerance)) refuse("HapticRenderer: Settings::step_tolerance is not a positive length; leave the default of 5 µm if in doubt");
  if (settings.maximum_iterations < 1) refuse("HapticRenderer: Settings::maximum_iterations is less than 1, and the tool could not move; give 1 to 32");
  if (settings.work_budget < 1) refuse("HapticRenderer: Settings::work_budget is less than 1, and the tool could not move; leave the default if in doubt");
  return settings;
}

}  // namespace feeler
