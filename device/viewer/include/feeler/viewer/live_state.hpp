// What the servo loop tells its watchers, as plain numbers: a sample of every tick, and a snapshot of the
// latest.
#pragma once

#include <array>
#include <cstdint>

#include "feeler/device/device_state.hpp"

namespace feeler::viewer {

/// What a strip chart shows of one tick. SI units, world axes.
struct TickSample {
  double time = 0;                  ///< of the tick's deadline, since the loop began [s]
  DeviceWrench wrench;              ///< that the renderer wants the hand to feel
  double offset = 0;                ///< from the haptic to the graphic tool [m]
  double turn = 0;                  ///< the same of rotations [rad]
  double compute_microseconds = 0;  ///< of the renderer's update alone
  double late_microseconds = 0;     ///< from the deadline to the start of the tick
  std::int32_t contacts = 0;        ///< that hold the tool
  std::int32_t iterations = 0;
  std::int32_t missed = 0;  ///< deadlines skipped just before this tick
  bool has_converged = false;
  bool has_folded = false;  ///< the local solution vanished, and the tool slid on to another one
};

/// A contact that holds the tool, or one that was recognised.
struct ShownContact {
  int type = 0;  ///< of Table 1 of the paper, 1 to 12; 0 for an active row of the optimisation
  std::array<double, 3> point = {};   ///< [m]
  std::array<double, 3> normal = {};  ///< unit, from the object to the tool
  double gap = 0;                     ///< [m]
  double force = 0;                   ///< share of the contact force [N]; 0 for a recognised one
};

/// Who moves the hand.
enum class HandMode : std::int32_t {
  still,   ///< nobody: it stays where it is
  motion,  ///< the motion that belongs to the scene
  person,  ///< somebody at a page
  device,  ///< somebody at a real device
};

/// The latest tick, as a picture shows it.
struct Snapshot {
  static constexpr int contact_capacity = 8;

  std::int64_t tick = 0;
  double time = 0;         ///< [s]
  std::int32_t stage = 0;  ///< number of the scene on show; it grows with every change
  HandMode mode = HandMode::still;
  DevicePose haptic;
  DevicePose graphic;
  DeviceWrench wrench;
  std::int32_t status = 0;  ///< a `TickStatus`
  std::int32_t iterations = 0;
  std::int32_t rows = 0;
  std::int32_t work = 0;
  std::int64_t missed = 0;  ///< deadlines since the loop began
  std::int32_t contact_count = 0;
  std::array<ShownContact, contact_capacity> contacts = {};  ///< those that hold the tool
};

}  // namespace feeler::viewer
