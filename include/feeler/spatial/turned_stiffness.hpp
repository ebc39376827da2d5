// The wrench of a stiffness whose axes are not the world's, but turn with an object or with the tool.
#pragma once

#include "feeler/core/scalar.hpp"
#include "feeler/spatial/pose.hpp"
#include "feeler/spatial/rotation.hpp"
#include "feeler/spatial/twist.hpp"
#include "feeler/spatial/wrench.hpp"

namespace feeler {

/// The wrench of a stiffness along given axes: those of an object that turns, or of a device's base as the object sees it.
///
/// It is `Stiffness::wrench` in these axes, and the negative gradient of ½ eᵀ A K Aᵀ e by the haptic pose as long as the axes A stand.
/// @param world_from_axes      unit
/// @param graphic_from_haptic  `motion_between(haptic, graphic)` of the reference point, world axes
/// @return  world axes, at the reference point of the haptic pose
template <RealScalar Scalar>
Wrench<Scalar> wrench_along(const Quaternion<Scalar>& world_from_axes, const Stiffness<Scalar>& stiffness,
                            const Twist<Scalar>& graphic_from_haptic) noexcept {
  const Quaternion<Scalar> back = world_from_axes.conjugate();
  const Wrench<Scalar> wrench = stiffness.wrench({back * graphic_from_haptic.linear, back * graphic_from_haptic.angular});
  return {world_from_axes * wrench.force, world_from_axes * wrench.torque};
}

/// The wrench of a stiffness along the axes of the haptic tool, which turn with the hand: a pen that is soft along its shaft.
///
/// With d = p_g − p_h, φ = Log(R_hᵀ R_g) and the energy ½ dᵀ R_h K_t R_hᵀ d + ½ φᵀ K_r φ, it is the negative gradient by the haptic pose: force F =
/// R_h K_t R_hᵀ d, torque d × F + R_h J_l⁻ᵀ(φ) K_r φ. Without d × F, which is how a turn of the axes bends the force, a closed motion of the hand
/// would gain energy.
/// @param haptic, graphic  poses of the reference point; unit
/// @return  world axes, at the reference point of the haptic pose
template <RealScalar Scalar>
Wrench<Scalar> wrench_along_tool(const Stiffness<Scalar>& stiffness, const Pose<Scalar>& haptic, const Pose<Scalar>& graphic) noexcept {
  const Pose<Scalar> haptic_from_graphic = haptic.inverse() * graphic;
  const Vector3<Scalar> phi = log_rotation(haptic_from_graphic.rotation);
  const Vector3<Scalar> force = haptic.rotation * Vector3<Scalar>(stiffness.translational.cwiseProduct(haptic_from_graphic.translation));
  const Vector3<Scalar> torque = inverse_left_jacobian<Scalar>(phi).transpose() * stiffness.rotational.cwiseProduct(phi);
  return {force, (graphic.translation - haptic.translation).cross(force) + haptic.rotation * torque};
}

}  // namespace feeler
