// Devices of Force Dimension through its DHD library: omega, sigma, lambda, delta, and the Novint Falcon.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "feeler/device/clock.hpp"
#include "feeler/device/driven_device.hpp"
#include "feeler/device/maker_libraries.hpp"

namespace feeler {

/// How to find a device of Force Dimension.
struct ForceDimensionSettings {
  std::vector<std::string> libraries = force_dimension_libraries();  ///< tried in this order; libdrd contains all of libdhd
  std::optional<int> serial_number = {};  ///< of one of several devices; goes before the index
  std::optional<int> index = {};  ///< of one of several, from 0 as the library counts them; neither takes the
                                  ///< first that is free
  bool initialises = false;  ///< lets a device that is not calibrated do it by itself: it moves, so hands
                             ///< off; needs libdrd
};

/// A device behind libdrd.so or libdhd.so, which is loaded by `open`; `read` and `write` call it directly.
///
/// The library's base frame is x to the user, y right, z up; poses and wrenches are turned into ours here.
/// Its gravity compensation is switched on, and lives on every tick being written. A device without a driven
/// wrist is force-only. A pose that it has not renewed since the last `read` keeps its time; that is no
/// error. Its specification is that of an omega.6 until `open` asks the device.
///
/// A device that is not calibrated is refused, as its poses would be wrong, or initialises itself where the
/// settings say so. While it has no power or its force is off, by its button for example, it pushes nothing
/// and every `read` is a warning that says why. A driven gripper is left free.
class ForceDimensionDevice final : public DrivenDevice {
 public:
  /// @param clock  stamps the poses, outlives the device; none is CLOCK_MONOTONIC
  explicit ForceDimensionDevice(ForceDimensionSettings settings = {}, Clock* clock = nullptr);
};

}  // namespace feeler
