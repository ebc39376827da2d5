// The settings that a renderer can work with; all others are refused when it is made, since the tick has nobody to tell.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "feeler/core/number_text.hpp"
#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/render/scene_rounding.hpp"
#include "feeler/render/settings.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "feeler/tool/symmetry.hpp"

namespace feeler {

namespace detail {
/// Whether a vector of weights is finite and positive; a NaN is neither.
template <class Scalar>
bool is_positive(const Vector3<Scalar>& weights) {
  return weights.allFinite() && (weights.array() > Scalar(0)).all();
}

/// Whether weights differ by so much that rounding leaves nothing of the least, and the tool stays where it is that way. Found by trial: 1e18
/// among translations and 1e22 between those and turns are the first that do.
template <class Scalar>
bool are_too_different(const Metric<Scalar>& metric, bool turns_matter) {
  const auto differ = [](const Vector3<Scalar>& v) { return !(v.minCoeff() >= Scalar(1e-15) * v.maxCoeff()); };
  if (differ(metric.translational)) return true;
  if (!turns_matter) return false;
  const auto both = metric.diagonal();
  return differ(metric.rotational) || !(both.minCoeff() >= Scalar(5e-22) * both.maxCoeff());
}

/// What is wrong with stiffness and metric, or nothing.
template <RealScalar Scalar>
std::string reason_against_weights(const Settings<Scalar>& settings, bool turns_matter) {
  using std::sqrt;
  const Scalar most = sqrt((std::numeric_limits<Scalar>::max)()) / 4;  // times the difference of two poses is finite
  for (const Vector3<Scalar>& stiffness : {settings.stiffness.translational, settings.stiffness.rotational})
    if (!((stiffness.array() >= Scalar(0)).all() && (stiffness.array() <= most).all()))
      return "HapticRenderer: Settings::stiffness has a component that is negative, a NaN, or more than " + number_text(static_cast<double>(most)) +
             ", whose wrench would overflow; give newtons a metre and newton-metres a radian";
  if (settings.metric && !(is_positive(settings.metric->translational) && (!turns_matter || is_positive(settings.metric->rotational))))
    return "HapticRenderer: Settings::metric has a weight that is not positive and finite; without it nothing draws the tool to the hand that way";
  if (!settings.metric && !(is_positive(settings.stiffness.translational) && (!turns_matter || is_positive(settings.stiffness.rotational))))
    return "HapticRenderer: Settings::stiffness has a zero, and nothing draws the tool to the hand that way; to feel no force or torque there set "
           "Settings::metric too, which weighs in its place";
  if (are_too_different(settings.metric_in_use(), turns_matter))
    return std::string("HapticRenderer: Settings::") + (settings.metric ? "metric" : "stiffness") +
           " has weights that differ by more than 1e15 among translations or turns, or 1e21 between them, and the tool would not follow the hand where they are least; "
           "bring them nearer to each other" +
           (settings.metric ? "" : ", or set Settings::metric too, which weighs in their place");
  return {};
}

/// What is wrong with the lengths and counts, but for the margin, or nothing.
template <RealScalar Scalar>
std::string reason_against_limits(const Settings<Scalar>& settings) {
  if (!settings.reference_point.allFinite())
    return "HapticRenderer: Settings::reference_point has a NaN or an infinity; give the point of the tool that the hand holds [m]";
  if (!(settings.trust_radius >= Scalar(1e-6) && settings.trust_radius <= Scalar(1)))
    return "HapticRenderer: Settings::trust_radius is not a length of 1e-06 to 1 m; with less the tool only creeps, with more no linearisation holds; leave the "
           "default of 0.4 mm if in doubt";
  if (!(settings.step_tolerance >= Scalar(1e-12) && settings.step_tolerance <= Scalar(1e-3)))
    return "HapticRenderer: Settings::step_tolerance is not a length of 1e-12 to 0.001 m; with less no tick converges, with more the tool stays where it is; leave "
           "the default of 5 µm if in doubt";
  if (settings.maximum_iterations < 1)
    return "HapticRenderer: Settings::maximum_iterations is less than 1, and the tool could not move; give 1 to 32";
  if (settings.work_budget < 1 || settings.work_budget > 100'000'000)
    return "HapticRenderer: Settings::work_budget is not 1 to 100000000; with less the tool could not move, with more a tick may take minutes; leave the default if "
           "in doubt";
  return {};
}

/// What is wrong with the margin in a scene, or with the scene, or nothing.
template <RealScalar MeshScalar, RealScalar Scalar>
std::string reason_against_margin(const Settings<MeshScalar>& settings, const SceneRounding<MeshScalar, Scalar>& rounding) {
  constexpr bool is_narrow = !std::is_same_v<MeshScalar, Scalar>;  // and the margin follows the rounding of poses
  const Scalar most = Scalar(MeshScalar(1e-3)), least = rounding.least_margin(), margin = Scalar(settings.margin);
  const auto text = [](const Scalar& length) {
    using std::isfinite;
    return isfinite(length) ? number_text(static_cast<double>(length)) : "more than " + number_text((std::numeric_limits<double>::max)());
  };
  if (!(least <= most))
    return "HapticRenderer: the object and the tool about its reference point are " + text(rounding.size) +
           " m across, and rounding could carry the tool through a surface whatever the margin; give all lengths in metres";
  if (!(margin >= least && margin <= most))
    return "HapticRenderer: Settings::margin is not a length of " + text(least) +
           " to 0.001 m; with less, rounding can carry the tool through a surface, and more is felt as a cushion; " +
           (least <= Scalar(Settings<MeshScalar>().margin) ? "leave the default of 1 µm if in doubt"
                                                           : "give such a margin, or all lengths in metres");
  const bool is_tool = rounding.reach > rounding.farthest;  // that is the farther away
  if (!(10 * rounding.of_poses() <= (is_narrow ? most : margin)))
    return (is_tool ? "HapticRenderer: the tool is so large, or its reference point so far from the origin of its frame, that poses are rounded to "
                    : "HapticRenderer: the object reaches " + text(rounding.farthest) + " m from the origin, where poses are rounded to ") +
           text(rounding.of_poses()) + " m; " +
           (is_tool ? "give a reference point on the tool, and all lengths in metres" : "move the scene to the origin") +
           (is_narrow                          ? ", or use double"
            : 10 * rounding.of_poses() <= most ? ", or give a larger margin"
                                               : "");
  return {};
}
}  // namespace detail

/// The sentence with which a renderer refuses a scene; empty where it can work with it.
/// @param tool  in the scalar that decides collisions
template <RealScalar MeshScalar, RigidTool Tool>
std::string reason_against_scene(const TriangleMesh<MeshScalar>& object, const Tool& tool, const Settings<MeshScalar>& settings) {
  using Scalar = typename Tool::Scalar;
  constexpr bool turns_matter = symmetry_of<Tool> != Symmetry::about_point;  // a sphere's cannot, and nothing weighs them
  std::string reason = detail::reason_against_limits(settings);
  if (reason.empty()) reason = detail::reason_against_weights(settings, turns_matter);
  if (!reason.empty()) return reason;
  const Vector3<Scalar> reference = settings.reference_point.template cast<Scalar>();
  if constexpr (!turns_matter) {
    if (tool.vertex(0) != reference)
      return "HapticRenderer: the reference point is not the centre of the tool, which has no other point to hold it by; set "
             "Settings::reference_point to the centre or, if the tool is held by a lever, make it a CompoundTool of this one piece";
  }
  return detail::reason_against_margin(settings, SceneRounding<MeshScalar, Scalar>(object, tool, reference));
}

}  // namespace feeler
