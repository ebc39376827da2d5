// Wrenches between the ticks of a slow renderer: the last one and how it answers to small motions of the
// hand.
#pragma once

#include <array>

#include "feeler/device/device_state.hpp"

namespace feeler {

/// What a slow tick leaves for the fast ones, as plain numbers: it may be handed over in a `LatestValue`.
struct WrenchModel {
  DevicePose pose;      ///< that was rendered; its position is the reference point of the renderer
  DeviceWrench wrench;  ///< there
  /// `wrench_derivative` there, row by row: change of the wrench by (dp, w), in N/m, N/rad, N·m/m, N·m/rad.
  /// All zero holds the wrench.
  std::array<double, 36> derivative = {};
};

/// How far a model may be trusted.
struct ExtrapolationLimits {
  double distance = 1e-3;  ///< farther from its pose the motion is shortened to it [m]
  double angle = 0.05;     ///< the same of turns [rad]
};

/// w ≈ w₀ + J Δ, Δ = (p − p₀, Log(R R₀ᵀ)), for a servo loop that is faster than the renderer.
///
/// Contacts push and never pull: where the force has turned against the one rendered, the part against it is
/// dropped, and so of the torque. What the renderer has not met yet is not felt before its next tick.
/// @return finite for finite arguments; no allocation
DeviceWrench extrapolated(const WrenchModel& model, const DevicePose& pose, const ExtrapolationLimits& limits = {}) noexcept;

}  // namespace feeler
