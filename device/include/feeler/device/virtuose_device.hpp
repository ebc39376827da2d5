// Devices of Haption through its Virtuose library: Virtuose 6D, 6D Desktop and their relatives.
#pragma once

#include <string>
#include <vector>

#include "feeler/device/clock.hpp"
#include "feeler/device/driven_device.hpp"
#include "feeler/device/maker_libraries.hpp"

namespace feeler {

/// How to find a device of Haption.
struct VirtuoseSettings {
  std::vector<std::string> libraries = virtuose_libraries();  ///< tried in this order
  std::string address = "localhost#5000";  ///< of the controller: host or IP, '#', port
  double period = 1e-3;                    ///< of the servo loop, told to the controller [s]
};

/// A device behind libvirtuose.so, which is loaded by `open`; it runs in impedance mode, and `read` and
/// `write` call it directly.
///
/// The library speaks single precision, in the frame x to the user, y right, z up; both end here. Its own
/// indexing is off: clutching belongs to the workspace map. While its emergency stop is pressed, its power
/// off or its dead man's switch released, it pushes nothing and every `read` is a warning, so that the force
/// comes back by the ramp and not at once. An overheated motor is told as its highest temperature, and a pose
/// that the controller has not renewed for two periods keeps its time. The library does not say which model
/// it is: the specification is that of a Virtuose 6D, cut to what SOFA lets it push.
class VirtuoseDevice final : public DrivenDevice {
 public:
  /// Refuses (`std::invalid_argument`) a period that is not from 0.00001 to 1 s.
  /// @param clock  stamps the poses, outlives the device; none is CLOCK_MONOTONIC
  explicit VirtuoseDevice(VirtuoseSettings settings = {}, Clock* clock = nullptr);
  /// The sentence with which the constructor refuses; empty where it does not. For `try_make`.
  static std::string reason_against(const VirtuoseSettings& settings = {}, const Clock* clock = nullptr);
};

}  // namespace feeler
