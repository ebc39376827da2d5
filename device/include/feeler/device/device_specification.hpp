// What a haptic device can sense and push, and the figures of known devices.
#pragma once

#include <array>
#include <string>

namespace feeler {

/// The figures of a device, from its maker or measured; every one can be overwritten by who knows better.
struct DeviceSpecification {
  std::string name;

  double minimum_rate = 0;  ///< servo ticks a second that the device accepts [Hz]
  double nominal_rate = 0;  ///< [Hz]
  double maximum_rate = 0;  ///< [Hz]

  double maximum_force = 0;      ///< for a moment [N]
  double continuous_force = 0;   ///< for ever, without overheating [N]
  double maximum_torque = 0;     ///< about its weakest axis [N·m]
  double continuous_torque = 0;  ///< about its weakest axis [N·m]

  // Recommended: of a preset, stable in every simulated hand on every scene at the nominal rate, but for devices that were not
  // tried (docs/stability.md). Makers and drivers state more for some devices.
  double stiffness = 0;             ///< that it renders without buzzing [N/m]
  double rotational_stiffness = 0;  ///< that it renders without buzzing [N·m/rad]

  std::array<double, 3> workspace = {0, 0, 0};  ///< width, height, depth [m]
  double position_resolution = 0;               ///< one encoder count, in space [m]
  double rotation_resolution = 0;               ///< one encoder count, of the coarsest axis [rad]

  double friction = 0;            ///< to push against when it is off [N]
  double apparent_mass = 0;       ///< felt at the handle [kg]
  double apparent_inertia = 0;    ///< felt when the handle is turned [kg·m²]
  double damping = 0;             ///< of the mechanism [N·s/m]
  double rotational_damping = 0;  ///< of the gimbal [N·m·s/rad]

  std::array<bool, 6> is_sensed = {};  ///< x, y, z, then rotation about x, y, z
  std::array<bool, 6> is_pushed = {};  ///< the same axes: has a motor

  /// Whether any rotation has a motor. A device without is force-only: six-DOF contact, three-DOF display.
  constexpr bool pushes_torque() const noexcept { return is_pushed[3] || is_pushed[4] || is_pushed[5]; }
  /// Makes it force-only: no motor turns it, whatever its model usually has.
  constexpr void lose_torque() noexcept {
    is_pushed[3] = is_pushed[4] = is_pushed[5] = false;
    maximum_torque = continuous_torque = rotational_stiffness = 0;
  }
};

// Presets of known devices. Which figures are confirmed, recalled or assumed is said at each one in the source.

DeviceSpecification phantom_premium_3_0_6dof();
DeviceSpecification phantom_premium_1_5_6dof();
DeviceSpecification phantom_premium_1_5_high_force_6dof();
DeviceSpecification touch();    ///< 3D Systems Touch, once Phantom Omni; force-only
DeviceSpecification touch_x();  ///< 3D Systems Touch X, once Phantom Desktop; force-only

DeviceSpecification omega_3();   ///< Force Dimension; senses and pushes positions only
DeviceSpecification omega_6();   ///< force-only
DeviceSpecification omega_7();   ///< force-only; its gripper is not driven
DeviceSpecification sigma_7();
DeviceSpecification lambda_7();
DeviceSpecification delta_3();   ///< senses and pushes positions only
DeviceSpecification falcon();    ///< Novint Falcon; senses and pushes positions only

DeviceSpecification virtuose_6d();
DeviceSpecification virtuose_6d_desktop();

DeviceSpecification inverse3();  ///< Haply Inverse3 with a VerseGrip; force-only

}  // namespace feeler
