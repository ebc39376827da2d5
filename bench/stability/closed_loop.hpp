// One run of the loop: hand, device and renderer, and what is measured of it.
#pragma once

#include <string>
#include <vector>

#include "feeler/device/device_specification.hpp"
#include "feeler/device/simulated_hand.hpp"
#include "stability/situations.hpp"

namespace feeler::stability {

/// What is between the ticks of the renderer and those of the device.
enum class Handover {
  direct,        ///< the renderer runs in the servo loop
  held,          ///< the renderer is slower, on a thread of its own; its last wrench is held
  extrapolated,  ///< the same, and goes on with the derivative of the wrench
};

/// A loop to be judged.
struct LoopSetup {
  DeviceSpecification device;
  Grip grip;
  double rate = 1000;                 ///< of the servo loop [Hz]
  double stiffness = 1000;            ///< [N/m]
  double rotational_stiffness = 0.1;  ///< [N·m/rad]; of what is shown, also where no motor turns the handle
  Engine engine = Engine::feeler;
  Handover handover = Handover::direct;
  int divider = 1;           ///< servo ticks to a tick of the renderer
  int latency = 0;           ///< servo ticks until a wrench of the slower renderer is there
  bool has_friction = true;  ///< Coulomb friction of the specification
  double kick = 1;           ///< share of the kick of a hold
  bool is_passive = false;   ///< with passivity control
};

/// One row of a trace.
struct TracePoint {
  double time = 0;      ///< [s]
  double position = 0;  ///< of the handle along the press, from the contact [m or rad]
  double force = 0;     ///< pushed, along the press [N or N·m]
};

/// What a run showed.
struct LoopResult {
  bool is_finite = true;
  double swing_start = 0;  ///< peak to peak of the handle in the first 0.8 s looked at, any axis [m]
  double swing_end = 0;    ///< peak to peak in the last 0.8 s: of a hold, its limit cycle [m]
  double turn_start = 0;   ///< the same of rotations [rad]
  double turn_end = 0;
  double buzz_end = 0;             ///< of the last 0.8 s [N]
  double torque_buzz_end = 0;      ///< [N·m]
  double buzz = 0;                 ///< RMS of the pushed force above 50 Hz, while held or sliding [N]
  double torque_buzz = 0;          ///< [N·m]
  double greatest_force_step = 0;  ///< between two ticks, while held or sliding [N]
  bool is_stable = false;
  std::vector<TracePoint> trace;  ///< if asked for
};

/// What still counts as rest: swings of two encoder counts, or 5 µm and 0.1 mrad, whichever is more; and a
/// hum above 50 Hz of a twentieth of what the hand presses with.
struct Rest {
  double swing, turn;        // [m], [rad]
  double buzz, torque_buzz;  // [N], [N·m]
};
Rest rest_of(const DeviceSpecification& device) noexcept;

/// From one of the two windows that end a hold to the other, a swing that dies keeps at most this share. A
/// handle that is barely held swings by itself, slowly, and keeps up to 0.7.
constexpr double decay_of_a_stable_loop = 0.8;
constexpr double window = 0.8;  ///< [s]

/// A hold: the hand comes down in 0.2 s until it presses with `press_of`, is kicked by 1 N (0.02 N·m) for 5
/// ms at 0.45 s, and is looked at in two windows, from 0.9 s and from 1.7 s to 2.5 s. Stable: bounded, at
/// rest or dying, and without a hum in the second window.
///
/// A slide: the hand comes down and goes on at 50 mm/s; what is measured is measured while it slides.
LoopResult run_loop(const Situation& situation, const Pose<double>& contact, const LoopSetup& setup, bool with_trace = false);

/// How hard the hand presses: half of what the device can push for ever, at most 1 N and 0.02 N·m.
double press_of(const DeviceSpecification& device, bool turns) noexcept;

}  // namespace feeler::stability
