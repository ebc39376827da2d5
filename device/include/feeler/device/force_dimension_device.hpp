// Devices of Force Dimension through its DHD library: omega, sigma, lambda, delta, and the Novint Falcon.
#pragma once

#include <string>
#include <vector>

#include "feeler/device/clock.hpp"
#include "feeler/device/driven_device.hpp"

namespace feeler {

/// How to find a device of Force Dimension.
struct ForceDimensionSettings {
  /// Tried in this order; libdrd contains all of libdhd.
  std::vector<std::string> libraries = {"libdrd.so", "libdrd.so.3", "libdhd.so", "libdhd.so.3",
                                        "/usr/local/lib/libdrd.so.3"};
};

/// A device behind libdrd.so or libdhd.so, which is loaded by `open`; `read` and `write` call it directly.
///
/// The library's base frame is x to the user, y right, z up; poses and wrenches are turned into ours here.
/// Its gravity compensation is switched on, and lives on every tick being written. A device without a driven
/// wrist is force-only. A pose that it has not renewed since the last `read` keeps its time; that is no
/// error. Its specification is that of an omega.6 until `open` asks the device.
class ForceDimensionDevice final : public DrivenDevice {
 public:
  /// @param clock  stamps the poses, outlives the device; none is CLOCK_MONOTONIC
  explicit ForceDimensionDevice(ForceDimensionSettings settings = {}, Clock* clock = nullptr);
};

}  // namespace feeler
