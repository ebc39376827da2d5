// The figures of known devices, each with how sure it is.
#include "feeler/device/device_specification.hpp"

#include <numbers>

namespace feeler {

// confirmed: read in a public driver or manual. recalled: from a datasheet, not confirmed. assumed: no source, a plausible value.
DeviceSpecification phantom_premium_3_0_6dof() {
  DeviceSpecification device;
  device.name = "Phantom Premium 3.0/6DOF";

  device.minimum_rate = 500;   // confirmed (OpenHaptics scheduler)
  device.nominal_rate = 1000;  // confirmed
  device.maximum_rate = 2000;  // confirmed for the parallel port and PCI

  device.maximum_force = 22;         // confirmed (CHAI3D)
  device.continuous_force = 3;       // recalled
  device.maximum_torque = 0.188;     // confirmed (CHAI3D); the datasheet recalls 0.515 for yaw and pitch, 0.170 for roll
  device.continuous_torque = 0.048;  // recalled: roll; 0.188 for yaw and pitch

  device.stiffness = 1000;            // confirmed (CHAI3D)
  device.rotational_stiffness = 0.3;  // confirmed (CHAI3D)

  device.workspace = {0.838, 0.584, 0.406};                        // recalled
  device.position_resolution = 0.02e-3;                            // recalled: 0.02 mm
  device.rotation_resolution = 0.008 * std::numbers::pi / 180;     // recalled: roll; 0.0023° for yaw and pitch

  device.friction = 0.2;             // recalled
  device.apparent_mass = 0.159;      // recalled, an upper bound
  device.apparent_inertia = 2e-4;    // assumed
  device.damping = 0.5;              // assumed: what a passive wall of 1000 N/m at 1 kHz needs, K T / 2
  device.rotational_damping = 2e-4;  // assumed, by the same rule for 0.3 N·m/rad

  device.is_sensed = {true, true, true, true, true, true};
  device.is_pushed = {true, true, true, true, true, true};
  return device;
}

}  // namespace feeler
