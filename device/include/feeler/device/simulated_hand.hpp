// A simulated hand that pulls the handle of a device along a path, and that the device can push back.
#pragma once

#include <cstdint>
#include <functional>

#include "feeler/device/device_state.hpp"
#include "feeler/device/tremor.hpp"

namespace feeler {

/// Where the hand wants to be at a time since the start [s]. Called several times a tick: no allocation, no exception. Where it gives a
/// NaN, an infinity or a zero quaternion, the hand stays where it last wanted to be.
using DevicePath = std::function<DevicePose(double time)>;

/// The handle of a device as a rigid body of isotropic inertia about its origin.
struct Handle {
  double mass = 0.159;               ///< [kg]
  double inertia = 2e-4;             ///< [kg·m²]
  double damping = 0.5;              ///< of the mechanism, against the base [N·s/m]
  double rotational_damping = 2e-4;  ///< of the gimbal, against the base [N·m·s/rad]
  double friction = 0;               ///< Coulomb, of the mechanism against the base [N]
  double rotational_friction = 0;    ///< of the gimbal [N·m]
};

/// A hand as a spring and a damper between its own path and the handle. The defaults are a relaxed human grip.
struct Grip {
  double stiffness = 1000;            ///< [N/m]; 500 is loose, 1500 is firm
  double rotational_stiffness = 0.5;  ///< [N·m/rad]
  double damping_ratio = 1;           ///< of the grip's damper with the handle; 1 is critical
  double tremor = 0;                  ///< root mean square per axis [m]; 1e-4 is human
  double rotational_tremor = 0;       ///< root mean square per axis [rad]; 1e-3 is human
  std::uint32_t seed = 1;             ///< of the tremor
};

/// Handle and hand, integrated with semi-implicit Euler in equal substeps of a tick.
///
///     m a = k (x_path − x) + c (v_path − v) − b v + F,   c = 2 ζ √(k m)
///
/// and the same for rotations, with e = Log(R_path Rᵀ). Time advances by the period only, never by a clock: the same path, seed and
/// wrenches give the same poses, bit for bit. Coulomb friction takes speed off at the end of each substep, and never turns it: a handle
/// sticks where nothing pushes it harder.
class SimulatedHand {
 public:
  /// At rest on the start of the path.
  /// @param period    of a tick [s]
  /// @param substeps  of the integration, per tick
  /// Refuses (`std::invalid_argument`) values that are not positive and grips that are too stiff or too damped for the substep.
  SimulatedHand(DevicePath path, const Handle& handle = {}, const Grip& grip = {}, double period = 1e-3, int substeps = 10);

  /// One tick, with this wrench on the handle for all of it; it must be finite.
  void advance(const DeviceWrench& wrench) noexcept;

  /// Puts the handle there, at rest; the time goes on.
  void place(const DevicePose& pose) noexcept { pose_ = pose, velocity_ = {}; }

  const DevicePose& pose() const noexcept { return pose_; }  ///< exact, before any encoder
  double time() const noexcept;                              ///< since the start [s]

 private:
  struct Velocity {
    double linear[3] = {0, 0, 0};   // [m/s]
    double angular[3] = {0, 0, 0};  // [rad/s], base axes
  };

  DevicePose target(double time) const noexcept;

  DevicePath path_;
  Handle handle_;
  Grip grip_;
  Tremor tremor_;
  double period_;
  int substeps_;
  std::int64_t ticks_ = 0;
  DevicePose pose_;
  DevicePose target_;
  Velocity velocity_;
};

}  // namespace feeler
