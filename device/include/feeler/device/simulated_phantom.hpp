// A simulated Phantom Premium 3.0/6DOF in a simulated hand, for tests, benchmarks and desks without a device.
#pragma once

#include "feeler/device/device.hpp"
#include "feeler/device/simulated_hand.hpp"

namespace feeler {

/// Settings of a `SimulatedPhantom`; the handle takes its mass, inertia and damping from the specification.
struct SimulatedPhantomSettings {
  DeviceSpecification specification = phantom_premium_3_0_6dof();
  Grip grip = {};
  double period = 1e-3;  ///< by which each `read` advances the simulation [s]
  int substeps = 10;     ///< of the integration, per period
  bool has_friction = false;         ///< the Coulomb friction of the specification
  double rotational_friction = 0;    ///< of the gimbal, which no specification tells [N·m]
};

/// A device whose hand follows a path. Each `read` after the first is one tick of `period`, so it never asks a clock.
///
/// What it has of the real device: the encoder grid of the reported pose; force and torque cut to the maximum with their direction kept;
/// and one tick of delay: a wrench written in tick n pushes from tick n + 1 on. Same path, seed and wrenches: same poses, bit for bit.
class SimulatedPhantom final : public Device {
 public:
  /// Refuses (`std::invalid_argument`) what `SimulatedHand` refuses.
  explicit SimulatedPhantom(DevicePath path, const SimulatedPhantomSettings& settings = {});

  /// The hand at rest on the start of its path, at time 0, pushed by nothing. Never fails.
  OpenResult open() override;
  /// The first call reports time 0; each later one advances by the period.
  DeviceStatus read(DeviceState& state) noexcept override;
  DeviceStatus write(const DeviceWrench& wrench) noexcept override;
  void close() noexcept override { is_open_ = false; }
  const DeviceSpecification& specification() const noexcept override { return settings_.specification; }
  bool lives_by_the_clock() const noexcept override { return false; }

  /// Where the handle truly is, before the encoders.
  const DevicePose& exact_pose() const noexcept { return hand_.pose(); }
  /// Buttons to report from now on; call it from the thread that reads.
  void press(std::uint32_t buttons) noexcept { buttons_ = buttons; }

 private:
  SimulatedPhantomSettings settings_;
  SimulatedHand at_start_;
  SimulatedHand hand_;
  DeviceWrench written_;  // in this tick
  DeviceWrench pushing_;  // on the handle now
  std::uint32_t buttons_ = 0;
  bool is_open_ = false;
  bool is_started_ = false;
};

}  // namespace feeler
