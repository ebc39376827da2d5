// Which devices there are: the drivers by name, and the search for one that answers.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "feeler/device/device.hpp"

namespace feeler {

/// The makers whose devices Feeler drives.
enum class Maker { open_haptics, force_dimension, virtuose };

constexpr std::array<Maker, 3> all_makers = {Maker::open_haptics, Maker::force_dimension, Maker::virtuose};

/// Its name for a command line: "openhaptics", "forcedimension", "virtuose".
const char* name_of(Maker maker) noexcept;
/// The other way round; nothing for another name.
std::optional<Maker> maker_named(std::string_view name) noexcept;

/// A driver that is not open yet.
/// @param library  file of the maker's library; empty for its usual names
/// @param period   of the servo loop, for makers that want to know it [s]
std::unique_ptr<Device> make_device(Maker maker, const std::string& library = {}, double period = 1e-3);

/// What a search found of one maker.
struct DeviceListing {
  Maker maker;
  DeviceSpecification device;  ///< of the device that answered
  std::string problem;         ///< why none did, in a sentence; empty if one did
};

/// Opens one device of each maker, with its force at zero, and closes it again. Takes seconds.
std::vector<DeviceListing> list_devices();

/// The listing as a paragraph a maker, for a terminal.
std::string to_string(const DeviceListing& listing);

}  // namespace feeler
