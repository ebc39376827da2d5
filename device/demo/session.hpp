// One run of one scene: a device in a simulated or a real hand, the renderer, and the servo loop that joins
// them.
#pragma once

#include <functional>
#include <string>

#include "feeler/device/device_catalogue.hpp"
#include "feeler/device/simulated_phantom.hpp"
#include "recording.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// What a session needs besides its scene.
struct SessionSettings {
  double rate = 1000.0;  ///< [Hz]
  double seconds = 8.0;
  std::uint32_t seed = 1;            ///< of the tremor of the simulated hand
  std::string device = "simulated";  ///< or auto, or the name of a maker
  DeviceChoice choice = {};          ///< of the maker; empty for the usual device
  double workspace_scale = 1.0;      ///< of a real device
  bool record = false;               ///< keep what passed between device and renderer
};

/// What can be told about a running session.
struct Progress {
  double time = 0.0;          ///< of the run [s]
  double rate = 0.0;          ///< achieved since the last report [Hz]
  double microseconds = 0.0;  ///< of the latest tick
  int contacts = 0;
  double force = 0.0;       ///< norm [N]
  std::int64_t missed = 0;  ///< deadlines so far
};
using ProgressSink = std::function<void(const Progress&)>;

/// The simulated device of a session: a Phantom Premium 3.0/6DOF in a steady hand.
SimulatedPhantomSettings device_settings(const SessionSettings& settings);

/// Runs the scene in real time and records every tick; reports about twice a second on the caller's thread.
/// A real device begins at the start pose of the scene, wherever its handle is; its first button is a clutch,
/// and an interrupt from the keyboard stops its force.
/// @throws BadInput when the start pose penetrates, the library refuses the mesh, or the device does not open
Recording run_session(const scenes::Scene& scene, const SessionSettings& settings, const ProgressSink& report);

}  // namespace feeler::demo
