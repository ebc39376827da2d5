// The figures of known devices, each with how sure it is.
#include "feeler/device/device_specification.hpp"

#include <numbers>

namespace feeler {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A device whose handle turns in every direction, with motors for forces only.
DeviceSpecification force_only(const char* name) {
  DeviceSpecification device;
  device.name = name;
  device.minimum_rate = 500;         // assumed
  device.nominal_rate = 1000;        // assumed
  device.maximum_rate = 1000;        // assumed
  device.apparent_inertia = 1e-4;    // assumed
  device.rotational_damping = 1e-4;  // assumed
  device.is_sensed = {true, true, true, true, true, true};
  device.is_pushed = {true, true, true, false, false, false};
  return device;
}

/// Its handle does not turn, or nobody sees it turn.
DeviceSpecification positions_only(const char* name) {
  DeviceSpecification device = force_only(name);
  device.is_sensed = device.is_pushed;
  return device;
}

// Force Dimension gives no continuous force: a quarter of the maximum is assumed, which is careful.
// Its library reads the device at up to 4 kHz: confirmed by its manual as the theoretical rate.
void run_fast(DeviceSpecification& device) { device.maximum_rate = 4000; }

}  // namespace

// confirmed: read in a public driver or manual. recalled: from a datasheet, not confirmed. assumed: no
// source, a plausible value. measured: half of the largest stiffness that is stable in every simulated hand on every scene at 1 kHz, where that is
// less than what drivers or makers state; docs/stability.md says which devices were not tried.
DeviceSpecification phantom_premium_3_0_6dof() {
  DeviceSpecification device;
  device.name = "Phantom Premium 3.0/6DOF";

  device.minimum_rate = 500;   // confirmed (OpenHaptics scheduler)
  device.nominal_rate = 1000;  // confirmed
  device.maximum_rate = 2000;  // confirmed for the parallel port and PCI

  device.maximum_force = 22;    // confirmed (CHAI3D)
  device.continuous_force = 3;  // recalled
  device.maximum_torque = 0.188;  // confirmed (CHAI3D); the datasheet recalls 0.515 for yaw and pitch, 0.170 for roll
  device.continuous_torque = 0.048;  // recalled: roll; 0.188 for yaw and pitch

  device.stiffness = 1000;            // confirmed (CHAI3D)
  device.rotational_stiffness = 0.3;  // confirmed (CHAI3D), and nine tenths of what is stable in every hand

  device.workspace = {0.838, 0.584, 0.406};     // recalled
  device.position_resolution = 0.02e-3;         // recalled: 0.02 mm
  device.rotation_resolution = 0.008 * degree;  // recalled: roll; 0.0023° for yaw and pitch

  device.friction = 0.2;             // recalled
  device.apparent_mass = 0.159;      // recalled, an upper bound
  device.apparent_inertia = 2e-4;    // assumed
  device.damping = 0.5;              // assumed: what a passive wall of 1000 N/m at 1 kHz needs, K T / 2
  device.rotational_damping = 2e-4;  // assumed, by the same rule for 0.3 N·m/rad

  device.is_sensed = {true, true, true, true, true, true};
  device.is_pushed = {true, true, true, true, true, true};
  return device;
}

DeviceSpecification phantom_premium_1_5_6dof() {
  DeviceSpecification device = phantom_premium_3_0_6dof();  // the same gimbal
  device.name = "Phantom Premium 1.5/6DOF";
  device.maximum_force = 8.5;     // confirmed (CHAI3D)
  device.continuous_force = 1.4;  // recalled
  device.stiffness = 700;  // measured; CHAI3D states 800, the datasheet recalls 3500: its encoders would hum
  device.workspace = {0.381, 0.267, 0.191};  // recalled
  device.position_resolution = 0.03e-3;      // recalled
  device.friction = 0.04;                    // recalled
  device.apparent_mass = 0.136;              // recalled
  device.damping = 0.4;                      // assumed: K T / 2 of CHAI3D's K
  return device;
}

DeviceSpecification phantom_premium_1_5_high_force_6dof() {
  DeviceSpecification device = phantom_premium_1_5_6dof();
  device.name = "Phantom Premium 1.5 High Force/6DOF";
  device.stiffness = 800;                 // confirmed (CHAI3D, of the other 1.5)
  device.maximum_force = 37.5;            // recalled
  device.continuous_force = 6.2;          // recalled
  device.position_resolution = 0.007e-3;  // recalled
  device.friction = 0.2;                  // recalled
  device.apparent_mass = 0.159;           // recalled, an upper bound
  return device;
}

DeviceSpecification touch() {
  DeviceSpecification device = force_only("Touch");
  device.maximum_force = 3.3;      // confirmed (CHAI3D)
  device.continuous_force = 0.88;  // recalled
  device.stiffness = 400;          // confirmed (CHAI3D); the datasheet recalls 1020 in its weakest direction
  device.workspace = {0.160, 0.120, 0.070};   // recalled
  device.position_resolution = 0.055e-3;      // recalled
  device.rotation_resolution = 0.1 * degree;  // assumed: potentiometers
  device.friction = 0.26;                     // recalled
  device.apparent_mass = 0.045;               // recalled
  device.damping = 0.2;                       // assumed: K T / 2
  return device;
}

DeviceSpecification touch_x() {
  DeviceSpecification device = touch();
  device.name = "Touch X";
  device.maximum_force = 7.9;                  // confirmed (CHAI3D)
  device.continuous_force = 1.75;              // recalled
  device.stiffness = 500;                      // measured; CHAI3D states 1000
  device.workspace = {0.160, 0.120, 0.120};    // recalled
  device.position_resolution = 0.023e-3;       // recalled
  device.rotation_resolution = 0.02 * degree;  // assumed: encoders
  device.friction = 0.06;                      // recalled
  device.damping = 0.5;                        // assumed: K T / 2 of CHAI3D's K
  return device;
}

DeviceSpecification omega_6() {
  DeviceSpecification device = force_only("omega.6");
  run_fast(device);
  device.maximum_force = 12;                   // confirmed (CHAI3D)
  device.continuous_force = 3;                 // assumed: a quarter
  device.stiffness = 2900;                     // measured; CHAI3D states 5000, the datasheet recalls 14500
  device.workspace = {0.160, 0.160, 0.110};    // recalled
  device.position_resolution = 0.01e-3;        // recalled, an upper bound
  device.rotation_resolution = 0.09 * degree;  // recalled
  device.friction = 0.1;                       // assumed
  device.apparent_mass = 0.2;                  // assumed
  device.damping = 2.5;                        // assumed: K T / 2 of CHAI3D's K
  return device;
}

DeviceSpecification omega_3() {
  DeviceSpecification device = omega_6();
  device.name = "omega.3";
  device.is_sensed = device.is_pushed;
  return device;
}

DeviceSpecification omega_7() {
  DeviceSpecification device = omega_6();
  device.name = "omega.7";
  return device;
}

DeviceSpecification sigma_7() {
  DeviceSpecification device = omega_6();
  device.name = "sigma.7";
  device.maximum_force = 12;                    // confirmed (CHAI3D); the datasheet recalls 20
  device.continuous_force = 3;                  // assumed: a quarter
  device.maximum_torque = 0.2;                  // confirmed (CHAI3D); the datasheet recalls 0.4
  device.continuous_torque = 0.05;              // assumed: a quarter
  device.stiffness = 2200;                      // measured; CHAI3D states 4000
  device.rotational_stiffness = 0.24;           // measured; CHAI3D states 1
  device.workspace = {0.190, 0.190, 0.130};     // recalled
  device.position_resolution = 0.0015e-3;       // recalled
  device.rotation_resolution = 0.013 * degree;  // recalled
  device.damping = 2;                           // assumed: K T / 2 of CHAI3D's K
  device.rotational_damping = 5e-4;             // assumed: the same
  device.is_pushed = {true, true, true, true, true, true};
  return device;
}

DeviceSpecification lambda_7() {
  DeviceSpecification device = sigma_7();
  device.name = "lambda.7";
  device.stiffness = 3300;                   // measured; CHAI3D states 8000
  device.workspace = {0.240, 0.240, 0.170};  // recalled, weakly
  device.damping = 4;                        // assumed: K T / 2 of CHAI3D's K
  return device;
}

DeviceSpecification delta_3() {
  DeviceSpecification device = positions_only("delta.3");
  run_fast(device);
  device.maximum_force = 12;             // assumed: as an omega
  device.continuous_force = 3;           // assumed: a quarter
  device.stiffness = 2000;               // assumed
  device.workspace = {0.3, 0.3, 0.2};    // assumed
  device.position_resolution = 0.03e-3;  // assumed
  device.friction = 0.1;                 // assumed
  device.apparent_mass = 0.25;           // assumed
  device.damping = 1;                    // assumed: K T / 2
  return device;
}

DeviceSpecification falcon() {
  DeviceSpecification device = positions_only("Falcon");
  device.maximum_force = 8;                  // confirmed (CHAI3D); its maker says more than 8.9
  device.continuous_force = 2;               // assumed: a quarter
  device.stiffness = 3000;                   // confirmed (CHAI3D)
  device.workspace = {0.102, 0.102, 0.102};  // confirmed
  device.position_resolution = 0.0635e-3;    // confirmed: 400 dpi
  device.friction = 0.5;                     // assumed
  device.apparent_mass = 0.15;               // assumed
  device.damping = 1.5;                      // assumed: K T / 2
  return device;
}

DeviceSpecification virtuose_6d() {
  DeviceSpecification device = force_only("Virtuose 6D");
  device.minimum_rate = 300;                   // confirmed: others run it at 3 ms
  device.maximum_force = 15;                   // confirmed (SOFA saturates there); its name recalls 35
  device.continuous_force = 10;                // recalled
  device.maximum_torque = 0.7;                 // confirmed (SOFA saturates there); recalled 3.1
  device.continuous_torque = 0.7;              // recalled 1.0, cut to the maximum
  device.stiffness = 2000;                     // recalled
  device.rotational_stiffness = 5;             // measured; recalled 30
  device.workspace = {0.45, 0.45, 0.45};       // recalled
  device.position_resolution = 0.01e-3;        // assumed
  device.rotation_resolution = 0.01 * degree;  // assumed
  device.friction = 0.5;                       // assumed
  device.apparent_mass = 0.5;                  // assumed
  device.apparent_inertia = 2e-3;              // assumed
  device.damping = 1;                          // assumed: K T / 2
  device.rotational_damping = 0.015;           // assumed: K T / 2 of the recalled K
  device.is_pushed = {true, true, true, true, true, true};
  return device;
}

DeviceSpecification virtuose_6d_desktop() {
  DeviceSpecification device = virtuose_6d();
  device.name = "Virtuose 6D Desktop";
  device.maximum_force = 10;              // recalled
  device.continuous_force = 3;            // recalled
  device.maximum_torque = 0.8;            // recalled
  device.continuous_torque = 0.2;         // recalled
  device.stiffness = 1000;                // assumed
  device.rotational_stiffness = 0.27;     // measured, with inertia and damping as assumed below
  device.workspace = {0.12, 0.12, 0.12};  // recalled: a sphere
  device.apparent_mass = 0.2;             // assumed
  device.apparent_inertia = 8e-4;         // assumed: less than that of the larger one, as its mass
  device.damping = 0.5;                   // assumed: K T / 2
  device.rotational_damping = 5e-4;       // assumed: K T / 2 of 1 N·m/rad
  return device;
}

DeviceSpecification inverse3() {
  DeviceSpecification device = force_only("Inverse3");
  device.minimum_rate = 200;                  // confirmed: Isaac Lab and a ROS 2 node run it so
  device.maximum_rate = 2000;                 // assumed; its maker says "multi-kHz"
  device.maximum_force = 10;                  // confirmed (the ROS 2 node cuts there)
  device.continuous_force = 2.5;              // assumed: a quarter
  device.stiffness = 500;                     // assumed: its maker's "hello floor" has 1000, its Unity examples 300
  device.workspace = {0.2, 0.2, 0.2};         // confirmed: its maker's examples stay in a sphere of 0.1 m
  device.position_resolution = 0.02e-3;       // assumed
  device.rotation_resolution = 0.1 * degree;  // assumed: inertial sensors
  device.friction = 0.1;                      // assumed
  device.apparent_mass = 0.15;                // assumed
  device.damping = 0.5;                       // assumed: K T / 2 of its maker's K
  return device;
}

}  // namespace feeler
