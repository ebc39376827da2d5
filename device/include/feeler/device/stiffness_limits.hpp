// How stiff a wall a device can render by what is known of it: bounds of sampling, of encoders, and of both.
#pragma once

#include "feeler/device/device_specification.hpp"

namespace feeler {

/// Largest stiffness of a passive wall, K ≤ 2b/T: what the mechanism dissipates must cover what a sample late
/// by half a period gives.
///
/// Colgate and Schenkel, "Passivity of a class of sampled-data systems: application to haptic interfaces",
/// 1997: b > KT/2 + |B|. It assumes an exact sensor and a wrench that is pushed in the tick of its pose;
/// where it is pushed n ticks later, their criterion, b > T/2 · Re((1 − e^(−jωT)) H) / (1 − cos ωT) for H = K
/// e^(−jnωT) and all ω, gives b > KT(½ + n). Holds for whatever passive hand. The same for rotations, in
/// N·m/rad and N·m·s/rad.
/// @param damping          b, of the device alone [N·s/m]
/// @param period           T [s], above 0
/// @param virtual_damping  B, rendered with the wall [N·s/m]; it takes from the bound whatever its sign
/// @param delay            between the tick of the pose and the push of its wrench [ticks]
/// @return [N/m]; 0 where the damping does not even cover B
constexpr double passive_stiffness(double damping, double period, double virtual_damping = 0, double delay = 0) noexcept {
  const double left = damping - (virtual_damping < 0 ? -virtual_damping : virtual_damping);
  return left > 0 ? left / (period * (0.5 + delay)) : 0;
}

/// Largest stiffness whose wall does not hum in one encoder count, K ≤ 2 f_c/Δ: the friction must hold half a
/// count of force.
///
/// Abbott and Okamura, "Effects of position quantization and sampling rate on virtual-wall passivity", 2005.
/// @param friction    Coulomb friction of the device [N]
/// @param resolution  one encoder count [m]; 0 for an exact sensor
/// @return [N/m]; infinite for an exact sensor
double quantised_stiffness(double friction, double resolution) noexcept;

/// The bounds for a device at a period.
struct StiffnessLimits {
  double passive = 0;             ///< 2b/T [N/m]
  double quantised = 0;           ///< 2 f_c/Δ [N/m]
  double rotational_passive = 0;  ///< 2b/T of the gimbal [N·m/rad]; 0 for a force-only device

  /// Largest stiffness of a wall that is passive on encoders: min(2b/T, 2 f_c/Δ) [N/m].
  double translational() const noexcept { return passive < quantised ? passive : quantised; }
  /// The same of rotations [N·m/rad]: of sampling alone, because no maker tells the friction of a gimbal.
  double rotational() const noexcept { return rotational_passive; }
};

/// From the damping, friction and resolution of its specification, which presets partly assume. These bounds
/// are for any passive hand; a hand that grips adds damping, and the device then renders more.
/// @param period  of the servo loop [s], above 0
StiffnessLimits stiffness_limits_of(const DeviceSpecification& device, double period) noexcept;

}  // namespace feeler
