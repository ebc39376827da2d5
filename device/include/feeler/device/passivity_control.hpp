// An observer of the energy that a device gives to the hand, and a damper that takes it back: optional, and
// nothing where not constructed.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "feeler/device/device_specification.hpp"
#include "feeler/device/device_state.hpp"

namespace feeler {

/// How energies are added before they are judged.
enum class EnergySum : std::uint8_t {
  total,      ///< one sum, F·v + τ·ω: one axis may give what another one took
  each_axis,  ///< six sums, base axes: stricter, and damps only the axes that give
};

/// Settings of a `PassivityControl`.
struct PassivitySettings {
  EnergySum sum = EnergySum::total;
  double damping = 0;             ///< most that is added [N·s/m]
  double rotational_damping = 0;  ///< most that is added [N·m·s/rad]
  double allowance = 0;           ///< energy that may be given before damping begins [J]; per sum
  int delay = 0;                  ///< ticks between the write of a wrench and its push: 0 or 1
};

/// The settings that suit a device: a damper that a sampled loop still renders, D ≤ m/(4T), and of which one
/// encoder count a tick makes no more force than the friction holds, D ≤ f_c T/Δ; and an allowance of the
/// continuous force over one count, because a count that flips looks like energy. With less, the damper hums
/// in the noise of the encoders (docs/stability.md).
/// @param period  of the servo loop [s]
PassivitySettings passivity_of(const DeviceSpecification& device, double period);

/// What an observer saw and a controller did.
struct PassivityReport {
  double energy = 0;  ///< taken from the hand since the last free pose [J]; negative: given to it. Of all axes
  double lowest_energy = 0;  ///< the least of it, or with `each_axis` of any axis [J]
  double dissipated = 0;     ///< by the added damping, at the velocities known when it was added [J]
  std::int64_t ticks_damped = 0;
};

/// Passivity observer and controller of Hannaford and Ryu ("Time-domain passivity control of haptic
/// interfaces", 2002).
///
/// A wrench is constant between two ticks, so the energy that passes is known exactly from the poses at both
/// ends (Ryu et al. 2005):
///
///     E(n) = E(n−1) − F·(p(n) − p(n−1)) − τ·Log(R(n) R(n−1)ᵀ),
///
/// with the wrench that the motors pushed in between. While E is negative, a damper is added to the wish,
///
///     F ← F − s D v,   τ ← τ − s D_r ω,   s = min(1, −E / (T (D v² + D_r ω²))),
///
/// that takes the debt back by the next tick, or as fast as the sampled damper may. Where the renderer wants
/// nothing the account starts anew: free space stays free, and no contact pays for another.
///
/// In a tick call `damped` between renderer and `ForceSafety`, and `pushed` with what the safety let through:
/// the safety has the last word. It knows no clock and shares nothing.
class PassivityControl {
 public:
  /// Refuses (`std::invalid_argument`) settings that are negative or not finite, and delays other than 0
  /// and 1.
  explicit PassivityControl(const PassivitySettings& settings);
  /// The sentence with which the constructor refuses; empty where it does not.
  static std::string reason_against(const PassivitySettings& settings);

  /// The wish with the damping that is due. What is not finite passes unchanged: the safety stops it. No
  /// allocation.
  DeviceWrench damped(const DeviceState& state, const DeviceWrench& wanted) noexcept;
  /// What the motors push from now on. No allocation.
  void pushed(const DeviceWrench& wrench) noexcept;

  const PassivityReport& report() const noexcept { return report_; }

 private:
  PassivitySettings settings_;
  PassivityReport report_;
  std::array<double, 6> damping_ = {};  // by axis: linear, then angular
  std::array<double, 6> energy_ = {};   // by axis [J]
  DevicePose last_pose_;
  double last_time_ = 0;  // [s]
  bool has_pose_ = false;
  DeviceWrench pushing_;  // since the last tick
  DeviceWrench written_;  // in the last tick
};

}  // namespace feeler
