// Devices of 3D Systems through OpenHaptics: Phantom Premium, Touch and Touch X.
#pragma once

#include <string>
#include <vector>

#include "feeler/device/clock.hpp"
#include "feeler/device/driven_device.hpp"
#include "feeler/device/maker_libraries.hpp"

namespace feeler {

/// How to find a device of OpenHaptics.
struct OpenHapticsSettings {
  std::vector<std::string> libraries = open_haptics_libraries();  ///< tried in this order
  std::string device_name;  ///< as its setup program calls it, "Default Device" for example; empty takes the
                            ///< default one
};

/// A device behind libHD.so, which is loaded by `open`.
///
/// The servo thread of libHD exchanges pose and wrench once a frame; `read` and `write` hand them over
/// without waiting. So a slow renderer never holds up that thread, and it is a watchdog: from the third frame
/// without a new wrench on, it pushes nothing. An error of the device silences it at once, until a wrench is
/// written by somebody who has read of the error; only an error from which libHD does not recover ends the
/// session.
///
/// Millimetres and millinewton metres end here. The torque goes out in base axes (HD_CURRENT_TORQUE), never
/// as joint torques of the gimbal.
///
/// Several devices, each by its name, share that thread. It pauses while a further one is opened: open all of
/// them before you start a loop. Those that are closed leave the others alone. While no frame comes for 20 ms, the
/// stylus is in its inkwell, or the safety switch is on, `read` is a warning and nothing is pushed.
///
/// `open` waits up to a second for the first pose. A device that can calibrate itself does so in its first
/// frames; one that needs a hand for it is refused, as its poses would be wrong. Its specification is that of
/// a Phantom Premium 3.0/6DOF until `open` asks the device.
class OpenHapticsDevice final : public DrivenDevice {
 public:
  /// @param clock  stamps the poses, outlives the device; none is CLOCK_MONOTONIC
  explicit OpenHapticsDevice(OpenHapticsSettings settings = {}, Clock* clock = nullptr);
};

}  // namespace feeler
